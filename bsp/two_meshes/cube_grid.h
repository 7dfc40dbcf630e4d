// SPDX-License-Identifier: Apache-2.0
//
// CubeGrid, OccupiedCubes: bit grids of the region near both meshes.
// There is a bit for each of a few thousand equal boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// All of space in up to 64 slabs along each axis: equal ones over a box, one before and one behind
/// that, without end. A position's slab is a function of it that never decreases, so whatever lies
/// between two positions is in the slabs from the one's to the other's; nothing else is needed of
/// it, and its roundings do not matter.
class CubeGrid {
public:
    static constexpr std::size_t side = 64;
    /// Slabs along the axes in bytes 0 to 2; byte 3 is 0.
    using Cube = std::uint32_t;

    /// The box in at most `slabs` slabs along its longest axis. \pre not empty, 1 <= slabs <= 62
    CubeGrid(const Box& box, int slabs);

    [[nodiscard]] Cube cube_of(const LatticePoint& p) const {
        Cube c = 0;
        for (unsigned k = 0; k < 3; ++k) {
            const double d = p[static_cast<int>(k)].to_double() - origin_[k];
            const double slab = std::min(std::max(d * scale_ + 1.0, 0.0), last_[k]);
            c |= static_cast<Cube>(static_cast<std::int32_t>(slab)) << 8 * k;
        }
        return c;
    }
    /// The last slab along an axis.
    [[nodiscard]] std::size_t last(std::size_t axis) const {
        return static_cast<std::size_t>(last_[axis]);
    }
    [[nodiscard]] static std::size_t x(Cube c) { return c & 0xff; }
    [[nodiscard]] static std::size_t y(Cube c) { return c >> 8 & 0xff; }
    [[nodiscard]] static std::size_t z(Cube c) { return c >> 16; }
    /// Rows along x, from one slab along z to the next, and in all. The one behind the last slab
    /// along y is never used.
    [[nodiscard]] std::size_t row_stride() const { return row_stride_; }
    [[nodiscard]] std::size_t row_count() const { return row_stride_ * (last(2) + 1); }
    /// The row in which a cube lies.
    [[nodiscard]] std::size_t row(Cube c) const { return row_stride_ * z(c) + y(c); }

private:
    std::array<double, 3> origin_{};
    std::array<double, 3> last_{};
    double scale_ = 0;
    std::size_t row_stride_ = 0;
};

/// A bit for each cube, a word for each row along x.
class CubeSet {
public:
    CubeSet() = default;
    /// One for each row of a grid.
    explicit CubeSet(std::vector<std::uint64_t> rows) : rows_(std::move(rows)) {}
    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] const std::uint64_t& row(std::size_t i) const { return rows_[i]; }
    [[nodiscard]] std::uint64_t& row(std::size_t i) { return rows_[i]; }
    [[nodiscard]] bool is_any() const {
        return std::ranges::any_of(rows_, [](std::uint64_t row) { return row != 0; });
    }
    [[nodiscard]] bool has(const CubeGrid& grid, CubeGrid::Cube c) const {
        return (rows_[grid.row(c)] >> CubeGrid::x(c) & 1U) != 0;
    }

private:
    std::vector<std::uint64_t> rows_;
};

/// From the least to the largest slab of three cubes along each axis.
struct CubeRange {
    CubeGrid::Cube lo = 0;
    CubeGrid::Cube hi = 0;

    CubeRange(CubeGrid::Cube a, CubeGrid::Cube b, CubeGrid::Cube c) {
#if defined(__SSE2__)
        const auto lanes = [](CubeGrid::Cube cube) {
            return _mm_cvtsi32_si128(static_cast<int>(cube));
        };
        const __m128i ab_lo = _mm_min_epu8(lanes(a), lanes(b));
        const __m128i ab_hi = _mm_max_epu8(lanes(a), lanes(b));
        lo = static_cast<CubeGrid::Cube>(_mm_cvtsi128_si32(_mm_min_epu8(ab_lo, lanes(c))));
        hi = static_cast<CubeGrid::Cube>(_mm_cvtsi128_si32(_mm_max_epu8(ab_hi, lanes(c))));
#else
        for (unsigned shift = 0; shift < 24; shift += 8) {
            const auto at = [shift](CubeGrid::Cube cube) { return cube >> shift & 0xff; };
            lo |= std::min({at(a), at(b), at(c)}) << shift;
            hi |= std::max({at(a), at(b), at(c)}) << shift;
        }
#endif
    }
    /// Bit k: it goes over two slabs along axis k. `large` where it goes over more along some axis.
    static constexpr unsigned large = 8;
    [[nodiscard]] unsigned shape() const {
        const CubeGrid::Cube d = hi - lo;  // no byte borrows
        return (d & 0xfefefe) != 0 ? large : (d & 1) | (d >> 7 & 2) | (d >> 14 & 4);
    }
    /// Rows along x.
    [[nodiscard]] std::size_t row_count() const {
        return (CubeGrid::y(hi) - CubeGrid::y(lo) + 1) * (CubeGrid::z(hi) - CubeGrid::z(lo) + 1);
    }
    /// Calls visit(row, bits) for the rows of the range until that is false; returns whether it
    /// never was.
    template <class Visit>
    bool for_each_row(const CubeGrid& grid, const Visit& visit) const {
        const std::size_t x = CubeGrid::x(lo);
        const std::uint64_t bits = ~std::uint64_t{0} >> (63 - (CubeGrid::x(hi) - x)) << x;
        for (std::size_t z = CubeGrid::z(lo); z <= CubeGrid::z(hi); ++z)
            for (std::size_t y = CubeGrid::y(lo); y <= CubeGrid::y(hi); ++y)
                if (!visit(grid.row_stride() * z + y, bits)) return false;
        return true;
    }
};

/// The cubes that facets of a mesh may meet: those that meet the box of a facet.
class OccupiedCubes {
public:
    /// `threads`, here and below: 1, or 0 for as many as there are here; the outcome does not
    /// depend on it.
    OccupiedCubes(const CubeGrid& grid, const LatticeMesh& mesh, std::uint32_t threads = 1);

    /// False when facets meet so many cubes that larger ones are better; then the rest is not
    /// there. Those of a grid of four slabs always are.
    [[nodiscard]] bool is_useful() const { return is_useful_; }
    [[nodiscard]] const CubeSet& cubes() const { return occupied_; }
    /// Where a point of the mesh is.
    [[nodiscard]] CubeGrid::Cube cube_of(std::uint32_t point) const { return of_points_[point]; }
    /// A cube that meets the box of a facet.
    [[nodiscard]] CubeGrid::Cube cube_of_facet(std::uint32_t facet) const {
        return places_[facet] & 0xffffff;
    }
    /// The facets whose boxes meet some cube of a set, in order.
    [[nodiscard]] std::vector<std::uint32_t> facets_in(const CubeSet& cubes,
                                                       std::uint32_t threads = 1) const;
    /// Memory behind it.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

private:
    [[nodiscard]] bool mark_facets(std::uint32_t threads);
    template <class Mark>
    void mark_part(std::size_t begin, std::size_t end, const Mark& mark,
                   std::vector<std::uint32_t>& large);
    [[nodiscard]] CubeRange range_of(std::uint32_t facet) const {
        const auto& t = triangles_[facet];
        return {of_points_[t[0]], of_points_[t[1]], of_points_[t[2]]};
    }

    CubeGrid grid_;
    std::span<const std::array<std::uint32_t, 3>> triangles_;
    PoolArray<CubeGrid::Cube> of_points_;
    /// By facet: the least cube of its range, and in byte 3 its shape.
    PoolArray<std::uint32_t> places_;
    CubeSet occupied_;
    std::size_t bytes_ = 0;
    bool is_useful_ = false;
};

}  // namespace trisect::detail
