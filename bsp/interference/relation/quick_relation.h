// SPDX-License-Identifier: Apache-2.0
//
// Filtered relation of two placed solids, in doubles.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_walk.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// A pair of triangles, by their numbers, and what doubles said of it.
struct CandidatePair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    PairVerdict verdict = PairVerdict::Unknown;
};
/// Pairs that doubles did not find apart.
struct CandidatePairs {
    std::vector<CandidatePair> pairs;
    bool is_complete = false;   ///< these are all
    bool may_coincide = false;  ///< there are many and some look as if they fell together
};

/// The relation when a crossing is found in doubles, or when the boundaries are certainly apart and
/// for each shell it is certain on which side of the other boundary it is; otherwise nothing. No
/// exact pose is made. Of solids in general position it hardly ever returns nothing.
///
/// When nothing is returned after a whole walk, `candidates`, if given, has all pairs that doubles
/// did not find apart; where many fall together the walk is not ended. The stack is scratch memory.
/// \pre neither model is empty
[[nodiscard]] std::optional<Relation> quick_relation(const InterferenceModelData& a,
                                                     const Pose& pose_a,
                                                     const InterferenceModelData& b,
                                                     const Pose& pose_b, ObbWalk::Stack& stack,
                                                     WalkCounters* counters = nullptr,
                                                     CandidatePairs* candidates = nullptr);

/// The same for boundaries known to have no common point; `to_a` is the map from B into A.
[[nodiscard]] std::optional<Relation> relation_of_apart(const InterferenceModelData& a,
                                                        const Pose& pose_a,
                                                        const InterferenceModelData& b,
                                                        const Pose& pose_b,
                                                        const ApproximateMap& to_a);

/// Whether a vertex of a model is inside of another solid; nothing when doubles cannot decide.
/// \pre it is not on the boundary of the other solid.
[[nodiscard]] std::optional<bool> is_certainly_inside(const InterferenceModelData& model,
                                                      VertexId v, const ApproximateMap& to_other,
                                                      const InterferenceModelData& other);

}  // namespace trisect::detail
