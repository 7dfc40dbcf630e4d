// SPDX-License-Identifier: Apache-2.0
//
// Polygon clipping, for the checkers of certificates.
#pragma once

#include <vector>

#include <trisect/bsp/interference/certificate/certified_points.h>
#include <trisect/bsp/interference/interference_certificate.h>

namespace trisect::detail::certified {

using Polygon = std::vector<ExactPoint>;  // convex

/// What of the polygons is strictly on a side of a plane, 1 or -1; closed again.
[[nodiscard]] std::vector<Polygon> beside(const std::vector<Polygon>& polygons,
                                          const SeparatingPlane& plane, int side);

}  // namespace trisect::detail::certified
