// SPDX-License-Identifier: Apache-2.0
//
// PredicateCounters: numbers of signs decided by each stage.
#pragma once

#include <cstdint>

#include <trisect/kernel/diagnostics.h>

namespace trisect {

struct PredicateCounters {
    std::uint64_t symbolic = 0;      ///< On by construction, no arithmetic
    std::uint64_t filtered = 0;      ///< decided in double precision with a proved bound
    std::uint64_t exact_narrow = 0;  ///< decided in 256 bits
    std::uint64_t exact_wide = 0;    ///< decided in 512 bits
    std::uint64_t exact_short = 0;   ///< decided in 128 bits (signs of two posed solids)

    [[nodiscard]] std::uint64_t total() const {
        return symbolic + filtered + exact_narrow + exact_wide + exact_short;
    }
    PredicateCounters& operator+=(const PredicateCounters& o) {
        symbolic += o.symbolic;
        filtered += o.filtered;
        exact_short += o.exact_short;
        exact_narrow += o.exact_narrow;
        exact_wide += o.exact_wide;
        return *this;
    }
    PredicateCounters& operator-=(const PredicateCounters& o) {
        symbolic -= o.symbolic;
        filtered -= o.filtered;
        exact_short -= o.exact_short;
        exact_narrow -= o.exact_narrow;
        exact_wide -= o.exact_wide;
        return *this;
    }
};

}  // namespace trisect
