// SPDX-License-Identifier: Apache-2.0
//
// What the steps of a leaf arrangement share: its polygons, what is known about them, and the
// pieces that they are cut into.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/detail/leaf_problem.h>
#include <trisect/bsp/detail/solid_state.h>
#include <trisect/bsp/detail/workbench.h>

namespace trisect::detail {

/// Number of an item, a piece or an operand of a leaf.
using LeafIndex = std::int32_t;

/// A polygon of the leaf with everything that the arrangement learns about it.
struct LeafItem {
    PolygonRef ref;
    LeafIndex operand = 0;
    int orientation = 1;  ///< -1 when flipped
    WorkPolygon shape;    ///< unclipped
    Box box;              ///< within the cell
    std::vector<LeafIndex> cutters;
    std::vector<LeafIndex> covers;  ///< coplanar, interiors meet
    bool touched = false;           ///< something of another surface may touch it
    int side_of_reference = 2;      ///< of the support; 2 = not computed

    [[nodiscard]] bool is_whole() const { return cutters.empty() && covers.empty(); }
};

/// A convex part of an item, on one side of everything else.
struct LeafPiece {
    LeafIndex item = 0;
    WorkPolygon shape;
    int step = 0;          ///< index into steps: how winding numbers change across
    bool dropped = false;  ///< a coincident piece speaks for it
};

struct LeafWork {
    Workbench bench;
    const LeafProblem* problem = nullptr;
    EvaluateStats* stats = nullptr;
    std::vector<LeafItem> items;
    std::vector<LeafPiece> pieces;
    std::vector<std::vector<int>> steps;
    std::vector<FacetName> incomplete;

    /// Forgets the last leaf and lists the polygons of this one.
    void start(const LeafProblem& leaf, EvaluateStats& counters);

    [[nodiscard]] static std::size_t u(LeafIndex i) { return static_cast<std::size_t>(i); }
    [[nodiscard]] LeafItem& item(LeafIndex i) { return items[u(i)]; }
    [[nodiscard]] const LeafItem& item(LeafIndex i) const { return items[u(i)]; }
    [[nodiscard]] const LeafOperand& operand_of(const LeafItem& i) const {
        return problem->operands[u(i.operand)];
    }
    /// The edge planes of a whole facet are made when something asks for them: most facets of a
    /// leaf meet nothing.
    const WorkPolygon& with_edges(LeafIndex i) {
        bench.with_edges(item(i).shape, item(i).ref);
        return item(i).shape;
    }
    /// How winding numbers change from below to above an item that nothing covers.
    [[nodiscard]] std::vector<int> step_of(LeafIndex i) const;
};

}  // namespace trisect::detail
