// SPDX-License-Identifier: Apache-2.0
//
// Solids from bytes, on a grid of 16: nearly every two of them share planes, edges or corners,
// which random doubles never do.
#pragma once

#include <array>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/solid.h>

#include "byte_source.h"

namespace fuzz {

inline trisect::Point3d grid_point(ByteSource& bytes) {
    const double x = bytes.between(0, 15);
    const double y = bytes.between(0, 15);
    return {x, y, static_cast<double>(bytes.between(0, 15))};
}

/// A box or a tetrahedron; the empty set where the bytes describe none.
inline trisect::Solid grid_solid(ByteSource& bytes) {
    const bool is_box = bytes.below(2) == 0;
    std::array<trisect::Point3d, 4> p{};
    for (auto& q : p) q = grid_point(bytes);
    if (is_box) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (p[0][k] > p[1][k]) std::swap(p[0][k], p[1][k]);
            if (p[0][k] == p[1][k]) p[1][k] += 1;
        }
        return trisect::Solid::from_mesh(trisect::make_box(p[0], p[1]));
    }
    const auto row = [&p](std::size_t i) {
        return std::array{p[i][0] - p[0][0], p[i][1] - p[0][1], p[i][2] - p[0][2]};
    };
    const auto a = row(1);
    const auto b = row(2);
    const auto c = row(3);
    const double det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
    if (det == 0) return {};
    if (det < 0) std::swap(p[2], p[3]);
    trisect::PolygonMesh mesh;
    mesh.points.assign(p.begin(), p.end());
    mesh.add_triangle(0, 2, 1);
    mesh.add_triangle(0, 1, 3);
    mesh.add_triangle(1, 2, 3);
    mesh.add_triangle(2, 0, 3);
    return trisect::Solid::from_mesh(mesh);
}

}  // namespace fuzz
