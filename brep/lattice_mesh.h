// SPDX-License-Identifier: Apache-2.0
//
// LatticeMesh: a triangle mesh with integer corners, the input of Solid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/kernel/lattice.h>

namespace trisect {

/// Triangles over lattice points.
///
/// Invariants: every index is less than points.size(); no triangle is degenerate (its corners are
/// not collinear); `face_of_triangle` is empty (triangle i came from face i) or names the polygon
/// of the file or caller that each triangle was cut from. Triangles of one face are coplanar or the
/// face was reported as non-planar. Orientation: counter-clockwise seen from outside.
struct LatticeMesh {
    Lattice lattice;
    std::vector<LatticePoint> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> face_of_triangle;

    [[nodiscard]] std::uint32_t face_of(std::uint32_t triangle) const {
        return face_of_triangle.empty() ? triangle : face_of_triangle[triangle];
    }
};

}  // namespace trisect
