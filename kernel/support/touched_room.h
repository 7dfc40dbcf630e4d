// SPDX-License-Identifier: Apache-2.0
//
// Room that several threads touch before one of them writes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

/// Room for so many more values, of which the pages have memory. A page that is touched for the
/// first time takes longer than all that is written to it (ready_memory.h), and other threads have
/// nothing to do while one copies much. `threads` as for ParallelParts; for few values, or one
/// thread, it is only reserved.
template <class T, class A>
void reserve_touched(std::vector<T, A>& values, std::size_t more, std::uint32_t threads) {
    constexpr std::size_t page = 4096;
    constexpr std::size_t least_pages = 1024;  // for a thread
    if (values.size() + more > values.capacity()) values.reserve(values.size() + more);
    const std::size_t pages = more * sizeof(T) / page;
    if (threads == 1 || pages < 2 * least_pages) return;
    auto* const room = reinterpret_cast<std::byte*>(values.data() + values.size());
    ParallelParts(pages, threads, least_pages)
        .for_each([room](std::size_t, std::size_t begin, std::size_t end) {
            // Nobody reads it.
            for (std::size_t i = begin; i < end; ++i)
                *const_cast<volatile std::byte*>(room + page * i) = std::byte{0};
        });
}

}  // namespace trisect::detail
