// SPDX-License-Identifier: Apache-2.0
//
// Work on the rows of a picture, on all threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdint>

namespace trisect::app {

/// Calls work(y) for y from 0 to count - 1, in any order and at the same time.
template <class Work>
void for_rows(std::uint32_t count, const Work& work) {
    constexpr std::uint32_t rows_at_once = 8;
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, rows_at_once),
                      [&](const tbb::blocked_range<std::uint32_t>& rows) {
                          for (std::uint32_t y = rows.begin(); y < rows.end(); ++y) work(y);
                      });
}

}  // namespace trisect::app
