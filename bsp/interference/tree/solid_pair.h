// SPDX-License-Identifier: Apache-2.0
//
// Relation of two placed boundaries of solids.
#pragma once

#include <trisect/bsp/interference/boxes/obb_walk.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// As interfere() of the solids. Both boundaries may get nodes; `a` and `b` are different ones.
[[nodiscard]] SolidInterference relation_of(const SolidBoundary& a, const Pose& pose_a,
                                            const SolidBoundary& b, const Pose& pose_b,
                                            const SolidInterferenceOptions& options,
                                            WalkCounters* counters = nullptr);

/// Of boundaries that are certainly apart.
[[nodiscard]] Relation relation_of_apart(const SolidBoundary& a, const Pose& pose_a,
                                         const SolidBoundary& b, const Pose& pose_b);

}  // namespace trisect::detail
