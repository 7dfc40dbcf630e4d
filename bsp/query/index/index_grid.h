// SPDX-License-Identifier: Apache-2.0
//
// IndexGrid: a wide node of an index, as a regular grid.
// Its cells are divided again, 4 x 4 x 4 at a time, where polygons crowd.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <trisect/bsp/query/index/index_point.h>

namespace trisect::detail {

/// What a cell of a grid or brick is, in 32 bits: empty, a leaf, or a brick; of a grid also
/// pending.
struct IndexSlot {
    static constexpr std::uint32_t outside = 0xfffffffeU;  ///< empty
    static constexpr std::uint32_t inside = 0xffffffffU;   ///< empty
    static constexpr std::uint32_t pending = 0xfffffffdU;  ///< a cell without a query yet
    static constexpr std::uint32_t brick_flag = 0x80000000U;
    [[nodiscard]] static bool is_empty(std::uint32_t slot) { return slot >= outside; }
    [[nodiscard]] static bool is_brick(std::uint32_t slot) {
        return (slot & brick_flag) != 0 && slot < pending;
    }
    [[nodiscard]] static std::uint32_t number(std::uint32_t slot) { return slot & ~brick_flag; }
};

/// A cell divided into 4 x 4 x 4, a bit each; bit x + 4 y + 16 z. Only mixed cells have a slot, so
/// an empty one costs two bits, and most of space is known from what fits into a small cache.
struct IndexBrick {
    std::uint64_t mixed = 0;
    std::uint64_t inside = 0;  ///< of empty cells
    std::uint32_t first = 0;   ///< slot of the first mixed cell

    [[nodiscard]] static unsigned bit(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        return (z & 3U) << 4U | (y & 3U) << 2U | (x & 3U);
    }
    [[nodiscard]] bool is_mixed(unsigned bit) const { return ((mixed >> bit) & 1U) != 0; }
    [[nodiscard]] bool is_inside(unsigned bit) const { return ((inside >> bit) & 1U) != 0; }
    /// The place of a mixed cell's slot: how many come before it.
    [[nodiscard]] std::uint32_t slot(unsigned bit) const {
        return first + ones(mixed & ((std::uint64_t{1} << bit) - 1));
    }

private:
    // The baseline of x86-64 has no instruction for it, and the library's function is a call.
    [[nodiscard]] static std::uint32_t ones(std::uint64_t v) {
        v -= (v >> 1U) & 0x5555555555555555U;
        v = (v & 0x3333333333333333U) + ((v >> 2U) & 0x3333333333333333U);
        v = (v + (v >> 4U)) & 0x0f0f0f0f0f0f0f0fU;
        return static_cast<std::uint32_t>((v * 0x0101010101010101U) >> 56U);
    }
};

/// Cells in a block: splitting planes at origin + i · size, all of them doubles.
struct IndexBlock {
    std::array<double, 3> origin{};
    std::array<double, 3> size{1, 1, 1};
    std::array<std::uint32_t, 3> n{1, 1, 1};

    [[nodiscard]] double splitter(std::size_t axis, std::uint32_t i) const {
        return origin[axis] + size[axis] * static_cast<double>(i);
    }
    /// The index along an axis of a coordinate up to rounding; clamped to the block.
    [[nodiscard]] std::uint32_t clamped(std::size_t axis, double v) const {
        const double t = (v - origin[axis]) / size[axis];
        if (!(t > 0)) return 0;
        return t < static_cast<double>(n[axis]) ? static_cast<std::uint32_t>(t) : n[axis] - 1;
    }
};

/// A grid of n[0] · n[1] · n[2] cells, each of which may be divided `levels` times.
///
/// Finest cells are counted from `origin`; `fine` is their edge, such that all splitting planes are
/// doubles, at odd multiples of 1/64 where coordinates leave room for that. A cell is half-open:
/// its lower splitting planes belong to it. The first and last cells along an axis reach as far as
/// the node's cell does.
///
/// The lower corner of a cell is a reference point: it is on no polygon, and its winding number is
/// known. A cell and the first cell of its brick share it.
struct IndexGrid {
    /// A point in finest cells: which one, and where precisely, up to 2^-26.
    struct Position {
        std::array<std::uint32_t, 3> fine{};
        std::array<double, 3> at{};
    };

    // What finds a point's cell comes first, in 64 bytes.
    std::array<double, 3> origin{};
    std::array<double, 3> scale{1, 1, 1};  ///< 1 / fine, rounded
    std::array<std::uint32_t, 3> n{1, 1, 1};
    int levels = 0;
    std::array<double, 3> fine{1, 1, 1};

    [[nodiscard]] std::size_t count() const { return std::size_t{n[0]} * n[1] * n[2]; }
    [[nodiscard]] std::size_t cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return (std::size_t{z} * n[1] + y) * n[0] + x;
    }
    [[nodiscard]] unsigned shift() const { return 2U * static_cast<unsigned>(levels); }
    [[nodiscard]] double splitter(std::size_t axis, std::uint32_t i) const {
        return origin[axis] + fine[axis] * static_cast<double>(i);
    }
    /// The exact cell of a point.
    [[nodiscard]] Position position(const IndexPoint& p) const {
        Position out;
        for (std::size_t k = 0; k < 3; ++k) {
            const double t = (p[k] - origin[k]) * scale[k];
            const double last = static_cast<double>((n[k] << shift()) - 1);
            const double clamped = t > 0 ? (t < last ? t : last) : 0;  // also for no number
            const auto i = static_cast<std::uint32_t>(clamped);
            const double part = t - static_cast<double>(i);
            out.at[k] = t;
            // t is below 2^25, so it is known to 2^-26; near a splitting plane that is not enough.
            const bool sure = part > 0x1p-20 && part < 1 - 0x1p-20 &&
                              (p.is_doubles() || p.error() * scale[k] < 0x1p-22);
            out.fine[k] = sure ? i : corrected(k, p, i);
        }
        return out;
    }
    /// The same for doubles that are exact; false where rounding might matter.
    [[nodiscard]] bool find_position(const std::array<double, 3>& p, Position& out) const {
        bool sure = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const double t = (p[k] - origin[k]) * scale[k];
            const double last = static_cast<double>((n[k] << shift()) - 1);
            const double clamped = t > 0 ? (t < last ? t : last) : 0;
            out.fine[k] = static_cast<std::uint32_t>(clamped);
            out.at[k] = t;
            const double part = t - static_cast<double>(out.fine[k]);
            sure = sure && part > 0x1p-20 && part < 1 - 0x1p-20;
        }
        return sure;
    }
    /// The cells of the grid, or of the brick of size 4^level finest cells that begins there.
    [[nodiscard]] IndexBlock block() const { return {origin, scaled(levels), n}; }
    [[nodiscard]] IndexBlock brick(const std::array<std::uint32_t, 3>& low, int level) const {
        return {{splitter(0, low[0]), splitter(1, low[1]), splitter(2, low[2])},
                scaled(level - 1),
                {4, 4, 4}};
    }

private:
    [[nodiscard]] std::array<double, 3> scaled(int level) const {
        const auto times = static_cast<double>(std::uint32_t{1} << (2 * level));
        return {fine[0] * times, fine[1] * times, fine[2] * times};
    }
    [[nodiscard]] std::uint32_t corrected(std::size_t axis, const IndexPoint& p,
                                          std::uint32_t i) const {
        const std::uint32_t end = n[axis] << shift();
        while (i > 0 && p.compare(axis, splitter(axis, i)) < 0) --i;
        while (i + 1 < end && p.compare(axis, splitter(axis, i + 1)) >= 0) ++i;
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
/// hi at most. Before each slab, more(t) decides whether what begins at t still matters.
template <class More, class Visit>
void for_cells_along(const IndexBlock& g, const ApproximateLine& line, double lo, double hi,
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
        // If it cannot be decided, all is listed.
        if (!(s.lo > -HUGE_VAL && s.hi < HUGE_VAL)) return Indices{0, g.n[k] - 1};
        const std::uint32_t i = g.clamped(k, s.lo);
        // A coordinate just below a splitting plane may have been rounded to it.
        const bool on_splitter = g.splitter(k, i) >= s.lo;
        return Indices{on_splitter && i > 0 ? i - 1 : i, g.clamped(k, s.hi)};
    };
    const Indices slabs = indices(a, span(a, lo, hi));
    const std::uint32_t count = slabs.hi - slabs.lo + 1;
    for (std::uint32_t step = 0; step < count; ++step) {
        const std::uint32_t i = d > 0 ? slabs.lo + step : slabs.hi - step;
        double t0 = lo;
        double t1 = hi;
        if (count > 1) {
            const double enter = g.splitter(a, d > 0 ? i : i + 1);
            const double leave = g.splitter(a, d > 0 ? i + 1 : i);
            const auto at = [&](double splitter, double sign) {
                const double t = (splitter - line.origin[a]) / d;
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
