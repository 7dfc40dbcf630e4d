// SPDX-License-Identifier: Apache-2.0
//
// Lists of numbers that meet a condition.
// Several threads make parts of a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/ready_memory.h>

namespace trisect::detail {

/// Calls list(begin, end, out) for consecutive parts of the numbers below `size`; each writes up to
/// end - begin numbers and returns where they end. All of them, in order. `threads`: 1, or 0 for as
/// many as there are here.
template <class List>
[[nodiscard]] std::vector<std::uint32_t> listed_in_parts(std::size_t size, std::uint32_t threads,
                                                         const List& list) {
    constexpr std::size_t least_part = 16384;
    // Room for one more each: a loop without a branch writes behind the last one.
    const ParallelParts parts(size, threads, least_part);
    const PoolArray<std::uint32_t> room(size + parts.count());
    std::vector<std::size_t> counts(parts.count() + 1);
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        std::uint32_t* const out = room.get() + begin + part;
        counts[part + 1] = static_cast<std::size_t>(list(begin, end, out) - out);
    });
    if (parts.count() == 1) return {room.get(), room.get() + counts[1]};
    std::inclusive_scan(counts.begin(), counts.end(), counts.begin());
    std::vector<std::uint32_t> all;
    resize_ready(all, counts.back());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t) {
        std::copy_n(room.get() + begin + part, counts[part + 1] - counts[part],
                    all.data() + counts[part]);
    });
    return all;
}

/// The numbers below `size` for which is_wanted(number), in order.
template <class Condition>
[[nodiscard]] std::vector<std::uint32_t> numbers_that(std::size_t size, std::uint32_t threads,
                                                      const Condition& is_wanted) {
    return listed_in_parts(
        size, threads, [&](std::size_t begin, std::size_t end, std::uint32_t* out) {
            const Condition wanted = is_wanted;  // nothing that is written is a part of it
            for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
                *out = i;
                out += wanted(i) ? 1 : 0;
            }
            return out;
        });
}

}  // namespace trisect::detail
