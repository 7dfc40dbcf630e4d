// SPDX-License-Identifier: Apache-2.0
//
// ShellFinder: the shells of a mesh, connected over edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/import/edge_table.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/kernel/support/disjoint_sets.h>

namespace trisect::detail {

/// Faces connected over edges with two faces; where more faces meet, shells stay apart unless one
/// of them would be open there.
struct Shell {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::uint32_t face = 0;  ///< the first one that has triangles
    bool closed = true;
    int volume = 0;  ///< its sign, where it is closed
};

/// Refers to the mesh, whose edges the table has.
class ShellFinder {
public:
    ShellFinder(const PreparedMesh& mesh, const EdgeTable& edges);

    /// By first triangles. Fills in shell_of_triangle.
    [[nodiscard]] std::vector<Shell> shells();
    /// A face of the part that the face is connected to: the same for all of them.
    [[nodiscard]] std::uint32_t part_of(std::uint32_t face) { return sets_.root(face); }

    std::vector<std::uint32_t> shell_of_triangle;

private:
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::int64_t>> net_by_shell(
        std::span<const EdgeUse> uses);
    void join_where_open(std::span<const EdgeUse> uses);

    const PreparedMesh& mesh_;
    DisjointSets sets_;
    std::vector<bool> open_;
};

}  // namespace trisect::detail
