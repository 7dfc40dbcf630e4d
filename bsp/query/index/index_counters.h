// SPDX-License-Identifier: Apache-2.0
//
// Counters of what queries do, per thread.
#pragma once

#include <cstdint>

namespace trisect::detail {

struct IndexCounters {
    std::uint64_t empty = 0;   ///< in a cell without polygons, or beyond the solid's box
    std::uint64_t side = 0;    ///< above or below all planes of a cell
    std::uint64_t region = 0;  ///< in a region of a cell that was traced before
    std::uint64_t corner = 0;  ///< on the sides of all planes on which a corner of the cell is
    std::uint64_t traced = 0;  ///< by a segment to such a corner, in single precision
    std::uint64_t exact = 0;   ///< by a segment to a known point, past some polygon exactly
    std::uint64_t on = 0;      ///< on a polygon
    std::uint64_t leaves = 0;  ///< of cell trees, whose polygons were prepared
};

inline constinit thread_local IndexCounters index_counters_of_thread;

[[nodiscard]] inline IndexCounters& index_counters() noexcept { return index_counters_of_thread; }

}  // namespace trisect::detail
