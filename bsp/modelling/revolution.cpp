// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/revolution.h>

#include <algorithm>
#include <cmath>

#include <trisect/brep/primitives/degrees.h>
#include <trisect/bsp/modelling/layered_walls.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

bool is_full(const RevolutionOptions& o) { return std::fabs(o.angle) >= 360; }

/// Whether the region is where x is positive.
bool is_right_of_axis(const PlaneRegion& region, const RevolutionOptions& o) {
    if (!std::isfinite(o.angle) || !std::isfinite(o.start) || o.angle == 0)
        throw UsageError("the angles of a revolution must be finite, and what it turns by not 0");
    if (o.segments < (is_full(o) ? 3U : 1U))
        throw UsageError("a revolution has three segments or more");
    double least = 0;
    double most = 0;
    for (const Point2d& p : region.points) {
        least = std::min(least, p[0]);
        most = std::max(most, p[0]);
    }
    if (least < 0 && most > 0)
        throw UsageError("the region of a revolution is on both sides of the axis x = 0");
    return most > 0;
}

void turn_over(PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin[f],
                     mesh.corners.begin() + mesh.face_begin[f + 1]);
}

}  // namespace

PolygonMesh revolution_mesh(const PlaneRegion& region, const RevolutionOptions& options) {
    const bool is_right = is_right_of_axis(region, options);
    const double angle = is_full(options) ? 360 : options.angle;
    const double wanted = std::max(std::floor(options.segments * std::fabs(angle) / 360), 1.0);
    detail::require_corners(region, wanted);
    const auto steps = static_cast<std::uint32_t>(wanted);
    const auto n = static_cast<std::uint32_t>(region.points.size());
    PolygonMesh mesh;
    for (std::uint32_t k = 0; k < steps + (is_full(options) ? 0 : 1); ++k) {
        const double at = options.start + angle * k / steps;
        const double c = detail::cosine_of_degrees(at);
        const double s = detail::sine_of_degrees(at);
        for (const Point2d& p : region.points) mesh.points.push_back({p[0] * c, p[0] * s, p[1]});
    }
    for (std::uint32_t k = 0; k < steps; ++k)
        detail::add_walls(mesh, region, k * n, (is_full(options) && k + 1 == steps ? 0 : k + 1) * n,
                          true);
    if (!is_full(options)) detail::add_ends(mesh, region, 0, steps * n);
    // Moved along +y, as here at first, a region of the plane xz lies the other way round.
    if (is_right == (angle > 0)) turn_over(mesh);
    return mesh;
}

Solid revolution(const PlaneRegion& region, const RevolutionOptions& options) {
    const PolygonMesh mesh = revolution_mesh(region, options);
    if (mesh.face_count() == 0) return {};
    return Solid::from_mesh(mesh, {.embedding = Embedding::Check});
}

}  // namespace trisect
