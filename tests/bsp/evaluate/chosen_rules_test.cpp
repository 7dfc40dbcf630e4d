// SPDX-License-Identifier: Apache-2.0
//
// Rules that are chosen for prisms and for operands that are apart, and that cells give the same.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/evaluate_all.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/stop_scope.h>

#include "engines/evaluate_stats.h"

namespace {

using trisect::evaluate;
using trisect::evaluate_all;
using trisect::exact_volume;
using trisect::Expression;
using trisect::LatticeMesh;
using trisect::Solid;
using trisect::test::EvaluateStats;

// A limit of work is counted by cells.
Solid evaluated_by_cells(const Expression& expression) {
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});
    return evaluate(expression);
}

void expect_as_by_cells(const Solid& result, const Expression& expression) {
    const Solid expected = evaluated_by_cells(expression);
    EXPECT_EQ(exact_volume(result.to_brep()), exact_volume(expected.to_brep()));
    EXPECT_TRUE(evaluate(result ^ expected).is_empty());
}

// Of 2 * sides + 2 * (sides - 2) facets.
Solid round_prism(std::int64_t sides, double radius, const std::array<std::int64_t, 3>& foot,
                  std::int64_t height) {
    LatticeMesh mesh;
    for (const std::int64_t z : {foot[2], foot[2] + height})
        for (std::int64_t i = 0; i < sides; ++i) {
            const double angle =
                2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
            mesh.points.push_back({foot[0] + std::llround(radius * std::cos(angle)),
                                   foot[1] + std::llround(radius * std::sin(angle)), z});
        }
    const auto n = static_cast<std::uint32_t>(sides);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        if (i + 2 < n) {
            mesh.triangles.push_back({0, i + 2, i + 1});
            mesh.triangles.push_back({n, n + i + 1, n + i + 2});
        }
        mesh.triangles.push_back({i, j, n + j});
        mesh.triangles.push_back({i, n + j, n + i});
    }
    return Solid::from_lattice_mesh(mesh);
}

std::vector<Expression> prisms_on_floor(std::int64_t n, std::int64_t sides) {
    std::vector<Expression> out;
    for (std::int64_t i = 0; i < n; ++i)
        out.emplace_back(
            round_prism(sides, static_cast<double>(30000 - 300 * i), {0, 0, 0}, 100 + 20 * i));
    return out;
}

Solid small_cube(double x, double y, double z) {
    return Solid::from_mesh(trisect::make_box({x, y, z}, {x + 1, y + 1, z + 1}));
}

// Pair by pair a plate less few drills took twice as long as one of outlines.
TEST(ChosenRules, FewPrismsAreOutlined) {
    std::vector<Expression> drills;
    for (std::int64_t i = 0; i < 3; ++i)
        drills.emplace_back(round_prism(100, 1000, {4000 * i + 3, 17 * i, 0}, 500));
    const Expression plate = round_prism(4, 20000, {0, 0, -500}, 1000);
    const Expression drilled = plate - Expression::any_of(drills);
    EvaluateStats stats;
    const Solid result = evaluate(drilled, {}, &stats);
    EXPECT_EQ(stats.prism_leaves, 1U);
    EXPECT_EQ(stats.filtered_leaves, 0U);
    expect_as_by_cells(result, drilled);
}

// As a leaf, of pieces, 64 such prisms took forty times as long.
TEST(ChosenRules, PrismsOfFewFacetsAreOutlined) {
    const Expression united = Expression::any_of(prisms_on_floor(24, 16));
    EvaluateStats stats;
    const Solid result = evaluate(united, {}, &stats);
    EXPECT_EQ(stats.prism_leaves, 1U);
    EXPECT_EQ(stats.pieces, 0U);
    expect_as_by_cells(result, united);
}

// Each wall is in half of the layers, more than sixteen.
TEST(ChosenRules, PrismsOfManyHeightsAreOutlined) {
    const Expression united = Expression::any_of(prisms_on_floor(60, 24));
    EvaluateStats stats;
    const Solid result = evaluate(united, {}, &stats);
    EXPECT_EQ(stats.prism_leaves, 1U);
    EXPECT_EQ(stats.filtered_leaves, 0U);
    expect_as_by_cells(result, united);
}

// Two meshes that are prisms with caps in one plane: pair by pair that took two to four times as
// long. Also where several formulas are evaluated together.
TEST(ChosenRules, TwoFlushPrismsAreOutlined) {
    const Expression a = round_prism(100, 1000, {0, 0, 0}, 500);
    const Expression b = round_prism(100, 1000, {303, 171, 0}, 400);
    const std::vector<Expression> formulas{a | b, a & b, a - b, a ^ b};
    const std::vector<Solid> together = evaluate_all(formulas);
    for (std::size_t i = 0; i < formulas.size(); ++i) {
        EvaluateStats stats;
        const Solid result = evaluate(formulas[i], {}, &stats);
        EXPECT_EQ(stats.prism_leaves, 1U);
        EXPECT_EQ(stats.filtered_leaves, 0U);
        expect_as_by_cells(result, formulas[i]);
        EXPECT_EQ(together[i].to_mesh().corners, result.to_mesh().corners);
    }
}

// Prisms without a common plane, and such whose walls touch, are compared as two meshes.
TEST(ChosenRules, OtherTwoPrismsAreCompared) {
    const Expression a = round_prism(100, 1000, {0, 0, 0}, 500);
    for (const Expression& b : {Expression(round_prism(100, 1000, {303, 171, 7}, 700)),
                                Expression(round_prism(100, 1000, {0, 0, 0}, 400))}) {
        const std::vector<Expression> formulas{a | b, a & b, a - b};
        const std::vector<Solid> together = evaluate_all(formulas);
        for (std::size_t i = 0; i < formulas.size(); ++i) {
            EvaluateStats stats;
            const Solid result = evaluate(formulas[i], {}, &stats);
            EXPECT_EQ(stats.prism_leaves, 0U);
            EXPECT_GT(stats.filtered_leaves, 0U);
            expect_as_by_cells(result, formulas[i]);
            EXPECT_EQ(together[i].to_mesh().corners, result.to_mesh().corners);
        }
    }
}

// No grid, and nothing is compared: all facets are kept.
TEST(ChosenRules, CubesApartAreKeptAsTheyAre) {
    for (const int n : {2, 3, 27}) {
        std::vector<Expression> cubes;
        for (int i = 0; i < n; ++i)
            cubes.emplace_back(small_cube(3 * (i % 3), 3 * (i / 3 % 3), 3 * (i / 9)));
        EvaluateStats stats;
        const Solid all = evaluate(Expression::any_of(cubes), {}, &stats);
        EXPECT_EQ(stats.grid_leaves, 0U);
        EXPECT_EQ(stats.pairs_boxes, 0U);
        EXPECT_EQ(stats.untouched_polygons, static_cast<std::uint64_t>(12 * n));
        EXPECT_EQ(all.to_mesh().face_count(), static_cast<std::size_t>(12 * n));
        expect_as_by_cells(all, Expression::any_of(cubes));
    }
}

// Of solids that touch, with caps and edges in common: of two such and more cells were arranged
// exactly. Where one is a complement, cells still are.
TEST(ChosenRules, ExclusiveOrsOfSolidsBesideEachOtherAreUnions) {
    std::vector<Expression> prisms;
    for (std::int64_t i = 0; i < 8; ++i)
        prisms.emplace_back(
            round_prism(40, 1000, {2000 * (i % 2), 2000 * (i / 2 % 2), 500 * (i / 4)}, 500));
    Expression formula = prisms[0];
    for (std::size_t i = 1; i < prisms.size(); ++i) formula = formula ^ prisms[i];
    EvaluateStats stats;
    const Solid result = evaluate(formula, {}, &stats);
    EXPECT_GT(stats.filtered_leaves, 0U);
    EXPECT_EQ(stats.exact_leaves, 0U);
    EXPECT_EQ(exact_volume(result.to_brep()),
              exact_volume(evaluate(Expression::any_of(prisms)).to_brep()));
    expect_as_by_cells(result, formula);
    expect_as_by_cells(evaluate(formula ^ ~prisms[3] ^ prisms[3]),
                       formula ^ ~prisms[3] ^ prisms[3]);
    const Expression turned = ~prisms[0] ^ prisms[1] ^ prisms[2] ^ prisms[5];
    const Solid outside = evaluate(turned);
    EXPECT_TRUE(evaluate(outside ^ evaluated_by_cells(turned)).is_empty());
}

// Nor are those of prisms.
TEST(ChosenRules, PrismsApartAreKeptAsTheyAre) {
    std::vector<Expression> prisms;
    for (std::int64_t i = 0; i < 12; ++i)
        prisms.emplace_back(
            round_prism(100, 1000, {3000 * (i % 3), 3000 * (i / 3 % 2), 3000 * (i / 6)}, 1000));
    EvaluateStats stats;
    const Solid all = evaluate(Expression::any_of(prisms), {}, &stats);
    EXPECT_EQ(stats.prism_leaves, 0U);
    EXPECT_EQ(stats.pairs_boxes, 0U);
    EXPECT_EQ(stats.untouched_polygons, 12U * 396U);
    expect_as_by_cells(all, Expression::any_of(prisms));
}

}  // namespace
