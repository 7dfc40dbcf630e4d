// SPDX-License-Identifier: Apache-2.0
//
// BoxesCounters: counts of the boxes that questions made.
#pragma once

#include <cstdint>

#include <trisect/kernel/counters.h>

namespace trisect::detail {

/// Leaves of cell trees that got boxes, and nodes.
struct BoxesCounters {
    std::uint64_t hulls = 0;      ///< of leaves
    std::uint64_t leaves = 0;     ///< with boxes of their triangles
    std::uint64_t triangles = 0;  ///< in these leaves
    std::uint64_t nodes = 0;      ///< of trees of solids, put together for questions

    BoxesCounters& operator+=(const BoxesCounters& o) {
        hulls += o.hulls;
        leaves += o.leaves;
        triangles += o.triangles;
        nodes += o.nodes;
        return *this;
    }
    BoxesCounters& operator-=(const BoxesCounters& o) {
        hulls -= o.hulls;
        leaves -= o.leaves;
        triangles -= o.triangles;
        nodes -= o.nodes;
        return *this;
    }
};

[[nodiscard]] inline BoxesCounters& boxes_counters() { return counters_of_thread<BoxesCounters>; }

}  // namespace trisect::detail
