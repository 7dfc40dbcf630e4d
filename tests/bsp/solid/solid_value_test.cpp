// SPDX-License-Identifier: Apache-2.0
//
// Solid as a value: the special sets, copies, names, and what is refused.

#include <trisect/bsp/solid.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <type_traits>
#include <utility>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "engines/evaluate_stats.h"
#include "support/solids.h"

namespace {

using trisect::evaluate;
using trisect::Expression;
using trisect::Solid;

Solid unit_box() { return Solid::from_mesh(trisect::make_box({1, 1, 1})); }

TEST(SolidValue, TheDefaultIsTheEmptySet) {
    const Solid s;
    EXPECT_TRUE(s.is_empty());
    EXPECT_FALSE(s.is_whole_space());
    EXPECT_TRUE(s.to_brep().is_empty());
    EXPECT_EQ(s.to_mesh().face_count(), 0U);
}

TEST(SolidValue, WholeSpaceHasNoBoundaryAndIsNotEmpty) {
    const Solid s = Solid::whole_space();
    EXPECT_FALSE(s.is_empty());
    EXPECT_TRUE(s.is_whole_space());
    EXPECT_TRUE(s.to_brep().is_empty());
    EXPECT_TRUE(evaluate(~s).is_empty());
    EXPECT_TRUE(evaluate(~Solid()).is_whole_space());
}

TEST(SolidValue, CopiesShareTheirState) {
    const Solid a = unit_box();
    Solid b = a;  // NOLINT(performance-unnecessary-copy-initialization): that is the test
    EXPECT_EQ(trisect::detail::state_of(a), trisect::detail::state_of(b));
    EXPECT_EQ(a.source_id(), b.source_id());
    b = Solid();
    EXPECT_TRUE(b.is_empty());
    EXPECT_FALSE(a.is_empty());
}

TEST(SolidValue, AssignmentToItselfAndMovesKeepTheSet) {
    Solid a = unit_box();
    const Solid& alias = a;
    a = alias;
    EXPECT_EQ(trisect::volume(a.to_brep()), 1);
    const Solid moved = std::move(a);
    EXPECT_EQ(trisect::volume(moved.to_brep()), 1);
}

TEST(SolidValue, MovedFromIsTheEmptySet) {
    static_assert(std::is_nothrow_move_constructible_v<Solid>);
    static_assert(std::is_nothrow_move_assignable_v<Solid>);
    Solid a = unit_box();
    const Solid taken = std::move(a);
    EXPECT_TRUE(a.is_empty());  // NOLINT(bugprone-use-after-move): that is the test
    EXPECT_NE(trisect::detail::state_of(a), nullptr);
    EXPECT_EQ(a.source_id(), 0U);
    EXPECT_EQ(a.to_mesh().face_count(), 0U);
    EXPECT_TRUE(a.to_brep().is_empty());
    a.refine();
    EXPECT_EQ(trisect::volume(evaluate(taken | a).to_brep()), 1);
    a = taken;
    EXPECT_EQ(trisect::volume(a.to_brep()), 1);
}

TEST(SolidValue, OfANullStateIsTheEmptySet) {
    const Solid s = trisect::detail::solid_of(nullptr);
    EXPECT_TRUE(s.is_empty());
    EXPECT_FALSE(s.is_whole_space());
    EXPECT_TRUE(evaluate(~s).is_whole_space());
    EXPECT_EQ(trisect::volume(evaluate(unit_box() - s).to_brep()), 1);
}

TEST(SolidValue, UnboundedSetsHaveNoMesh) {
    using trisect::UnsupportedError;
    const Solid a = unit_box();
    EXPECT_THROW((void)Solid::whole_space().to_mesh(), UnsupportedError);
    EXPECT_THROW((void)evaluate(~Solid()).to_mesh(), UnsupportedError);
    const Solid rest = evaluate(~a);
    EXPECT_THROW((void)rest.to_mesh(), UnsupportedError);
    EXPECT_THROW((void)evaluate(rest | a).to_mesh(), UnsupportedError);
    EXPECT_THROW((void)evaluate(a ^ Solid::whole_space()).to_mesh(), UnsupportedError);
    // The boundary itself is bounded, and its orientation says on which side the set is.
    EXPECT_EQ(trisect::volume(rest.to_brep()), -1);
    EXPECT_EQ(evaluate(~rest).to_mesh().face_count(), 12U);
    EXPECT_EQ(evaluate(a - rest).to_mesh().face_count(), 12U);
}

TEST(SolidValue, OnTheirBoundaryDependsWhetherHalfSpacesAreBounded) {
    // The unit box and its complement, of half-spaces alone.
    trisect::Expression box = Solid::whole_space();
    for (int axis = 0; axis < 3; ++axis) {
        box = box & Solid::half_space(trisect::Plane::axis_aligned(axis, 1, 1), {});
        box = box - Solid::half_space(trisect::Plane::axis_aligned(axis, 1, 0), {});
    }
    EXPECT_EQ(evaluate(box).to_mesh().face_count(), 12U);
    EXPECT_THROW((void)evaluate(~box).to_mesh(), trisect::UnsupportedError);
    EXPECT_EQ(evaluate(box & unit_box()).to_mesh().face_count(), 12U);
}

TEST(SolidValue, EveryImportHasItsOwnName) {
    EXPECT_NE(unit_box().source_id(), unit_box().source_id());
}

TEST(SolidValue, OperandsOutliveTheirHandles) {
    Solid result;
    {
        const Solid a = unit_box();
        const Solid b = Solid::from_mesh(trisect::make_box({0.5, 0.5, 0.5}, {2, 2, 2}));
        result = evaluate(a | b);
    }
    EXPECT_EQ(trisect::volume(result.to_brep()), 1 + 3.375 - 0.125);
}

TEST(SolidValue, OperandsAreNotChangedByEvaluation) {
    const Solid a = unit_box();
    const Solid b = Solid::from_mesh(trisect::make_box({0.5, 0.5, 0.5}, {2, 2, 2}));
    const auto before = a.to_mesh();
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(evaluate(a - b).is_empty());
    EXPECT_EQ(a.to_mesh(), before);
}

// As a file that is read twice.
TEST(SolidValue, EqualMeshesAreOneOperand) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(1, 2);
    const std::size_t points = mesh.points.size();
    const Solid a = Solid::from_mesh(mesh);
    const Solid b = Solid::from_mesh(mesh);
    trisect::test::EvaluateStats stats;
    EXPECT_EQ(evaluate(a | b, {}, &stats).to_mesh().points.size(), points);
    EXPECT_EQ(stats.mixed_leaves, 0U);
    EXPECT_EQ(evaluate(a & b).to_mesh().points.size(), points);
    EXPECT_TRUE(evaluate(a - b).is_empty());
    EXPECT_TRUE(evaluate(a ^ b).is_empty());
    EXPECT_TRUE(evaluate(~a | b).is_whole_space());
    // One that may meet itself, and one with another corner.
    trisect::SolidOptions resolved;
    resolved.embedding = trisect::Embedding::Resolve;
    EXPECT_TRUE(evaluate(a - Solid::from_mesh(mesh, resolved)).is_empty());
    for (double& c : mesh.points[5]) c *= 0.875;
    EXPECT_FALSE(evaluate(a - Solid::from_mesh(mesh)).is_empty());
}

TEST(SolidValue, OpenMeshesAreRefused) {
    trisect::PolygonMesh open = trisect::make_box({1, 1, 1});
    open.face_begin.pop_back();
    open.corners.resize(open.face_begin.back());
    EXPECT_THROW((void)Solid::from_mesh(open), trisect::InvalidSolid);
}

TEST(SolidValue, HalfSpacesWithoutNormalAreRefused) {
    EXPECT_THROW((void)Solid::half_space(trisect::Plane(), {}), trisect::UsageError);
}

TEST(SolidValue, EmptyMeshesAreTheEmptySet) {
    EXPECT_TRUE(Solid::from_mesh(trisect::PolygonMesh()).is_empty());
    EXPECT_TRUE(Solid::from_lattice_mesh(trisect::LatticeMesh()).is_empty());
}

// Leaves that are put off turn out empty here.
TEST(SolidValue, WhatStepsAndAFormulaDoNotShareIsEmpty) {
    Expression formula = solids::ball(1, 3);
    Solid chain = solids::ball(1, 3);
    for (int i = 1; i < 5; ++i) {
        const Solid tool = solids::ball(1 + 0.01 * i, 3, {0.02 * i, 0.03 - 0.01 * i, 0.011 * i});
        formula = formula - Expression(tool);
        chain = evaluate(Expression(chain) - Expression(tool));
    }
    const Solid direct = evaluate(formula);
    const Solid nothing = evaluate(Expression(direct) ^ Expression(chain));
    EXPECT_TRUE(nothing.is_empty());
    EXPECT_FALSE(nothing.is_whole_space());
    EXPECT_TRUE(evaluate(~Expression(nothing)).is_whole_space());
    EXPECT_FALSE(direct.is_empty());
    EXPECT_FALSE(evaluate(~Expression(direct)).is_whole_space());
}

// A wall is two triangles in one plane, each a face of its own, between which the plate has a
// vertex.
TEST(SolidValue, FacesOfBoresInTrianglesHaveAllVertices) {
    constexpr std::uint32_t sides = 8;
    trisect::PolygonMesh bores;
    for (int i = 0; i < 64; ++i) {
        trisect::PolygonMesh bore;
        for (const double z : {-0.5, 1.5})
            for (std::uint32_t k = 0; k < sides; ++k) {
                const double angle = 2 * std::numbers::pi * k / sides;
                bore.points.push_back({i % 8 + 0.5 + 0.35 * std::cos(angle),
                                       i / 8 + 0.5 + 0.35 * std::sin(angle), z});
            }
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t l = (k + 1) % sides;
            bore.add_triangle(k, l, l + sides);
            bore.add_triangle(k, l + sides, k + sides);
            if (k < 2) continue;
            bore.add_triangle(0, k, k - 1);
            bore.add_triangle(sides, sides + k - 1, sides + k);
        }
        trisect::append(bores, bore);
    }
    const Solid plate = Solid::from_mesh(trisect::make_box({8, 8, 1}));
    const Solid bored = evaluate(Expression(plate) - Expression(Solid::from_mesh(bores)));
    const trisect::Brep brep = bored.to_brep({.maximal_faces = false});
    EXPECT_EQ(brep.counts().faces, 6U + 64 * 2 * sides);
    EXPECT_EQ(exact_volume(brep), exact_volume(bored.to_brep()));
}

// Two meshes without a tree.
TEST(SolidValue, AMeshLessItselfIsEmpty) {
    const Solid ball = solids::ball(1, 5);
    const Solid other = Solid::from_mesh(ball.to_mesh());
    EXPECT_TRUE(evaluate(Expression(ball) - Expression(other)).is_empty());
    EXPECT_FALSE(evaluate(Expression(ball) & Expression(other)).is_empty());
}

TEST(SolidValue, FacesOfAPolygonMeshStayWhole) {
    const trisect::Brep brep = unit_box().to_brep();
    EXPECT_EQ(brep.counts().faces, 6U);
    EXPECT_EQ(brep.counts().edges, 12U);
}

// The two triangles of a quadrilateral are one face.
TEST(SolidValue, FacesOfAnOperandStayWholeWhereNotJoined) {
    EXPECT_EQ(unit_box().to_brep({.maximal_faces = false}).counts().faces, 6U);
}

}  // namespace
