// SPDX-License-Identifier: Apache-2.0
//
// Mirror images of solids.
#pragma once

#include <array>

#include <trisect/brep/transform.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// The reflection in the plane a x + b y + c z + d = 0. Entries of the matrix are exact where the
/// squared length of the normal is a power of two and nothing else is rounded, as for planes across
/// an axis and between two axes (1, -1, 0); others are rounded, by a few units in the last place of
/// 1, and of the distance. \throw UsageError for a normal of length 0, or numbers that are not
/// finite, or too large to be squared
[[nodiscard]] AffineMap mirror_map(const std::array<double, 4>& plane);

/// The mirror image in a plane, the inside inside. Exact in planes across an axis through the
/// origin and between two axes; elsewhere as transformed() has it: corners are rounded once, from
/// exact positions under the map. `report` is overwritten.
/// \throw as mirror_map() and transformed()
[[nodiscard]] Solid mirrored(const Solid& solid, const std::array<double, 4>& plane,
                             LatticeReport* report = nullptr);
/// In the plane through the origin across a direction.
[[nodiscard]] Solid mirrored(const Solid& solid, const Point3d& normal,
                             LatticeReport* report = nullptr);
/// In the coordinate plane across the axis 0, 1 or 2. Exact.
[[nodiscard]] Solid mirrored(const Solid& solid, int axis);

}  // namespace trisect
