// SPDX-License-Identifier: Apache-2.0
//
// What has a lower bound below the distance is opened, in whatever order; what has one above it
// should not be. So the search begins best first: the pair of boxes with the least bound is opened,
// then its nearest child, down to triangles, which give bounds above and below
// (triangle_distance.cpp). After some of these descents the least upper bound is near the distance,
// and what is clearly below it is opened at once, in depth. The rest waits in the order of bounds,
// and most of it is left out when its turn comes. What remains are the pairs whose lower bound is
// not above the least upper one: nearly always one, or the few around a common edge or vertex. The
// exact distance is the least of theirs.
//
// Where a shaft is in its hole, thousands of pairs are equally near, and doubles cannot say which
// is the nearest. For bounds of the distance that does not matter: [lower, upper] of the best pair
// so far may become [lower - (upper - lower), upper], and then what is certainly not nearer than
// that can be left out. For nearly all others three directions prove it, at a quarter of the cost
// of closest points.

#include <trisect/bsp/interference/relation/distance_search.h>

#include <algorithm>

namespace trisect::detail {

DistanceSearch::DistanceSearch(const Boundary& a, const Pose& pose_a, const Boundary& b,
                               const Pose& pose_b)
    : a_(&a), b_(&b), pairs_(PairDistance(a, pose_a, b, pose_b)) {
    pose_.emplace(a.boxes, b.boxes, pairs_->map());
    unit_ = a.boxes.unit * pairs_->least_stretch() * (1 - 0x1p-20);
}

void DistanceSearch::note(const Candidate& c) {
    if (!(c.bounds.lower <= upper_) || !(c.bounds.lower < limit_)) return;
    arrays_->candidates.push_back(c);
    if (!(c.bounds.upper < upper_)) return;
    upper_ = c.bounds.upper;
    const double enough = c.bounds.lower - (upper_ - c.bounds.lower);
    if (all_ || !(enough > 0)) return;
    enough_ = enough;
    skipped_ = std::min(skipped_, enough_);
}

void DistanceSearch::compare(std::uint32_t a, std::uint32_t b) {
    ++counters_.triangle_pairs;
    const Candidate c = pairs_->compare(a, b, std::min({upper_, limit_, enough_}));
    if (c.bounds.upper < std::numeric_limits<double>::infinity()) note(c);
}

void DistanceSearch::compare_leaves(ObbChild a, ObbChild b) {
    for (std::uint32_t j = 0; j < b.count(); ++j)
        for (std::uint32_t i = 0; i < a.count(); ++i)
            compare(a_->boxes.order[a.first() + i], b_->boxes.order[b.first() + j]);
}

void DistanceSearch::expand(const BoundedPair& e) {
    const ObbTree& ta = a_->boxes;
    const ObbTree& tb = b_->boxes;
    const bool leaf_a = ta.is_leaf(e.a);
    const bool leaf_b = tb.is_leaf(e.b);
    if (leaf_a && leaf_b) {
        compare_leaves(ta.child(e.a), tb.child(e.b));
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
        if (is_beyond(unit_ * static_cast<double>(bound))) continue;
        put({bound, open_b ? e.a : ObbId::of(node, k), open_b ? ObbId::of(node, k) : e.b});
    }
}

// The nearest one is on top of the stack when a node has been opened.
void DistanceSearch::put(const BoundedPair& pair) {
    constexpr std::uint32_t first_descents = 8;
    constexpr double surely = 0.875;
    std::vector<BoundedPair>& stack = arrays_->stack;
    if (descents_ < first_descents) {
        if (!stack.empty() && pair.bound < stack.back().bound) {
            arrays_->queue.push(stack.back());
            stack.back() = pair;
        } else if (stack.empty()) {
            stack.push_back(pair);
        } else {
            arrays_->queue.push(pair);
        }
        return;
    }
    const bool leaves = a_->boxes.is_leaf(pair.a) && b_->boxes.is_leaf(pair.b);
    if (leaves || unit_ * static_cast<double>(pair.bound) <= surely * std::min(upper_, limit_))
        stack.push_back(pair);
    else
        arrays_->queue.push(pair);
}

void DistanceSearch::descend(const BoundedPair& from) {
    std::vector<BoundedPair>& stack = arrays_->stack;
    stack.push_back(from);
    while (!stack.empty() && !is_done()) {
        const BoundedPair e = stack.back();
        stack.pop_back();
        if (!is_beyond(unit_ * static_cast<double>(e.bound))) expand(e);
    }
    ++descents_;
}

void DistanceSearch::start(double limit) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    arrays_->queue.clear();
    arrays_->stack.clear();
    descents_ = 0;
    arrays_->candidates.clear();
    limit_ = limit;
    upper_ = enough_ = skipped_ = infinite;
    arrays_->queue.push({});
}

void DistanceSearch::search() {
    BoundedPair e;
    while (!is_done() && arrays_->queue.pop(e)) descend(e);
    finish();
}

void DistanceSearch::run(double limit, bool stop,
                         std::optional<std::array<std::uint32_t, 2>> first) {
    all_ = true;
    stop_ = stop;
    start(limit);
    if (first) {
        // For its upper bound only: the walk comes to it by itself.
        ++counters_.triangle_pairs;
        const Candidate c = pairs_->compare((*first)[0], (*first)[1], limit);
        if (c.crossing) note(c);
        upper_ = c.bounds.upper;
    }
    search();
}

void DistanceSearch::run_for_bounds(double limit) {
    all_ = false;
    stop_ = false;
    start(limit);
    search();
}

void DistanceSearch::finish() {
    std::erase_if(arrays_->candidates,
                  [this](const Candidate& c) { return c.bounds.lower > upper_; });
    std::sort(
        arrays_->candidates.begin(), arrays_->candidates.end(),
        [](const Candidate& c, const Candidate& d) { return c.bounds.upper < d.bounds.upper; });
    lower_ = skipped_;
    for (const Candidate& c : arrays_->candidates) lower_ = std::min(lower_, c.bounds.lower);
}

}  // namespace trisect::detail
