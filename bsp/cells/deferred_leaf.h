// SPDX-License-Identifier: Apache-2.0
//
// DeferredLeaf: a leaf with crossing facets that are cut on demand.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <trisect/bsp/cells/axis_picture.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// What a leaf of imported meshes needs to cut its facets on the first use of its polygons: a later
/// operation there, a query. It is one in general position, or an axis-perpendicular one. A mesh of
/// the result does not need them (traced_facets.h, axis_faces.h). Immutable.
class DeferredLeaf {
public:
    struct Operand {
        std::int32_t slot = 0;  ///< of the formula
        PolygonList polygons;   ///< whole facets
        bool flipped = false;   ///< they are to be read with the other orientation
        int winding = 0;        ///< at the leaf's reference point
    };

    Cell cell;
    FinePoint reference;
    std::vector<Operand> operands;
    Residual::Ref formula;
    EvaluateOptions::Winding rule = EvaluateOptions::Winding::Positive;
    /// Of a leaf in general position: those of its polygons that nothing crosses in the cell.
    PolygonList uncrossed;
    /// Of an axis-perpendicular leaf; else null.
    std::unique_ptr<const AxisPicture> picture;

    /// The leaf's polygons, as an evaluation that does not defer would have listed them.
    [[nodiscard]] PolygonList arrange() const;
    /// For the leaf's node: arrange() once.
    [[nodiscard]] std::mutex& arranging() const { return arranging_; }

private:
    mutable std::mutex arranging_;
};

}  // namespace trisect::detail
