// SPDX-License-Identifier: Apache-2.0
//
// Best first: the pair of boxes with the least lower bound is opened next, so that no pair is ever
// opened whose bound is above the distance. A pair of triangles at the front gives bounds above and
// below (triangle_distance.cpp); the search ends when the front is beyond the least upper bound.
// What remains are the pairs whose lower bound is not above it: nearly always one, or the few
// around a common edge or vertex. The exact distance is the least of theirs.

#include <trisect/bsp/interference/relation/distance_search.h>

#include <algorithm>

namespace trisect::detail {

namespace {

struct ByBound {
    template <class Entry>
    bool operator()(const Entry& a, const Entry& b) const {
        return a.bound > b.bound;
    }
};

}  // namespace

DistanceSearch::DistanceSearch(const Boundary& a, const Pose& pose_a, const Boundary& b,
                               const Pose& pose_b)
    : a_(&a), b_(&b), pairs_(PairDistance(a, pose_a, b, pose_b)) {
    pose_.emplace(a.boxes, b.boxes, pairs_->map());
    unit_ = a.boxes.unit * pairs_->least_stretch() * (1 - 0x1p-20);
}

void DistanceSearch::note(const Candidate& c) {
    if (!(c.bounds.lower <= upper_) || !(c.bounds.lower < limit_)) return;
    upper_ = std::min(upper_, c.bounds.upper);
    arrays_->candidates.push_back(c);
}

void DistanceSearch::push(float bound, ObbId a, ObbId b) {
    arrays_->heap.push_back({bound, a, b});
    std::push_heap(arrays_->heap.begin(), arrays_->heap.end(), ByBound{});
}

void DistanceSearch::expand(const Entry& e) {
    const ObbTree& ta = a_->boxes;
    const ObbTree& tb = b_->boxes;
    const bool leaf_a = ta.is_leaf(e.a);
    const bool leaf_b = tb.is_leaf(e.b);
    if (leaf_a && leaf_b) {
        const ObbChild ca = ta.child(e.a);
        const ObbChild cb = tb.child(e.b);
        for (std::uint32_t j = 0; j < cb.count(); ++j)
            for (std::uint32_t i = 0; i < ca.count(); ++i) {
                ++counters_.triangle_pairs;
                note(compare(ta.order[ca.first() + i], tb.order[cb.first() + j]));
            }
        return;
    }
    const auto size = [](const ObbTree& t, ObbId id) {
        const ObbNode& n = t.nodes[id.node()];
        return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
    };
    const bool open_b = leaf_a || (!leaf_b && pose_->scale() * size(tb, e.b) > size(ta, e.a));
    ++counters_.node_tests;
    const std::uint32_t node = open_b ? tb.child(e.b).node() : ta.child(e.a).node();
    const ObbNode& opened = open_b ? tb.nodes[node] : ta.nodes[node];
    const Float4 gaps =
        open_b ? pose_->best_gaps(ta.box(e.a), opened) : pose_->best_gaps(opened, tb.box(e.b));
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (!(opened.half[0][k] >= 0)) continue;
        // The parents' bound holds as well.
        const float bound = std::max(e.bound, gaps[k]);
        const double least = unit_ * static_cast<double>(bound);
        if (least > upper_ || least >= limit_) continue;
        push(bound, open_b ? e.a : ObbId::of(node, k), open_b ? ObbId::of(node, k) : e.b);
    }
}

void DistanceSearch::run(double limit, bool stop,
                         std::optional<std::array<std::uint32_t, 2>> start) {
    std::vector<Entry>& heap = arrays_->heap;
    heap.clear();
    arrays_->candidates.clear();
    limit_ = limit;
    upper_ = std::numeric_limits<double>::infinity();
    if (start) {
        // For its upper bound only: the walk comes to it by itself.
        ++counters_.triangle_pairs;
        const Candidate c = compare((*start)[0], (*start)[1]);
        if (c.crossing) note(c);
        upper_ = c.bounds.upper;
    }
    push(0, ObbId{}, ObbId{});
    while (!heap.empty()) {
        if (upper_ <= 0 || (stop && upper_ < limit_)) break;
        const Entry e = heap.front();
        if (unit_ * static_cast<double>(e.bound) > upper_) break;
        std::pop_heap(heap.begin(), heap.end(), ByBound{});
        heap.pop_back();
        expand(e);
    }
    finish();
}

void DistanceSearch::finish() {
    std::erase_if(arrays_->candidates,
                  [this](const Candidate& c) { return c.bounds.lower > upper_; });
    std::sort(
        arrays_->candidates.begin(), arrays_->candidates.end(),
        [](const Candidate& c, const Candidate& d) { return c.bounds.upper < d.bounds.upper; });
    lower_ = std::numeric_limits<double>::infinity();
    for (const Candidate& c : arrays_->candidates) lower_ = std::min(lower_, c.bounds.lower);
}

}  // namespace trisect::detail
