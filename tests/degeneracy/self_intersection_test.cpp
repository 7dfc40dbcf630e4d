// SPDX-License-Identifier: Apache-2.0
//
// Operands whose boundary meets itself: what is inside is decided by winding numbers.

#include <gtest/gtest.h>

#include <array>

#include "figures.h"

namespace self_intersection_test {
namespace {

using degeneracy::cube;
using degeneracy::Figures;
using degeneracy::figures;
using reference::concatenated;
using reference::Operand;
using reference::reversed;
using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::Solid;

// The set that an operand describes, in all ways to ask for it.
Figures resolved(const Operand& operand,
                 EvaluateOptions::Winding rule = EvaluateOptions::Winding::Positive) {
    EvaluateOptions options;
    options.winding = rule;
    const Solid s = engines::solid(operand, trisect::Embedding::Resolve);
    const auto naive = reference::evaluate({operand}, reference::Expression::leaf(0),
                                           rule == EvaluateOptions::Winding::Positive
                                               ? reference::InsideRule::Positive
                                               : reference::InsideRule::NonZero);
    Figures first;
    for (const std::uint32_t leaf : {3U, 25U, 1000U}) {
        options.leaf_polygons = leaf;
        const trisect::Brep brep = evaluate(s, options).to_brep();
        EXPECT_EQ(engines::difference(brep, reference::canonical_boundary(naive.cells)), "")
            << "leaf size " << leaf;
        if (leaf == 3U) first = figures(brep);
        EXPECT_EQ(figures(brep), first) << "leaf size " << leaf;
    }
    return first;
}

const Figures cube4{8, 12, 6, 6, 1, "64", 96};
const Figures nothing;
constexpr auto non_zero = EvaluateOptions::Winding::NonZero;

TEST(SelfIntersection, OverlappingBoxesInOneMeshAreTheirUnion) {
    EXPECT_EQ(resolved(concatenated(cube(0, 4), cube(2, 6))),
              (Figures{20, 30, 12, 12, 1, "120", 168}));
}

TEST(SelfIntersection, FlushBoxesInOneMeshAreTheirUnion) {
    EXPECT_EQ(resolved(concatenated(cube(0, 4), reference::box({4, 0, 0}, {8, 4, 4}))),
              (Figures{8, 12, 6, 6, 1, "128", 160}));
    EXPECT_EQ(resolved(concatenated(cube(0, 4), reference::box({4, 1, 1}, {6, 3, 3}))),
              (Figures{16, 24, 11, 12, 1, "72", 112}));
}

TEST(SelfIntersection, AShellWoundTwiceIsOne) {
    EXPECT_EQ(resolved(concatenated(cube(0, 4), cube(0, 4))), cube4);
    EXPECT_EQ(resolved(concatenated(cube(0, 4), cube(0, 4)), non_zero), cube4);
}

TEST(SelfIntersection, AShellAndItsReverseAreNothing) {
    EXPECT_EQ(resolved(concatenated(cube(0, 4), reversed(cube(0, 4)))), nothing);
    EXPECT_EQ(resolved(concatenated(cube(0, 4), reversed(cube(0, 4))), non_zero), nothing);
}

TEST(SelfIntersection, AnInsideOutShellIsNothingOrASolid) {
    EXPECT_EQ(resolved(reversed(cube(0, 4))), nothing);
    EXPECT_EQ(resolved(reversed(cube(0, 4)), non_zero), cube4);
}

TEST(SelfIntersection, AnInsideOutShellInAnotherIsACavity) {
    const Figures hollow{16, 24, 12, 12, 2, "56", 120};
    const Operand mesh = concatenated(cube(0, 4), reversed(cube(1, 3)));
    EXPECT_EQ(resolved(mesh), hollow);
    EXPECT_EQ(resolved(mesh, non_zero), hollow);
    // Once more: the winding number in the cavity is -1.
    const Operand twice = concatenated(mesh, reversed(cube(1, 3)));
    EXPECT_EQ(resolved(twice), hollow);
    EXPECT_EQ(resolved(twice, non_zero), cube4);
}

TEST(SelfIntersection, ANestedShellOfTheSameOrientationVanishes) {
    EXPECT_EQ(resolved(concatenated(cube(0, 4), cube(1, 3))), cube4);
}

TEST(SelfIntersection, AnInsideOutShellThatCrossesTheOuterOneIsAPocket) {
    // Outside of the cube the winding number is -1.
    const Operand mesh = concatenated(cube(0, 4), reversed(cube(2, 6)));
    EXPECT_EQ(resolved(mesh), (Figures{14, 21, 9, 9, 1, "56", 96}));
    EXPECT_EQ(resolved(mesh, non_zero), (Figures{28, 42, 18, 18, 2, "112", 192, 6, 6}));
}

// A pentagram prism: one closed band of five rectangles that crosses itself, with two caps of three
// triangles wound around the middle twice.
TEST(SelfIntersection, AFaceThatCrossesItselfIsFilled) {
    const std::array<std::array<std::int64_t, 2>, 5> star{
        {{0, 10}, {6, -8}, {-10, 3}, {10, 3}, {-6, -8}}};
    Operand mesh;
    const auto at = [&](std::size_t i, std::int64_t z) {
        return reference::LatticePoint{star[i % 5][0], star[i % 5][1], z};
    };
    for (std::size_t i = 0; i < 5; ++i) {
        mesh.push_back({at(i + 1, 0), at(i, 0), at(i, 4)});
        mesh.push_back({at(i + 1, 0), at(i, 4), at(i + 1, 4)});
    }
    for (const std::size_t i : {1U, 2U, 3U}) {
        mesh.push_back({at(0, 0), at(i, 0), at(i + 1, 0)});
        mesh.push_back({at(0, 4), at(i + 1, 4), at(i, 4)});
    }
    ASSERT_TRUE(reference::is_balanced(mesh));
    const Figures filled = resolved(reference::signed_volume(mesh) > 0 ? mesh : reversed(mesh));
    EXPECT_EQ(filled.vertices, 20U);
    EXPECT_EQ(filled.edges, 30U);
    EXPECT_EQ(filled.faces, 12U);
    EXPECT_EQ(filled.shells, 1U);
}

TEST(SelfIntersection, ResolvedOperandsMeetOthers) {
    const Operand crossing = concatenated(cube(0, 4), cube(2, 6));
    EXPECT_EQ(degeneracy::checked_figures(
                  {crossing, cube(2, 4)},
                  reference::pair_expression(reference::Expression::Kind::Difference)),
              (Figures{28, 42, 18, 18, 2, "112", 192, 6, 6}));
    EXPECT_EQ(
        degeneracy::checked_figures({crossing, reversed(cube(1, 5))},
                                    reference::pair_expression(reference::Expression::Kind::Union)),
        (Figures{20, 30, 12, 12, 1, "120", 168}));
}

}  // namespace
}  // namespace self_intersection_test
