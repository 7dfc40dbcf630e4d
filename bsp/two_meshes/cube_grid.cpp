// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/cube_grid.h>

#include <atomic>

#include <trisect/bsp/two_meshes/listed_numbers.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

CubeGrid::CubeGrid(const Box& box, int slabs) {
    double longest = 0;
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3; ++k) {
        origin_[k] = static_cast<double>(box.lo[k]);
        extent[k] = static_cast<double>(box.hi[k] - box.lo[k] + 1);
        longest = std::max(longest, extent[k]);
    }
    scale_ = slabs / longest;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto inner = static_cast<std::int32_t>(extent[k] * scale_);
        last_[k] = std::min(inner, slabs - 1) + 2;
    }
    row_stride_ = last(1) + 2;
}

namespace {

// Nearly all facets go over at most two slabs along each axis. A bit at the least cube, in a set
// for each of the eight shapes, is then all that has to be written or read of one, without a
// branch.
constexpr std::size_t shapes = CubeRange::large;

// The rows of a grid for each shape, with some more so that the next one along z is always there.
struct ShapeRows {
    std::size_t count;
    std::size_t padded;
    std::array<std::size_t, 3> next;  // along each axis
    std::vector<std::uint64_t> rows;

    explicit ShapeRows(const CubeGrid& grid)
        : count(grid.row_count()),
          padded(count + grid.row_stride()),
          next{0, 1, grid.row_stride()},
          rows(shapes * padded) {}
    [[nodiscard]] std::uint64_t* of(std::size_t shape) { return &rows[shape * padded]; }
};

// The cubes that boxes of all shapes meet, from those where they begin.
CubeSet all_met(ShapeRows begins) {
    for (std::size_t k = 3; k-- > 0;)
        for (std::size_t shape = 0; shape < std::size_t{1} << k; ++shape) {
            const std::uint64_t* const two = begins.of(shape | std::size_t{1} << k);
            std::uint64_t* const one = begins.of(shape);
            for (std::size_t row = 0; row < begins.count; ++row) {
                one[row] |= two[row];
                if (k == 0) {
                    one[row] |= two[row] << 1;
                } else {
                    one[row + begins.next[k]] |= two[row];
                }
            }
        }
    begins.rows.resize(begins.count);
    return CubeSet(std::move(begins.rows));
}

// The cubes where boxes begin that meet a set.
ShapeRows all_that_meet(const CubeGrid& grid, const CubeSet& cubes) {
    ShapeRows begins(grid);
    std::copy_n(&cubes.row(0), begins.count, begins.of(0));
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t shape = 0; shape < std::size_t{1} << k; ++shape) {
            const std::uint64_t* const one = begins.of(shape);
            std::uint64_t* const two = begins.of(shape | std::size_t{1} << k);
            for (std::size_t row = 0; row < begins.count; ++row)
                two[row] = one[row] | (k == 0 ? one[row] >> 1 : one[row + begins.next[k]]);
        }
    return begins;
}

// Fewer facets or points are not worth a thread.
constexpr std::size_t least_in_grid = 16384;

// Rows that facets over more than two slabs may have in all. A grid of four slabs, with two more
// around them, has so many for each.
std::size_t most_rows(std::size_t facets) { return 36 * facets + 4096; }

}  // namespace

OccupiedCubes::OccupiedCubes(const CubeGrid& grid, const LatticeMesh& mesh, std::uint32_t threads)
    : grid_(grid),
      triangles_(mesh.triangles),
      of_points_(mesh.points.size()),
      places_(mesh.triangles.size()) {
    ParallelParts(mesh.points.size(), threads, least_in_grid)
        .for_each([&, by_value = grid, out = of_points_.get()](std::size_t, std::size_t begin,
                                                               std::size_t end) {
            // Nothing that is written may be a part of the grid.
            for (std::size_t i = begin; i < end; ++i) out[i] = by_value.cube_of(mesh.points[i]);
        });
    is_useful_ = mark_facets(threads);
    bytes_ = mesh.points.size() * sizeof(CubeGrid::Cube) +
             mesh.triangles.size() * sizeof(std::uint32_t) +
             occupied_.size() * sizeof(std::uint64_t);
}

// Calls mark(row, bits) for the facets that are not large.
template <class Mark>
void OccupiedCubes::mark_part(std::size_t begin, std::size_t end, const Mark& mark,
                              std::vector<std::uint32_t>& large) {
    const CubeGrid::Cube* const of_points = of_points_.get();
    std::uint32_t* const places = places_.get();
    const CubeGrid grid = grid_;
    const std::array<std::uint32_t, 3>* const triangles = triangles_.data();
    for (std::size_t f = begin; f < end; ++f) {
        const auto& t = triangles[f];
        const CubeRange range(of_points[t[0]], of_points[t[1]], of_points[t[2]]);
        const unsigned shape = range.shape();
        places[f] = range.lo | shape << 24;
        if (shape == CubeRange::large) [[unlikely]] {
            large.push_back(static_cast<std::uint32_t>(f));
            continue;
        }
        mark(shape, grid.row(range.lo), std::uint64_t{1} << CubeGrid::x(range.lo));
    }
}

bool OccupiedCubes::mark_facets(std::uint32_t threads) {
    ShapeRows begins(grid_);
    std::uint64_t* const rows = begins.of(0);
    const std::size_t of_shape = begins.padded;
    const ParallelParts parts(triangles_.size(), threads, least_in_grid);
    std::vector<std::vector<std::uint32_t>> large(parts.count());
    if (parts.count() == 1) {
        const auto mark = [=](unsigned shape, std::size_t row, std::uint64_t bit) {
            rows[shape * of_shape + row] |= bit;
        };
        mark_part(0, triangles_.size(), mark, large[0]);
    } else {
        // Nearly always another facet has set the bit; to look first keeps caches from waiting.
        const auto mark = [=](unsigned shape, std::size_t row, std::uint64_t bit) {
            const std::atomic_ref bits(rows[shape * of_shape + row]);
            if ((bits.load(std::memory_order_relaxed) & bit) == 0)
                bits.fetch_or(bit, std::memory_order_relaxed);
        };
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            mark_part(begin, end, mark, large[part]);
        });
    }
    std::size_t rows_of_large = 0;
    for (const auto& of_part : large)
        for (const std::uint32_t f : of_part) rows_of_large += range_of(f).row_count();
    if (rows_of_large > most_rows(triangles_.size())) return false;
    occupied_ = all_met(std::move(begins));
    for (const auto& of_part : large)
        for (const std::uint32_t f : of_part)
            range_of(f).for_each_row(grid_, [&](std::size_t row, std::uint64_t bits) {
                occupied_.row(row) |= bits;
                return true;
            });
    return true;
}

std::vector<std::uint32_t> OccupiedCubes::facets_in(const CubeSet& cubes,
                                                    std::uint32_t threads) const {
    ShapeRows begins = all_that_meet(grid_, cubes);
    const std::uint64_t* const rows = begins.of(0);
    const std::size_t of_shape = begins.padded;
    return numbers_that(
        triangles_.size(), threads,
        [&, grid = grid_, places = places_.get()](std::uint32_t number) {
            const std::size_t shape = places[number] >> 24;
            const CubeGrid::Cube lo = places[number] & 0xffffff;
            if (shape == CubeRange::large) [[unlikely]]
                return !range_of(number).for_each_row(grid,
                                                      [&](std::size_t row, std::uint64_t bits) {
                                                          return (cubes.row(row) & bits) == 0;
                                                      });
            return (rows[shape * of_shape + grid.row(lo)] >> CubeGrid::x(lo) & 1U) != 0;
        });
}

}  // namespace trisect::detail
