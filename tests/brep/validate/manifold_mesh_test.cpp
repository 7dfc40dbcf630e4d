// SPDX-License-Identifier: Apache-2.0
//
// Checks over neighbours, against validation, which compares without them.

#include <trisect/brep/validate/manifold_mesh.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/certificate.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/brep/validate/sheet_grid.h>
#include <trisect/brep/validate/sheets.h>
#include <trisect/brep/validate/twins.h>

#include "support/mesh_builders.h"

namespace {

using trisect::PolygonMesh;
using trisect::detail::ManifoldMesh;
using trisect::test::cuboid;
using trisect::test::together;

// A sphere whose corners are moved, and now and then put in each other's place. On a coarse grid,
// so that parts coincide.
PolygonMesh dented_sphere(std::mt19937& random, std::uint32_t detail) {
    PolygonMesh mesh = trisect::make_icosphere(64, detail);
    const std::size_t moved = random() % 4;
    for (std::size_t n = 0; n < moved; ++n)
        for (double& c : mesh.points[random() % mesh.points.size()])
            c += (static_cast<double>(random() % 5) - 2) * 24;
    if (random() % 4 == 0)
        mesh.points[random() % mesh.points.size()] = mesh.points[random() % mesh.points.size()];
    return mesh;
}

TEST(ManifoldMesh, MostMeshesAreDecidedOverNeighbours) {
    std::mt19937 random(20261123);
    std::size_t decided = 0;
    std::size_t left = 0;
    for (std::uint32_t round = 0; round < 200; ++round) {
        const auto mesh = trisect::import_mesh(dented_sphere(random, 1 + round % 3)).mesh;
        const auto manifold = ManifoldMesh::of(mesh.points, mesh.triangles);
        const auto nested = manifold ? manifold->are_shells_nested() : std::nullopt;
        const auto apart = manifold ? manifold->has_no_contact() : std::nullopt;
        if (!nested || !apart) {
            ++left;
            continue;
        }
        ++decided;
        EXPECT_EQ(*nested && *apart, trisect::is_embedded(mesh)) << round;
    }
    EXPECT_GT(decided, 100U);
    EXPECT_GT(left, 10U);
}

auto facts(const trisect::Certificate& c) {
    return std::tuple(c.closed, c.oriented, c.self_intersecting_pairs, c.undecided);
}

// A point that nobody names, in the place of another one, leaves the certificate to validation.
TEST(ManifoldMesh, CertificateIsThatOfValidation) {
    std::mt19937 random(20261124);
    std::size_t certified = 0;
    constexpr std::uint32_t rounds = 200;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        PolygonMesh mesh = dented_sphere(random, 1 + round % 3);
        const trisect::Certificate quick = trisect::certify(mesh);
        mesh.points.push_back(mesh.points.front());
        EXPECT_EQ(facts(trisect::certify(mesh)), facts(quick)) << round;
        certified += quick.holds() ? 1U : 0U;
    }
    EXPECT_GT(certified, rounds / 10);
    EXPECT_LT(certified, rounds * 9 / 10);
}

// Coordinates of any doubles that span at most 126 bits.
TEST(ManifoldMesh, WideCoordinatesAreDecided) {
    std::mt19937 random(20261125);
    std::uniform_real_distribution<double> noise(0.95, 1.05);
    for (const double nearest : {1.0, 1e-9, 1e-17}) {
        PolygonMesh mesh = trisect::make_icosphere(1, 3);
        for (trisect::Point3d& p : mesh.points)
            for (double& c : p) c *= noise(random) * (std::fabs(c) < 0.1 ? nearest : 1);
        const trisect::Certificate quick = trisect::certify(mesh);
        EXPECT_TRUE(quick.self_intersecting_pairs);
        EXPECT_TRUE(nearest < 1 || quick.holds());
        mesh.points.push_back(mesh.points.front());  // leaves it to validation
        EXPECT_EQ(facts(trisect::certify(mesh)), facts(quick));
        mesh.points.pop_back();
        mesh.points[7] = {-mesh.points[7][0] / 3, -mesh.points[7][1] / 3, -mesh.points[7][2] * 9};
        const trisect::Certificate crossed = trisect::certify(mesh);
        EXPECT_GT(crossed.self_intersecting_pairs.value_or(0), 0U);
        EXPECT_FALSE(crossed.holds());
    }
}

TEST(SheetGrid, LeavesMostOfASphereOut) {
    const auto mesh = trisect::import_mesh(trisect::make_icosphere(1, 5)).mesh;
    const auto twins = trisect::detail::Twins::of(mesh.points.size(), mesh.triangles);
    ASSERT_TRUE(twins);
    const auto sheets = trisect::detail::find_sheets(mesh.points, mesh.triangles, *twins);
    ASSERT_TRUE(sheets);
    const auto near = trisect::detail::triangles_near_others(mesh.points, mesh.triangles, *sheets);
    EXPECT_GT(near.size(), 0U);
    EXPECT_LT(near.size(), mesh.triangles.size() / 2);
}

// Fans: at a corner of two, at one that two fans share, and where an edge has four triangles.
TEST(Twins, OnlyOneFanAtACorner) {
    const auto has_twins = [](const PolygonMesh& polygons) {
        const auto mesh = trisect::import_mesh(polygons).mesh;
        return trisect::detail::Twins::of(mesh.points.size(), mesh.triangles).has_value();
    };
    EXPECT_TRUE(has_twins(cuboid()));
    EXPECT_TRUE(has_twins(together(cuboid(), cuboid({2, 2, 2}, {3, 3, 3}))));
    EXPECT_FALSE(has_twins(together(cuboid(), cuboid({1, 1, 1}, {2, 2, 2}))));
    EXPECT_FALSE(has_twins(together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1}))));
    using Triangle = trisect::detail::Twins::Triangle;
    const std::vector<Triangle> pair{{0, 1, 2}, {0, 2, 1}};
    EXPECT_FALSE(trisect::detail::Twins::of(3, pair)) << "two sides of one triangle";
    const std::vector<Triangle> folded{{0, 1, 1}, {0, 1, 1}, {0, 1, 1}};
    EXPECT_FALSE(trisect::detail::Twins::of(2, folded)) << "repeated corners";
    const std::vector<Triangle> open{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    EXPECT_FALSE(trisect::detail::Twins::of(4, open)) << "a fan without the face opposite";
}

TEST(Twins, RunBackwards) {
    const auto mesh = trisect::import_mesh(trisect::make_icosphere(1, 3)).mesh;
    const auto twins = trisect::detail::Twins::of(mesh.points.size(), mesh.triangles);
    ASSERT_TRUE(twins);
    for (std::uint32_t h = 0; h < 3 * twins->triangle_count(); ++h) {
        const std::uint32_t back = (*twins)[h];
        EXPECT_EQ((*twins)[back], h);
        const auto& t = mesh.triangles[h / 3];
        const auto& u = mesh.triangles[back / 3];
        EXPECT_EQ(t[h % 3], u[(back % 3 + 1) % 3]);
        EXPECT_EQ(t[(h % 3 + 1) % 3], u[back % 3]);
    }
}

}  // namespace
