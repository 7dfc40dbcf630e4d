// SPDX-License-Identifier: Apache-2.0
//
// How much of a result assembly works on, and that its output is a function of the set and the
// operands' facets, not of the tree.

#include <gtest/gtest.h>

#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/detail/assembly.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::make_box;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::detail::AssemblyStats;

AssemblyStats stats_of(const Solid& solid) {
    AssemblyStats stats;
    (void)trisect::detail::assemble_mesh(*solid.state(), &stats);
    return stats;
}

Solid box(double low, double high) {
    return Solid::from_mesh(make_box({low, low, low}, {high, high, high}));
}

TEST(AssemblyWork, AnImportedMeshPassesThrough) {
    const PolygonMesh sphere = trisect::make_icosphere(1, 3);
    const AssemblyStats stats = stats_of(Solid::from_mesh(sphere));
    EXPECT_EQ(stats.whole_facets, sphere.face_count());
    EXPECT_EQ(stats.worked_facets, 0U);
    EXPECT_EQ(stats.parts, 0U);
}

TEST(AssemblyWork, DisjointSolidsPassThrough) {
    const AssemblyStats stats = stats_of(evaluate(box(0, 1) | box(3, 4)));
    EXPECT_EQ(stats.whole_facets, 24U);
    EXPECT_EQ(stats.worked_facets, 0U);
}

TEST(AssemblyWork, ACornerCutsThreeSidesOfEachBox) {
    // Each box has 6 facets in the 3 sides that the other one cuts. What is left whole lies in the
    // other sides.
    const AssemblyStats stats = stats_of(evaluate(box(0, 2) | box(1, 3)));
    EXPECT_EQ(stats.whole_facets + stats.worked_facets, 24U);
    EXPECT_GE(stats.whole_facets, 8U);
    EXPECT_GE(stats.parts, stats.worked_facets);
    EXPECT_GE(stats.edges, 3 * stats.worked_facets);
}

TEST(AssemblyWork, ASmallCutLeavesNearlyAllOfASphereAlone) {
    const Solid sphere = Solid::from_mesh(trisect::make_icosphere(1, 5));
    const Solid tool = Solid::from_mesh(trisect::transformed(
        trisect::make_icosphere(0.1, 2), trisect::AffineMap::translation({0.6, 0.48, 0.64})));
    const AssemblyStats stats = stats_of(evaluate(sphere - tool));
    EXPECT_GT(stats.whole_facets, 20000U);
    EXPECT_LT(stats.worked_facets, 600U);
}

TEST(AssemblyWork, OnlyCoplanarNeighboursAreJoined) {
    AssemblyStats stats;
    // Two facets for each side of a box.
    EXPECT_EQ(trisect::detail::assemble_brep(*box(0, 1).state(), {}, &stats).counts().faces, 6U);
    EXPECT_EQ(stats.joined_facets, 12U);
    const Solid sphere = Solid::from_mesh(trisect::make_icosphere(1, 3));
    (void)trisect::detail::assemble_brep(*sphere.state(), {}, &stats);
    EXPECT_EQ(stats.joined_facets, 0U);
}

TEST(AssemblyOrder, TrianglesDoNotDependOnTheTree) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 3));
    const Solid b = Solid::from_mesh(trisect::transformed(
        trisect::make_icosphere(1, 3), trisect::AffineMap::translation({0.5, 0.25, 0.125})));
    const Solid c = Solid::from_mesh(make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 2}));
    const Expression formula = (a | b) - c;
    const PolygonMesh first = evaluate(formula).to_mesh();
    for (const std::uint32_t leaf : {20U, 200U, 100000U}) {
        for (const std::uint32_t offset : {83U, 1U, 127U}) {
            EvaluateOptions options;
            options.leaf_polygons = leaf;
            options.wall_offset = offset;
            EXPECT_EQ(evaluate(formula, options).to_mesh(), first) << leaf << ' ' << offset;
        }
    }
}

}  // namespace
