// SPDX-License-Identifier: Apache-2.0
//
// Space and time are halved in turns. A pair of boxes much smaller than the sweep would be kept
// whatever it is like, so boxes are divided only while they are larger; then time is. The pairs
// left over, the front, are what both halves begin with, the earlier one first. Where it finds an
// event the later one is never looked at: the first contact costs what lies before it.

#include <trisect/bsp/interference/motion/contact_search.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

namespace {

// Intervals stay multiples of 2^-36, and their halves in PairEvents exact doubles.
constexpr int most_halvings = 36;
// So few pairs of triangles are solved at once, however long the interval is.
constexpr std::size_t pairs_solved_at_once = 6;

}  // namespace

void ContactSearch::run(const BallMotion& over, EarliestEvents& events) {
    if (solved_ != nullptr) solved_->begin_search();
    search(over, {SweptWalk::Pair{}}, 0, events);
}

void ContactSearch::search(const BallMotion& over, const Pairs& front, int depth,
                           EarliestEvents& events) {
    if (over.from > events.latest() || over.to < events.earliest()) return;
    ++counters_.intervals;
    const SweptMap swept = swept_map(over, b_.boundary().lo, b_.boundary().hi);
    const ObbPose pose(a_.boundary().boxes, b_.boundary().boxes, swept.map, swept.sweep);
    if (pose.is_apart()) return;
    Pairs leaves;
    Pairs coarse;
    if (separating_ != nullptr) {
        separating_->set(over, swept);
        walk_.refine(pose, swept.sweep, front, leaves, coarse, *separating_);
    } else {
        walk_.refine(pose, swept.sweep, front, leaves, coarse);
    }
    if (leaves.empty() && coarse.empty()) return;

    // Triangles that sweep farther than they are large had better wait for a shorter interval.
    const bool worth_halving = !coarse.empty() || (leaves.size() > pairs_solved_at_once &&
                                                   walk_.are_long(pose, swept.sweep, leaves));
    if (!worth_halving || depth == most_halvings) {
        solve(over, leaves, events);
        if (coarse.empty()) return;
    }
    if (depth == most_halvings) {
        // Boxes smaller than the sweep of an interval this short: too small to be distinguished.
        leaves.clear();
        walk_.refine(pose, 0, coarse, leaves, coarse);
        solve(over, leaves, events);
        return;
    }
    coarse.insert(coarse.end(), leaves.begin(), leaves.end());
    leaves = {};
    search(over.left_half(), coarse, depth + 1, events);
    search(over.right_half(), coarse, depth + 1, events);
}

void ContactSearch::solve(const BallMotion& over, Pairs& leaves, EarliestEvents& events) {
    // What a triangle of B does on its way is worked out once for all its partners.
    std::sort(leaves.begin(), leaves.end(), [](const SweptWalk::Pair& p, const SweptWalk::Pair& q) {
        return p.b.index != q.b.index ? p.b.index < q.b.index : p.a.index < q.a.index;
    });
    find_parts(leaves);
    for (const PartPair& p : parts_) {
        if (solved_ != nullptr) {
            counters_.triangle_pairs += solved_->add(p.a, p.b, events);
            continue;
        }
        const EventModel::Range of_b = b_.triangles_of(p.b);
        const EventModel::Range of_a = a_.triangles_of(p.a);
        for (std::uint32_t j = of_b.begin; j < of_b.end; ++j)
            for (std::uint32_t i = of_a.begin; i < of_a.end; ++i) {
                ++counters_.triangle_pairs;
                pairs_.find(i, j, over, events);
            }
    }
}

void ContactSearch::find_parts(const Pairs& leaves) {
    const ObbTree& ta = a_.boundary().boxes;
    const ObbTree& tb = b_.boundary().boxes;
    parts_.clear();
    for (const SweptWalk::Pair& p : leaves) {
        const ObbChild la = ta.child(p.a);
        const ObbChild lb = tb.child(p.b);
        for (std::uint32_t j = 0; j < lb.count(); ++j)
            for (std::uint32_t i = 0; i < la.count(); ++i)
                parts_.push_back(
                    {b_.part_of(tb.order[lb.first() + j]), a_.part_of(ta.order[la.first() + i])});
    }
    if (!a_.has_common_parts() && !b_.has_common_parts()) return;
    std::sort(parts_.begin(), parts_.end());
    parts_.erase(std::unique(parts_.begin(), parts_.end()), parts_.end());
}

}  // namespace trisect::detail
