// SPDX-License-Identifier: Apache-2.0
//
// GridCounters: numbers of facets that were listed by cells of a grid.
#pragma once

#include <cstdint>

namespace trisect::detail {

/// Of a thread, as Diagnostics<GridCounters> has them (kernel/diagnostics.h): what it lists itself.
struct GridCounters {
    std::uint64_t grids = 0;   ///< pairs of solids whose facets were listed so (PlacesInCells)
    std::uint64_t facets = 0;  ///< of both, each once

    GridCounters& operator-=(const GridCounters& o) {
        grids -= o.grids;
        facets -= o.facets;
        return *this;
    }
};

}  // namespace trisect::detail
