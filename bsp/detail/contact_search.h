// SPDX-License-Identifier: Apache-2.0
//
// ContactSearch: the first events of two moving solids, found by halving the interval of the
// parameter and walking down two trees of boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/detail/approximate_map.h>
#include <trisect/bsp/detail/ball_motion.h>
#include <trisect/bsp/detail/contact_event.h>
#include <trisect/bsp/detail/obb_pose.h>
#include <trisect/bsp/detail/obb_tree.h>
#include <trisect/bsp/detail/pair_events.h>

namespace trisect::detail {

/// What a search did.
struct SearchCounters {
    std::uint64_t intervals = 0;       ///< parts of the parameter's interval looked at
    std::uint64_t box_tests = 0;       ///< one box against four, over an interval
    std::uint64_t triangle_pairs = 0;  ///< pairs of triangles whose events were asked for
};

/// One pose, and how far any point of a solid is from there during an interval.
struct SweptMap {
    ApproximateMap map;
    double sweep = 0;  ///< distance in A's lattice units
};

/// For all points within the box lo, hi of B.
[[nodiscard]] SweptMap swept_map(const BallMotion& motion, const std::array<double, 3>& lo,
                                 const std::array<double, 3>& hi);

class ContactSearch {
public:
    ContactSearch(const EventModel& a, const EventModel& b, PairEvents& pairs)
        : a_(a), b_(b), pairs_(pairs) {}

    /// Adds the first events of the motion in the interval of `over`. \pre neither model is empty.
    void run(const BallMotion& over, EarliestEvents& events);

    [[nodiscard]] const SearchCounters& counters() const { return counters_; }

private:
    struct Pair {
        ObbId a;
        ObbId b;
    };
    using Pairs = std::vector<Pair>;

    void search(const BallMotion& over, const Pairs& front, int depth, EarliestEvents& events);
    void refine(const ObbPose& pose, const SweptMap& swept, const Pairs& front, Pairs& leaves,
                Pairs& coarse);
    void push_children(const ObbPose& pose, const Pair& pair, bool of_b, Pairs& stack);
    void solve(const BallMotion& over, Pairs& leaves, EarliestEvents& events);
    [[nodiscard]] double size_a(ObbId id) const;
    [[nodiscard]] double size_b(const ObbPose& pose, ObbId id) const;

    const EventModel& a_;
    const EventModel& b_;
    PairEvents& pairs_;
    SearchCounters counters_;
};

}  // namespace trisect::detail
