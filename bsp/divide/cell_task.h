// SPDX-License-Identifier: Apache-2.0
//
// CellTask: the remaining work of an evaluation in one cell.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/packed_box.h>
#include <trisect/bsp/cells/residual.h>

namespace trisect::detail {

/// An operand in a cell: the subtree of this cell, or a list of polygons that may meet it. Trivial
/// type; what it points to is kept by the operands of the evaluation, the evaluator or its arena.
struct CellOperand {
    std::int32_t slot = -1;
    int winding = 0;  ///< at the cell's reference point
    bool embedded = false;
    bool has_fractions = false;  ///< of coordinates
    bool complemented = false;   ///< of the tree; of a list: read with the other orientation
    bool is_list = false;
    bool unbounded = false;  ///< a list: of one half-space
    bool drawn_in = false;   ///< a list: some boxes reach beyond the frame
    /// The node whose cell this is (a leaf, or with children); of a list, the leaf that its entries
    /// name polygons of: facet numbers if the leaf has a whole source, else places in its list.
    const CellNode* node = nullptr;
    const PackedBox* entries = nullptr;
    std::uint32_t count = 0;
    PackedBox box;  ///< of a list: its reach, within the cell

    [[nodiscard]] std::uint64_t size() const { return is_list ? count : node->size(); }
    [[nodiscard]] std::span<const PackedBox> list() const { return {entries, count}; }
    [[nodiscard]] PolygonRef polygon(std::uint32_t id) const {
        const PolygonList& names = node->polygons();
        const Source* whole = names.whole_source();
        return whole != nullptr ? PolygonRef{whole, nullptr, id, names.flipped(), false}
                                : names[id];
    }
};

struct CellTask {
    Cell cell;
    FinePoint reference;
    Frame frame;
    bool has_frame = false;
    Residual::Ref formula;
    std::span<CellOperand> operands;
    int depth = 0;
    /// A part of the formula of a cell, whose operands may be results of other parts: they are
    /// none of the operands that crossings are collected of.
    bool is_part = false;
    int stalled = 0;  ///< splitting planes in a row that did not separate the polygons

    [[nodiscard]] std::uint64_t size() const {
        std::uint64_t sum = 0;
        for (const CellOperand& o : operands) sum += o.size();
        return sum;
    }
};

struct SplittingPlane {
    int axis = 0;
    std::int64_t position = 0;

    [[nodiscard]] std::int64_t last_below() const { return lattice_below(position); }
};

/// Winding numbers of a complement; those of solids with trees are 0 and 1.
[[nodiscard]] inline int complemented_winding(int winding, bool complemented) {
    return complemented ? 1 - winding : winding;
}

}  // namespace trisect::detail
