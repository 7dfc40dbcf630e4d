// SPDX-License-Identifier: Apache-2.0
//
// Formulas of a few large solids and many small ones, which are put together in the order of space
// (settled_parts.h, beside_boundary.h), against a tree of cells.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/many_meshes/balanced_tree.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/stop_scope.h>

namespace {

using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;

Solid sphere(double radius, std::uint32_t subdivisions, const trisect::Point3d& centre) {
    PolygonMesh mesh = trisect::make_icosphere(radius, subdivisions);
    for (trisect::Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += centre[k];
    return Solid::from_mesh(mesh);
}

struct Scene {
    Expression large;  // a union of two
    Expression one;    // of these
    Expression small;  // a union of many
};

// Small ones are in the box from -1.3 to 1.3, some beside both large ones, some within.
Scene scene(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-1.3, 1.3);
    const Expression one = sphere(0.9, 4, {0.31, 0.02, 0.11});
    const Expression other = sphere(0.8, 4, {-0.35, 0.13, -0.17});
    std::vector<Expression> small;
    for (int i = 0; i < count; ++i)
        small.emplace_back(
            sphere(0.17 + 0.001 * (i % 13), 1, {at(random), at(random), at(random)}));
    return {one | other, one, Expression::any_of(small)};
}

PolygonMesh by_cells(const Expression& expression) {
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});  // counted by cells
    return trisect::evaluate(expression).to_mesh();
}

void expect_same_as_cells(const Expression& expression) {
    const PolygonMesh expected = by_cells(expression);
    for (const std::uint32_t threads : {1U, 2U, 4U}) {
        trisect::EvaluateOptions options;
        options.threads = threads;
        const PolygonMesh mesh = trisect::evaluate(expression, options).to_mesh(threads);
        ASSERT_EQ(mesh.corners, expected.corners) << threads << " threads";
        ASSERT_TRUE(mesh.points == expected.points) << threads << " threads";
    }
}

TEST(Neighbours, IntersectedWithLargerOnes) {
    const Scene s = scene(20301, 150);
    expect_same_as_cells(s.large & s.small);
}

// The calling thread is at the root of the tree, and of what lies first in it.
TEST(Neighbours, HalvesStayWhereTheyAreMade) {
    using trisect::detail::HalfCounters;
    const Scene s = scene(30101, 400);
    const auto halves = [&](std::uint32_t threads) {
        trisect::EvaluateOptions options;
        options.threads = threads;
        const trisect::Diagnostics<HalfCounters> diagnostics;
        static_cast<void>(trisect::evaluate(s.large & s.small, options));
        return diagnostics.counters();
    };
    const HalfCounters of_one = halves(1);
    EXPECT_EQ(of_one.in_place + of_one.moved, 0U);
    const HalfCounters of_two = halves(2);
    EXPECT_GT(of_two.in_place + of_two.moved, 0U);
}

TEST(Neighbours, SubtractedFromLargerOnes) {
    const Scene s = scene(20302, 150);
    expect_same_as_cells(s.large - s.small);
}

TEST(Neighbours, LessLargerOnes) {
    const Scene s = scene(20303, 150);
    expect_same_as_cells(s.small - s.large);
}

TEST(Neighbours, UnitedWithWhatIsNested) {
    const Scene s = scene(20304, 100);
    const Expression far = sphere(0.8, 4, {-0.35, 0.13, -0.17});
    expect_same_as_cells((s.one - far) | s.small);
}

TEST(Neighbours, WithinAnotherOperation) {
    const Scene s = scene(20305, 100);
    const Expression more = sphere(0.4, 3, {0.1, 0.6, -0.6});
    expect_same_as_cells((s.large & s.small) | more);
}

TEST(Neighbours, WhatIsBesideAllIsNothing) {
    const Scene s = scene(20306, 0);
    std::vector<Expression> small;
    for (int i = 0; i < 80; ++i)
        small.emplace_back(sphere(0.1, 1, {1.25 + 0.02 * (i % 2), 1.21, -1.2 + 0.03 * i}));
    const Solid none = trisect::evaluate(s.large & Expression::any_of(small));
    EXPECT_EQ(none.to_mesh().face_count(), 0U);
}

// Fewer than are looked at beforehand: nothing is left of them where their box is.
TEST(Neighbours, ApartFromLargerOnes) {
    const Scene s = scene(20307, 0);
    std::vector<Expression> small;
    for (int i = 0; i < 40; ++i)
        small.emplace_back(sphere(0.1, 1, {5.25 + 0.02 * (i % 2), 1.21, -1.2 + 0.03 * i}));
    const Expression others = Expression::any_of(small);
    EXPECT_EQ(trisect::evaluate(s.large & others).to_mesh().face_count(), 0U);
    expect_same_as_cells(s.large - others);
}

// Nothing crosses it, so the small ones whose boxes have it say on which side it is: of those
// facets that have settled some are gone.
TEST(Neighbours, LargeOneWithinASmallOne) {
    const Scene s = scene(20308, 150);
    const Expression inner = sphere(0.3, 2, {0.05, 0.12, 0.07});
    const Expression tiny = sphere(0.05, 4, {0.06, 0.11, 0.07});
    const Expression apart = sphere(0.05, 4, {1.7, 0.11, 0.07});
    const Expression all = s.small | inner;
    expect_same_as_cells((tiny | apart) & all);
    expect_same_as_cells((tiny | apart) - all);
    expect_same_as_cells((tiny - s.one) | all);
    expect_same_as_cells(((s.one - tiny) | apart) & all);
}

}  // namespace
