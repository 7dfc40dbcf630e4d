// SPDX-License-Identifier: Apache-2.0
//
// The tree of a mesh before any operation.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/source.h>

namespace trisect::detail {

/// One leaf with all facets. `t_edges`: as import reports, corners lie inside edges, so that every
/// facet may have vertices in its edges.
[[nodiscard]] inline std::shared_ptr<const CellNode> uncut_root(const Source& source,
                                                                bool t_edges) {
    auto root = CellNode::fresh(source, point_beyond(source.box()), 0, false);
    if (!t_edges) return root;
    std::vector<PolygonRef> refs(root->polygons().begin(), root->polygons().end());
    for (PolygonRef& r : refs) r.touched = true;
    return CellNode::leaf(PolygonList(std::move(refs)), root->reference(), root->winding(), true);
}

}  // namespace trisect::detail
