// SPDX-License-Identifier: Apache-2.0
//
// Boxes of lists of polygons, as native files have them.
#pragma once

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// Of what has no box.
inline constexpr Box no_box{{0, 0, 0}, {0, 0, 0}};

/// Adds the boxes of all that a list has.
inline void add_listed(Box& box, const PolygonList& list) {
    if (list.has_all_facets()) return box.add(list.whole_source()->box());
    for (const PolygonRef& r : list) box.add(r.box());
}

}  // namespace trisect::detail
