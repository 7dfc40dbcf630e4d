// SPDX-License-Identifier: Apache-2.0
//
// Exact queries on two placed solids, by any PairStructure.
// The structure decides how fast; the answers are the same.
//
// All are about the poses that the structure was placed at last, and add what they did to
// `counters`.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/hierarchies/pairs/pair_structure.h>
#include <trisect/bsp/interference/interference.h>

namespace trisect::hierarchies {

/// Whether the boundaries have a common point. Stops at the first pair that certainly has one.
/// \throw LimitError as interfere(), for all of these.
[[nodiscard]] bool boundaries_meet(PairStructure& structure, CostCounters& counters);

/// A face of A and a face of B.
using FacePair = std::pair<FaceId, FaceId>;

/// All pairs of faces that have a common point; ascending, each once.
[[nodiscard]] std::vector<FacePair> meeting_faces(PairStructure& structure, CostCounters& counters);

/// What interfere() says.
[[nodiscard]] Relation relation(PairStructure& structure, CostCounters& counters);

/// Which triangles are the closest, as far as doubles with error bounds can decide: what
/// boundary_distance() says, before any exact arithmetic. In the user's units.
struct DistanceInterval {
    double lower = 0;
    double upper = 0;
};
/// \throw LimitError for poses beyond the range of doubles.
[[nodiscard]] DistanceInterval distance(PairStructure& structure, CostCounters& counters);

/// The distance of the boundaries and where it is.
struct ClosestFeatures {
    ExactRational squared;  ///< in the user's units
    /// Of all pairs of closest points that are corners of the set of such pairs (as good as any:
    /// they are all of them unless features are parallel), the entities that they are on; the first
    /// in the order of BoundaryEntity, first of A's and then of B's. Nothing where boundaries meet:
    /// meeting_faces() has the places.
    std::optional<std::pair<BoundaryEntity, BoundaryEntity>> features;
    friend bool operator==(const ClosestFeatures&, const ClosestFeatures&) = default;
};
/// Exact. Cost: distance(), and some hundred microseconds for each pair of triangles that doubles
/// leave. \throw LimitError as distance()
[[nodiscard]] ClosestFeatures closest(PairStructure& structure, CostCounters& counters);

}  // namespace trisect::hierarchies
