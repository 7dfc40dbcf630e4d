// SPDX-License-Identifier: Apache-2.0
//
// Exclusive ors of many meshes without a tree (exclusive_or_without_tree.h), against the naive
// engine in rationals and against exclusive ors of two, one after the other.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/diagnostics.h>

#include "engines.h"

namespace exclusive_or_test {
namespace {

using reference::Expression;
using reference::Operand;
using Kind = Expression::Kind;

// Some operands are complements.
Expression random_exclusive_or(reference::Random& random, std::size_t n) {
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < n; ++i) {
        const Expression leaf = Expression::leaf(i);
        terms.push_back(random.chance(1, 4) ? Expression::node(Kind::Complement, {leaf}) : leaf);
    }
    return Expression::node(Kind::Xor, terms);
}

// Whether it was done without a tree; by one, two and four threads then.
bool expect_agreement(const std::vector<Operand>& operands, const Expression& all) {
    std::vector<trisect::Solid> solids;
    solids.reserve(operands.size());
    for (const auto& o : operands) solids.push_back(engines::solid(o, trisect::Embedding::Assume));
    const auto expected = reference::canonical_boundary(reference::evaluate(operands, all).cells);
    std::uint64_t doubtful = 0;
    const auto difference =
        engines::pairwise_difference(engines::formula(all, solids), {}, expected, doubtful);
    EXPECT_EQ(difference.value_or(""), "");
    return difference.has_value();
}

TEST(ExclusiveOrOfMany, InGeneralPosition) {
    int without_tree = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 710000);
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < 3 + seed % 4; ++i)
            operands.push_back(engines::mapped(reference::random_embedded_solid(random), random));
        without_tree +=
            expect_agreement(operands, random_exclusive_or(random, operands.size())) ? 1 : 0;
    }
    EXPECT_EQ(without_tree, 100);
}

// Nearly everything touches there.
TEST(ExclusiveOrOfMany, OnASmallGrid) {
    int without_tree = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 720000);
        const auto operands = reference::random_family(random, 3 + seed % 4, true);
        without_tree +=
            expect_agreement(operands, random_exclusive_or(random, operands.size())) ? 1 : 0;
    }
    EXPECT_GT(without_tree, 90);
}

// Within each other and apart: nothing crosses, and each boundary is turned by how many are around.
TEST(ExclusiveOrOfMany, OfShells) {
    std::vector<Operand> operands;
    for (std::int64_t i = 0; i < 4; ++i)
        operands.push_back(reference::box({i, i, i}, {20 - i, 21 - i, 22 - i}));
    operands.push_back(reference::box({30, 3, 3}, {33, 6, 6}));
    for (const bool negated : {false, true}) {
        std::vector<Expression> terms;
        for (std::size_t i = 0; i < operands.size(); ++i) terms.push_back(Expression::leaf(i));
        Expression all = Expression::node(Kind::Xor, terms);
        if (negated) all = Expression::node(Kind::Complement, {all});
        EXPECT_TRUE(expect_agreement(operands, all));
    }
}

TEST(ExclusiveOrOfMany, TakesWhatTwoOfThemTake) {
    constexpr int n = 5;
    std::vector<trisect::Solid> solids;
    for (int i = 0; i < n; ++i) {
        trisect::PolygonMesh mesh = trisect::make_icosphere(100000, 2);
        for (auto& p : mesh.points) {
            p[0] = std::round(p[0] + 31100 * std::cos(1.1 * i));
            p[1] = std::round(p[1] + 31700 * std::sin(1.1 * i));
            p[2] = std::round(p[2] + 1300 * i);
        }
        solids.push_back(trisect::Solid::from_mesh(mesh));
    }
    trisect::Expression all = solids[0];
    trisect::Solid by_twos = solids[0];
    for (int i = 1; i < n; ++i) {
        all = all ^ solids[static_cast<std::size_t>(i)];
        by_twos = trisect::evaluate(by_twos ^ solids[static_cast<std::size_t>(i)]);
    }
    const trisect::Solid at_once = trisect::evaluate(all);
    const auto tree = trisect::detail::state_of(at_once)->lazy_tree();
    ASSERT_NE(tree, nullptr);
    EXPECT_FALSE(tree->is_cut());
    EXPECT_NEAR(trisect::volume(at_once) / trisect::volume(by_twos), 1, 1e-12);
    EXPECT_TRUE(trisect::evaluate(at_once ^ by_twos).is_empty());
}

trisect::Solid ball_at(double x, double y, double z) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(1000, 2);
    for (auto& p : mesh.points) p = {std::round(p[0]) + x, p[1] + y, p[2] + z};
    return trisect::Solid::from_mesh(mesh);
}

// Faces of three meshes through one line may cross there, without an edge in it.
TEST(ExclusiveOrOfMany, LeavesWhatTouchesToCells) {
    const trisect::Solid a = ball_at(0, 0, 0);
    const trisect::Solid b = ball_at(2000, 0, 0);
    const trisect::Solid c = ball_at(4000, 0, 0);
    const trisect::Solid d = ball_at(1234.5, 678.25, 432.125);
    const trisect::Solid all = trisect::evaluate(a ^ b ^ c ^ d);
    EXPECT_EQ(trisect::detail::state_of(all)->lazy_tree(), nullptr);
    const trisect::Solid row = trisect::evaluate(trisect::evaluate(a ^ b) ^ c);
    EXPECT_NEAR(trisect::volume(all) / trisect::volume(trisect::evaluate(row ^ d)), 1, 1e-12);
}

// Their boxes have no insides in common.
TEST(ExclusiveOrOfMany, TakesWhatTouchesSideBySideForAUnion) {
    const trisect::Solid b = ball_at(2000, 0, 0);
    const trisect::Solid all = trisect::evaluate(ball_at(0, 0, 0) ^ b ^ ball_at(4000, 0, 0));
    EXPECT_NE(trisect::detail::state_of(all)->lazy_tree(), nullptr);
    EXPECT_FALSE(trisect::detail::state_of(all)->lazy_tree()->is_cut());
    EXPECT_NEAR(trisect::volume(all) / trisect::volume(b), 3, 1e-12);
}

}  // namespace
}  // namespace exclusive_or_test
