// SPDX-License-Identifier: Apache-2.0
//
// Cutting of facets in leaves in general position: items, and their parts operand by operand.
//
// What crosses a facet in general position leaves a path of segments on it, and where two of them
// meet, an edge of the cutters' mesh pierces the facet. The facet is split along the whole line of
// a segment, within the part that the segment runs through, so parts stay convex
// (filtered_cutting_splits.cpp). Then the next segment begins on a line that was cut before,
// exactly at the point that both lines have in common (filtered_cutting_points.cpp). A part with
// known winding numbers (filtered_cutting_windings.cpp) bounds the result or not, and is cut no
// further.

#include <trisect/bsp/leaf/doubles/filtered_cutting.h>

#include <algorithm>
#include <limits>

#include <trisect/bsp/cells/facet_in_cell.h>
#include <trisect/bsp/leaf/straight_crossings.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// Contacts are compared pair by pair for common planes.
constexpr std::size_t many_contacts = 200;

}  // namespace

void FilteredCutting::start(FilteredFacets& facets, const FilteredPairs& pairs,
                            FilteredWindings& windings, LeafFormula& formula,
                            std::span<const int> open, EvaluateStats& stats) {
    keeps_common_lines_ = may_have_straight_crossings(facets.problem());
    found_common_lines_ = false;
    facets_ = &facets;
    pairs_ = &pairs;
    windings_ = &windings;
    formula_ = &formula;
    open_ = open;
    stats_ = &stats;
    n_ = facets.operand_count();
    row_ = formula.row_size();
    answers_.fill({});
}

FilteredPart& FilteredCutting::add_part() {
    if (count_ == parts_.size()) parts_.emplace_back();
    FilteredPart& p = parts_[count_++];
    p.state = FilteredPart::State::Open;
    p.sides = sides_.size();
    sides_.resize(sides_.size() + 2 * row_);
    return p;
}

// The whole outline.
bool FilteredCutting::make_shape() {
    vertices_.clear();
    exact_signs_.clear();
    const FilteredFacet& f = (*facets_)[item_];
    facets_->make_outline(item_);
    clipped_.size = 0;
    clipped_.above = 0;
    for (std::size_t c = 0; c < f.size; ++c) {
        FilteredVertex& v = vertices_.emplace_back();
        v.at = facets_->corner(f, c);
        v.lines = {static_cast<FilteredLine>(c == 0 ? f.size - 1U : c - 1),
                   static_cast<FilteredLine>(c)};
        clipped_.add(static_cast<std::int16_t>(c), static_cast<FilteredLine>(c), f.edge(c).above);
    }
    was_clipped_ = false;
    return contacts_.size() <= many_contacts;
}

void FilteredCutting::start_item(LeafIndex item) {
    item_ = item;
    has_common_lines_ = false;
    contacts_ = pairs_->contacts(item);
    sides_.clear();
    count_ = 0;
    planes_.clear();
    plane_of_line_.clear();
    exact_signs_.clear();
}

// Whether an operand other than a facet's own decides the formula on both of its sides.
bool FilteredCutting::is_covered(LeafIndex operand, std::span<const int> windings) const {
    for (std::size_t o = 0; o < open_.size(); ++o)
        if (windings[o] != open_[o] && o != as_index(operand)) return true;
    return false;
}

FilteredCutting::Result FilteredCutting::whole(LeafIndex item) {
    start_item(item);
    const FilteredFacet& f = (*facets_)[item];
    LeafIndex windings = windings_->anchor_of(item, *stats_).windings;
    const int key = 2 * f.operand + (f.orientation > 0 ? 1 : 0);
    const auto answer_for = [&](LeafIndex w) -> Answer& {
        return answers_[(4 * as_index(w) + static_cast<std::size_t>(key)) % answers_.size()];
    };
    const auto is_known = [&](LeafIndex w) {
        return answer_for(w).windings == w && answer_for(w).key == key;
    };
    if (windings >= 0 && is_known(windings)) return answer_for(windings).result;
    if (windings < 0) {
        if (!f.contained && f.is_whole() &&
            certainly_misses(f.ref, facets_->problem().cell.lattice_box()))
            return {};
        if (!make_shape() || !clip_to_cell()) return {Remains::Uncertain, false};
        if (clipped_.size == 0) return {};  // listed for its box, but not in the cell
        windings = windings_->from_clear_boxes(item, *stats_);
        if (windings < 0) {
            if (!trace_start()) return {Remains::Uncertain, false};
            windings = windings_->remember(item, start_windings_);
        }
        if (is_known(windings)) return answer_for(windings).result;
    }
    Result result;
    if (!is_covered(f.operand, windings_->windings(windings))) {
        FilteredPart& part = add_part();
        set_sides(part, windings_->windings(windings));
        settle(part);
        if (part.state == FilteredPart::State::Kept) result = {Remains::Uncut, part.inside_above};
    }
    answer_for(windings) = {windings, key, result};
    return result;
}

std::optional<std::span<const int>> FilteredCutting::windings_on(LeafIndex item) {
    start_item(item);
    if (const auto at = windings_->anchor_of(item, *stats_).windings; at >= 0)
        return windings_->windings(at);
    if (!make_shape() || !clip_to_cell()) return std::nullopt;
    if (clipped_.size == 0) return std::span<const int>();
    if (!trace_start()) return std::nullopt;
    return start_windings_;
}

// Makes the item its first part, without a shape. False when it cannot bound the result.
bool FilteredCutting::add_item() {
    known_windings_.assign(start_windings_.begin(), start_windings_.end());
    for (const FilteredContact& c : contacts_)
        known_windings_[as_index((*facets_)[c.other].operand)] = unknown_winding;
    const FilteredPart& part = add_part();
    set_sides(part, known_windings_);
    const int over = formula_->value(above(part));
    return over < 0 || over != formula_->value(below(part));
}

FilteredCutting::Result FilteredCutting::cut(LeafIndex item) {
    constexpr Result uncertain{Remains::Uncertain, false};
    start_item(item);
    const auto operand_at = [&](std::size_t c) { return (*facets_)[contacts_[c].other].operand; };
    // Winding numbers at a corner may show at once that the item lies within some other solid.
    const FilteredWindings::Anchor anchor = windings_->anchor_of(item, *stats_);
    if (anchor.windings >= 0) {
        start_at(anchor);
        if (!add_item()) return {};
    }
    if (!make_shape() || !join_coplanar() || !clip_to_cell()) return uncertain;
    if (clipped_.size == 0) return {};
    if (anchor.windings < 0) {
        if (!trace_start()) return uncertain;
        if (!add_item()) return {};
    }
    const std::size_t sides = parts_[0].sides;
    parts_[0] = clipped_;
    parts_[0].state = FilteredPart::State::Open;
    parts_[0].sides = sides;
    settle(parts_[0]);
    // First by those operands that the start lies in: they are likely to decide about large parts.
    for (const bool around : {true, false}) {
        for (std::size_t begin = 0; begin < contacts_.size();) {
            std::size_t end = begin + 1;
            while (end < contacts_.size() && operand_at(end) == operand_at(begin)) ++end;
            if ((start_windings_[as_index(operand_at(begin))] > 0) == around &&
                !cut_by(operand_at(begin), begin, end))
                return uncertain;
            begin = end;
        }
    }
    stats_->pieces += count_;
    found_common_lines_ = found_common_lines_ || has_common_lines_;
    return remains();
}

bool FilteredCutting::cut_by(LeafIndex operand, std::size_t begin, std::size_t end) {
    const std::size_t o = as_index(operand);
    const std::size_t before = count_;
    for (std::size_t k = 0; k < before; ++k) {
        if (parts_[k].state != FilteredPart::State::Open) continue;
        const bool above_matters = formula_->value(above(parts_[k])) < 0;
        const bool below_matters = formula_->value(below(parts_[k])) < 0;
        const std::size_t first = count_;
        {
            const std::size_t sides = add_part().sides;
            parts_[first] = parts_[k];
            parts_[first].sides = sides;
            parts_[first].winding = -1;
            std::copy_n(above(parts_[k]).begin(), 2 * row_, above(parts_[first]).begin());
        }
        // Nothing but the first cutter can have cut a whole item in the cell: it need not be
        // tested.
        bool sure = first == 1 && (*facets_)[item_].contained;
        is_common_line_ = false;
        for (std::size_t c = begin; c < end; ++c) {
            const std::size_t last = count_;
            for (std::size_t j = first; j < last; ++j)
                if (split(j, c, sure) == Split::Uncertain) return false;
            sure = false;
        }
        for (std::size_t j = first; j < count_; ++j)
            if (!find_sides(parts_[j], operand, begin, end)) return false;
        has_common_lines_ = has_common_lines_ || is_common_line_;
        if (count_ == first + 1 ||
            (!is_common_line_ && same_sides(first, operand, above_matters, below_matters))) {
            // Undone, if anything was cut.
            FilteredPart& part = parts_[k];
            if (above_matters) formula_->set(above(part), o, above(parts_[first])[o]);
            if (below_matters) formula_->set(below(part), o, below(parts_[first])[o]);
            if (count_ > first + 1) ++stats_->cuts_undone;
            count_ = first;
            settle(part);
            continue;
        }
        for (std::size_t j = first; j < count_; ++j) settle(parts_[j]);
        // The first of the new parts takes the place of the old one, the last one its place.
        parts_[k] = parts_[first];
        --count_;
        if (first != count_) parts_[first] = parts_[count_];
    }
    return true;
}

bool FilteredCutting::same_sides(std::size_t first, LeafIndex operand, bool above_matters,
                                 bool below_matters) const {
    const std::size_t o = as_index(operand);
    const auto over = [&](std::size_t j) { return sides_[parts_[j].sides + o]; };
    const auto under = [&](std::size_t j) { return sides_[parts_[j].sides + row_ + o]; };
    for (std::size_t j = first + 1; j < count_; ++j)
        if ((above_matters && over(j) != over(first)) ||
            (below_matters && under(j) != under(first)))
            return false;
    return true;
}

FilteredCutting::Result FilteredCutting::remains() const {
    std::size_t kept = 0;
    bool uniform = true;
    bool inside_above = false;
    for (const FilteredPart& p : parts()) {
        if (p.state == FilteredPart::State::Open) return {Remains::Uncertain, false};
        if (p.state == FilteredPart::State::Dropped) continue;
        if (kept++ == 0) inside_above = p.inside_above;
        uniform = uniform && p.inside_above == inside_above;
    }
    if (kept == 0) return {};
    if (kept == count_ && uniform && (count_ == 1 || !has_common_lines_))
        return {Remains::Uncut, inside_above};
    return {Remains::Parts, false};
}

// A vertex of a new fragment in lattice units. Where points of one chain of cuts are made out of
// each other errors grow, so those that are large for the fragment are made anew.
Approximation FilteredCutting::in_lattice(std::int16_t vertex, double extent) const {
    const FilteredVertex& v = vertices_[static_cast<std::size_t>(vertex)];
    const FilteredFacet& f = (*facets_)[item_];
    const bool is_corner = vertex < f.size;
    if (is_corner && !f.is_whole())
        return f.ref.fragment->vertices()[static_cast<std::size_t>(vertex)];
    if (is_corner || v.at.error <= 0x1p-30 * extent) return facets_->in_lattice(v.at);
    return approximate(f.ref.source->support(f.ref.facet), plane_of(v.lines[0]).plane(),
                       plane_of(v.lines[1]).plane());
}

PolygonRef FilteredCutting::fragment(const FilteredPart& part) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vector3 lo{infinity, infinity, infinity};
    Vector3 hi{-infinity, -infinity, -infinity};
    for (std::size_t i = 0; i < part.size; ++i) {
        edges_[i] = {plane_of(part.lines[i]), (part.above >> i & 1U) != 0};
        const Approximation& a = vertices_[static_cast<std::size_t>(part.vertices[i])].at;
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], a.c[k] - a.error);
            hi[k] = std::max(hi[k], a.c[k] + a.error);
        }
    }
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, hi[k] - lo[k]);
    for (std::size_t i = 0; i < part.size; ++i) corners_[i] = in_lattice(part.vertices[i], extent);
    PolygonRef out = (*facets_)[item_].ref;
    out.fragment = Fragment::make(std::span(edges_).first(part.size),
                                  std::span(corners_).first(part.size), facets_->positions(lo, hi));
    return out;
}

}  // namespace trisect::detail
