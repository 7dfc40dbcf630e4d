// SPDX-License-Identifier: Apache-2.0
//
// Triangulation of simple polygons with a handful of corners.
// Nearly all faces of booleans are such. It allocates nothing, sorts nothing and computes few
// signs.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <trisect/brep/face/convex_cut.h>

namespace trisect::detail {

/// More corners than this are for the sweep (triangulate.h).
inline constexpr std::size_t small_polygon_limit = 32;

/// Cuts a simple polygon with corners 0 .. n-1, counter-clockwise, into n - 2 triangles that use
/// every corner, straight ones too.
///
/// `orientation(i, j, k)` is the exact sign of a turn; `first_corner()` names the corner to start
/// at, and is computed only when the polygon is not convex; `emit(i, j, k)` receives the triangles.
/// An ear is a strictly convex corner whose triangle holds no other corner, not even on its sides;
/// every simple polygon has one (Meisters 1975). Corners that are strictly convex cannot be in the
/// way alone, so only the others are looked at. At most O(n^3) signs. Returns false when no ear is
/// left: then the polygon was not simple.
/// \pre 3 <= n <= small_polygon_limit, no two corners at the same place.
template <class Orientation, class FirstCorner, class Emit>
bool cut_small_polygon(std::size_t n, Orientation&& orientation, FirstCorner&& first_corner,
                       Emit&& emit) {
    using Index = std::uint32_t;
    static_assert(small_polygon_limit <= 32, "a bit for each corner");
    std::array<std::uint8_t, small_polygon_limit> prev{};
    std::array<std::uint8_t, small_polygon_limit> next{};
    std::uint32_t blocks = 0;
    const auto bit = [](Index i) { return std::uint32_t{1} << i; };
    const auto is_blunt = [&](Index i) {
        return orientation(Index{prev[i]}, i, Index{next[i]}) <= 0;
    };
    for (Index i = 0; i < n; ++i) {
        prev[i] = static_cast<std::uint8_t>(i == 0 ? n - 1 : i - 1);
        next[i] = static_cast<std::uint8_t>(i + 1 == n ? 0 : i + 1);
        if (n > 3 && is_blunt(i)) blocks |= bit(i);
    }
    if (blocks == 0) {
        cut_convex_or_fan(static_cast<Index>(n), emit);
        return true;
    }
    const auto is_ear = [&](Index c) {
        if ((blocks & bit(c)) != 0) return false;
        const Index a = prev[c];
        const Index b = next[c];
        for (std::uint32_t others = blocks & ~(bit(a) | bit(b)); others != 0;
             others &= others - 1) {
            const auto p = static_cast<Index>(std::countr_zero(others));
            if (orientation(a, c, p) >= 0 && orientation(c, b, p) >= 0 && orientation(b, a, p) >= 0)
                return false;
        }
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
        next[before] = static_cast<std::uint8_t>(after);
        prev[after] = static_cast<std::uint8_t>(before);
        // Cutting only narrows wedges: a convex corner stays convex.
        for (const Index i : {before, after})
            if ((blocks & bit(i)) != 0 && !is_blunt(i)) blocks &= ~bit(i);
        --left;
        failures = 0;
        c = next[after];  // skipping one spreads the triangles
    }
    const Index before = prev[c];
    const Index after = next[c];
    if (orientation(before, c, after) <= 0) return false;
    emit(before, c, after);
    return true;
}

}  // namespace trisect::detail
