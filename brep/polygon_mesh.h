// SPDX-License-Identifier: Apache-2.0
//
// PolygonMesh: a mesh as plain arrays of doubles and indices.
// Meshes come from files and callers, and go back to them, in this form. It promises nothing
// about its geometry.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/point3d.h>

namespace trisect {

/// Indexed polygons with one loop each.
///
/// Invariants: `face_begin` has face_count()+1 entries, starts with 0, does not decrease and ends
/// with `corners.size()`; every corner is less than `points.size()`. Regular value type.
struct PolygonMesh {
    std::vector<Point3d> points;
    std::vector<std::uint32_t> face_begin{0};
    std::vector<std::uint32_t> corners;

    [[nodiscard]] std::size_t face_count() const noexcept { return face_begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t f) const noexcept {
        return {corners.data() + face_begin[f], corners.data() + face_begin[f + 1]};
    }
    void add_face(std::span<const std::uint32_t> loop) {
        corners.insert(corners.end(), loop.begin(), loop.end());
        face_begin.push_back(static_cast<std::uint32_t>(corners.size()));
    }
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::array<std::uint32_t, 3> t{a, b, c};
        add_face(t);
    }
    friend bool operator==(const PolygonMesh&, const PolygonMesh&) = default;
};

/// Adds the points and faces of another mesh after its own. What they have in common is not joined.
void append(PolygonMesh& mesh, const PolygonMesh& other);

}  // namespace trisect
