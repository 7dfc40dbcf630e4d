// SPDX-License-Identifier: Apache-2.0
//
// Random tetrahedra on a small grid for the tests of import.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

#include <trisect/brep/polygon_mesh.h>

namespace trisect::test {

using Random = std::mt19937_64;

inline std::uint64_t below(Random& random, std::uint64_t n) { return random() % n; }

/// A chain without boundary: the outward triangles of tetrahedra whose corners are drawn from few
/// points, so that faces, edges and corners coincide, degenerate and turn inside out all the time.
inline PolygonMesh tetrahedra(Random& random, std::uint64_t grid, std::size_t count) {
    PolygonMesh m;
    const std::size_t points = 4 + below(random, 12);
    for (std::size_t i = 0; i < points; ++i) {
        Point3d p;
        for (double& c : p) c = static_cast<double>(below(random, grid));
        m.points.push_back(p);
    }
    for (std::size_t i = 0; i < count; ++i) {
        std::array<std::uint32_t, 4> t{};
        for (auto& c : t) c = static_cast<std::uint32_t>(below(random, points));
        m.add_triangle(t[0], t[2], t[1]);
        m.add_triangle(t[0], t[1], t[3]);
        m.add_triangle(t[1], t[2], t[3]);
        m.add_triangle(t[2], t[0], t[3]);
    }
    return m;
}

}  // namespace trisect::test
