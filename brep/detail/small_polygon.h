// SPDX-License-Identifier: Apache-2.0
//
// Triangles of simple polygons with a handful of corners, which nearly all faces of booleans are:
// no allocation, no sorting, a few signs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace trisect::detail {

/// More corners than this are for the sweep (triangulate.h).
inline constexpr std::size_t small_polygon_limit = 16;

/// Cuts a simple polygon with corners 0 .. n-1, counter-clockwise, into n - 2 triangles that use
/// every corner, straight ones too.
///
/// `orientation(i, j, k)` is the exact sign of a turn; `first_corner()` names the corner to start
/// at, and is asked only when the polygon is not convex (then it is a fan around corner 0);
/// `emit(i, j, k)` receives the triangles. An ear is a strictly convex corner whose triangle holds
/// no other corner, not even on its sides; every simple polygon has one (Meisters 1975). Corners
/// that are strictly convex cannot be in the way alone, so only the others are looked at. At most
/// O(n^3) signs. Returns false when no ear is left: then the polygon was not simple.
/// \pre 3 <= n <= small_polygon_limit, no two corners at the same place.
template <class Orientation, class FirstCorner, class Emit>
bool cut_small_polygon(std::size_t n, Orientation&& orientation, FirstCorner&& first_corner,
                       Emit&& emit) {
    using Index = std::uint32_t;
    std::array<Index, small_polygon_limit> prev{};
    std::array<Index, small_polygon_limit> next{};
    std::array<bool, small_polygon_limit> blocks{};
    bool convex = true;
    for (Index i = 0; i < n; ++i) {
        prev[i] = static_cast<Index>(i == 0 ? n - 1 : i - 1);
        next[i] = static_cast<Index>(i + 1 == n ? 0 : i + 1);
        if (n > 3) blocks[i] = orientation(prev[i], i, next[i]) <= 0;
        convex = convex && !blocks[i];
    }
    if (convex) {
        for (Index i = 2; i < n; ++i) emit(0U, i - 1, i);
        return true;
    }
    const auto is_ear = [&](Index c) {
        if (blocks[c]) return false;
        const Index a = prev[c];
        const Index b = next[c];
        for (Index p = 0; p < n; ++p)
            if (blocks[p] && p != a && p != b && orientation(a, c, p) >= 0 &&
                orientation(c, b, p) >= 0 && orientation(b, a, p) >= 0)
                return false;
        return true;
    };
    Index c = first_corner();
    std::size_t failures = 0;
    for (std::size_t left = n; left > 3;) {
        if (!is_ear(c)) {
            if (++failures > left) return false;
            c = next[c];
            continue;
        }
        const Index before = prev[c];
        const Index after = next[c];
        emit(before, c, after);
        next[before] = after;
        prev[after] = before;
        // Cutting only narrows wedges: a convex corner stays convex.
        for (const Index i : {before, after})
            if (blocks[i]) blocks[i] = orientation(prev[i], i, next[i]) <= 0;
        --left;
        failures = 0;
        c = next[after];  // skipping one spreads the triangles
    }
    if (orientation(prev[c], c, next[c]) <= 0) return false;
    emit(prev[c], c, next[c]);
    return true;
}

}  // namespace trisect::detail
