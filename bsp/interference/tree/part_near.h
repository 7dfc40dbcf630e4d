// SPDX-License-Identifier: Apache-2.0
//
// The part of a solid that is near another one.
#pragma once

#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// What `a` has in a box that contains `b`, both under their poses; the walls of the box are off
/// `b`. The solid itself where the box contains it, or where doubles do not say where `b` is.
/// Faces keep their names. O(what of `a` is near the box). \pre neither is empty
[[nodiscard]] Solid part_near(const Solid& solid, const SolidBoundary& a, const Pose& pose_a,
                              const SolidBoundary& b, const Pose& pose_b);

}  // namespace trisect::detail
