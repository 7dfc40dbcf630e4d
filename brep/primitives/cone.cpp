// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/cone.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <trisect/brep/primitives/circle.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

// The points of a ring of this radius, one or `segments`; returns their indices, `segments` of
// them.
std::vector<std::uint32_t> add_ring(PolygonMesh& m, double radius, double z, std::uint32_t segments,
                                    double extent) {
    const auto begin = static_cast<std::uint32_t>(m.points.size());
    std::vector<std::uint32_t> ring(segments, begin);
    if (radius == 0) {
        m.points.push_back({0, 0, z});
        return ring;
    }
    const auto points = detail::circle(radius, segments, extent);
    for (std::uint32_t i = 0; i < segments; ++i) {
        m.points.push_back({points[i][0], points[i][1], z});
        ring[i] = begin + i;
    }
    return ring;
}

}  // namespace

PolygonMesh make_cone(double bottom_radius, double top_radius, double height,
                      std::uint32_t segments) {
    detail::require_between(segments, 3, detail::segment_limit, "the segments of a cone");
    detail::require_positive(height, "the height of a cone");
    detail::require_positive(std::max(bottom_radius, top_radius), "the larger radius of a cone");
    if (!(bottom_radius >= 0) || !(top_radius >= 0))
        throw UsageError("the radii of a cone must not be negative");
    PolygonMesh m;
    const double extent = std::max(bottom_radius, top_radius);
    auto bottom = add_ring(m, bottom_radius, 0, segments, extent);
    const auto top = add_ring(m, top_radius, height, segments, extent);
    for (std::uint32_t i = 0; i < segments; ++i) {
        const std::uint32_t k = (i + 1) % segments;
        if (bottom[i] != bottom[k]) m.add_triangle(bottom[i], bottom[k], top[k]);
        if (top[i] != top[k]) m.add_triangle(bottom[i], top[k], top[i]);
    }
    if (top_radius > 0) m.add_face(top);
    std::reverse(bottom.begin(), bottom.end());
    if (bottom_radius > 0) m.add_face(bottom);
    return m;
}

}  // namespace trisect
