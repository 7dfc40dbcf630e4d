// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/shift_along.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace trisect::detail {

std::optional<InfinitesimalShift> shift_along(std::span<const std::array<int, 3>> directions) {
    InfinitesimalShift shift;
    do {
        for (unsigned signs = 0; signs < 8; ++signs) {
            for (std::size_t k = 0; k < 3; ++k)
                shift.signs[k] = static_cast<std::int8_t>((signs >> k & 1U) != 0 ? -1 : 1);
            if (std::ranges::all_of(directions, [&](const auto& d) { return shift.along(d) > 0; }))
                return shift;
        }
    } while (std::ranges::next_permutation(shift.axes).found);
    return std::nullopt;
}

}  // namespace trisect::detail
