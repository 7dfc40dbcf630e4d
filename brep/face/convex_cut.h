// SPDX-License-Identifier: Apache-2.0
//
// Triangulation of a convex polygon with many corners.
// A fan is as correct, but all its needles meet in one corner: no division of space separates
// them, and the box of each meets a fixed share of all others. Halving instead leaves every
// corner with a logarithmic number of triangles, which get smaller towards the outline.
#pragma once

#include <cstdint>

namespace trisect::detail {

/// Polygons up to here become fans.
inline constexpr std::uint32_t small_convex_limit = 16;

/// Of the corners first, ..., last, which turn left: calls emit(a, b, c), a < b < c, for each
/// triangle.
template <class Emit>
void cut_convex_run(std::uint32_t first, std::uint32_t last, const Emit& emit) {
    if (last - first < 2) return;
    const std::uint32_t middle = first + (last - first) / 2;
    emit(first, middle, last);
    cut_convex_run(first, middle, emit);
    cut_convex_run(middle, last, emit);
}

/// Of a strictly convex polygon with corners 0, ..., count - 1. O(count).
template <class Emit>
void cut_convex(std::uint32_t count, const Emit& emit) {
    const std::uint32_t third = count / 3;
    emit(std::uint32_t{0}, third, 2 * third);
    cut_convex_run(0, third, emit);
    cut_convex_run(third, 2 * third, emit);
    // The last run ends at corner 0 again.
    cut_convex_run(2 * third, count, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (c == count) {
            emit(std::uint32_t{0}, a, b);
        } else {
            emit(a, b, c);
        }
    });
}

/// The same, but a fan around corner 0 where corners are few.
template <class Emit>
void cut_convex_or_fan(std::uint32_t count, const Emit& emit) {
    if (count > small_convex_limit) return cut_convex(count, emit);
    for (std::uint32_t i = 2; i < count; ++i) emit(std::uint32_t{0}, i - 1, i);
}

}  // namespace trisect::detail
