// SPDX-License-Identifier: Apache-2.0
//
// Local convexity, against that of the whole and against validation, which compares all pairs.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/certificate.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/manifold_mesh.h>
#include <trisect/brep/validate/validate.h>

#include "support/mesh_builders.h"

namespace convex_surface_test {
namespace {

using trisect::LatticeMesh;
using trisect::PolygonMesh;

bool is_convex_surface(const LatticeMesh& mesh) {
    const auto manifold = trisect::detail::ManifoldMesh::of(mesh.points, mesh.triangles);
    return manifold && manifold->is_convex();
}

bool is_convex_surface(const PolygonMesh& mesh) {
    return is_convex_surface(trisect::import_mesh(mesh).mesh);
}

TEST(ConvexSurface, OfPrimitives) {
    EXPECT_TRUE(is_convex_surface(trisect::make_box({1, 2, 3})));
    EXPECT_TRUE(is_convex_surface(trisect::make_cylinder(0.1, 7, 30)));
    EXPECT_TRUE(is_convex_surface(trisect::make_icosphere(3, 3)));
}

TEST(ConvexSurface, TwoOfThemAreNone) {
    const PolygonMesh one = trisect::make_box({1, 1, 1});
    const PolygonMesh other = trisect::make_box({0.5, 0.5, 0.5}, {2, 2, 2});
    EXPECT_FALSE(is_convex_surface(trisect::test::together(one, other)));
}

// Convex over all edges and within all planes, but it goes around the axis twice.
TEST(ConvexSurface, TwiceAroundIsNone) {
    LatticeMesh mesh;
    const std::array<std::array<double, 2>, 3> ring{{{10, 0}, {-5, 9}, {-5, -9}}};
    for (std::size_t i = 0; i < 6; ++i)
        mesh.points.push_back({trisect::Coordinate(ring[i % 3][0]),
                               trisect::Coordinate(ring[i % 3][1]), trisect::Coordinate(0.0)});
    for (const double z : {8.0, -8.0})
        mesh.points.push_back(
            {trisect::Coordinate(0.0), trisect::Coordinate(0.0), trisect::Coordinate(z)});
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.triangles.push_back({i, j, 6});
        mesh.triangles.push_back({j, i, 7});
    }
    EXPECT_TRUE(trisect::is_convex(mesh));
    EXPECT_FALSE(is_convex_surface(mesh));
}

// A tetrahedron one edge of which has a corner on one side alone, and a triangle without area in
// between, as rounding leaves it.
TEST(ConvexSurface, ATriangleOfCornersInARowIsNone) {
    const std::vector<trisect::Point3d> points{
        {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2, 0, 0}};
    std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}, {0, 4, 3}, {4, 1, 3},
                                                        {0, 3, 2}, {1, 2, 3}, {0, 1, 4}};
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        std::rotate(triangles.begin(), triangles.begin() + 1, triangles.end());
        LatticeMesh mesh;
        for (const auto& p : points)
            mesh.points.push_back(
                {trisect::Coordinate(p[0]), trisect::Coordinate(p[1]), trisect::Coordinate(p[2])});
        mesh.triangles = triangles;
        EXPECT_FALSE(is_convex_surface(mesh));
        PolygonMesh written;
        written.points = points;
        for (const auto& t : triangles) written.add_triangle(t[0], t[1], t[2]);
        const trisect::Certificate certificate = trisect::certify(written);
        EXPECT_TRUE(certificate.closed);
        EXPECT_TRUE(certificate.oriented);
        EXPECT_EQ(certificate.self_intersecting_pairs, 0U);
    }
}

TEST(ConvexSurface, OfHullsWithCornersMoved) {
    std::mt19937 random(20261128);
    int convex = 0;
    int others = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<trisect::Point3d> points;
        const auto number = [&](unsigned n) { return static_cast<double>(random() % n); };
        for (unsigned i = 0; i < 5 + random() % 9; ++i)
            points.push_back({number(5), number(5), number(5)});
        PolygonMesh mesh;
        try {
            mesh = trisect::make_hull(points);
        } catch (const trisect::Error&) {
            continue;  // flat
        }
        EXPECT_TRUE(is_convex_surface(mesh)) << round;
        LatticeMesh moved = trisect::import_mesh(mesh).mesh;
        const std::size_t at = random() % moved.points.size();
        moved.points[at] = moved.points[random() % moved.points.size()];
        if (round % 2 == 0)
            moved.points[at] = {trisect::Coordinate(number(5)), trisect::Coordinate(number(5)),
                                trisect::Coordinate(number(5))};
        const trisect::ValidationReport report = trisect::validate(moved);
        if (report.count(trisect::DefectKind::DegenerateFace) != 0) continue;
        if (is_convex_surface(moved)) {
            ++convex;
            EXPECT_TRUE(trisect::is_convex(moved)) << round;
            EXPECT_TRUE(report.is_solid()) << round << report.to_string();
        } else {
            ++others;
        }
    }
    EXPECT_GT(convex, 50);
    EXPECT_GT(others, 500);
}

}  // namespace
}  // namespace convex_surface_test
