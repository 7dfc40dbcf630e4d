// SPDX-License-Identifier: Apache-2.0
//
// Planes between two triangles.
#pragma once

#include <array>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// True only if some plane has the corners of both triangles strictly on its two sides. It is
/// searched for in a few steps. Corners are exact.
[[nodiscard]] bool have_plane_between(const std::array<Vector3, 3>& a,
                                      const std::array<Vector3, 3>& b);
/// The same of triangles that have one corner in common, through which the plane goes.
[[nodiscard]] bool have_plane_between(const Vector3& common, const std::array<Vector3, 2>& a,
                                      const std::array<Vector3, 2>& b);

}  // namespace trisect::detail
