// SPDX-License-Identifier: Apache-2.0
//
// ContactEvent: a time at which two features of moving solids become coplanar and meet.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/detail/real_root.h>

namespace trisect::detail {

/// A vertex, an edge or (with neither) a face. `face` is a face at the feature in any case.
struct ContactFeature {
    VertexId vertex;
    EdgeId edge;
    FaceId face;
};

struct FeaturePair {
    ContactFeature a;
    ContactFeature b;
};

/// All events at the first of the times that were added.
class EarliestEvents {
public:
    /// Only events after `after`, if given, count.
    explicit EarliestEvents(std::optional<RealRoot> after = std::nullopt);

    void add(RealRoot s, const FeaturePair& pair);

    [[nodiscard]] bool is_empty() const { return pairs_.empty(); }
    /// \pre !is_empty()
    [[nodiscard]] RealRoot& time() { return time_; }
    [[nodiscard]] const std::vector<FeaturePair>& pairs() const { return pairs_; }
    /// No event after this matters; beyond 1 when there is none yet.
    [[nodiscard]] double latest() const { return latest_; }
    /// No event before this counts.
    [[nodiscard]] double earliest() const { return earliest_; }

private:
    std::optional<RealRoot> after_;
    RealRoot time_;
    std::vector<FeaturePair> pairs_;
    double latest_ = 2;
    double earliest_ = -1;
};

}  // namespace trisect::detail
