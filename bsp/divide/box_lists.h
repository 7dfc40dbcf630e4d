// SPDX-License-Identifier: Apache-2.0
//
// Lists of packed boxes and their halves.
// Long ones are gone through by several threads; the outcome does not depend on their number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/packed_box.h>

namespace trisect::detail {

/// Smaller lists are not worth a thread.
inline constexpr std::size_t parallel_list = 32768;

/// The box of all. `threads`: 0 means as many as there are here.
[[nodiscard]] PackedBox box_of_list(std::span<const PackedBox> boxes, std::uint32_t threads);

/// Those that are met, in their order; for long lists.
[[nodiscard]] std::vector<PackedBox> boxes_that_meet(std::span<const PackedBox> boxes,
                                                     const PackedReach& reach,
                                                     std::uint32_t threads);

/// Calls visit(box) for the boxes that meet a box, in their order, on the calling thread.
template <class Visit>
void for_each_meeting(std::span<const PackedBox> boxes, const PackedReach& reach,
                      std::uint32_t threads, const Visit& visit) {
    if (threads != 1 && boxes.size() >= 2 * parallel_list) {
        for (const PackedBox& e : boxes_that_meet(boxes, reach, threads)) visit(e);
        return;
    }
    for (const PackedBox& e : boxes)
        if (reach.meets(e)) visit(e);
}

/// Where a list is divided: below the rounded position `first_above`.
struct ListCut {
    std::size_t axis = 0;
    int first_above = 0;
    [[nodiscard]] bool has_below(const PackedBox& b) const {
        return b.lo[axis] < static_cast<std::int16_t>(first_above);
    }
    [[nodiscard]] bool has_above(const PackedBox& b) const {
        return b.minus_hi[axis] <= static_cast<std::int16_t>(-first_above);
    }
};

/// How many of a list are on one side alone.
struct HalfSizes {
    std::size_t below = 0;
    std::size_t above = 0;
};

/// Writes those below to the front of `room`, in their order, those above to its end, in the
/// opposite order, and what reaches to both sides to `across`, in its order.
/// \pre room.size() == boxes.size()
HalfSizes divide_list(std::span<const PackedBox> boxes, const ListCut& cut,
                      std::span<PackedBox> room, std::vector<PackedBox>& across,
                      std::uint32_t threads);

}  // namespace trisect::detail
