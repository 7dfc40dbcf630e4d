// SPDX-License-Identifier: Apache-2.0
//
// DeferredLeaf: a leaf with crossing facets that are cut on demand.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/occupancy_grid.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// What a leaf of imported meshes needs to cut its facets when its polygons are first needed: by a
/// later operation there, or by a query. Assembly of a mesh needs only what is `known`
/// (traced_facets.h, axis_faces.h). Immutable.
class DeferredLeaf {
public:
    struct Operand {
        std::int32_t slot = 0;  ///< of the formula
        PolygonList polygons;   ///< whole facets
        bool flipped = false;   ///< they are to be read with the other orientation
        int winding = 0;        ///< at the leaf's reference point
    };
    using Picture = std::unique_ptr<const OccupancyGrid>;
    using Arrange = PolygonList (*)(const DeferredLeaf& leaf);

    Cell cell;
    FinePoint reference;
    std::vector<Operand> operands;
    Residual::Ref formula;
    EvaluateOptions::Winding rule = EvaluateOptions::Winding::Positive;
    /// Of a leaf in general position those of its polygons that nothing crosses in the cell; of a
    /// axis-perpendicular leaf its occupancy grid.
    std::variant<PolygonList, Picture> known;
    /// Lists the leaf's polygons as an evaluation that does not defer would have.
    Arrange arrange = nullptr;

    /// Null for an axis-perpendicular leaf.
    [[nodiscard]] const PolygonList* uncrossed() const { return std::get_if<PolygonList>(&known); }
    /// Null for a leaf in general position.
    [[nodiscard]] const OccupancyGrid* occupancy() const {
        const Picture* const occupancy = std::get_if<Picture>(&known);
        return occupancy != nullptr ? occupancy->get() : nullptr;
    }
    /// For the leaf's node: arrange once.
    [[nodiscard]] std::mutex& arranging() const { return arranging_; }

private:
    mutable std::mutex arranging_;
};

}  // namespace trisect::detail
