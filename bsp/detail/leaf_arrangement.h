// SPDX-License-Identifier: Apache-2.0
//
// Leaf arrangement: which polygons bound the result in one cell.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cell_tree.h>
#include <trisect/bsp/detail/residual.h>
#include <trisect/bsp/detail/solid_state.h>
#include <trisect/bsp/detail/workbench.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// An operand of the formula in one cell.
struct LeafOperand {
    std::int32_t slot = -1;
    std::span<const PolygonRef> polygons;
    bool flipped = false;  ///< the polygons are to be read with the other orientation
    /// The polygons do not cross, cover or touch each other except in common edges and vertices,
    /// and the winding number is 0 outside and 1 inside.
    bool embedded = false;
    int winding = 0;  ///< at the reference point
};

struct LeafProblem {
    Cell cell;
    FinePoint reference;
    std::span<const LeafOperand> operands;
    const Residual* formula = nullptr;
    const EvaluateOptions* options = nullptr;
};

/// \throw LimitError when the work so far exceeds the budget, CancelledError when asked to stop.
void check_budget(const EvaluateOptions& options, const EvaluateStats& stats);

/// Scratch memory that one thread uses for all its leaves; starts anywhere, ends anywhere.
class LeafArranger {
public:
    LeafArranger();
    ~LeafArranger();
    LeafArranger(const LeafArranger&) = delete;
    LeafArranger& operator=(const LeafArranger&) = delete;

    /// The polygons of the result in the cell, whole where nothing cut them. `values` must have an
    /// entry for every slot of the formula and is scratch.
    [[nodiscard]] std::vector<PolygonRef> arrange(const LeafProblem& problem, SlotValues& values,
                                                  EvaluateStats& stats);
    /// Facets that lost a part to a coincident facet in the cells so far (SolidState::incomplete).
    [[nodiscard]] std::vector<FacetName>& incomplete();

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Change of an operand's winding number from one reference point to another, along polygons that
/// include all that meet the segment. Nothing when the segment is degenerate.
[[nodiscard]] std::optional<int> trace_winding(std::span<const PolygonRef> polygons, bool flipped,
                                               const FinePoint& from, const FinePoint& to);

/// inside = winding number > 0, or != 0.
[[nodiscard]] inline bool is_inside(int winding, EvaluateOptions::Winding rule) {
    return rule == EvaluateOptions::Winding::Positive ? winding > 0 : winding != 0;
}

/// The part of a polygon in a closed cell: the polygon itself when it is not cut, nothing when no
/// area is left.
[[nodiscard]] std::optional<PolygonRef> clip_to_cell(Workbench& bench, const PolygonRef& ref,
                                                     const Cell& cell);

/// Whether a polygon has area in the cell; its box may reach into cells that it misses.
[[nodiscard]] bool meets_cell(Workbench& bench, const PolygonRef& ref, const Cell& cell);

/// A new fragment of `ref` with the polygon's edges.
[[nodiscard]] PolygonRef make_fragment(const Workbench& bench, const PolygonRef& ref,
                                       const WorkPolygon& polygon);

}  // namespace trisect::detail
