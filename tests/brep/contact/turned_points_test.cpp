// SPDX-License-Identifier: Apache-2.0
//
// Contacts of turned box-like parts, against all pairs.

#include <trisect/brep/contact/turned_points.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <trisect/brep/contact/embedding_counters.h>
#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/manifold_mesh.h>

#include "support/mesh_builders.h"

namespace {

using trisect::AffineMap;
using trisect::LatticeMesh;
using trisect::PolygonMesh;
using trisect::detail::TurnedPoints;

AffineMap turn(double a, double b) {
    return trisect::compose(AffineMap::rotation({1, 2, 0.3}, a), AffineMap::rotation({0, 0, 1}, b));
}

// Teeth of random heights on a bar, extruded.
PolygonMesh comb(std::mt19937& random, int teeth) {
    trisect::Outline outline{{0, 0}, {2.0 * teeth, 0}};
    for (int i = teeth; i > 0; --i) {
        const double height = 1 + static_cast<double>(random() % 4);
        outline.push_back({2.0 * i, height});
        outline.push_back({2.0 * i - 1, height});
        outline.push_back({2.0 * i - 1, 0.5});
        outline.push_back({2.0 * i - 2, 0.5});
    }
    return trisect::make_extrusion(outline, {}, 0, 3);
}

bool has_contact_of_some_pair(const LatticeMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t k = i + 1; k < mesh.triangles.size(); ++k)
            if (trisect::detail::find_contact(mesh.points, mesh.triangles[i], mesh.triangles[k])
                    .kind != trisect::detail::ContactKind::None)
                return true;
    return false;
}

TEST(TurnedPoints, PartsAcrossTheAxesAndSpheresHaveNone) {
    std::mt19937 random(3);
    const LatticeMesh straight = trisect::import_mesh(comb(random, 6)).mesh;
    EXPECT_FALSE(TurnedPoints::of(straight.points, straight.triangles));
    const LatticeMesh sphere = trisect::import_mesh(trisect::make_icosphere(1, 3)).mesh;
    EXPECT_FALSE(TurnedPoints::of(sphere.points, sphere.triangles));
    const LatticeMesh turned =
        trisect::import_mesh(transformed(comb(random, 6), turn(30, 12))).mesh;
    EXPECT_TRUE(TurnedPoints::of(turned.points, turned.triangles));
}

TEST(TurnedPoints, ContactsAreThoseOfAllPairs) {
    std::mt19937 random(20261129);
    trisect::detail::embedding_counters() = {};
    std::size_t apart = 0;
    std::size_t meeting = 0;
    for (int round = 0; round < 64; ++round) {
        PolygonMesh mesh = comb(random, 3 + round % 5);
        // Teeth come into each other; or a thousandth, or a billionth, apart.
        if (round % 4 != 0)
            mesh = trisect::test::together(
                mesh, transformed(comb(random, 3),
                                  AffineMap::translation({0, -4.5,
                                                          std::ldexp(1, -10 * (round % 4)) -
                                                              (round % 8 < 4 ? 0.0 : 3.0)})));
        if (round % 3 == 0)
            mesh.points[random() % mesh.points.size()][random() % 3] += round % 2 == 0 ? 0.25 : 2.5;
        const double a = static_cast<double>(random() % 3600) / 10;
        const LatticeMesh turned = trisect::import_mesh(transformed(mesh, turn(a, a / 3))).mesh;
        const auto manifold = trisect::detail::ManifoldMesh::of(turned.points, turned.triangles);
        if (!manifold) continue;
        const auto answer = manifold->has_no_contact();
        if (!answer) continue;
        EXPECT_EQ(*answer, !has_contact_of_some_pair(turned)) << round;
        ++(*answer ? apart : meeting);
    }
    EXPECT_GT(apart, 16U);
    EXPECT_GT(meeting, 8U);
    EXPECT_GT(trisect::detail::embedding_counters().turned_lines, 1000U);
    EXPECT_GT(trisect::detail::embedding_counters().graph_corners, 1000U);
}

}  // namespace
