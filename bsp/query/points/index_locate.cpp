// SPDX-License-Identifier: Apache-2.0
//
// Point location, one point after the other: a descent to a cell, and there PointInLeaf.

#include <algorithm>

#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/points/index_counters.h>
#include <trisect/bsp/query/points/index_in_leaf.h>

namespace trisect::detail {

namespace {

// Whether a point is known well enough for the planes of a cell.
bool is_precise(const IndexTree::Cell& cell, const IndexPoint& p) {
    if (p.is_doubles()) return true;
    if (cell.grid == nullptr) return false;
    const auto& s = cell.grid->scale;
    return p.error() * std::max({s[0], s[1], s[2]}) < 0x1p-22;
}

bool is_beyond(const IndexTree& tree, const IndexPoint& p) {
    if (!tree.is_bounded()) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] - p.error() > tree.hi()[k] || p[k] + p.error() < tree.lo()[k]) return true;
    return false;
}

}  // namespace

Location locate_polygons(const IndexBase& index, const IndexPoint& point,
                         std::vector<PolygonId>& on) {
    on.clear();
    const IndexTree& tree = index.tree;
    if (is_beyond(tree, point)) {
        ++index_counters().empty;
        return tree.is_inside_beyond() ? Location::Inside : Location::Outside;
    }
    bool inside = false;
    bool several = false;
    tree.for_leaves_at(point, [&](const IndexTree::Cell& cell, const IndexGrid::Position& at) {
        if (!cell.is_mixed()) {
            ++index_counters().empty;
            inside = cell.is_inside();
            return;
        }
        const std::size_t before = on.size();
        PointInLeaf in_leaf;
        in_leaf.begin(tree, cell, at, is_precise(cell, point));
        const PointInLeaf::Answer quick = in_leaf.decide(index);
        const bool found = quick == PointInLeaf::Answer::Open
                               ? in_leaf.finish(index, point, on)
                               : quick == PointInLeaf::Answer::Inside;
        if (on.empty()) inside = found;
        several = several || (before != 0 && on.size() != before);
    });
    if (on.empty()) return inside ? Location::Inside : Location::Outside;
    if (several) {
        std::sort(on.begin(), on.end());
        on.erase(std::unique(on.begin(), on.end()), on.end());
    }
    return Location::OnFace;
}

}  // namespace trisect::detail
