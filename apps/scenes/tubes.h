// SPDX-License-Identifier: Apache-2.0
//
// Closed tubes as triangles, tori among them.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <trisect/brep/polygon_mesh.h>

namespace scenes {

/// nu rings of nv corners, point(u, v) with both from 0 to 2 pi.
template <class Point>
[[nodiscard]] trisect::PolygonMesh tube(std::uint32_t nu, std::uint32_t nv, Point&& point) {
    constexpr double pi = std::numbers::pi;
    trisect::PolygonMesh m;
    for (std::uint32_t i = 0; i < nu; ++i)
        for (std::uint32_t j = 0; j < nv; ++j)
            m.points.push_back(point(2 * pi * i / nu, 2 * pi * j / nv));
    const auto id = [nu, nv](std::uint32_t i, std::uint32_t j) { return i % nu * nv + j % nv; };
    for (std::uint32_t i = 0; i < nu; ++i)
        for (std::uint32_t j = 0; j < nv; ++j) {
            m.add_triangle(id(i, j), id(i + 1, j), id(i + 1, j + 1));
            m.add_triangle(id(i, j), id(i + 1, j + 1), id(i, j + 1));
        }
    return m;
}

/// Around the z axis; the middle of the tube has radius 1.
[[nodiscard]] inline trisect::PolygonMesh torus(double minor, std::uint32_t nu, std::uint32_t nv) {
    return tube(nu, nv, [minor](double u, double v) {
        const double r = 1 + minor * std::cos(v);
        return trisect::Point3d{r * std::cos(u), r * std::sin(u), minor * std::sin(v)};
    });
}

}  // namespace scenes
