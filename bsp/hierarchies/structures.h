// SPDX-License-Identifier: Apache-2.0
//
// Registry of all pair structures, by name.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>

namespace trisect::hierarchies {

/// docs/hierarchies.md has a paragraph on each.
enum class StructureKind : std::uint8_t {
    AllPairs,  ///< no structure; for tests and as a measure
    Aabb,      ///< axis-parallel boxes, B's fitted anew to each pose
    Kdop6,     ///< axis-parallel boxes, B's turned where they are met
    Kdop14,
    Kdop18,
    Kdop26,
    Kdop18Refit,  ///< B's fitted anew to each pose
    Kdop18Climb,  ///< B's found by climbing along hulls
    Sphere,
    SphereOctree,    ///< sphere trees: around an octree's cubes,
    SphereMedial,    ///< about the medial axis,
    SphereVertices,  ///< about vertices
    Obb,             ///< oriented boxes, a binary tree
    ObbHull,         ///< along the axes of the hull's covariance instead of the surface's
    ObbWide,         ///< oriented boxes with four children to a node
    ObbPacked,       ///< the tree of interfere(): four boxes at a time, in floats
    Hull,            ///< convex hulls of few corners
    Octree,          ///< A's space divided, B's triangles entered; and so on below
    KdTree,
    RTree,
    HashGrid,
    HierarchicalGrid,
    ConvexParts,  ///< hulls of convex parts, closest features tracked
    Bsp,          ///< A's classic tree, B's triangles cut by it
    Msp,          ///< A's Brep-Index, likewise
    FreeSpace,    ///< tetrahedra around the obstacle A, walked through by B
};

struct StructureInfo {
    StructureKind kind;
    std::string_view name;   ///< "aabb"
    std::string_view brief;  ///< half a line, without full stop
};

/// All of them, AllPairs first.
[[nodiscard]] std::span<const StructureInfo> all_structures();
[[nodiscard]] std::string_view to_string(StructureKind kind);
[[nodiscard]] std::optional<StructureKind> structure_kind(std::string_view name);

/// \throw UsageError when one of the models is empty.
[[nodiscard]] std::unique_ptr<PairStructure> make_structure(StructureKind kind,
                                                            const InterferenceModel& a,
                                                            const InterferenceModel& b);

}  // namespace trisect::hierarchies
