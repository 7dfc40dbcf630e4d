// SPDX-License-Identifier: Apache-2.0
//
// MeasureCounters: numbers of measures with and without an exact mesh.
#pragma once

#include <cstdint>

namespace trisect::detail {

/// Volumes, exact or rounded, and areas of solids that are surely bounded, of a thread
/// (kernel/diagnostics.h).
struct MeasureCounters {
    std::uint64_t enclosed = 0;  ///< sums over facets said what the double is
    std::uint64_t exact = 0;     ///< the exact mesh did

    MeasureCounters& operator-=(const MeasureCounters& o) {
        enclosed -= o.enclosed;
        exact -= o.exact;
        return *this;
    }
};

}  // namespace trisect::detail
