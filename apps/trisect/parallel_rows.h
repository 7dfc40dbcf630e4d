// SPDX-License-Identifier: Apache-2.0
//
// Work on the rows of a picture, on all threads.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::app {

/// Calls work(y) for y from 0 to count - 1, in any order and at the same time.
template <class Work>
void for_rows(std::uint32_t count, const Work& work) {
    constexpr std::size_t rows_at_once = 8;
    detail::ParallelParts(count, 0, rows_at_once)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y) work(static_cast<std::uint32_t>(y));
        });
}

}  // namespace trisect::app
