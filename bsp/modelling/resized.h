// SPDX-License-Identifier: Apache-2.0
//
// Solids scaled to a size.
#pragma once

#include <array>

#include <trisect/brep/measure.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// Factors that give a box new sizes. An axis whose size is not positive keeps its factor 1, or, if
/// it `follows`, takes the factor of the axis with the largest new size, as OpenSCAD's resize() has
/// it. Each factor is a quotient of the size and a difference of coordinates, both rounded.
/// \throw UsageError for sizes that are not finite
[[nodiscard]] Point3d resize_factors(const Bounds& box, const Point3d& sizes,
                                     const std::array<bool, 3>& follows = {});

/// The solid scaled from the origin so that its box has these sizes, to within rounding: factors as
/// above, of what bounds() has, and corners once, by transformed(). The empty
/// set stays empty. `report` is overwritten.
/// \throw as above, and as bounds() and transformed()
[[nodiscard]] Solid resized(const Solid& solid, const Point3d& sizes,
                            const std::array<bool, 3>& follows = {},
                            LatticeReport* report = nullptr);

}  // namespace trisect
