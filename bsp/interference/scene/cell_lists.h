// SPDX-License-Identifier: Apache-2.0
//
// CellLists: occupied cells of a uniform grid, in a hash table.
// Each has a list of numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <trisect/kernel/support/flat_map.h>

namespace trisect::hierarchies {

/// The place of a cell in its grid.
using CellPlace = std::array<std::int32_t, 3>;

[[nodiscard]] inline detail::Key128 key_of(const CellPlace& c) {
    return {static_cast<std::uint64_t>(static_cast<std::uint32_t>(c[0])) << 32U |
                static_cast<std::uint32_t>(c[1]),
            static_cast<std::uint32_t>(c[2])};
}

/// The cell of a coordinate. It never falls when the coordinate grows, whatever the rounding, and
/// beyond 2^30 cells all are one; so what has a coordinate in common has a cell in common.
[[nodiscard]] inline std::int32_t cell_along(double x, double size) {
    constexpr double most = 0x1p30;
    const double at = std::floor(x / size);
    return static_cast<std::int32_t>(at < -most ? -most : (at > most ? most : at));
}

/// Cells from `lo` to `hi`, both included.
struct CellRange {
    CellPlace lo{};
    CellPlace hi{};

    [[nodiscard]] static CellRange of(const std::array<double, 3>& lo,
                                      const std::array<double, 3>& hi, double size) {
        CellRange r;
        for (std::size_t k = 0; k < 3; ++k) {
            r.lo[k] = cell_along(lo[k], size);
            r.hi[k] = cell_along(hi[k], size);
        }
        return r;
    }
    /// Their number; a double, since it may be large.
    [[nodiscard]] double count() const {
        double n = 1;
        for (std::size_t k = 0; k < 3; ++k) n *= static_cast<double>(hi[k]) - lo[k] + 1;
        return n;
    }
    [[nodiscard]] bool contains(const CellPlace& c) const {
        bool r = true;
        for (std::size_t k = 0; k < 3; ++k) r = r && lo[k] <= c[k] && c[k] <= hi[k];
        return r;
    }
    /// visit(place) for all of them.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::int32_t x = lo[0]; x <= hi[0]; ++x)
            for (std::int32_t y = lo[1]; y <= hi[1]; ++y)
                for (std::int32_t z = lo[2]; z <= hi[2]; ++z) visit(CellPlace{x, y, z});
    }
};

/// Filled in two rounds: `count` for every entry, then `add` for the same ones. Storage is linear
/// in the number of entries; a look-up is one probe of a hash table.
class CellLists {
public:
    void clear();
    void count(const CellPlace& place);
    /// Between the rounds.
    void allocate();
    void add(const CellPlace& place, std::uint32_t number);

    [[nodiscard]] std::size_t size() const { return places_.size(); }
    [[nodiscard]] std::size_t entry_count() const { return entries_.size(); }
    [[nodiscard]] const CellPlace& place(std::size_t cell) const { return places_[cell]; }
    [[nodiscard]] std::span<const std::uint32_t> list(std::size_t cell) const {
        return std::span(entries_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }
    /// Empty where the cell is not occupied.
    [[nodiscard]] std::span<const std::uint32_t> at(const CellPlace& place) const {
        const std::int32_t cell = numbers_.find(key_of(place));
        if (cell < 0) return {};
        return list(static_cast<std::size_t>(cell));
    }
    [[nodiscard]] std::size_t bytes() const {
        return places_.size() * (sizeof(CellPlace) + 2 * sizeof(std::uint32_t) + 48) +
               entries_.size() * sizeof(std::uint32_t);
    }

private:
    detail::FlatMap numbers_;
    std::vector<CellPlace> places_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> filled_;
    std::vector<std::uint32_t> entries_;
};

}  // namespace trisect::hierarchies
