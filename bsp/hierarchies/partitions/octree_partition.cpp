// SPDX-License-Identifier: Apache-2.0
//
// An octree needs no choice of where to cut, and that is its strength and its weakness: a cube is
// divided into eight wherever the surface is in it. A triangle is listed in every leaf that it may
// meet, by its plane and edges, not its box alone.
//
// Source: H. Samet, The design and analysis of spatial data structures (1990); D. Meagher,
// Geometric modeling using octree encoding (1982).

#include <algorithm>
#include <cmath>

#include <trisect/bsp/hierarchies/partitions/partitions.h>
#include <trisect/bsp/hierarchies/partitions/space_tree_partition.h>
#include <trisect/bsp/query/index/triangle_in_boxes.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::hierarchies {

namespace {

Box cube_around(const Box& b) {
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, b.hi[k] - b.lo[k]);
    Box cube = b;
    // A little more, so that rounding keeps the boxes inside.
    for (std::size_t k = 0; k < 3; ++k)
        cube.hi[k] = b.lo[k] + std::nextafter(size, HUGE_VAL) * detail::surely_more;
    return cube;
}

std::vector<Box> octants(const Box& cell) {
    std::vector<Box> parts(8, cell);
    for (std::size_t k = 0; k < 3; ++k) {
        const double middle = 0.5 * cell.lo[k] + 0.5 * cell.hi[k];
        if (!(cell.lo[k] < middle && middle < cell.hi[k])) return {};
        for (std::size_t c = 0; c < 8; ++c)
            ((c >> k & 1U) != 0 ? parts[c].lo : parts[c].hi)[k] = middle;
    }
    return parts;
}

SpaceTree octree(const detail::InterferenceModelData& model, const TriangleBoxes& boxes) {
    std::vector<detail::TriangleInBoxes> triangles;
    triangles.reserve(boxes.size());
    for (const detail::ModelTriangle& t : model.triangles)
        triangles.emplace_back(std::array{model.position(t.vertex[0]), model.position(t.vertex[1]),
                                          model.position(t.vertex[2])});
    const auto may_meet = [&](std::uint32_t i, const Box& cell) {
        std::array<double, 3> middle{};
        double half = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = 0.5 * cell.lo[k] + 0.5 * cell.hi[k];
            half = std::max({half, cell.hi[k] - middle[k], middle[k] - cell.lo[k]});
        }
        // A cube that contains the cell, grown by what positions are off by.
        return triangles[i].may_meet(middle, half * detail::surely_more + 4 * boxes.error());
    };
    const auto divide = [](const Box& cell, std::span<const std::uint32_t>) {
        return octants(cell);
    };
    return {boxes, cube_around(boxes.bounds()), divide, may_meet};
}

}  // namespace

std::unique_ptr<PairStructure> make_octree_partition(const InterferenceModel& a,
                                                     const InterferenceModel& b) {
    return std::make_unique<SpaceTreePartition>("octree", octree, a, b);
}

}  // namespace trisect::hierarchies
