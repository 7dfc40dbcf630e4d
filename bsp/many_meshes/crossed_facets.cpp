// SPDX-License-Identifier: Apache-2.0
//
// Both lists are divided by planes across the axes, down to few pairs, and compared there in
// doubles, what these leave open by integers. Facets that are long beside a cell are listed with
// the box of what lies in it, and not where that is nothing.

#include <trisect/bsp/many_meshes/crossed_facets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/task_group.h>

namespace trisect::detail {

namespace {

// Pairs that are compared as they are; more, where facets are few.
constexpr std::uint64_t few_pairs = 4000;
constexpr std::uint64_t pairs_of_few = 16000;
constexpr std::size_t few_items = 280;
// What a splitting plane may leave of the pairs; once in a row it may leave more.
constexpr double worthy_part_of_pairs = 0.75;

template <class Items>
std::uint64_t pairs_of(const Items& items) {
    return std::uint64_t{items[0].size()} * items[1].size();
}

template <class Items>
bool are_few_pairs(const Items& items) {
    const bool few = items[0].size() + items[1].size() <= few_items;
    return pairs_of(items) <= (few ? pairs_of_few : few_pairs);
}

// Fewer items of a cell are not worth a thread of their own.
constexpr std::size_t least_at_once = std::size_t{1} << 16;

constexpr std::array<std::size_t, 2> second_first{1, 0};

// So that no other cell lists it.
bool lies_within(const OutlineBox& box, const OutlineBox& bounds) {
    bool out = true;
    for (std::size_t k = 0; k < 3; ++k) {
        out &= bounds.lo[k] <= box.lo[k];
        out &= box.hi[k] < bounds.hi[k];
    }
    return out;
}

// A triangle, cut by planes across the axes: in doubles, off by no more than its margin.
class CutTriangle {
public:
    explicit CutTriangle(const std::array<Vector3, 3>& corners) {
        for (const Vector3& c : corners) {
            points_[count_++] = c;
            for (const double v : c) margin_ = std::max(margin_, 0x1p-45 * std::fabs(v));
        }
    }
    void cut(std::size_t axis, double at, bool below) {
        std::array<Vector3, most> out;
        std::size_t n = 0;
        const auto height = [&](const Vector3& p) { return below ? at - p[axis] : p[axis] - at; };
        for (std::size_t i = 0; i < count_; ++i) {
            const Vector3& p = points_[i];
            const Vector3& q = points_[i + 1 == count_ ? 0 : i + 1];
            const double a = height(p);
            const double b = height(q);
            if (a >= 0) out[n++] = p;
            if ((a >= 0) != (b >= 0)) {
                const double t = a / (a - b);
                for (std::size_t k = 0; k < 3; ++k) out[n][k] = p[k] + t * (q[k] - p[k]);
                ++n;
            }
        }
        points_ = out;
        count_ = n;
    }
    [[nodiscard]] double margin() const { return margin_; }
    [[nodiscard]] OutlineBox box() const {
        OutlineBox b = OutlineBox::none();
        for (std::size_t i = 0; i < count_; ++i) b.add(Approximation{points_[i], margin_});
        return b;
    }

private:
    static constexpr std::size_t most = 10;
    std::array<Vector3, most> points_;
    std::size_t count_ = 0;
    double margin_ = 0;
};

}  // namespace

bool CrossedFacetsFinder::find(const OutlinedSolid& first, const OutlinedSolid& second,
                               const Places& near, EvaluateStats& stats) {
    solids_ = {&first, &second};
    stats_ = &stats;
    found_.clear();
    known_.clear();
    all_known_.clear();
    is_shared_ = options_.threads != 1 && near[0].size() + near[1].size() >= 2 * least_at_once;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Cell cell;
    cell.bounds = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    for (std::size_t i = 0; i < 2; ++i) {
        cell.items[i].reserve(near[i].size());
        for (const std::uint32_t f : near[i]) cell.items[i].push_back({solids_[i]->boxes[f], f});
    }
    if (!is_shared_) return solve(cell);
    return isolated([&] { return solve(cell); });
}

bool CrossedFacetsFinder::solve(Cell& cell) {
    ++stats_->cells;
    check_budget(options_, *stats_);
    if (!leave_out(cell)) return true;
    if (are_few_pairs(cell.items)) return compare(cell);
    const Splitter splitter = splitter_of(cell);
    const bool stalls = splitter.part_left > worthy_part_of_pairs;
    if (stalls && cell.stalled) return compare(cell);
    cell.stalled = stalls;
    return with_enough_stack([&] { return divide(cell, splitter); });
}

// Takes out what does not meet the other ones' boxes in the cell; false when nothing is left.
bool CrossedFacetsFinder::leave_out(Cell& cell) const {
    for (std::size_t i = 0; i < 2; ++i) {
        OutlineBox& reach = cell.reach;
        reach = OutlineBox::none();
        for (const Item& item : cell.items[1 - i]) reach.add(item.box);
        for (std::size_t k = 0; k < 3; ++k) {
            reach.lo[k] = std::max(reach.lo[k], cell.bounds.lo[k]);
            reach.hi[k] = std::min(reach.hi[k], cell.bounds.hi[k]);
        }
        std::erase_if(cell.items[i], [&](Item& item) {
            if (reach.contains(item.box)) return false;
            if (!item.box.meets(reach)) return true;
            draw_in(i, item, reach);
            return !item.box.meets(reach);
        });
        if (cell.items[i].empty()) return false;
    }
    return true;
}

// A facet that is long beside the reach along two axes.
void CrossedFacetsFinder::draw_in(std::size_t solid, Item& item, const OutlineBox& reach) const {
    int along = 0;
    for (std::size_t k = 0; k < 3; ++k)
        along += 3 * (item.box.hi[k] - item.box.lo[k]) > reach.hi[k] - reach.lo[k] ? 1 : 0;
    if (along < 2) return;
    const OutlinedSolid::Facet& f = solids_[solid]->facets[item.place];
    CutTriangle part(meshes_.corners(f.slot, f.number - meshes_.operands->operands[f.slot].first));
    for (std::size_t k = 0; k < 3; ++k) {
        if (item.box.lo[k] < reach.lo[k]) part.cut(k, reach.lo[k] - part.margin(), false);
        if (item.box.hi[k] > reach.hi[k]) part.cut(k, reach.hi[k] + part.margin(), true);
    }
    const OutlineBox box = part.box();
    for (std::size_t k = 0; k < 3; ++k) {
        item.box.lo[k] = std::max(item.box.lo[k], box.lo[k]);
        item.box.hi[k] = std::min(item.box.hi[k], box.hi[k]);
    }
}

// In the middle, across the axis that leaves the fewest pairs.
CrossedFacetsFinder::Splitter CrossedFacetsFinder::splitter_of(const Cell& cell) {
    OutlineBox all = OutlineBox::none();
    for (const auto& items : cell.items)
        for (const Item& item : items) all.add(item.box);
    Splitter best;
    best.part_left = 2;
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = std::max(all.lo[k], cell.bounds.lo[k]);
        const double high = std::min(all.hi[k], cell.bounds.hi[k]);
        Splitter s{k, low + (high - low) / 2, 0, {}};
        double below = 1;
        double above = 1;
        for (std::size_t i = 0; i < 2; ++i) {
            const PoolVector<Item>& items = cell.items[i];
            auto& [first, second] = s.counts[i];
            for (const Item& item : items) {
                first += item.box.lo[k] < s.at ? 1 : 0;
                second += item.box.hi[k] >= s.at ? 1 : 0;
            }
            below *= static_cast<double>(first) / static_cast<double>(items.size());
            above *= static_cast<double>(second) / static_cast<double>(items.size());
        }
        s.part_left = below + above;
        if (s.part_left < best.part_left) best = s;
    }
    return best;
}

bool CrossedFacetsFinder::divide(Cell& cell, const Splitter& splitter) {
    const auto& [axis, at, part_left, counts] = splitter;
    std::array<Cell, 2> children;
    for (Cell& c : children) {
        c.bounds = cell.bounds;
        c.stalled = cell.stalled;
    }
    children[0].bounds.hi[axis] = children[1].bounds.lo[axis] = at;
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < 2; ++k) children[k].items[i].reserve(counts[i][k]);
        for (const Item& item : cell.items[i]) {
            if (item.box.lo[axis] < at) children[0].items[i].push_back(item);
            if (item.box.hi[axis] >= at) children[1].items[i].push_back(item);
        }
        cell.items[i] = {};
    }
    return solve_both(children);
}

// Large ones at the same time; what is found is the same, in the same order.
bool CrossedFacetsFinder::solve_both(std::array<Cell, 2>& cells) {
    const auto is_large = [](const Cell& c) {
        return c.items[0].size() + c.items[1].size() >= least_at_once;
    };
    if (!is_shared_ || !std::ranges::all_of(cells, is_large))
        return solve(cells[0]) && solve(cells[1]);
    SpecialPosition special(meshes_.facet_count());
    CrossedFacetsFinder other(meshes_, options_, special);
    EvaluateStats made;
    other.solids_ = solids_;
    other.stats_ = &made;
    other.is_shared_ = true;
    std::array<bool, 2> are_solved{};
    FirstFailure failure;
    fork_join([&] { failure.guard(1, [&] { are_solved[1] = other.solve(cells[1]); }); },
              [&] { failure.guard(0, [&] { are_solved[0] = solve(cells[0]); }); });
    failure.rethrow();
    *stats_ += made;
    add(other);
    return are_solved[0] && are_solved[1];
}

// What comes behind all of this.
void CrossedFacetsFinder::add(const CrossedFacetsFinder& other) {
    position_.add(other.position_);
    for (const CrossedFacets& c : other.found_)
        if (known_.find({c.places[0], c.places[1]}) < 0) found_.push_back(c);
    for (const auto& places : other.all_known_)
        if (known_.insert({places[0], places[1]}, 0).second && is_shared_)
            all_known_.push_back(places);
}

bool CrossedFacetsFinder::compare(const Cell& cell) {
    const std::size_t count = cell.items[0].size() + cell.items[1].size();
    ++stats_->mixed_leaves;
    ++stats_->filtered_leaves;
    stats_->listed_polygons += count;
    pairs_.start(count, cell.items[0][0].box.lo, cell.reach);
    for (const std::size_t i : second_first) {
        for (const Item& item : cell.items[i]) {
            const OutlinedSolid::Facet& f = solids_[i]->facets[item.place];
            pairs_.add(f.slot, f.number, item.box);
        }
        if (i == 1) pairs_.end_second();
    }
    leave_out_planes(cell);
    if (!pairs_.find()) return false;
    stats_->pairs_boxes += pairs_.box_pairs();
    stats_->pairs_touching += pairs_.crossings().size();
    stats_->pairs_cutting += pairs_.crossings().size();
    for (const WholeFacetPairs::Crossing& c : pairs_.crossings())
        keep(cell, places_of(cell, c.places), c.ends);
    decide(cell);
    return true;
}

// Facets of one plane do not cross, and what they touch is found for all of them together.
void CrossedFacetsFinder::leave_out_planes(const Cell& cell) {
    planes_.clear();
    for (const std::size_t i : second_first) {
        in_planes_[i].clear();
        for (const Item& item : cell.items[i]) {
            const OutlinedSolid::Facet& f = solids_[i]->facets[item.place];
            const std::uint32_t plane = special_.plane_across_axis(f.number);
            planes_.push_back(plane);
            if (plane != 0) in_planes_[i].push_back({plane, f.number, f.slot, item.box});
        }
        std::ranges::stable_sort(in_planes_[i], {}, &SpecialPairs::InCell::plane);
    }
    if (in_planes_[0].empty() || in_planes_[1].empty()) return;
    special_.look_at_planes(in_planes_[0], in_planes_[1]);
    pairs_.leave_out_planes(planes_);
}

void CrossedFacetsFinder::decide(const Cell& cell) {
    for (const WholeFacetPairs::Places& pair : pairs_.doubtful()) {
        ++stats_->doubtful_pairs;
        const std::array places = places_of(cell, pair);
        const auto crossing = special_.crossing(solids_[0]->facets[places[0]].number,
                                                solids_[1]->facets[places[1]].number);
        if (!crossing) continue;
        ++stats_->pairs_touching;
        ++stats_->pairs_cutting;
        keep(cell, places, crossing->ends);
    }
}

// A pair may be listed in several cells, but not where one of them is within this one. Of two parts
// the whole facets may cross somewhere else.
void CrossedFacetsFinder::keep(const Cell& cell, const std::array<std::uint32_t, 2>& places,
                               const std::array<FacetCrossing::End, 2>& ends) {
    const std::array facets{&solids_[0]->facets[places[0]], &solids_[1]->facets[places[1]]};
    const std::array boxes{&solids_[0]->boxes[places[0]], &solids_[1]->boxes[places[1]]};
    if (!facets[0]->whole || !facets[1]->whole) {
        OutlineBox box = OutlineBox::none();
        for (const FacetCrossing::End& end : ends) box.add(end.at);
        for (std::size_t i = 0; i < 2; ++i)
            if (!facets[i]->whole && !boxes[i]->meets(box)) return;
    }
    const bool is_once = lies_within(*boxes[0], cell.bounds) || lies_within(*boxes[1], cell.bounds);
    if (!is_once) {
        if (!known_.insert({places[0], places[1]}, 0).second) return;
        if (is_shared_) all_known_.push_back(places);
    }
    CrossedFacets& made = found_.emplace_back();
    made.places = places;
    made.crossing.ends = ends;
    for (std::size_t k = 0; k < 2; ++k) made.crossing.facets[k] = facets[k]->number;
}

}  // namespace trisect::detail
