// SPDX-License-Identifier: Apache-2.0
//
// IndexGrid: a wide node of an index, a regular grid of cubes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <trisect/bsp/detail/index_point.h>

namespace trisect::detail {

/// Cells of n[0] · n[1] · n[2] cubes whose edge is a power of two; walls at origin + i · size, all
/// of them doubles. A cell is half-open: its lower walls belong to it. So a coordinate's cell is
/// found by one subtraction and one product that are exact wherever the result is no integer. The
/// first and last cells along an axis reach as far as the node's cell does.
struct IndexGrid {
    static constexpr std::uint32_t outside = 0xfffffffeU;  ///< empty cells; else a node
    static constexpr std::uint32_t inside = 0xffffffffU;

    std::array<double, 3> origin{};
    double size = 1;
    double scale = 1;  ///< 1 / size
    std::array<std::uint32_t, 3> n{1, 1, 1};
    std::uint32_t first = 0;  ///< of the tree's array of cells

    [[nodiscard]] std::size_t count() const { return std::size_t{n[0]} * n[1] * n[2]; }
    [[nodiscard]] std::size_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return (std::size_t{z} * n[1] + y) * n[0] + x;
    }
    [[nodiscard]] double wall(std::size_t axis, std::uint32_t i) const {
        return origin[axis] + size * static_cast<double>(i);
    }
    /// The index along an axis of a coordinate; clamped to the grid.
    [[nodiscard]] std::uint32_t clamped(std::size_t axis, double v) const {
        const double t = (v - origin[axis]) * scale;
        if (!(t > 0)) return 0;
        return t < static_cast<double>(n[axis]) ? static_cast<std::uint32_t>(t) : n[axis] - 1;
    }
    /// The exact index of a point of the grid.
    [[nodiscard]] std::uint32_t index(std::size_t axis, const IndexPoint& p) const {
        const double t = (p[axis] - origin[axis]) * scale;
        const std::uint32_t i = clamped(axis, p[axis]);
        // Rounding may have led to a wall from below, an error across it.
        if (p.is_doubles() && static_cast<double>(i) != t) return i;
        return corrected(axis, p, i);
    }
    [[nodiscard]] std::size_t cell(const IndexPoint& p) const {
        return number(index(0, p), index(1, p), index(2, p));
    }

private:
    [[nodiscard]] std::uint32_t corrected(std::size_t axis, const IndexPoint& p,
                                          std::uint32_t i) const {
        while (i > 0 && p.compare(axis, wall(axis, i)) < 0) --i;
        while (i + 1 < n[axis] && p.compare(axis, wall(axis, i + 1)) >= 0) ++i;
        return i;
    }
};

/// A straight line in doubles: origin + t · direction, its coordinates within these errors.
struct ApproximateLine {
    std::array<double, 3> origin{};
    std::array<double, 3> direction{};
    double origin_error = 0;
    double direction_error = 0;
};

/// Calls visit(x, y, z, lo, hi) for all cells that the line may meet for t from `lo` to `hi`, slab
/// by slab in the line's direction, and some beside it; the line is in the cell within its lo and
/// hi at most. Before each slab, more(t) is asked whether what begins at t still matters.
template <class More, class Visit>
void for_cells_along(const IndexGrid& g, const ApproximateLine& line, double lo, double hi,
                     const More& more, const Visit& visit) {
    std::size_t a = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(line.direction[k]) > std::fabs(line.direction[a])) a = k;
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    const double d = line.direction[a];
    // Coordinates of the line over a range of t, with everything that rounding may do.
    struct Span {
        double lo = 0;
        double hi = 0;
    };
    const auto span = [&](std::size_t k, double t0, double t1) {
        const double s = line.origin[k] + t0 * line.direction[k];
        const double e = line.origin[k] + t1 * line.direction[k];
        const double t = std::max(std::fabs(t0), std::fabs(t1));
        const double slack =
            (std::fabs(line.origin[k]) + t * std::fabs(line.direction[k])) * 0x1p-49 +
            1.01 * (line.origin_error + t * line.direction_error);
        return Span{std::min(s, e) - slack, std::max(s, e) + slack};
    };
    struct Indices {
        std::uint32_t lo = 0;
        std::uint32_t hi = 0;
    };
    const auto indices = [&](std::size_t k, const Span& s) {
        // What cannot be told is everything.
        if (!(s.lo > -HUGE_VAL && s.hi < HUGE_VAL)) return Indices{0, g.n[k] - 1};
        const std::uint32_t i = g.clamped(k, s.lo);
        // A coordinate just below a wall may have been rounded to it.
        const bool on_wall = (s.lo - g.origin[k]) * g.scale == static_cast<double>(i);
        return Indices{on_wall && i > 0 ? i - 1 : i, g.clamped(k, s.hi)};
    };
    const Indices slabs = indices(a, span(a, lo, hi));
    const std::uint32_t count = slabs.hi - slabs.lo + 1;
    for (std::uint32_t step = 0; step < count; ++step) {
        const std::uint32_t i = d > 0 ? slabs.lo + step : slabs.hi - step;
        double t0 = lo;
        double t1 = hi;
        if (count > 1) {
            const double enter = g.wall(a, d > 0 ? i : i + 1);
            const double leave = g.wall(a, d > 0 ? i + 1 : i);
            const auto at = [&](double wall, double sign) {
                const double t = (wall - line.origin[a]) / d;
                const double e =
                    std::fabs(t) * (0x1p-49 + 1.01 * line.direction_error / std::fabs(d)) +
                    1.01 * line.origin_error / std::fabs(d) + 0x1p-1000;
                return t + sign * e;
            };
            // The outermost slabs have no end.
            if (i != (d > 0 ? 0 : g.n[a] - 1)) t0 = std::max(lo, at(enter, -1));
            if (i != (d > 0 ? g.n[a] - 1 : 0)) t1 = std::min(hi, at(leave, 1));
            if (t0 > t1) continue;
        }
        if (!more(t0)) return;
        const Indices rows = indices(b, span(b, t0, t1));
        const Indices columns = indices(c, span(c, t0, t1));
        for (std::uint32_t j = rows.lo; j <= rows.hi; ++j)
            for (std::uint32_t l = columns.lo; l <= columns.hi; ++l) {
                std::array<std::uint32_t, 3> at{};
                at[a] = i;
                at[b] = j;
                at[c] = l;
                visit(at[0], at[1], at[2], t0, t1);
            }
    }
}

}  // namespace trisect::detail
