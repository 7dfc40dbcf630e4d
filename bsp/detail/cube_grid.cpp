// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/cube_grid.h>

#include <memory>

namespace trisect::detail {

CubeGrid::CubeGrid(const Box& box, int slabs) {
    double longest = 0;
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3; ++k) {
        origin_[k] = box.lo[k];
        extent[k] = static_cast<double>(box.hi[k] - box.lo[k] + 1);
        longest = std::max(longest, extent[k]);
    }
    scale_ = slabs / longest;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto inner = static_cast<std::int32_t>(extent[k] * scale_);
        last_[k] = std::min(inner, slabs - 1) + 2;
    }
}

OccupiedCubes::OccupiedCubes(const CubeGrid& grid, const LatticeMesh& mesh)
    : triangles_(mesh.triangles), of_points_(mesh.points.size()) {
    const CubeGrid by_value = grid;  // nothing that is written may be a part of it
    CubeGrid::Cube* out = of_points_.data();
    for (const LatticePoint& p : mesh.points) *out++ = by_value.cube_of(p);
    is_useful_ = mark_facets();
}

// Most facets lie in one cube, or in the one of the facet before.
bool OccupiedCubes::mark_facets() {
    std::size_t rows_left = 16 * triangles_.size() + CubeGrid::side * CubeGrid::side;
    const CubeGrid::Cube* const of_points = of_points_.data();
    std::uint64_t* const rows = &occupied_.row(0);
    for (const auto& t : triangles_) {
        const CubeRange range(of_points[t[0]], of_points[t[1]], of_points[t[2]]);
        if (range.lo == range.hi) {
            rows[CubeGrid::row(range.lo)] |= std::uint64_t{1} << CubeGrid::x(range.lo);
            continue;
        }
        const bool few = range.for_each_row([&](std::size_t row, std::uint64_t bits) {
            rows[row] |= bits;
            return --rows_left != 0;
        });
        if (!few) return false;
    }
    return true;
}

std::vector<std::uint32_t> OccupiedCubes::facets_in(const CubeSet& cubes) const {
    const auto found = std::make_unique_for_overwrite<std::uint32_t[]>(triangles_.size() + 1);
    std::uint32_t* end = found.get();
    const CubeGrid::Cube* const of_points = of_points_.data();
    const std::uint64_t* const rows = &cubes.row(0);
    std::uint32_t number = 0;
    for (const auto& t : triangles_) {
        const CubeRange range(of_points[t[0]], of_points[t[1]], of_points[t[2]]);
        bool meets = false;
        if (range.lo == range.hi) {
            meets = (rows[CubeGrid::row(range.lo)] >> CubeGrid::x(range.lo) & 1U) != 0;
        } else {
            meets = !range.for_each_row(
                [&](std::size_t row, std::uint64_t bits) { return (rows[row] & bits) == 0; });
        }
        *end = number++;
        end += meets ? 1 : 0;
    }
    return {found.get(), end};
}

}  // namespace trisect::detail
