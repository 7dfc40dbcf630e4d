// SPDX-License-Identifier: Apache-2.0
//
// Lists are made of leaves and, where the operands' trees do not share a splitting plane, of whole
// subtrees: the polygons below a node, each clipped to the leaf that lists it. A whole facet that
// all leaves list which it meets stays whole: clipped it would come back as a fragment for each of
// them, at every step of a chain that comes by. Boxes of lists are rounded to a frame; one frame
// that covers all lists and leaves of the task is made when the first list is, and a finer one
// where rounding would hide what has to be parted.

#include <trisect/bsp/divide/operand_lists.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <trisect/bsp/cells/facet_in_cell.h>
#include <trisect/bsp/cells/packed_box.h>
#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/divide/choose_splitting_plane.h>
#include <trisect/bsp/divide/partition.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

// Where rounded positions get this coarse for what has to be parted, a finer frame is made.
constexpr int coarse_extent = 128;

CellRef child_of(const CellNode& node, bool complemented, std::size_t i) {
    CellRef c = node.child(static_cast<int>(i));
    c.complemented = c.complemented != complemented;
    return c;
}

// Contains what a leaf or a list has in a cell. Facets of a mesh are not looked up one by one: a
// somewhat larger frame costs less.
Box box_within(const CellOperand& o, const Cell& cell) {
    const Source* mesh = o.is_list ? nullptr : o.node->polygons().whole_source();
    if (mesh == nullptr || mesh->is_half_space()) return exact_box(o, cell);
    return mesh->box().intersected(cell.lattice_box());
}

// A frame for all lists and leaves of a task.
void make_frame(CellTask& task) {
    Box all;
    for (const CellOperand& o : task.operands) {
        if (!o.is_list && !o.node->is_leaf()) continue;
        const bool unbounded = o.size() == 1 && o.node->polygons().size() == 1 &&
                               o.node->polygons()[0].source->is_half_space();
        const Box b = box_within(o, task.cell);
        if (!unbounded && !b.is_empty()) all.add(b);
    }
    task.has_frame = true;
    if (!all.is_empty()) task.frame = Frame::covering(all);
}

bool has_splitter(const CellOperand& o, const std::optional<SplittingPlane>& splitter) {
    return splitter && !o.is_list && !o.node->is_leaf() && o.node->axis() == splitter->axis &&
           o.node->splitter() == splitter->position;
}

}  // namespace

// Lists the polygons below a node. A polygon that also reaches into other leaves may be missing
// there, so it is clipped to the leaf that lists it; whole facets that do are left to
// join_leaves().
void OperandLists::flatten(const CellRef& tree, const Cell& cell, std::vector<PolygonRef>& out) {
    const CellNode& node = *tree.node;
    if (!node.is_leaf()) {
        for (std::size_t i = 0; i < 2; ++i)
            with_enough_stack([&] {
                flatten(child_of(node, tree.complemented, i),
                        i == 0 ? cell.below(node.axis(), node.splitter())
                               : cell.above(node.axis(), node.splitter()),
                        out);
            });
        return;
    }
    const auto leaf = static_cast<std::uint32_t>(leaf_cells_.size());
    leaf_cells_.push_back(cell);
    for (PolygonRef r : node.polygons()) {
        r.flipped = r.flipped != tree.complemented;
        if (r.fragment == nullptr && !r.source->is_half_space() && !cell.contains(r.box())) {
            reaching_.push_back({r, leaf});
        } else {
            add_clipped(r, cell, out);
        }
    }
}

void OperandLists::add_clipped(const PolygonRef& polygon, const Cell& cell,
                               std::vector<PolygonRef>& out) {
    make_room(out);
    if (const auto part = clip_to_cell(bench_, polygon, cell)) out.push_back(*part);
}

// Whether all leaves list a facet that it meets. `listed`: by those that do.
bool OperandLists::is_whole(std::span<const Reaching> listed) const {
    // Every leaf would be tested with every facet.
    constexpr std::size_t many_leaves = 64;
    if (leaf_cells_.size() > many_leaves) return false;
    const PolygonRef& facet = listed[0].polygon;
    for (const Reaching& r : listed)
        if (r.polygon.flipped != facet.flipped) return false;
    const Box box = facet.box();
    std::size_t next = 0;
    for (std::uint32_t leaf = 0; leaf < leaf_cells_.size(); ++leaf) {
        if (next < listed.size() && listed[next].leaf == leaf) {
            ++next;
        } else if (leaf_cells_[leaf].meets(box) &&
                   !certainly_misses(facet, leaf_cells_[leaf].lattice_box())) {
            return false;
        }
    }
    return true;
}

// Lists the facets that reach out of their leaves.
void OperandLists::join_leaves(std::vector<PolygonRef>& out) {
    const auto name = [](const Reaching& r) {
        return std::pair(r.polygon.source->serial(), r.polygon.facet);
    };
    std::ranges::sort(reaching_, {}, [&](const Reaching& r) { return std::pair(name(r), r.leaf); });
    for (std::size_t begin = 0; begin < reaching_.size();) {
        std::size_t end = begin + 1;
        while (end < reaching_.size() && name(reaching_[end]) == name(reaching_[begin])) ++end;
        const std::span listed(&reaching_[begin], end - begin);
        if (is_whole(listed)) {
            make_room(out);
            PolygonRef& whole = out.emplace_back(listed[0].polygon);
            for (const Reaching& r : listed) whole.touched = whole.touched || r.polygon.touched;
        } else {
            for (const Reaching& r : listed) add_clipped(r.polygon, leaf_cells_[r.leaf], out);
        }
        begin = end;
    }
}

// Makes a leaf of an operand's subtree.
void OperandLists::make_leaf(CellOperand& operand, const Cell& cell) {
    if (operand.is_list || operand.node->is_leaf()) return;
    std::vector<PolygonRef> parts;
    bench_.clear();
    leaf_cells_.clear();
    reaching_.clear();
    try {
        flatten({operand.node->shared_from_this(), operand.complemented}, cell, parts);
        join_leaves(parts);
    } catch (...) {
        end_fragments(parts);
        throw;
    }
    made_.push_back(CellNode::leaf(PolygonList(std::move(parts)), {}, 0, true));
    operand.node = made_.back().get();
    operand.complemented = false;
}

void OperandLists::make(CellTask& task, const std::optional<SplittingPlane>& splitter,
                        std::uint32_t threads) {
    bool opened = false;
    for (CellOperand& o : task.operands) {
        if (o.is_list || has_splitter(o, splitter)) continue;
        make_leaf(o, task.cell);
        opened = true;
    }
    if (!opened) return;
    const bool anew = task.has_frame && !splitter;
    if (anew || !task.has_frame) make_frame(task);
    for (CellOperand& o : task.operands) {
        if (has_splitter(o, splitter)) continue;
        if (!o.is_list) {
            open_leaf(o, task, arena_, threads);
        } else if (anew) {
            reframe(o, task, arena_);
        }
    }
}

void OperandLists::refine_frame(CellTask& task) const {
    if (task.frame.shift == 0 || contested_extent(task) >= coarse_extent) return;
    Box all;
    for (const CellOperand& o : task.operands) {
        if (o.unbounded || o.count == 0) continue;
        const Box b = exact_box(o, task.cell);
        if (!b.is_empty()) all.add(b);
    }
    if (all.is_empty()) return;
    const Frame finer = Frame::covering(all);
    if (finer.shift >= task.frame.shift) return;
    task.frame = finer;
    for (CellOperand& o : task.operands) reframe(o, task, arena_);
}

}  // namespace trisect::detail
