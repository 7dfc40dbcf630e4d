// SPDX-License-Identifier: Apache-2.0
//
// Cubes that facets occupy, and the facets that meet some (cube_grid.h), against slabs that are
// compared one by one.

#include <trisect/bsp/two_meshes/cube_grid.h>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "support/lattice_arithmetic.h"

namespace {

using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::detail::Box;
using trisect::detail::CubeGrid;
using trisect::detail::CubeSet;
using trisect::detail::OccupiedCubes;

// Triangles in a box and beyond it, of extents up to `size`.
LatticeMesh random_triangles(std::uint32_t seed, std::size_t count, std::int64_t size) {
    std::mt19937 random(seed);
    const auto between = [&](std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(random() % static_cast<std::uint32_t>(high - low));
    };
    LatticeMesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        const LatticePoint at{between(-1200, 1200), between(-800, 800), between(-300, 300)};
        for (int k = 0; k < 3; ++k)
            mesh.points.push_back(
                {at.x + between(0, size), at.y + between(0, size), at.z + between(0, size)});
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

std::array<std::size_t, 3> slabs_of(CubeGrid::Cube c) {
    return {CubeGrid::x(c), CubeGrid::y(c), CubeGrid::z(c)};
}

// Whether the box of a facet meets a cube.
bool meets(const CubeGrid& grid, const LatticeMesh& mesh, std::size_t facet, CubeGrid::Cube cube) {
    for (std::size_t k = 0; k < 3; ++k) {
        std::array<std::size_t, 3> slabs{};
        for (std::size_t i = 0; i < 3; ++i)
            slabs[i] = slabs_of(grid.cube_of(mesh.points[mesh.triangles[facet][i]]))[k];
        const auto [low, high] = std::ranges::minmax(slabs);
        if (slabs_of(cube)[k] < low || slabs_of(cube)[k] > high) return false;
    }
    return true;
}

template <class Visit>
void for_each_cube(const CubeGrid& grid, const Visit& visit) {
    for (std::size_t z = 0; z <= grid.last(2); ++z)
        for (std::size_t y = 0; y <= grid.last(1); ++y)
            for (std::size_t x = 0; x <= grid.last(0); ++x)
                visit(static_cast<CubeGrid::Cube>(x | y << 8 | z << 16));
}

void expect_as_one_by_one(std::int64_t size, int slabs, std::uint32_t seed) {
    Box box;
    box.add(LatticePoint{-1000, -700, -200});
    box.add(LatticePoint{1000, 700, 200});
    const CubeGrid grid(box, slabs);
    const LatticeMesh mesh = random_triangles(seed, 60, size);
    const LatticeMesh other = random_triangles(seed + 1, 5, size);
    const OccupiedCubes cubes(grid, mesh);
    const OccupiedCubes other_cubes(grid, other);
    ASSERT_TRUE(cubes.is_useful() && other_cubes.is_useful());
    std::vector<bool> is_near(mesh.triangles.size());
    for_each_cube(grid, [&](CubeGrid::Cube cube) {
        bool occupied = false;
        bool occupied_by_other = false;
        for (std::size_t f = 0; f < other.triangles.size(); ++f)
            occupied_by_other = occupied_by_other || meets(grid, other, f, cube);
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
            if (!meets(grid, mesh, f, cube)) continue;
            occupied = true;
            if (occupied_by_other) is_near[f] = true;
        }
        EXPECT_EQ(cubes.cubes().has(grid, cube), occupied);
        EXPECT_EQ(other_cubes.cubes().has(grid, cube), occupied_by_other);
    });
    std::vector<std::uint32_t> expected;
    for (std::uint32_t f = 0; f < is_near.size(); ++f)
        if (is_near[f]) expected.push_back(f);
    EXPECT_EQ(cubes.facets_in(other_cubes.cubes()), expected);
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
        EXPECT_TRUE(meets(grid, mesh, f, cubes.cube_of_facet(f)));
}

TEST(CubeGrid, FacetsOfOneOrTwoSlabs) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) expect_as_one_by_one(100, 16, 2 * seed);
}

TEST(CubeGrid, FacetsOfManySlabs) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) expect_as_one_by_one(500, 12, 2 * seed);
}

TEST(CubeGrid, AsManySlabsAsThereCanBe) {
    expect_as_one_by_one(60, 62, 7);
    expect_as_one_by_one(3, 1, 8);
}

// A slab never lies before that of a lesser position, and the slabs at the ends have no end.
TEST(CubeGrid, SlabsAscend) {
    Box box;
    box.add(LatticePoint{-3, 5, -(std::int64_t{1} << 50)});
    box.add(LatticePoint{4, 5, std::int64_t{1} << 50});
    const CubeGrid grid(box, 62);
    std::size_t before = 0;
    for (int bits = 52; bits >= 0; --bits) {
        const auto z = CubeGrid::z(grid.cube_of({0, 5, -(std::int64_t{1} << bits)}));
        EXPECT_GE(z, before);
        before = z;
    }
    EXPECT_EQ(CubeGrid::z(grid.cube_of({0, 5, -(std::int64_t{1} << 52)})), 0U);
    EXPECT_EQ(CubeGrid::z(grid.cube_of({0, 5, std::int64_t{1} << 52})), grid.last(2));
    EXPECT_GE(grid.last(0), 2U);
    EXPECT_LE(grid.last(2), 63U);
}

}  // namespace
