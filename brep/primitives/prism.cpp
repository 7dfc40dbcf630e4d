// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/prism.h>

#include <trisect/brep/primitives/circle.h>
#include <trisect/brep/primitives/extrusion.h>

namespace trisect {

PolygonMesh make_prism(const Outline& polygon, double height) {
    detail::require_positive(height, "the height of a prism");
    return make_extrusion(polygon, {}, 0, height);
}

PolygonMesh make_regular_prism(std::uint32_t sides, double radius, double height) {
    detail::require_between(sides, 3, detail::segment_limit, "the number of sides of a prism");
    detail::require_positive(radius, "the radius of a prism");
    return make_prism(detail::circle(radius, sides, radius), height);
}

}  // namespace trisect
