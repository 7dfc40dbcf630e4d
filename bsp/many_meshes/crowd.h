// SPDX-License-Identifier: Apache-2.0
//
// Crowd: density of the boxes of operands in the box of all.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/bsp/cells/cell.h>

namespace trisect::detail {

/// By how many boxes of operands a point of their common box lies in, on average.
enum class Crowd : std::uint8_t {
    None,
    Near,    ///< two and more: neighbours are compared first
    All,     ///< so many that most operands fill one place
    InFirst  ///< few, but the first one's has half of the box, and all others are tools in it
};

/// \pre not empty
[[nodiscard]] Crowd crowd_of(std::span<const Box> boxes);

/// Whether at least half of all end where other ones begin, with a part of a plane in common.
/// O(n log n)
[[nodiscard]] bool do_stand(std::span<const Box> boxes);

/// Whether no two meet; boxes that touch meet. As for_each_meeting()
[[nodiscard]] bool are_apart(std::span<const Box> boxes);

/// Whether boxes that meet others mostly begin or end at a coordinate at which the other one does,
/// or lie about one, or none meet. O(n^2) where all meet
[[nodiscard]] bool may_touch_or_are_apart(std::span<const Box> boxes);

/// Whether the largest one meets more than 64: a facet that so many operands cross is traced in no
/// cell (FacetOutline). \pre not empty
[[nodiscard]] bool meets_many(std::span<const Box> boxes);

}  // namespace trisect::detail
