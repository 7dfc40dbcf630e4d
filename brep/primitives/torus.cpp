// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/torus.h>

#include <trisect/brep/primitives/circle.h>
#include <trisect/kernel/error.h>

namespace trisect {

PolygonMesh make_torus(double major_radius, double minor_radius, std::uint32_t major_segments,
                       std::uint32_t minor_segments) {
    detail::require_positive(major_radius, "the major radius of a torus");
    detail::require_positive(minor_radius, "the minor radius of a torus");
    if (!(minor_radius < major_radius))
        throw UsageError("the minor radius of a torus must be smaller than the major one");
    detail::require_between(major_segments, 3, detail::segment_limit, "the segments of a torus");
    detail::require_between(minor_segments, 3, detail::segment_limit, "the segments of a torus");
    if (std::uint64_t{major_segments} * minor_segments > (1U << 26))
        throw UsageError("a torus of more than 2^27 triangles");
    PolygonMesh m;
    const double extent = major_radius + minor_radius;
    // Ring k of the tube has its own radius and height; all rings have the same angles.
    const auto tube = detail::circle(minor_radius, minor_segments, extent);
    for (const Point2d& t : tube)
        for (const Point2d& p : detail::circle(major_radius + t[0], major_segments, extent))
            m.points.push_back({p[0], p[1], t[1]});
    const auto at = [&](std::uint32_t k, std::uint32_t i) {
        return (k % minor_segments) * major_segments + i % major_segments;
    };
    for (std::uint32_t k = 0; k < minor_segments; ++k)
        for (std::uint32_t i = 0; i < major_segments; ++i) {
            m.add_triangle(at(k, i), at(k, i + 1), at(k + 1, i + 1));
            m.add_triangle(at(k, i), at(k + 1, i + 1), at(k + 1, i));
        }
    return m;
}

}  // namespace trisect
