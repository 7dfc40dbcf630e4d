// SPDX-License-Identifier: Apache-2.0
//
// An operation copies the paths to what it changes and shares all other nodes. So both trees are
// gone down side by side, and wherever they have the same node everything below is the same. Cells
// of a node are compared as they were put together before, whatever would be chosen now.

#include <utility>

#include <trisect/bsp/interference/tree/clipped_polygon.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>

namespace trisect::detail {

namespace {

bool are_equal(const Cell& a, const Cell& b) { return a.lo == b.lo && a.hi == b.hi; }

bool contains(const Cell& a, const Cell& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (b.lo[k] < a.lo[k] || b.hi[k] > a.hi[k]) return false;
    return true;
}

// Room before everything is made anew, in nodes.
constexpr std::uint32_t few_dropped = 4096;

}  // namespace

std::optional<ChangedBoxes> SolidBoundary::replace(const Solid& solid) {
    auto next = std::make_unique<const IndexBase>(solid);
    const CellNode& root = refined(*next->root().node);
    if (is_empty() || root.size() == 0 || next->lattice() != lattice || !next->is_bounded() ||
        next->is_inside_beyond() || dropped_ > boxes.nodes.size() / 2 + few_dropped)
        return std::nullopt;
    const Part all = part(*next, root, Cell{}, next->root().complemented);
    for (std::size_t k = 0; k < 3; ++k)
        if (all.box.lo[k] < lo[k] || all.box.hi[k] > hi[k]) return std::nullopt;
    // What was the mesh of a source may be clipped from now on.
    position_error = clipped_error * largest;
    // The old tree lives until all is compared.
    const std::unique_ptr<const IndexBase> before = std::exchange(base_, std::move(next));
    ChangedBoxes changed(boxes.nodes.size());
    update(ObbId{}, all, changed);
    return changed;
}

void SolidBoundary::update(ObbId id, const Part& next, ChangedBoxes& changed) {
    Part& part = parts_[part_of_[id.index]];
    if (part.at.node == next.at.node && part.at.turned == next.at.turned) return;
    changed.set_other(id);
    put_box(id.node(), id.lane(), next.box);
    const bool both_divided = !part.at.node->is_leaf() && !next.at.node->is_leaf();
    part = next;
    const ObbChild child = boxes.nodes[id.node()].child[id.lane()];
    if (child.is_pending()) return;
    if (both_divided && update_cells(child.node(), next, changed)) return;
    drop(child.node(), changed);
    boxes.nodes[id.node()].child[id.lane()] = ObbChild::pending(0);
}

// False where the lanes of the node are not all there is.
bool SolidBoundary::update_cells(std::uint32_t node, const Part& next, ChangedBoxes& changed) {
    std::vector<std::pair<ObbId, Part>> found;
    std::vector<LeafAt> open{next.at};
    std::uint32_t used = 0;
    const auto lane_of = [&](const auto& holds) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t p = part_of_[ObbId::of(node, k).index];
            if (p != none && boxes.nodes[node].half[0][k] >= 0 && holds(parts_[p].at.cell))
                return static_cast<int>(k);
        }
        return -1;
    };
    for (std::uint32_t k = 0; k < 4; ++k)
        if (boxes.nodes[node].half[0][k] >= 0) ++used;
    while (!open.empty()) {
        const LeafAt at = open.back();
        open.pop_back();
        if (const int lane = lane_of([&](const Cell& c) { return are_equal(c, at.cell); });
            lane >= 0) {
            const Part p = part(*at.node, at.cell, at.turned);
            if (at.node->size() == 0 || p.is_empty()) return false;
            found.emplace_back(ObbId::of(node, static_cast<std::uint32_t>(lane)), p);
            continue;
        }
        if (at.node->size() == 0) continue;
        if (at.node->is_leaf() ||
            lane_of([&](const Cell& c) { return contains(at.cell, c); }) < 0) {
            if (!part(*at.node, at.cell, at.turned).is_empty()) return false;
            continue;
        }
        for (int i = 0; i < 2; ++i) {
            const CellRef& child = at.node->child(i);
            open.push_back({&refined(*child.node),
                            i == 0 ? at.cell.below(at.node->axis(), at.node->splitter())
                                   : at.cell.above(at.node->axis(), at.node->splitter()),
                            at.turned != child.complemented});
        }
    }
    if (found.size() != used) return false;
    for (const auto& [id, p] : found) update(id, p, changed);
    return true;
}

void SolidBoundary::drop(std::uint32_t node, ChangedBoxes& changed) {
    std::vector<std::uint32_t> open{node};
    while (!open.empty()) {
        const std::uint32_t n = open.back();
        open.pop_back();
        changed.set_gone(n);
        ++dropped_;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const ObbChild child = boxes.nodes[n].child[k];
            if (!child.is_leaf() && !child.is_pending()) open.push_back(child.node());
        }
    }
}

}  // namespace trisect::detail
