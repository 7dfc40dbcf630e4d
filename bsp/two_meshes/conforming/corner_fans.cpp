// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/conforming/corner_fans.h>

#include <algorithm>
#include <cstddef>

namespace trisect::detail {

CornerFans::CornerFans(const CornerNames& names, StackArena& arena) {
    const std::size_t count = names.count();
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        // First counts, then ends, which filling from behind makes begins.
        std::uint32_t* const ends = begins_[mesh] = arena.take<std::uint32_t>(count + 1);
        std::fill(ends, ends + count + 1, 0U);
        const std::uint32_t first = names.first_item(mesh);
        const std::uint32_t end = names.first_item(mesh + 1);
        for (std::uint32_t item = first; item < end; ++item)
            for (const std::uint32_t v : names.corners(item)) ends[v] += names.is_common(v) ? 1 : 0;
        std::uint32_t sum = 0;
        for (std::size_t v = 0; v <= count; ++v) sum = ends[v] += sum;
        Corner* const out = corners_[mesh] = arena.take<Corner>(sum);
        for (std::uint32_t item = end; item-- > first;)
            for (std::uint32_t k = 3; k-- > 0;) {
                const std::uint32_t v = names.corners(item)[k];
                if (names.is_common(v)) out[--ends[v]] = {item << 2U | k};
            }
    }
}

}  // namespace trisect::detail
