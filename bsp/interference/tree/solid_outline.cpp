// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/tree/solid_boundary.h>

namespace trisect::detail {

namespace {

// Calls visit(p) for all corners, of a mesh once each.
template <class Visit>
void for_corners(const LeafBoxes& leaf, const Visit& visit) {
    if (const Source* const mesh = leaf.polygons().only_source()) {
        for (const LatticePoint& p : mesh->mesh().points) visit(p.doubles());
        return;
    }
    std::vector<TriangleCorners> parts;
    for (std::uint32_t t = 0; t < leaf.triangle_count(); ++t) {
        parts.clear();
        leaf.add_parts(t, parts);
        for (const TriangleCorners& corners : parts)
            for (const auto& p : corners) visit(p);
    }
}

// Tight boxes of points, cell by cell of a grid over all of them.
std::vector<DoubleBox> outline_of(const LeafBoxes& leaf, std::size_t side) {
    DoubleBox nothing;
    nothing.lo.fill(HUGE_VAL);
    nothing.hi.fill(-HUGE_VAL);
    const auto add = [](DoubleBox& box, const std::array<double, 3>& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::min(box.lo[k], p[k]);
            box.hi[k] = std::max(box.hi[k], p[k]);
        }
    };
    DoubleBox all = nothing;
    for_corners(leaf, [&](const std::array<double, 3>& p) { add(all, p); });
    std::vector<DoubleBox> cells(side * side * side, nothing);
    for_corners(leaf, [&](const std::array<double, 3>& p) {
        std::size_t cell = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double extent = all.hi[k] - all.lo[k];
            const double at =
                extent > 0 ? (p[k] - all.lo[k]) / extent * static_cast<double>(side) : 0;
            cell = cell * side +
                   static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(side - 1)));
        }
        add(cells[cell], p);
    });
    std::erase_if(cells, [](const DoubleBox& b) { return b.lo[0] > b.hi[0]; });
    return cells;
}

}  // namespace

std::vector<DoubleBox> SolidBoundary::outline(std::size_t most) const {
    if (is_empty()) return {};
    const CellNode& root = refined(*base_->root().node);
    if (root.is_leaf()) {
        const LeafBoxes& leaf = boxed_leaf(root, Cell{}).boxes();
        return outline_of(leaf, static_cast<std::size_t>(std::cbrt(static_cast<double>(most))));
    }
    // The largest nodes are divided first.
    const auto is_smaller = [](const Part& a, const Part& b) {
        const auto size = [](const Part& p) {
            return p.at.node->is_leaf() ? 0 : p.at.node->size();
        };
        return size(a) < size(b);
    };
    std::vector<Part> heap{part(root, Cell{}, false)};
    while (heap.size() < most && !heap.front().at.node->is_leaf()) {
        std::ranges::pop_heap(heap, is_smaller);
        const LeafAt at = heap.back().at;
        heap.pop_back();
        for (int i = 0; i < 2; ++i) {
            const CellRef& child = at.node->child(i);
            const CellNode& node = refined(*child.node);
            if (node.size() == 0) continue;
            heap.push_back(part(node,
                                i == 0 ? at.cell.below(at.node->axis(), at.node->splitter())
                                       : at.cell.above(at.node->axis(), at.node->splitter()),
                                false));
            std::ranges::push_heap(heap, is_smaller);
        }
    }
    std::vector<DoubleBox> out;
    for (const Part& p : heap)
        if (!p.is_empty()) out.push_back(p.box);
    return out;
}

}  // namespace trisect::detail
