// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/extrusion.h>

#include <algorithm>
#include <cmath>

#include <trisect/brep/primitives/degrees.h>
#include <trisect/bsp/modelling/layered_walls.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

constexpr double most_degrees = 10;  // in one layer, by default

bool is_straight(const ExtrusionOptions& o) {
    return o.twist == 0 && o.scale[0] == 1 && o.scale[1] == 1;
}

void require_sense(double low, double high, const ExtrusionOptions& o) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
        throw UsageError("the heights of an extrusion must be finite and low < high");
    if (!std::isfinite(o.twist)) throw UsageError("the twist of an extrusion must be finite");
    for (const double s : o.scale)
        if (!std::isfinite(s) || s < 0)
            throw UsageError("the scale of an extrusion must be finite and not negative");
}

}  // namespace

PolygonMesh extrusion_mesh(const PlaneRegion& region, double low, double high,
                           const ExtrusionOptions& options) {
    require_sense(low, high, options);
    const double wanted = options.divisions != 0
                              ? options.divisions
                              : std::max(std::ceil(std::fabs(options.twist) / most_degrees), 1.0);
    detail::require_corners(region, wanted);
    const auto layers = static_cast<std::uint32_t>(wanted);
    const auto n = static_cast<std::uint32_t>(region.points.size());
    PolygonMesh mesh;
    for (std::uint32_t k = 0; k <= layers; ++k) {
        const double part = static_cast<double>(k) / layers;
        const double c = detail::cosine_of_degrees(options.twist * part);
        const double s = detail::sine_of_degrees(options.twist * part);
        const double sx = 1 + (options.scale[0] - 1) * part;
        const double sy = 1 + (options.scale[1] - 1) * part;
        const double z = k == layers ? high : low + (high - low) * part;
        for (const Point2d& p : region.points)
            mesh.points.push_back({sx * (c * p[0] - s * p[1]), sy * (s * p[0] + c * p[1]), z});
    }
    for (std::uint32_t k = 0; k < layers; ++k)
        detail::add_walls(mesh, region, k * n, (k + 1) * n, options.twist < 0);
    detail::add_ends(mesh, region, 0, layers * n);
    return mesh;
}

Solid extrusion(const PlaneRegion& region, double low, double high,
                const ExtrusionOptions& options) {
    require_sense(low, high, options);
    if (is_straight(options)) return solid_of_region(region, low, high);
    const PolygonMesh mesh = extrusion_mesh(region, low, high, options);
    if (mesh.face_count() == 0) return {};
    return Solid::from_mesh(mesh, {.embedding = Embedding::Check});
}

}  // namespace trisect
