// SPDX-License-Identifier: Apache-2.0
//
// Exact curved boundaries of spheres and tori.
// Circles are rational quadratics with weights 1, 1, 2, which doubles represent.
#pragma once

#include <trisect/brep/curved/curved_boundary.h>

namespace trisect {

/// The sphere about the origin: eight patches of degrees 2 and 2, one an octant.
/// \throw UsageError unless the radius is positive.
[[nodiscard]] CurvedBoundary make_curved_sphere(double radius);

/// The torus about the z axis: sixteen patches of degrees 2 and 2. The sums and differences of the
/// radii are rounded to doubles if they must be.
/// \throw UsageError unless 0 < minor_radius < major_radius.
[[nodiscard]] CurvedBoundary make_curved_torus(double major_radius, double minor_radius);

}  // namespace trisect
