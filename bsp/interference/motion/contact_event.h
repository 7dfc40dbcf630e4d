// SPDX-License-Identifier: Apache-2.0
//
// ContactEvent: a time of coplanarity and contact of two moving features.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/number/real_root.h>
#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>

namespace trisect::detail {

/// A part of a triangle of an EventModel.
struct ContactFeature {
    std::uint32_t triangle = 0;
    Feature feature;
};

/// A vertex that arrives in a triangle, or two edges that cross.
struct FeaturePair {
    enum class Kind : std::uint8_t { VertexOfA, VertexOfB, Edges };
    Kind kind = Kind::Edges;
    ContactFeature a;
    ContactFeature b;
};

/// All events at one time.
struct EventsAtATime {
    RealRoot time;
    std::vector<FeaturePair> pairs;
};

/// The events at the first few of the times that were added.
class EarliestEvents {
public:
    /// At so many times at most. Only events after `after`, if given, count.
    explicit EarliestEvents(std::optional<RealRoot> after = std::nullopt, std::size_t times = 1);

    void add(RealRoot s, const FeaturePair& pair);

    [[nodiscard]] bool is_empty() const { return events_.empty(); }
    /// There may be events after the last of these.
    [[nodiscard]] bool is_full() const { return events_.size() == times_; }
    /// In ascending order.
    [[nodiscard]] std::vector<EventsAtATime>& events() { return events_; }
    /// No event after this matters; beyond 1 when all do.
    [[nodiscard]] double latest() const { return latest_; }
    /// No event before this counts.
    [[nodiscard]] double earliest() const { return earliest_; }

private:
    std::optional<RealRoot> after_;
    std::size_t times_;
    std::vector<EventsAtATime> events_;
    double latest_ = 2;
    double earliest_ = -1;
};

}  // namespace trisect::detail
