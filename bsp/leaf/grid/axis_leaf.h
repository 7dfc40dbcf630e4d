// SPDX-License-Identifier: Apache-2.0
//
// Leaf arrangement of axis-perpendicular polygons: boxes, plates, grids, sponges.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <trisect/bsp/leaf/grid/axis_arrangement.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>

namespace trisect::detail {

/// Arranges a leaf of embedded operands whose polygons are all axis-perpendicular. The planes make
/// a grid of the cell, and a set is a bit for each of its units. Coincident, touching and crossing
/// facets are nothing special, no pair is compared and no segment traced. Keeps its memory from
/// leaf to leaf; what it returns depends on the problem alone.
///
/// What is cut comes out in what facets have of rectangles as large as possible; but where polygons
/// are not needed yet, as a LeafPicture, if facets of imported meshes have to be cut and all facets
/// in their planes bound the result.
///
/// Not for leaves with a polygon of another kind, nor for grids that are too large.
class AxisLeaf final : public LeafArrangement {
private:
    [[nodiscard]] std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) override;

    AxisArrangement<std::int64_t> of_whole_;
    std::unique_ptr<AxisArrangement<Int128>> of_fractions_;  // once it was needed
};

}  // namespace trisect::detail
