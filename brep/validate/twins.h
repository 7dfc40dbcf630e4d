// SPDX-License-Identifier: Apache-2.0
//
// Twins: opposite half-edges of a closed, oriented triangle mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/import/edge_table.h>

namespace trisect::detail {

/// Half-edge 3·t + i runs from corner i of triangle t to its next corner; its twin runs back.
class Twins {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// Nothing unless the mesh is plainly manifold by the names of its corners: every edge belongs
    /// to two triangles that pass it in opposite directions, the triangles around every corner form
    /// one fan, and no two triangles have the same three corners.
    /// \pre corners are below point_count; fewer than 2^30 triangles.
    /// O(n).
    [[nodiscard]] static std::optional<Twins> of(std::size_t point_count,
                                                 std::span<const Triangle> triangles);

    [[nodiscard]] std::uint32_t operator[](std::uint32_t halfedge) const { return twin_[halfedge]; }
    [[nodiscard]] std::size_t triangle_count() const { return twin_.size() / 3; }

    /// Calls visit(from, to, uses) once for every edge: two uses, forward first.
    template <class Visit>
    void for_each_edge(std::span<const Triangle> triangles, Visit&& visit) const {
        for (std::uint32_t h = 0; h < twin_.size(); ++h) {
            const std::uint32_t back = twin_[h];
            if (back < h) continue;
            const std::uint32_t from = triangles[h / 3][h % 3];
            const std::uint32_t to = triangles[back / 3][back % 3];
            const std::array<EdgeUse, 2> uses{EdgeUse{to, 2 * (h / 3) + 1},
                                              EdgeUse{to, 2 * (back / 3)}};
            visit(from, to, std::span<const EdgeUse>(uses));
        }
    }

    /// Connected components: a number for every triangle, counted from 0 by first triangles.
    struct Shells {
        std::vector<std::uint32_t> of_triangle;
        std::uint32_t count = 0;
    };
    [[nodiscard]] Shells shells() const;

private:
    explicit Twins(std::vector<std::uint32_t> twin) : twin_(std::move(twin)) {}

    std::vector<std::uint32_t> twin_;
};

}  // namespace trisect::detail
