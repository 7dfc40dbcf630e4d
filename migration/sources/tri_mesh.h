// SPDX-License-Identifier: Apache-2.0
//
// TriMesh: triangles with runs, faces and properties.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <manifold/common.h>

namespace manifold {

/// One use of an original: its number, where it was moved, and which way its faces look.
struct Run {
    int original = -1;
    mat3x4 transform = la::identity;
    bool backside = false;
    bool normals = false;  ///< the first three properties are normals, as the run lies
};

using Triple = std::array<std::uint32_t, 3>;

/// Invariants: `rows`, `run` and `face` have an entry for each triangle, `rows` only where `width`
/// is not 0; every point is used.
struct TriMesh {
    std::vector<vec3> points;
    std::vector<Triple> corners;
    std::size_t width = 0;           ///< properties of a corner
    std::vector<double> properties;  ///< `width` a row
    std::vector<Triple> rows;        ///< by triangle: those of its corners
    std::vector<std::uint32_t> run;
    std::vector<std::uint64_t> face;  ///< of the run's original
    std::vector<Run> runs;
    std::size_t turned = 0;  ///< triangles that rounding turned over

    [[nodiscard]] const vec3& corner(std::size_t triangle, std::size_t k) const {
        return points[corners[triangle][k]];
    }
    [[nodiscard]] const double* row(std::size_t triangle, std::size_t k) const {
        return properties.data() + rows[triangle][k] * width;
    }
    /// Twice the area, along the normal.
    [[nodiscard]] vec3 normal(std::size_t triangle) const {
        return la::cross(corner(triangle, 1) - corner(triangle, 0),
                         corner(triangle, 2) - corner(triangle, 0));
    }
};

/// How theirs chooses the length within which places are one, relative to the largest coordinate.
inline constexpr double relative_epsilon = 1e-12;

[[nodiscard]] Box box_of(const TriMesh& mesh);
[[nodiscard]] double volume_of(const TriMesh& mesh);
[[nodiscard]] double area_of(const TriMesh& mesh);
/// The same points moved; triangles are turned over where the map is a reflection.
[[nodiscard]] TriMesh moved(TriMesh mesh, const mat3x4& map);
/// The given triangles alone. Runs stay.
[[nodiscard]] TriMesh part_of(const TriMesh& mesh, const std::vector<std::uint32_t>& triangles);
/// Triangles of each connected part; sharing a point connects.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> parts_of(const TriMesh& mesh);
/// For each triangle the smallest one of the flat face that it is part of: connected triangles of
/// one run within the tolerance of the plane of one of them.
[[nodiscard]] std::vector<std::uint64_t> flat_faces(const TriMesh& mesh);
/// A map after another one.
[[nodiscard]] mat3x4 compose(const mat3x4& second, const mat3x4& first);
/// How normals move.
[[nodiscard]] mat3 normal_map(const mat3x4& map);

/// For each side of each triangle, 3 * triangle + k, the side that runs back; none where that is
/// open or has more than two triangles.
inline constexpr std::uint32_t no_side = 0xffffffff;
[[nodiscard]] std::vector<std::uint32_t> opposite_sides(const TriMesh& mesh);

}  // namespace manifold
