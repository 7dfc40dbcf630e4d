// SPDX-License-Identifier: Apache-2.0
//
// Boundaries put together by several threads: the same edges, points and meshes as by one.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/assembly/assembly_parts.h>
#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "support/solids.h"

namespace {

using trisect::evaluate;
using trisect::Expression;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::detail::BoundaryEdge;
using trisect::detail::BoundaryParts;

void expect_equal_edges(const BoundaryParts& a, const BoundaryParts& b) {
    ASSERT_EQ(a.edges.size(), b.edges.size());
    ASSERT_EQ(a.bench.point_count(), b.bench.point_count());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.edges.size(); ++i) {
        const BoundaryEdge& e = a.edges[i];
        const BoundaryEdge& f = b.edges[i];
        if (e.from != f.from || e.to != f.to || e.facet != f.facet ||
            e.line.plane != f.line.plane || a.bench.nearest(e.from) != b.bench.nearest(f.from))
            ++different;
    }
    EXPECT_EQ(different, 0U);
}

// Not only the mesh: small boundaries would be put together by one thread. Returns the edges.
std::size_t expect_the_same_on_threads(const Solid& solid) {
    const auto state = trisect::detail::state_of(solid);
    BoundaryParts alone;
    trisect::detail::gather_parts(*state, alone, true, 1);
    const PolygonMesh mesh = solid.to_mesh(1);
    for (const std::uint32_t threads : {2U, 5U}) {
        BoundaryParts parts;
        trisect::detail::gather_parts(*state, parts, true, threads);
        expect_equal_edges(parts, alone);
        const PolygonMesh other = solid.to_mesh(threads);
        EXPECT_EQ(other.corners, mesh.corners);
        EXPECT_TRUE(other.points == mesh.points);
    }
    return alone.edges.size();
}

void add_box(PolygonMesh& mesh, const Point3d& low, const Point3d& high) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (unsigned i = 0; i < 8; ++i)
        mesh.points.push_back({(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1],
                               (i & 4U) != 0 ? high[2] : low[2]});
    for (const auto& f : std::array<std::array<std::uint32_t, 4>, 6>{{{0, 2, 3, 1},
                                                                      {4, 5, 7, 6},
                                                                      {0, 1, 5, 4},
                                                                      {2, 6, 7, 3},
                                                                      {0, 4, 6, 2},
                                                                      {1, 3, 7, 5}}}) {
        mesh.add_triangle(first + f[0], first + f[1], first + f[2]);
        mesh.add_triangle(first + f[0], first + f[2], first + f[3]);
    }
}

void add_bore(PolygonMesh& mesh, double x, double y, std::uint32_t sides, double low = -0.5,
              double high = 1.5) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const double z : {low, high})
        for (std::uint32_t k = 0; k < sides; ++k) {
            const double angle = 0.3 * x + 0.7 * y + 6.28 * k / sides;
            mesh.points.push_back(
                {x + 0.5 + 0.35 * std::cos(angle), y + 0.5 + 0.35 * std::sin(angle), z});
        }
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t l = (k + 1) % sides;
        mesh.add_triangle(first + k, first + l, first + l + sides);
        mesh.add_triangle(first + k, first + l + sides, first + k + sides);
        if (k < 2) continue;
        mesh.add_triangle(first, first + k, first + k - 1);
        mesh.add_triangle(first + sides, first + sides + k - 1, first + sides + k);
    }
}

// Outlines of what many meshes leave of each other's facets.
TEST(ExportOnThreads, ManyBalls) {
    std::vector<Solid> balls;
    for (int i = 0; i < 16; ++i)
        balls.push_back(
            solids::ball(1, 4, {0.31 * i, 0.4 * (i % 3), 0.27 * ((i * 7) % 5)}, 0x1p-30));
    EXPECT_GT(expect_the_same_on_threads(evaluate(Expression::any_of(balls))), 3000U);
}

// More of them, so that planes, points and edges are made by several threads, too.
TEST(ExportOnThreads, ManyLargerBalls) {
    std::vector<Solid> balls;
    for (int i = 0; i < 40; ++i)
        balls.push_back(
            solids::ball(1, 5, {0.31 * i, 0.4 * (i % 3), 0.27 * ((i * 7) % 5)}, 0x1p-30));
    EXPECT_GT(expect_the_same_on_threads(evaluate(Expression::any_of(balls))), 16384U);
}

// Vertices of many facets in special position are looked for inside their edges.
TEST(ExportOnThreads, BoresThroughAPlate) {
    PolygonMesh bores;
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) add_bore(bores, i, j, 32);
    const Solid plate = evaluate(solids::box(0, 0, 0, 12, 12, 1) - Solid::from_mesh(bores));
    EXPECT_GT(expect_the_same_on_threads(plate), 8192U);
}

// Closed paths of two tools on the same facets: some meet, some lie in each other, most are alone.
TEST(ExportOnThreads, BoresOfTwoToolsThroughAPlate) {
    std::array<PolygonMesh, 2> bores;
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 10; ++j)
            for (std::size_t tool = 0; tool < 2; ++tool)
                if ((i * j) % 3 != static_cast<int>(tool))
                    add_bore(bores[tool], i + 0.03125 * (j % 7) * static_cast<double>(tool), j, 24);
    const Solid plate = solids::box(0, 0, 0, 10.5, 10, 1);
    const Solid first = Solid::from_mesh(bores[0]);
    const Solid second = Solid::from_mesh(bores[1]);
    const Solid both = evaluate(plate - first - second);
    EXPECT_GT(expect_the_same_on_threads(both), 4096U);
    const Solid one_by_one = evaluate(evaluate(plate - first) - second);
    EXPECT_EQ(trisect::exact_volume(both.to_brep()), trisect::exact_volume(one_by_one.to_brep()));
}

// One face with many holes, whose vertices are all corners of the tool.
TEST(ExportOnThreads, PocketsThatEndWithThePlate) {
    PolygonMesh pockets;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) add_bore(pockets, i, j, 10, 0.5, 1);
    const Solid plate = evaluate(solids::box(0, 0, 0, 40, 40, 1) - Solid::from_mesh(pockets));
    EXPECT_GT(expect_the_same_on_threads(plate), 16000U);
}

// The same, but these vertices are where planes meet.
TEST(ExportOnThreads, PocketsBeyondThePlate) {
    PolygonMesh pockets;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) add_bore(pockets, i, j, 10, 0.5, 1.25);
    const Solid plate = evaluate(solids::box(0, 0, 0, 40, 40, 1) - Solid::from_mesh(pockets));
    EXPECT_GT(expect_the_same_on_threads(plate), 16000U);
}

// A box less bars across each other. Returns the edges.
std::size_t expect_the_same_of_bars(int count) {
    std::vector<Solid> bars;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        PolygonMesh mesh;
        for (int i = 0; i < count; ++i)
            for (int j = 0; j < count; ++j) {
                Point3d low{};
                Point3d high{};
                low[axis] = -1;
                high[axis] = 3 * count + 1;
                low[(axis + 1) % 3] = 3 * i + 1;
                high[(axis + 1) % 3] = 3 * i + 2 + (i + j) % 2;
                low[(axis + 2) % 3] = 3 * j + 1;
                high[(axis + 2) % 3] = 3 * j + 2;
                if ((i + j) % 2 == 1) high[(axis + 1) % 3] -= 0.5;
                add_box(mesh, low, high);
            }
        bars.push_back(Solid::from_mesh(mesh));
    }
    const double side = 3 * count;
    const Solid rest = evaluate(solids::box(0, 0, 0, side, side, side) - Expression::any_of(bars));
    return expect_the_same_on_threads(rest);
}

// Planes with hundreds of edges each, outlined one by one.
TEST(ExportOnThreads, PlanesAcrossAxes) { EXPECT_GT(expect_the_same_of_bars(9), 2048U); }

// The same with so many vertices that several threads make them.
TEST(ExportOnThreads, LargePlanesAcrossAxes) { EXPECT_GT(expect_the_same_of_bars(18), 8192U); }

}  // namespace
