// SPDX-License-Identifier: Apache-2.0
//
// LeafArrangement: interface of all leaf arrangements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/cells/occupancy_grid.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// All polygons that bound the result in the cell, whole where nothing cut them.
struct LeafPolygons {
    std::vector<PolygonRef> polygons;
};

/// Of imported meshes, those polygons that nothing crosses in the cell. The others are still to be
/// cut.
struct LeafUncrossed {
    std::vector<PolygonRef> polygons;
    std::size_t crossed = 0;  ///< polygons left out; not 0
};

/// Polygons across axes as a grid of bits; facets of imported meshes are still to be cut.
struct LeafPicture {
    std::unique_ptr<const OccupancyGrid> occupancy;
};

/// Facets that bound the result as they are, and outlines of all else.
struct LeafOutlines {
    std::vector<PolygonRef> whole;
    NamedOutlines outlines;
};

using LeafResult = std::variant<LeafPolygons, LeafUncrossed, LeafPicture, LeafOutlines>;

/// What the leaves of one thread find out beside their polygons.
struct LeafFindings {
    EvaluateStats stats;
    /// Facets that lost a part to a coincident one (CellTree::incomplete); unordered.
    std::vector<FacetName> incomplete;
    /// Whether facets may go straight across each other in a line
    /// (CellTree::may_have_straight_crossings).
    bool may_have_straight_crossings = false;
    /// With the operands of the formula by slot, where crossings are collected; unordered, and
    /// pairs may be there several times.
    std::optional<Crossings> crossings;
    /// By number, the facets that leaves found crossed, in formulas of more than two operands.
    std::vector<std::uint32_t> seen;

    /// A facet of an operand may cross others where no leaf compares them. \pre crossings
    void note_uncertain(std::int32_t slot, std::uint32_t facet) {
        crossings->uncertain.push_back(crossings->number_of(static_cast<std::size_t>(slot), facet));
    }
    /// The same of all facets of a leaf, if crossings are collected.
    void note_uncertain(const LeafProblem& problem);
};

/// Scratch memory that one thread uses for all its leaves of a kind. What it returns depends on the
/// problem alone, not on the leaves before.
class LeafArrangement {
public:
    LeafArrangement() = default;
    virtual ~LeafArrangement() = default;
    LeafArrangement(const LeafArrangement&) = delete;
    LeafArrangement& operator=(const LeafArrangement&) = delete;

    /// Nothing, and no findings, when the leaf is of another kind.
    [[nodiscard]] std::optional<LeafResult> arrange(const LeafProblem& problem,
                                                    LeafFindings& findings);

protected:
    /// As arrange(). Where it gives up the statistics are reset, and where it throws fragments in
    /// `out_` end.
    [[nodiscard]] virtual std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                                   LeafFindings& findings) = 0;
    /// What was collected in `out_`, as large as it need be; `out_` is used again.
    [[nodiscard]] std::vector<PolygonRef> listed();

    std::vector<PolygonRef> out_;  ///< empty when a leaf begins
};

}  // namespace trisect::detail
