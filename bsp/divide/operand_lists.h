// SPDX-License-Identifier: Apache-2.0
//
// Polygon lists of a task's operands, from subtrees and leaves.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// Makes the lists that partition() distributes, and the leaves that arrangements read. Keeps the
/// leaves that it makes of subtrees, since lists name their polygons.
class OperandLists {
public:
    OperandLists(StackArena& arena, Workbench& bench) : arena_(arena), bench_(bench) {}

    /// Makes lists of all operands, except trees that have the splitting plane. When nothing but
    /// lists is left, the frame is made anew: the one so far may belong to one operand and be
    /// narrow. `threads` as in ParallelParts.
    void make(CellTask& task, const std::optional<SplittingPlane>& splitter, std::uint32_t threads);

    /// Makes leaves of subtrees, so that every operand is a list or a leaf: all that an arrangement
    /// needs, which looks at polygons and not at boxes in a frame.
    void make_leaves(CellTask& task) {
        for (CellOperand& o : task.operands) make_leaf(o, task.cell);
    }

    /// A finer frame for the task where what still has to be parted is small in its own.
    /// \pre all operands are lists.
    void refine_frame(CellTask& task) const;

private:
    /// A whole facet, listed by a leaf out of which it reaches.
    struct Reaching {
        PolygonRef polygon;
        std::uint32_t leaf = 0;
    };
    void flatten(const CellRef& tree, const Cell& cell, std::vector<PolygonRef>& out);
    void add_clipped(const PolygonRef& polygon, const Cell& cell, std::vector<PolygonRef>& out);
    [[nodiscard]] bool is_whole(std::span<const Reaching> listed) const;
    void join_leaves(std::vector<PolygonRef>& out);
    void make_leaf(CellOperand& operand, const Cell& cell);

    StackArena& arena_;
    Workbench& bench_;
    std::vector<std::shared_ptr<const CellNode>> made_;
    // Of the subtree that becomes a leaf.
    std::vector<Cell> leaf_cells_;
    std::vector<Reaching> reaching_;
};

}  // namespace trisect::detail
