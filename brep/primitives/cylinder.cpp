// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/cylinder.h>

#include <trisect/brep/primitives/circle.h>
#include <trisect/brep/primitives/extrusion.h>

namespace trisect {

PolygonMesh make_cylinder(double radius, double height, std::uint32_t segments) {
    detail::require_between(segments, 3, detail::segment_limit, "the segments of a cylinder");
    detail::require_positive(radius, "the radius of a cylinder");
    detail::require_positive(height, "the height of a cylinder");
    return make_extrusion(detail::circle(radius, segments, radius), {}, 0, height);
}

}  // namespace trisect
