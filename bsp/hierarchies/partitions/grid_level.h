// SPDX-License-Identifier: Apache-2.0
//
// GridLevel: boxes in the hashed cells of one grid.
// They are found around a box, near cells first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include <trisect/bsp/hierarchies/pairs/triangle_boxes.h>
#include <trisect/bsp/interference/boxes/cost.h>
#include <trisect/bsp/interference/scene/cell_lists.h>

namespace trisect::hierarchies {

/// Value type. The size of a cell is a power of two, so that division by it rounds nothing.
class GridLevel {
public:
    explicit GridLevel(double size = 1) : size_(size) {}

    [[nodiscard]] double size() const { return size_; }
    [[nodiscard]] CellLists& cells() { return cells_; }
    [[nodiscard]] const CellLists& cells() const { return cells_; }
    [[nodiscard]] std::size_t bytes() const { return cells_.bytes(); }
    /// To be called when all cells are filled.
    void close();

    [[nodiscard]] Box box_of(const CellPlace& place) const {
        Box box{};
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = size_ * place[k];
            box.hi[k] = size_ * (place[k] + 1.0);
        }
        return box;
    }
    [[nodiscard]] CellRange range_of(const Box& box) const {
        return CellRange::of(box.lo, box.hi, size_);
    }

    /// visit(number) for what is in these cells, until it returns true. Looks up every cell, or
    /// goes through all occupied ones where these are fewer.
    template <class Visit>
    bool in(const CellRange& wanted, CostCounters& counters, Visit&& visit) const {
        const CellRange range = common(wanted);
        if (range.count() == 0) return false;
        if (range.count() > static_cast<double>(cells_.size())) {
            counters.volume_tests += cells_.size();
            for (std::size_t c = 0; c < cells_.size(); ++c) {
                if (!range.contains(cells_.place(c))) continue;
                for (const std::uint32_t i : cells_.list(c))
                    if (visit(i)) return true;
            }
            return false;
        }
        for (std::int32_t x = range.lo[0]; x <= range.hi[0]; ++x)
            for (std::int32_t y = range.lo[1]; y <= range.hi[1]; ++y)
                for (std::int32_t z = range.lo[2]; z <= range.hi[2]; ++z) {
                    ++counters.volume_tests;
                    for (const std::uint32_t i : cells_.at({x, y, z}))
                        if (visit(i)) return true;
                }
        return false;
    }

    /// The same in rings around a range, the nearest first, while ring r, which is at least
    /// (r - 1) cells away, is not beyond the limit; visit(number) returns the limit from now on.
    template <class Visit>
    double near(const CellRange& start, double limit, CostCounters& counters, Visit&& visit) const {
        if (cells_.size() == 0) return limit;
        double looked_up = 0;
        const auto first = first_ring(start);
        const auto last = last_ring(start);
        for (std::int64_t r = first; r <= last; ++r) {
            if (static_cast<double>(r - 1) * size_ > limit) return limit;
            const CellRange outer = common(grown(start, r));
            const CellRange inner = r == 0 ? nothing() : common(grown(start, r - 1));
            looked_up += outer.count() - inner.count();
            if (looked_up > 2 * static_cast<double>(cells_.size()))
                return rest(inner, limit, counters, visit);
            const auto with_limit = [&](const CellPlace& place) {
                ++counters.volume_tests;
                for (const std::uint32_t i : cells_.at(place)) limit = visit(i);
            };
            for_each_between(outer, inner, with_limit);
        }
        return limit;
    }

private:
    [[nodiscard]] static CellRange nothing() { return {{0, 0, 0}, {-1, -1, -1}}; }
    [[nodiscard]] static CellRange grown(const CellRange& range, std::int64_t by);
    /// Part of the grid's bounds; `nothing()` where there is none.
    [[nodiscard]] CellRange common(const CellRange& range) const;
    /// The first ring that reaches into the bounds, and the one that has all of them.
    [[nodiscard]] std::int64_t first_ring(const CellRange& start) const;
    [[nodiscard]] std::int64_t last_ring(const CellRange& start) const;

    /// Cells of the outer range that are not in the inner one.
    template <class Visit>
    static void for_each_between(const CellRange& outer, const CellRange& inner, Visit&& visit) {
        for (std::int32_t x = outer.lo[0]; x <= outer.hi[0]; ++x)
            for (std::int32_t y = outer.lo[1]; y <= outer.hi[1]; ++y) {
                const bool beside = x < inner.lo[0] || x > inner.hi[0] || y < inner.lo[1] ||
                                    y > inner.hi[1] || inner.lo[2] > inner.hi[2];
                for (std::int32_t z = outer.lo[2]; z <= outer.hi[2]; ++z) {
                    if (!beside && z == inner.lo[2]) z = inner.hi[2] + 1;
                    if (z <= outer.hi[2]) visit(CellPlace{x, y, z});
                }
            }
    }

    /// All occupied cells that are not in the range: where the grid is hardly filled, going through
    /// them is cheaper than looking for them.
    template <class Visit>
    double rest(const CellRange& inner, double limit, CostCounters& counters, Visit&& visit) const {
        counters.volume_tests += cells_.size();
        for (std::size_t c = 0; c < cells_.size(); ++c)
            if (!inner.contains(cells_.place(c)))
                for (const std::uint32_t i : cells_.list(c)) limit = visit(i);
        return limit;
    }

    double size_;
    CellLists cells_;
    CellRange bounds_{{0, 0, 0}, {-1, -1, -1}};
};

/// The least power of two that is not below a positive number.
[[nodiscard]] double power_of_two_above(double v);

}  // namespace trisect::hierarchies
