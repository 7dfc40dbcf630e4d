// SPDX-License-Identifier: Apache-2.0
//
// build_bsp: construction of a BspTree from the boundary of a solid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/bsp_tree.h>
#include <trisect/kernel/convex_polygon.h>

namespace trisect {

/// How the next plane is chosen. The set that results never depends on it.
struct BspBuildOptions {
    /// How many polygons of a cell are tried; at least 1.
    std::uint32_t candidates = 6;
    /// A split polygon counts as much as this many polygons of imbalance.
    std::uint32_t split_weight = 8;
};

/// The solid that a set of polygons bounds. Deterministic.
///
/// \pre the boundary is embedded: closed, oriented outward (or inward, for the complement), and no
/// two polygons cross each other or share an area. Shells may be nested and may touch each other in
/// vertices and edges; faces may be cut in any way, T-vertices included. Polygons that bound
/// nothing are accepted and answered with a tree that means nothing. No polygon: the empty set.
///
/// Cost: O(candidates · n) predicates a level. n to a few n nodes in practice; Θ(n²) in the worst
/// case (Paterson and Yao 1990). Every plane cuts its cell.
[[nodiscard]] BspTree build_bsp(std::span<const ConvexPolygon> boundary,
                                const BspBuildOptions& options = {});
[[nodiscard]] BspTree build_bsp(const LatticeMesh& mesh, const BspBuildOptions& options = {});

/// The triangles of a mesh as polygons.
[[nodiscard]] std::vector<ConvexPolygon> convex_polygons(const LatticeMesh& mesh);

}  // namespace trisect
