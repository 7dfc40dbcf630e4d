// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers at cut facets in general position.
//
// They are known at one point of an item: a corner in the cell, or the middle of the item's part
// there, to which a segment is traced. From it to the middle of any part there is a straight way
// within the item, and what it crosses are segments of contacts.

#include <trisect/bsp/leaf/doubles/filtered_cutting.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// The axis along which two points are farthest apart.
std::size_t longest_axis(const Approximation& a, const Approximation& b) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(b.c[k] - a.c[k]) > std::fabs(b.c[axis] - a.c[axis])) axis = k;
    return axis;
}

}  // namespace

// A point in the interior of a part.
Approximation FilteredCutting::middle_of(const FilteredPart& part, int attempt) const {
    static constexpr std::array<std::array<double, 3>, 4> weights{
        {{1, 1, 1}, {3, 5, 11}, {7, 2, 4}, {1, 6, 2}}};
    const auto& weight = weights[static_cast<std::size_t>(attempt)];
    const std::size_t n = part.size;
    const std::array<std::size_t, 3> corners{0, n / 3, 2 * n / 3};
    const double total = weight[0] + weight[1] + weight[2];
    Approximation m;
    double largest = 0;
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Approximation& a = vertices_[static_cast<std::size_t>(part.vertices[corners[i]])].at;
        error = std::max(error, a.error);
        for (std::size_t k = 0; k < 3; ++k) {
            m.c[k] += weight[i] * a.c[k] / total;
            largest = std::max(largest, std::fabs(a.c[k]));
        }
    }
    m.error = error_slack * error + largest * 0x1p-49;
    return m;
}

// -1 below the contact's support, 1 above, for the middle of a part; 0 when nothing decides. Where
// its corners are on one side of the support, so is the middle.
int FilteredCutting::sign_at_middle(const FilteredPart& part, const Approximation& middle,
                                    int attempt, std::size_t contact) {
    const int s = facets_->plane(contacts_[contact].other).sign(middle);
    if (s != 0 || attempt > 0) return s;
    int low = 1;
    int high = -1;
    for (std::size_t i = 0; i < part.size; ++i) {
        const int at = sign_at(part.vertices[i], contact);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return low >= 0 ? high : (high <= 0 ? low : 0);
}

bool FilteredCutting::trace_start() {
    for (int attempt = 0; attempt < 4; ++attempt) {
        start_ = middle_of(clipped_, attempt);
        if (!windings_->at_point(start_, (*facets_)[item_].operand, *stats_, start_windings_))
            continue;
        bool sure = true;
        start_sides_.clear();
        for (const FilteredContact& c : contacts_) {
            start_sides_.push_back(static_cast<std::int8_t>(facets_->plane(c.other).sign(start_)));
            sure = sure && start_sides_.back() != 0;
        }
        if (sure) return true;
    }
    return false;
}

// Starts at a corner of the item that lies in the cell.
void FilteredCutting::start_at(const FilteredWindings::Anchor& anchor) {
    const auto known = windings_->windings(anchor.windings);
    start_windings_.assign(known.begin(), known.end());
    const auto corner = static_cast<std::size_t>(anchor.corner);
    start_ = facets_->corner((*facets_)[item_], corner);
    start_sides_.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c)
        start_sides_.push_back(static_cast<std::int8_t>(side_of_corner(c, corner)));
}

// How winding numbers change on the straight way from the start to a point of the item.
bool FilteredCutting::change_to(const FilteredPart& part, int attempt, std::size_t begin,
                                std::size_t end, int& change) {
    const Approximation middle = middle_of(part, attempt);
    change = 0;
    for (std::size_t c = begin; c < end; ++c) {
        const FilteredPlane& plane = facets_->plane(contacts_[c].other);
        const int at_end = sign_at_middle(part, middle, attempt, c);
        if (at_end == 0) return false;
        const int at_start = start_sides_[c];
        if (at_start == at_end) continue;
        Approximation x;
        if (!interpolate(start_, plane.value(start_.c), middle, plane.value(middle.c),
                         plane.error(start_) + plane.error(middle), x))
            return false;
        const auto& segment = crossing_of(c).ends;
        const std::size_t axis = longest_axis(segment[0].at, segment[1].at);
        const int first = compare_along(axis, x, segment[0].at);
        const int second = compare_along(axis, x, segment[1].at);
        if (first == 0 || second == 0) return false;
        if (first != second) change += at_start * (*facets_)[contacts_[c].other].orientation;
    }
    return true;
}

bool FilteredCutting::find_sides(const FilteredPart& part, LeafIndex operand, std::size_t begin,
                                 std::size_t end) {
    ++stats_->traces_within;
    const auto set = [&](int w) {
        formula_->set(above(part), as_index(operand), w);
        formula_->set(below(part), as_index(operand), w);
    };
    if (part.winding >= 0) {
        set(part.winding);
        return true;
    }
    for (int attempt = 0; attempt < 4; ++attempt) {
        int change = 0;
        if (!change_to(part, attempt, begin, end, change)) continue;
        set(start_windings_[as_index(operand)] + change);
        return true;
    }
    return false;
}

// An embedded operand has 0 outside its own facets and 1 inside.
void FilteredCutting::set_sides(const FilteredPart& part, std::span<const int> windings) {
    const FilteredFacet& f = (*facets_)[item_];
    std::copy(windings.begin(), windings.end(), above(part).begin());
    std::copy(windings.begin(), windings.end(), below(part).begin());
    above(part)[as_index(f.operand)] = f.orientation > 0 ? 0 : 1;
    below(part)[as_index(f.operand)] = f.orientation > 0 ? 1 : 0;
    formula_->fill(above(part));
    formula_->fill(below(part));
}

void FilteredCutting::settle(FilteredPart& part) {
    const int over = formula_->value(above(part));
    if (over < 0) return;
    const int under = formula_->value(below(part));
    if (under < 0) return;
    part.state = over == under ? FilteredPart::State::Dropped : FilteredPart::State::Kept;
    part.inside_above = over == 1;
}

}  // namespace trisect::detail
