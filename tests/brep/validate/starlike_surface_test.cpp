// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that each direction from a point meets once, against validation, which compares all
// pairs.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/brep/validate/manifold_mesh.h>
#include <trisect/brep/validate/validate.h>

#include "support/mesh_builders.h"

namespace starlike_surface_test {
namespace {

using trisect::Coordinate;
using trisect::LatticeMesh;
using trisect::PolygonMesh;

bool is_starlike(const LatticeMesh& mesh) {
    const auto manifold = trisect::detail::ManifoldMesh::of(mesh.points, mesh.triangles);
    return manifold && manifold->is_starlike();
}

bool is_starlike(const PolygonMesh& mesh) { return is_starlike(trisect::import_mesh(mesh).mesh); }

// A pole, rings, and the other pole, each corner moved along its radius.
template <class Radius>
PolygonMesh bumpy_sphere(std::uint32_t rings, std::uint32_t sides, const Radius& radius) {
    PolygonMesh mesh;
    mesh.points.push_back({0, 0, radius()});
    for (std::uint32_t r = 1; r <= rings; ++r)
        for (std::uint32_t s = 0; s < sides; ++s) {
            const double polar = 3.14159265 * r / (rings + 1);
            const double turn = 6.2831853 * s / sides;
            const double size = radius();
            mesh.points.push_back({size * std::sin(polar) * std::cos(turn),
                                   size * std::sin(polar) * std::sin(turn),
                                   size * std::cos(polar)});
        }
    mesh.points.push_back({0, 0, -radius()});
    const std::uint32_t last = rings * sides + 1;
    for (std::uint32_t s = 0; s < sides; ++s) {
        const std::uint32_t t = (s + 1) % sides;
        mesh.add_triangle(0, 1 + s, 1 + t);
        mesh.add_triangle(last, last - sides + t, last - sides + s);
        for (std::uint32_t r = 0; r + 1 < rings; ++r) {
            const std::uint32_t a = 1 + r * sides;
            mesh.add_triangle(a + s, a + sides + s, a + sides + t);
            mesh.add_triangle(a + s, a + sides + t, a + t);
        }
    }
    return mesh;
}

TEST(StarlikeSurface, OfPrimitives) {
    EXPECT_TRUE(is_starlike(trisect::make_box({1, 2, 3})));
    EXPECT_TRUE(is_starlike(trisect::make_cylinder(0.1, 7, 30)));
    EXPECT_TRUE(is_starlike(trisect::make_icosphere(3, 3)));
    EXPECT_FALSE(is_starlike(trisect::make_torus(3, 1)));
}

TEST(StarlikeSurface, InsideOutAndTwoOfThemAreNone) {
    const PolygonMesh one = trisect::make_box({1, 1, 1});
    EXPECT_FALSE(is_starlike(trisect::test::flipped(one)));
    EXPECT_FALSE(
        is_starlike(trisect::test::together(one, trisect::make_box({0.5, 0.5, 0.5}, {2, 2, 2}))));
    // Both around the same point.
    EXPECT_FALSE(
        is_starlike(trisect::test::together(one, trisect::make_box({-1, -1, -1}, {2, 2, 2}))));
}

// All triangles turn away from the origin, but each direction meets two.
TEST(StarlikeSurface, TwiceAroundIsNone) {
    LatticeMesh mesh;
    const std::array<std::array<double, 2>, 3> ring{{{10, 0}, {-5, 9}, {-5, -9}}};
    for (std::size_t i = 0; i < 6; ++i)
        mesh.points.push_back(
            {Coordinate(ring[i % 3][0]), Coordinate(ring[i % 3][1]), Coordinate(0.0)});
    for (const double z : {8.0, -8.0})
        mesh.points.push_back({Coordinate(0.0), Coordinate(0.0), Coordinate(z)});
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.triangles.push_back({i, j, 6});
        mesh.triangles.push_back({j, i, 7});
    }
    EXPECT_FALSE(is_starlike(mesh));
}

TEST(StarlikeSurface, NeedNotBeConvex) {
    std::mt19937 random(20261129);
    for (int round = 0; round < 20; ++round) {
        const PolygonMesh mesh =
            bumpy_sphere(5, 9, [&] { return 1 + 0.1 * double(random() % 10); });
        EXPECT_TRUE(is_starlike(mesh)) << round;
        EXPECT_TRUE(trisect::validate(trisect::import_mesh(mesh).mesh).is_solid()) << round;
    }
}

// Where it says yes, all pairs of triangles say so, whatever was moved where.
TEST(StarlikeSurface, OfSolidsWithCornersMoved) {
    std::mt19937 random(20261130);
    int starlike = 0;
    int others = 0;
    for (int round = 0; round < 3000; ++round) {
        std::vector<trisect::Point3d> points;
        const double unit = round % 3 == 0 ? 0.1 : 1;
        const auto number = [&](unsigned n) { return unit * static_cast<double>(random() % n); };
        for (unsigned i = 0; i < 5 + random() % 9; ++i)
            points.push_back({number(5), number(5), number(5)});
        PolygonMesh mesh;
        try {
            mesh = trisect::make_hull(points);
        } catch (const trisect::Error&) {
            continue;  // flat
        }
        for (auto k = random() % 3; k > 0; --k)
            mesh.points[random() % mesh.points.size()] = {number(6), number(6), number(6)};
        LatticeMesh moved;
        try {
            moved = trisect::import_mesh(mesh).mesh;
        } catch (const trisect::Error&) {
            continue;
        }
        if (is_starlike(moved)) {
            ++starlike;
            const trisect::ValidationReport report = trisect::validate(moved);
            EXPECT_TRUE(report.is_solid()) << round << report.to_string();
            EXPECT_TRUE(trisect::is_embedded(moved)) << round;
        } else {
            ++others;
        }
    }
    EXPECT_GT(starlike, 800);
    EXPECT_GT(others, 500);
}

}  // namespace
}  // namespace starlike_surface_test
