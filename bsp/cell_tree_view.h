// SPDX-License-Identifier: Apache-2.0
//
// Size and cells of the partition of a solid, for drawings.
// Computations with solids do not need it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/solid.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// The size of a cell tree. Subtrees that a solid shares with others count in full.
struct CellTreeStats {
    std::size_t nodes = 0;  ///< splitting planes and leaves
    std::size_t leaves = 0;
    std::size_t inside_leaves = 0;    ///< homogeneous: no polygon, and in the solid
    std::size_t outside_leaves = 0;   ///< the same, not in the solid
    std::size_t listing_leaves = 0;   ///< with polygons
    std::size_t arranged_leaves = 0;  ///< of those: where operands met and an arrangement was made
    std::size_t depth = 0;            ///< splitting planes above the deepest leaf
    std::size_t polygons = 0;         ///< listed, in all leaves together
    std::size_t largest_leaf = 0;     ///< most polygons of one leaf
    std::size_t fragments = 0;        ///< parts of facets that an operation cut out, each once
    std::size_t bytes = 0;            ///< of nodes, lists and fragments, without the sources
};

/// O(size of the tree).
[[nodiscard]] CellTreeStats cell_tree_stats(const Solid& solid);

/// A leaf of the partition.
struct CellLeaf {
    Point3d lo{};  ///< user's units, rounded; infinite where nothing bounds it
    Point3d hi{};
    std::size_t polygons = 0;  ///< 0: homogeneous
    std::size_t depth = 0;
    bool is_inside = false;    ///< of a homogeneous leaf
    bool is_arranged = false;  ///< see CellTreeStats::arranged_leaves
};

/// The leaves that meet a closed box in the user's units, whose ends may be infinite and may be
/// equal: lo.z == hi.z gives a slice. Leaves are in the order of the splitting planes, below
/// first. O(splitting planes that the box meets).
/// \throw UsageError when an end is not a number or lo > hi.
[[nodiscard]] std::vector<CellLeaf> cell_tree_leaves(const Solid& solid, const Point3d& lo,
                                                     const Point3d& hi);

/// Positions of splitting planes are multiples of a lattice unit divided by this.
inline constexpr int cell_position_scale = 192;

/// A splitting plane or a leaf, with its place in the tree.
struct CellTreeNode {
    int axis = -1;  ///< that the plane is perpendicular to; -1: a leaf
    std::int64_t position =
        0;                     ///< the plane, exactly: position / cell_position_scale lattice units
    std::size_t above = 0;     ///< the child above; the one below follows its parent
    std::size_t polygons = 0;  ///< of a leaf; 0: homogeneous
    bool is_inside = false;    ///< of a homogeneous leaf
    bool is_arranged = false;  ///< see CellTreeStats::arranged_leaves
};

/// All of the tree, the root first, a parent before its children, below before above. O(size).
[[nodiscard]] std::vector<CellTreeNode> cell_tree_nodes(const Solid& solid);

}  // namespace trisect
