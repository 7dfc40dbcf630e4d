// SPDX-License-Identifier: Apache-2.0
//
// The root's reference point. For imported meshes it is a corner outside of everything, where all
// winding numbers are free; a solid with a tree already has the numbers at points of its own, and
// from there a straight segment is traced. A segment that meets an edge or a vertex is given up for
// one to another point, farther out.

#include <trisect/bsp/evaluate/root_task.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/bsp/divide/reference_points.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

namespace {

// Fragments of half-spaces may end where space does: nothing is beyond them.
bool ends_at_limit(const Box& box) { return std::ranges::min(box.lo) <= -coordinate_limit; }

// A point outside the boxes of all leaves, three units beyond their common corner; or, when there
// is a tree, any of its points.
FinePoint outer_reference(std::span<const std::shared_ptr<const SolidState>> solids) {
    Box all;
    for (const auto& s : solids) {
        const CellNode* n = s->root().node.get();
        if (!n->is_leaf()) {
            while (!n->is_leaf()) n = n->child(0).node.get();
            return n->reference();
        }
        const PolygonList& polygons = n->polygons();
        const Source* whole = polygons.has_all_facets() ? polygons.whole_source() : nullptr;
        if (whole != nullptr && !whole->is_half_space()) {
            if (!whole->box().is_empty()) all.add(whole->box());
            continue;
        }
        for (const PolygonRef& r : polygons)
            if ((r.fragment != nullptr || !r.source->is_half_space()) && !ends_at_limit(r.box()))
                all.add(r.box());
    }
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k)
        p.c[k] =
            all.is_empty() ? 0 : (all.lo[k] - 3) * splitting_scale + 6 * static_cast<int>(k) + 12;
    return p;
}

bool passes_by(const Box& box, const FinePoint& a, const FinePoint& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::max(a.c[k], b.c[k]) < fine_lower(box.lo[k], false) ||
            std::min(a.c[k], b.c[k]) > fine_upper(box.hi[k], false))
            return true;
    return false;
}

// Winding number of a root at a point: at once where the way there is free.
std::optional<int> winding_of_root(const SolidState& solid, const FinePoint& p) {
    const CellNode& n = *solid.root().node;
    const Source* whole =
        n.is_leaf() && n.polygons().has_all_facets() ? n.polygons().whole_source() : nullptr;
    if (whole != nullptr && passes_by(whole->box(), n.reference(), p))
        return complemented_winding(n.winding(), solid.root().complemented);
    return winding_in_tree(n, solid.root().complemented, Cell{}, p);
}

void place_operand(const SolidState& solid, std::size_t slot, int winding, CellTask& task) {
    CellOperand o;
    o.slot = static_cast<std::int32_t>(slot);
    o.winding = winding;
    o.embedded = solid.embedded;
    o.has_fractions = !solid.whole;
    o.complemented = solid.root().complemented;
    o.node = unfolded(solid.root().node.get());
    ::new (&task.operands[slot]) CellOperand(o);
}

bool place_root(std::span<const std::shared_ptr<const SolidState>> solids, CellTask& task) {
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const auto w = winding_of_root(*solids[i], task.reference);
        if (!w) return false;
        place_operand(*solids[i], i, *w, task);
    }
    return true;
}

}  // namespace

CellTask root_task(const Residual::Ref& formula,
                   std::span<const std::shared_ptr<const SolidState>> solids, StackArena& arena) {
    CellTask task;
    task.formula = formula;
    task.reference = outer_reference(solids);
    task.operands = {arena.take<CellOperand>(solids.size()), solids.size()};
    bool placed = place_root(solids, task);
    for (int attempt = 0; attempt < 100 && !placed; ++attempt) {
        for (std::size_t k = 0; k < 3; ++k)
            task.reference.c[k] -= static_cast<std::int64_t>(
                6 * (mix64(static_cast<std::uint64_t>(attempt) * 3 + k) % 2000));
        placed = place_root(solids, task);
    }
    TRISECT_EXPECTS(placed, "no reference point for the operands");
    return task;
}

CellTask task_in_cell(const Residual::Ref& formula,
                      std::span<const std::shared_ptr<const SolidState>> solids, const Cell& cell,
                      StackArena& arena) {
    CellTask task;
    task.cell = cell;
    task.formula = formula;
    task.reference = solids[0]->root().node->reference();
    task.operands = {arena.take<CellOperand>(solids.size()), solids.size()};
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const CellRef& root = solids[i]->root();
        place_operand(*solids[i], i, complemented_winding(root.node->winding(), root.complemented),
                      task);
    }
    return task;
}

}  // namespace trisect::detail
