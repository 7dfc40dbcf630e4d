// SPDX-License-Identifier: Apache-2.0
//
// GridPath: traversal of a grid along a line, front to back.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <trisect/bsp/query/index/indexed_leaf.h>
#include <trisect/bsp/query/lines/index_line.h>

namespace trisect::detail {

/// Followed in doubles, from cell to cell (Amanatides and Woo 1987), with a division an axis for
/// the whole line. A computed point is within 2^-12 finest cells of the real one, or there is no
/// path. Cells list what meets them enlarged by 2^-10, so whatever the line meets at t is listed in
/// the cell in which the path is at t, even where that is not the line's own cell.
class GridPath {
public:
    using Vector = std::array<double, 3>;

    /// A part of the line in a leaf, in the coordinates of its cell.
    struct Span {
        std::array<float, 3> enter{};
        std::array<float, 3> leave{};
        /// Whether both ends are where LeafPlanes are good.
        [[nodiscard]] bool is_near() const {
            for (std::size_t k = 0; k < 3; ++k)
                if (!(std::min(enter[k], leave[k]) > -0.25F &&
                      std::max(enter[k], leave[k]) < 1.25F))
                    return false;
            return true;
        }
    };

    /// For lo <= t <= hi, which may be infinite if the line leaves the grid.
    template <class Range>
    [[nodiscard]] static std::optional<GridPath> make(const IndexGrid& g, const IndexLine& line,
                                                      const Range& range) {
        GridPath p(g);
        p.lo_ = range.lo;
        p.hi_ = range.hi;
        double error = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            p.at_[k] = (line.origin()[k] - g.origin[k]) * g.scale[k];
            p.step_[k] = line.direction()[k] * g.scale[k];
            if (std::fabs(p.step_[k]) < 0x1p-500) p.step_[k] = 0;
            p.inverse_[k] = p.step_[k] != 0 ? 1 / p.step_[k] : HUGE_VAL;
        }
        p.clip();
        if (!(p.hi_ < 0x1p400)) return std::nullopt;
        if (p.hi_ < p.lo_) return p;
        for (std::size_t k = 0; k < 3; ++k) {
            const double far = std::max(std::fabs(p.lo_), std::fabs(p.hi_));
            const double terms = std::fabs(line.origin()[k]) + std::fabs(g.origin[k]) +
                                 far * std::fabs(line.direction()[k]);
            error = std::max(
                error, (terms * 0x1p-48 + line.origin().error() + far * line.direction_error()) *
                           g.scale[k] * 1.01);
        }
        if (!(error < 0x1p-12)) return std::nullopt;
        return p;
    }

    /// Calls visit(leaf, span) in order, until more(t) does not hold for a cell that begins at t.
    template <class More, class Visit>
    void walk(const IndexedLeaf& index, const More& more, const Visit& visit) const {
        if (!(lo_ <= hi_)) return;
        (void)walk_block(
            {0, 0, 0}, grid_.n, grid_.shift(), lo_, hi_,
            [&](const Cell& at) { return grid_.cell(at[0], at[1], at[2]); },
            [&](std::size_t cell, const Cell& low, double t0, double t1) {
                return walk_slot(index, index.grid_slot(cell), low, grid_.levels, t0, t1, more,
                                 visit);
            });
    }

private:
    using Cell = std::array<std::uint32_t, 3>;

    explicit GridPath(const IndexGrid& g) : grid_(g) {}

    // To what is in the grid or a little beside it, as far as its outermost cells may reach.
    void clip() {
        for (std::size_t k = 0; k < 3; ++k) {
            const double whole = static_cast<double>(grid_.n[k] << grid_.shift());
            const double reach = whole / 16;
            const double end = whole + reach;
            if (step_[k] == 0) {
                if (at_[k] < -reach || at_[k] > end) hi_ = -1;
                continue;
            }
            const double a = (-reach - at_[k]) * inverse_[k];
            const double b = (end - at_[k]) * inverse_[k];
            lo_ = std::max(lo_, std::min(a, b));
            hi_ = std::min(hi_, std::max(a, b));
        }
    }

    template <class More, class Visit>
    [[nodiscard]] bool walk_slot(const IndexedLeaf& index, std::uint32_t slot, const Cell& low,
                                 int level, double t0, double t1, const More& more,
                                 const Visit& visit) const {
        if (IndexSlot::is_empty(slot)) return true;
        if (!more(t0)) return false;
        const unsigned shift = 2U * static_cast<unsigned>(level);
        if (!IndexSlot::is_brick(slot)) {
            Span span;
            const double scale = 1 / static_cast<double>(std::uint32_t{1} << shift);
            for (std::size_t k = 0; k < 3; ++k) {
                const double base = at_[k] - static_cast<double>(low[k]);
                span.enter[k] = static_cast<float>((base + t0 * step_[k]) * scale);
                span.leave[k] = static_cast<float>((base + t1 * step_[k]) * scale);
            }
            visit(slot, span);
            return true;
        }
        const IndexBrick& brick = index.brick(slot);
        return walk_block(
            low, {4, 4, 4}, shift - 2, t0, t1,
            [&](const Cell& at) { return IndexBrick::bit(at[0], at[1], at[2]); },
            [&](unsigned bit, const Cell& cell, double from, double to) {
                if (!brick.is_mixed(bit)) return true;
                return walk_slot(index, index.slot(brick.slot(bit)), cell, level - 1, from, to,
                                 more, visit);
            });
    }

    // The cells of a block one after the other; false when enter() says so.
    template <class Number, class Enter>
    [[nodiscard]] bool walk_block(const Cell& low, const Cell& n, unsigned shift, double t0,
                                  double t1, const Number& number, const Enter& enter) const {
        const double size = static_cast<double>(std::uint32_t{1} << shift);
        Cell at{};
        std::array<double, 3> next{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double base = at_[k] - static_cast<double>(low[k]);
            const double place = (base + t0 * step_[k]) / size;
            const double last = static_cast<double>(n[k] - 1);
            at[k] = static_cast<std::uint32_t>(place > 0 ? std::min(place, last) : 0.0);
            next[k] = splitter_after(k, low[k], at[k], n[k], size);
        }
        double from = t0;
        for (;;) {
            std::size_t axis = next[1] < next[0] ? 1 : 0;
            if (next[2] < next[axis]) axis = 2;
            const double to = std::clamp(next[axis], from, t1);
            const Cell cell{low[0] + (at[0] << shift), low[1] + (at[1] << shift),
                            low[2] + (at[2] << shift)};
            if (!enter(number(at), cell, from, to)) return false;
            if (!(next[axis] < t1)) return true;
            at[axis] += step_[axis] > 0 ? 1U : 0xffffffffU;
            from = to;
            next[axis] = splitter_after(axis, low[axis], at[axis], n[axis], size);
        }
    }

    // Where the line leaves a cell along an axis; never in the last one, which goes on.
    [[nodiscard]] double splitter_after(std::size_t k, std::uint32_t low, std::uint32_t at,
                                        std::uint32_t n, double size) const {
        const bool up = step_[k] > 0;
        if (step_[k] == 0 || (up ? at + 1 == n : at == 0)) return HUGE_VAL;
        const double splitter =
            static_cast<double>(low) + static_cast<double>(up ? at + 1 : at) * size;
        return (splitter - at_[k]) * inverse_[k];
    }

    const IndexGrid& grid_;
    Vector at_{};
    Vector step_{};
    Vector inverse_{};
    double lo_ = 0;
    double hi_ = 0;
};

}  // namespace trisect::detail
