// SPDX-License-Identifier: Apache-2.0
//
// quick_relation: the relation of two posed models in general position, without exact arithmetic.
#pragma once

#include <optional>

#include <trisect/bsp/detail/interference_model_data.h>
#include <trisect/bsp/detail/obb_walk.h>
#include <trisect/bsp/interference.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// Overlapping where an edge of one passes through a face of the other, Disjoint where boundaries
/// have no point in common and no shell of one is in the bounding box of the other; nothing where
/// doubles cannot tell, and where one might contain a shell of the other. Never wrong.
/// \pre both models have triangles.
[[nodiscard]] std::optional<Relation> quick_relation(const InterferenceModelData& a,
                                                     const Pose& pose_a,
                                                     const InterferenceModelData& b,
                                                     const Pose& pose_b, ObbWalk::Stack& stack);

}  // namespace trisect::detail
