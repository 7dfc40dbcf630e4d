// SPDX-License-Identifier: Apache-2.0
//
// A child of a cell needs a point off all polygons with the winding numbers of all operands there.
// The parent's point is one child's too. For the other one the way leads straight through the
// splitting plane: so it meets little, and most lists have nothing near it. A tree that is cut
// along its own splitting plane has a point itself. What is hit in an edge or a vertex gives up,
// and the next point is tried.

#include <trisect/bsp/divide/reference_points.h>

#include <algorithm>
#include <vector>

#include <trisect/bsp/cells/trace/axis_trace.h>
#include <trisect/bsp/cells/trace/trace_winding.h>
#include <trisect/bsp/divide/refine_leaf.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

bool lies_outside(const FinePoint& p, const Box& box) {
    for (std::size_t k = 0; k < 3; ++k)
        if (p.c[k] < fine_lower(box.lo[k], false) || p.c[k] > fine_upper(box.hi[k], false))
            return true;
    return false;
}

const CellNode* unfolded(const CellNode* node) {
    if (!node->is_leaf()) return node;
    const CellNode* refinement = node->refinement();
    return refinement != nullptr ? refinement : node;
}

std::optional<int> winding_in_tree(const CellNode& root, bool complemented, const Cell& cell,
                                   const FinePoint& p) {
    const CellNode* node = unfolded(&root);
    Cell at = cell;
    while (true) {
        if (node->is_leaf() && node->reference() == p)
            return complemented_winding(node->winding(), complemented);
        if (node->is_leaf() && node->size() > 4 * refinable_leaf)
            if (const CellNode* fine = refined(*node, at)) node = fine;
        if (node->is_leaf()) break;
        const std::size_t i =
            p.c[static_cast<std::size_t>(node->axis())] > node->splitter() ? 1 : 0;
        const CellRef& c = node->child(static_cast<int>(i));
        at = i == 0 ? at.below(node->axis(), node->splitter())
                    : at.above(node->axis(), node->splitter());
        complemented = complemented != c.complemented;
        node = unfolded(c.node.get());
    }
    const std::vector<PolygonRef> refs(node->polygons().begin(), node->polygons().end());
    const auto change = trace_winding(refs, false, node->reference(), p);
    if (!change) return std::nullopt;
    return complemented_winding(node->winding() + *change, complemented);
}

namespace {

// The lattice positions that a segment comes near.
Box box_around(const FinePoint& a, const FinePoint& b) {
    Box segment;
    for (std::size_t k = 0; k < 3; ++k) {
        segment.lo[k] = lattice_below(std::min(a.c[k], b.c[k])) - 1;
        segment.hi[k] = lattice_below(std::max(a.c[k], b.c[k])) + 2;
    }
    return segment;
}

std::optional<int> list_winding(const CellTask& task, const CellOperand& o, const FinePoint& p,
                                std::optional<int> axis) {
    if (o.count == 0) return o.winding;
    const PackedReach near(PackedBox::of(task.frame, box_around(task.reference, p)));
    // The way is in the cell, and what is in the list lies in that box as far as the cell goes.
    if (!o.unbounded && !near.meets(o.box)) return o.winding;
    if (axis) {
        AxisTrace trace(task.reference, p, *axis);
        for (const PackedBox& e : o.list())
            if (near.meets(e)) trace.add(o.polygon(e.id));
        const auto change = trace.change(o.complemented);
        if (!change) return std::nullopt;
        return o.winding + *change;
    }
    std::vector<PolygonRef> met;
    for (const PackedBox& e : o.list())
        if (near.meets(e)) met.push_back(o.polygon(e.id));
    const auto change = trace_winding(met, o.complemented, task.reference, p);
    if (!change) return std::nullopt;
    return o.winding + *change;
}

// Winding numbers of all operands at p, which lies in the task's cell; `axis` when only that
// coordinate differs from the reference.
bool windings_at(const CellTask& task, const FinePoint& p, std::optional<int> axis, CellTask& out) {
    for (std::size_t i = 0; i < task.operands.size(); ++i) {
        const CellOperand& o = task.operands[i];
        const std::optional<int> w = o.is_list
                                         ? list_winding(task, o, p, axis)
                                         : winding_in_tree(*o.node, o.complemented, task.cell, p);
        if (!w) return false;
        out.operands[i].winding = *w;
    }
    out.reference = p;
    return true;
}

// The same for a point straight behind a splitting plane, on whose other side the reference lies.
// What meets the way there reaches over to that side, unless the way passes a position where a
// corner may be behind the splitting plane.
bool pass_splitter(const CellTask& task, const SplittingPlane& splitter, const FinePoint& p,
                   const CellTask& other_side, CellTask& out) {
    const auto k = static_cast<std::size_t>(splitter.axis);
    if (lattice_below(p.c[k]) != splitter.last_below() || p.c[k] % splitting_scale == 0 ||
        std::ranges::any_of(task.operands, &CellOperand::has_fractions))
        return windings_at(task, p, splitter.axis, out);
    for (std::size_t i = 0; i < task.operands.size(); ++i) {
        const CellOperand& o = task.operands[i];
        const std::optional<int> w =
            o.is_list ? list_winding(task, other_side.operands[i], p, splitter.axis)
                      : winding_in_tree(*o.node, o.complemented, task.cell, p);
        if (!w) return false;
        out.operands[i].winding = *w;
    }
    out.reference = p;
    return true;
}

}  // namespace

bool place_reference(const CellTask& task, const SplittingPlane& splitter, int which,
                     CellChildren& children) {
    const auto k = static_cast<std::size_t>(splitter.axis);
    CellTask& out = children[static_cast<std::size_t>(which)];
    const CellTask& other_side = children[static_cast<std::size_t>(1 - which)];
    if (out.cell.contains(task.reference)) {
        out.reference = task.reference;
        for (std::size_t i = 0; i < task.operands.size(); ++i)
            out.operands[i].winding = task.operands[i].winding;
        return true;
    }
    // A tree that is cut along its own splitting plane has points on both sides, without a trace.
    for (const CellOperand& o : out.operands) {
        if (o.is_list) continue;
        const CellNode* node = o.node;
        while (!node->is_leaf()) node = node->child(which == 0 ? 1 : 0).node.get();
        const FinePoint p = node->reference();
        if (out.cell.contains(p) && windings_at(task, p, std::nullopt, out)) return true;
        break;
    }
    // Straight through the splitting plane; the segment hits little.
    FinePoint p = task.reference;
    const std::int64_t first = first_reference_steps[static_cast<std::size_t>(which)][k];
    for (const std::int64_t step : {first, std::int64_t{37}, std::int64_t{59}, std::int64_t{101}}) {
        const std::int64_t direction = which == 0 ? -1 : 1;
        p.c[k] = reference_position(splitter.position + direction * step, direction);
        if (out.cell.contains(p) && pass_splitter(task, splitter, p, other_side, out)) return true;
    }
    // Then anywhere near the polygons.
    Box around;
    for (const CellOperand& o : task.operands) {
        if (!o.is_list || o.box.is_empty()) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            around.lo[axis] =
                std::min(around.lo[axis], task.frame.last_below(axis, o.box.low(axis)) + 1);
            around.hi[axis] =
                std::max(around.hi[axis], task.frame.last_below(axis, o.box.high(axis) + 1));
        }
    }
    if (around.is_empty()) around = out.cell.lattice_box();
    for (std::uint64_t attempt = 1; attempt <= 200; ++attempt) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Near the polygons, or at the end of the cell that is nearest to them.
            std::int64_t lo =
                std::max(out.cell.lo[axis] + 1, (around.lo[axis] - 2) * splitting_scale);
            std::int64_t hi =
                std::min(out.cell.hi[axis] - 1, (around.hi[axis] + 2) * splitting_scale);
            if (hi - lo < splitting_scale / 2) {
                const bool cell_is_above =
                    (around.hi[axis] + 2) * splitting_scale < out.cell.hi[axis];
                lo = cell_is_above ? out.cell.lo[axis] + 1
                                   : std::max(out.cell.lo[axis] + 1, out.cell.hi[axis] - 512);
                hi = std::min(out.cell.hi[axis] - 1, lo + 512);
            }
            const auto range = static_cast<std::uint64_t>(std::max<std::int64_t>(hi - lo, 1));
            const auto c = lo + static_cast<std::int64_t>(mix64(attempt * 3 + axis) % range);
            p.c[axis] = reference_position(c, 1);
        }
        if (out.cell.contains(p) && windings_at(task, p, std::nullopt, out)) return true;
    }
    return false;
}

}  // namespace trisect::detail
