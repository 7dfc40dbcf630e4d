// SPDX-License-Identifier: Apache-2.0
//
// A mesh of revolution, for examples.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>

/// A closed outline of points (radius, z), counter-clockwise, about the z axis. Radii of 0 become
/// one point; import leaves out what is flat there.
inline trisect::PolygonMesh revolved(const std::vector<trisect::Point2d>& outline,
                                     std::uint32_t sides) {
    constexpr double pi = 3.14159265358979323846;
    const auto n = static_cast<std::uint32_t>(outline.size());
    trisect::PolygonMesh mesh;
    for (std::uint32_t s = 0; s < sides; ++s) {
        // Half a turn is in the plane y = 0: sin(pi) in doubles is 1e-16, which is an undercut.
        const double c = std::cos(2 * pi * s / sides);
        const double d = 2 * s % sides == 0 ? 0 : std::sin(2 * pi * s / sides);
        for (const auto& [r, z] : outline) mesh.points.push_back({r * c, r * d, z});
    }
    for (std::uint32_t s = 0; s < sides; ++s) {
        const std::uint32_t here = s * n;
        const std::uint32_t next = (s + 1) % sides * n;
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t j = (i + 1) % n;
            mesh.add_triangle(here + i, next + i, next + j);
            mesh.add_triangle(here + i, next + j, here + j);
        }
    }
    return mesh;
}
