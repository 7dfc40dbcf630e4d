// SPDX-License-Identifier: Apache-2.0
//
// Part of a listed polygon inside a cell.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// The part of a polygon in a closed cell: the polygon itself when it is not cut, nothing when no
/// area is left.
[[nodiscard]] std::optional<PolygonRef> clip_to_cell(Workbench& bench, const PolygonRef& ref,
                                                     const Cell& cell);

/// Whether a polygon has area in the cell; its box may reach into cells that it misses.
[[nodiscard]] bool meets_cell(Workbench& bench, const PolygonRef& ref, const Cell& cell);

/// Whether all that the bounding planes of a cell could cut off a fragment has been cut off: its
/// box is rounded outwards and says too much where it ends at a splitting plane.
[[nodiscard]] bool ends_at_splitters(const Fragment& fragment, const Cell& cell);

/// Room for one more polygon, to be made before its fragment is: a fragment that no list holds yet
/// would be lost when the list cannot grow.
inline void make_room(std::vector<PolygonRef>& list) {
    if (list.size() == list.capacity()) list.reserve(2 * list.size() + 8);
}

/// Ends the fragments of a list that did not become a PolygonList: those without other owners.
inline void end_fragments(std::vector<PolygonRef>& list) {
    const PolygonList freed(std::move(list));
}

/// A new fragment of `ref` with the polygon's edges.
[[nodiscard]] PolygonRef make_fragment(const Workbench& bench, const PolygonRef& ref,
                                       const WorkPolygon& polygon);

}  // namespace trisect::detail
