// SPDX-License-Identifier: Apache-2.0
//
// ContactSearch: search for the first events of two moving solids.
// It halves the interval of the parameter and walks down two trees of boxes.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/contact_event.h>
#include <trisect/bsp/interference/motion/facing_cones.h>
#include <trisect/bsp/interference/motion/pair_events.h>
#include <trisect/bsp/interference/motion/solved_pairs.h>
#include <trisect/bsp/interference/motion/swept_walk.h>

namespace trisect::detail {

/// What a search did.
struct SearchCounters {
    std::uint64_t intervals = 0;       ///< parts of the parameter's interval looked at
    std::uint64_t box_tests = 0;       ///< one box against four, over an interval
    std::uint64_t triangle_pairs = 0;  ///< pairs of triangles whose events were computed
};

class ContactSearch {
public:
    /// `parting`, if given, leaves out what moves apart: for the first contact of solids that are
    /// apart at the beginning. `solved`, if given, computes the events of pairs and keeps them.
    ContactSearch(EventModel& a, EventModel& b, PairEvents& pairs, RecedingFaces* parting = nullptr,
                  SolvedPairs* solved = nullptr)
        : a_(a),
          b_(b),
          pairs_(pairs),
          separating_(parting),
          solved_(solved),
          walk_(a.boundary().boxes, b.boundary().boxes) {}

    /// Adds the first events of the motion in the interval of `over`. \pre neither model is empty.
    void run(const BallMotion& over, EarliestEvents& events);

    [[nodiscard]] SearchCounters counters() const {
        SearchCounters r = counters_;
        r.box_tests = walk_.box_tests();
        return r;
    }

private:
    using Pairs = SweptWalk::Pairs;

    void search(const BallMotion& over, const Pairs& front, int depth, EarliestEvents& events);
    void solve(const BallMotion& over, Pairs& leaves, EarliestEvents& events);
    void find_parts(const Pairs& leaves);

    EventModel& a_;
    EventModel& b_;
    PairEvents& pairs_;
    RecedingFaces* separating_;
    SolvedPairs* solved_;
    SweptWalk walk_;
    // The second solid's first, for the order.
    struct PartPair {
        std::uint32_t b = 0;
        std::uint32_t a = 0;
        friend constexpr auto operator<=>(const PartPair&, const PartPair&) = default;
    };
    std::vector<PartPair> parts_;  // of `solve`
    SearchCounters counters_;
};

}  // namespace trisect::detail
