// SPDX-License-Identifier: Apache-2.0
//
// Sorting by several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

/// Sorts values of which no two are equal: the outcome is the same for any number of threads, of
/// which 0 means as many as there are here. Needs memory for half of them where several work.
template <class T>
void sort_in_parts(std::vector<T>& values, std::uint32_t threads) {
    constexpr std::size_t least_sorted = 8192;
    const std::size_t count = parts_by_thread(values.size(), threads, least_sorted).count();
    const auto at = [&](std::size_t part) {
        return values.begin() +
               static_cast<std::ptrdiff_t>(values.size() * std::min(part, count) / count);
    };
    const auto for_each = [&](std::size_t parts, const auto& work) {
        ParallelParts(parts, parts == 1 ? 1 : threads, 1)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) work(i);
            });
    };
    for_each(count, [&](std::size_t part) { std::sort(at(part), at(part + 1)); });
    for (std::size_t width = 1; width < count; width *= 2)
        for_each((count + 2 * width - 1) / (2 * width), [&](std::size_t pair) {
            const std::size_t first = 2 * width * pair;
            std::inplace_merge(at(first), at(first + width), at(first + 2 * width));
        });
}

}  // namespace trisect::detail
