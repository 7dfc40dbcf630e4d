// SPDX-License-Identifier: Apache-2.0
//
// Leaf arrangement: selection of the polygons that bound a result in one cell.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <trisect/bsp/cells/axis_picture.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/trace_winding.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// What bounds the result in a cell.
struct LeafResult {
    std::vector<PolygonRef> polygons;   ///< whole where nothing cut them
    std::vector<FacetName> incomplete;  ///< facets that lost a part to a coincident facet
    /// So many facets that something crosses were left out.
    std::size_t deferred = 0;
    /// Of an axis-perpendicular leaf whose facets are still to be cut: then `polygons` is empty.
    std::unique_ptr<const AxisPicture> picture = nullptr;
};

/// Scratch memory that one thread uses for all its leaves. What it returns depends on the problem
/// alone, not on the leaves before.
class LeafArranger {
public:
    LeafArranger();
    ~LeafArranger();
    LeafArranger(const LeafArranger&) = delete;
    LeafArranger& operator=(const LeafArranger&) = delete;

    /// `values` must have an entry for every slot of the formula and is scratch; `stats` is added
    /// to.
    [[nodiscard]] LeafResult arrange(const LeafProblem& problem, SlotValues& values,
                                     EvaluateStats& stats);
    /// From now on the crossings of leaves are collected, and facets that something crosses are
    /// left out where that is possible. `operands` are those of the formula, by slot.
    void collect_crossings(std::span<const Crossings::Operand> operands);
    /// From now on axis-perpendicular leaves that would cut facets of imported meshes become
    /// occupancy grids.
    void make_pictures();
    /// A facet of an operand may cross others where no leaf compares them.
    void note_doubtful(std::int32_t slot, std::uint32_t facet);
    /// By number, the facets that leaves found crossed, in formulas of more than two operands.
    [[nodiscard]] const std::vector<std::uint32_t>& seen() const;
    /// Polygons of the largest leaf so far.
    [[nodiscard]] std::size_t largest_leaf() const;
    /// Then it is like new, but keeps its scratch memory.
    void forget();
    /// What was collected so far; unordered, and pairs may be there several times.
    [[nodiscard]] const Crossings& crossings() const;
    /// The same when all polygons are axis-perpendicular and the leaf is not too large for that;
    /// else nothing. Such leaves may be much larger than others.
    [[nodiscard]] std::optional<LeafResult> arrange_across_axes(const LeafProblem& problem,
                                                                EvaluateStats& stats);
    /// The same when all operands are prisms along one axis, whole within the cell; else nothing.
    [[nodiscard]] std::optional<LeafResult> arrange_prisms(const LeafProblem& problem,
                                                           EvaluateStats& stats);
    /// The same in general position, where doubles decide all; else nothing.
    [[nodiscard]] std::optional<LeafResult> arrange_plain(const LeafProblem& problem,
                                                          EvaluateStats& stats);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace trisect::detail
