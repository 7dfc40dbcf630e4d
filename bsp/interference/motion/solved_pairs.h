// SPDX-License-Identifier: Apache-2.0
//
// SolvedPairs: events of pairs of parts, each pair computed once.
// For searches that come to the same pairs many times.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/contact_event.h>
#include <trisect/bsp/interference/motion/event_model.h>
#include <trisect/bsp/interference/motion/pair_events.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// Parts that slide along each other are near at all times, so each interval of each search leads
/// to them. Here a search gets all their events at the first one.
class SolvedPairs {
public:
    /// `piece` is the whole motion; all must outlive this.
    SolvedPairs(EventModel& a, EventModel& b, PairEvents& pairs, const BallMotion& piece)
        : a_(a), b_(b), pairs_(pairs), piece_(piece) {}

    void begin_search() { ++search_; }
    /// Adds the events of two parts, once in a search.
    /// \return how many pairs of triangles were compared for it
    std::uint64_t add(std::uint32_t part_a, std::uint32_t part_b, EarliestEvents& events);

private:
    struct Event {
        RealRoot time;
        FeaturePair pair;
    };
    struct Pair {
        std::uint32_t search = 0;  // the last one that has its events
        std::uint32_t begin = 0;   // of them
        std::uint32_t end = 0;
    };
    std::uint64_t solve(std::uint32_t part_a, std::uint32_t part_b);

    EventModel& a_;
    EventModel& b_;
    PairEvents& pairs_;
    const BallMotion& piece_;
    std::uint32_t search_ = 0;
    FlatMap numbers_;
    std::vector<Pair> solved_;
    std::vector<Event> events_;
};

}  // namespace trisect::detail
