// SPDX-License-Identifier: Apache-2.0
//
// ChangedBox: the region in which an evaluation differs from one before.
#pragma once

#include <cstdint>

#include <trisect/bsp/cells/cell.h>

namespace trisect::detail {

/// Of a formula (new and window) or (before and not window).
struct ChangedBox {
    std::int32_t window = -1;  ///< the slot of an empty set that stands for the choice
    std::int32_t before = -1;  ///< the slot of the set of before
    Box box;                   ///< outside of it both formulas have the same value
};

}  // namespace trisect::detail
