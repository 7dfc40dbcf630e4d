// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/embedding.h>

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/contact/embedding_counters.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/manifold_counts.h>
#include <trisect/brep/validate/validate.h>

#include "support/lattice_arithmetic.h"
#include "support/mesh_builders.h"

namespace {

using trisect::is_embedded;
using trisect::PolygonMesh;
using trisect::test::cuboid;
using trisect::test::flipped;
using trisect::test::together;

bool embedded(const PolygonMesh& mesh) { return is_embedded(trisect::import_mesh(mesh).mesh); }

TEST(Embedding, SolidsAndTheirCavities) {
    EXPECT_TRUE(embedded(cuboid()));
    EXPECT_TRUE(embedded(trisect::make_icosphere(1, 4)));
    EXPECT_TRUE(embedded(together(cuboid(), cuboid({2, 2, 2}, {3, 3, 3}))));
    EXPECT_TRUE(
        embedded(together(cuboid({0, 0, 0}, {3, 3, 3}), flipped(cuboid({1, 1, 1}, {2, 2, 2})))));
}

TEST(Embedding, WhatMeetsItself) {
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({0.5, 0.5, 0.5}, {2, 2, 2})))) << "crosses";
    EXPECT_FALSE(embedded(together(cuboid(), cuboid()))) << "coincides";
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 0, 0}, {2, 1, 1})))) << "flush";
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 0.25, 0.25}, {2, 0.5, 0.5}))))
        << "on a face";
}

// Three cubes in a row: the last two touch in a face, far from the first one.
TEST(Embedding, OfSomeTrianglesOnly) {
    const PolygonMesh cubes = together(together(cuboid(), cuboid({2, 0, 0}, {3, 1, 1})),
                                       cuboid({3, 0.25, 0.25}, {4, 0.75, 0.75}));
    const trisect::LatticeMesh mesh = trisect::import_mesh(cubes).mesh;
    const auto triangles = [](std::uint32_t first, std::uint32_t end) {
        std::vector<std::uint32_t> out;
        for (std::uint32_t t = first; t < end; ++t) out.push_back(t);
        return out;
    };
    ASSERT_EQ(mesh.triangles.size(), 36U);
    EXPECT_FALSE(is_embedded(mesh));
    EXPECT_TRUE(trisect::are_embedded(mesh, {}));
    EXPECT_TRUE(trisect::are_embedded(mesh, triangles(0, 12)));
    EXPECT_FALSE(trisect::are_embedded(mesh, triangles(12, 24)));
    EXPECT_FALSE(trisect::are_embedded(mesh, triangles(0, 36)));
}

TEST(Embedding, CountsWhatDecided) {
    const auto counts = [](const PolygonMesh& mesh) {
        const trisect::Diagnostics<trisect::detail::EmbeddingCounters> diagnostics;
        EXPECT_TRUE(embedded(mesh));
        return diagnostics.counters();
    };
    const auto of_ball = counts(trisect::make_icosphere(1, 3));
    EXPECT_EQ(of_ball.starlike, 1U);
    EXPECT_EQ(of_ball.compared, 0U);
    const auto of_ring = counts(trisect::make_torus(3, 1, 12, 8));
    EXPECT_EQ(of_ring.starlike + of_ring.height_fields + of_ring.convex, 0U);
    EXPECT_EQ(of_ring.compared, 1U);
    EXPECT_GT(of_ring.edge_lines + of_ring.own_planes, 0U);
    EXPECT_EQ(of_ring.exact_pairs, 0U);
}

// Winding numbers of 2 and of -1.
TEST(Embedding, ShellsThatAreNested) {
    EXPECT_FALSE(embedded(together(cuboid({0, 0, 0}, {3, 3, 3}), cuboid({1, 1, 1}, {2, 2, 2}))));
    EXPECT_FALSE(embedded(flipped(cuboid())));
}

// A solid may touch itself, but who asks has to look.
TEST(Embedding, TouchingInAnEdgeOrACorner) {
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1}))));
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 1, 1}, {2, 2, 2}))));
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 1, 0.5}, {2, 2, 2}))));
}

// Whether it is decided over neighbours or by validation, the answer is that of all checks.
bool is_without_defect(const trisect::LatticeMesh& mesh) {
    const trisect::ValidationReport report = trisect::validate(mesh);
    for (std::size_t k = 0; k < trisect::defect_kind_count; ++k) {
        const auto kind = static_cast<trisect::DefectKind>(k);
        const bool of_points =
            kind == trisect::DefectKind::DuplicatePoint || kind == trisect::DefectKind::UnusedPoint;
        if (!of_points && report.count(kind) != 0) return false;
    }
    return true;
}

TEST(Embedding, SameAsValidationWhereCornersMove) {
    std::mt19937 random(20261123);
    std::size_t embedded = 0;
    constexpr std::size_t rounds = 400;
    for (std::size_t round = 0; round < rounds; ++round) {
        trisect::LatticeMesh mesh =
            trisect::import_mesh(
                trisect::make_icosphere(64, static_cast<std::uint32_t>(1 + round % 3)))
                .mesh;
        // From hardly a dent to corners far outside, on so coarse a grid that they often coincide.
        const std::int64_t reach = std::int64_t{1} << (36 + round % 8);
        for (std::size_t n = 0; n < 1 + round % 5; ++n) {
            trisect::LatticePoint& p = mesh.points[random() % mesh.points.size()];
            for (trisect::Coordinate* const c : {&p.x, &p.y, &p.z})
                *c = *c + (static_cast<std::int64_t>(random() % 5) - 2) * reach / 4;
        }
        if (random() % 4 == 0)
            mesh.points[random() % mesh.points.size()] = mesh.points[random() % mesh.points.size()];
        const bool answer = is_embedded(mesh);
        EXPECT_EQ(answer, is_without_defect(mesh)) << round;
        embedded += answer ? 1 : 0;
    }
    EXPECT_GT(embedded, rounds / 10);
    EXPECT_LT(embedded, rounds * 9 / 10);
}

TEST(ManifoldCounts, ShellsAndHandles) {
    const auto counts_of = [](const PolygonMesh& polygons) {
        const trisect::LatticeMesh mesh = trisect::import_mesh(polygons).mesh;
        return trisect::manifold_counts(mesh.points.size(), mesh.triangles);
    };
    const auto cubes = counts_of(together(cuboid(), cuboid({2, 2, 2}, {3, 3, 3})));
    EXPECT_EQ(cubes, (trisect::ManifoldCounts{16, 36, 2, 0}));
    const auto torus = counts_of(trisect::make_torus(3, 1, 12, 8));
    ASSERT_TRUE(torus);
    EXPECT_EQ(torus->genus, 1);
    EXPECT_EQ(torus->shells, 1U);
    EXPECT_FALSE(counts_of(together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1})))) << "edge of four";
    EXPECT_FALSE(counts_of(together(cuboid(), cuboid({1, 1, 1}, {2, 2, 2})))) << "two fans";
}

}  // namespace
