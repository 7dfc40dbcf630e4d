// SPDX-License-Identifier: Apache-2.0
//
// The cell-tree engine against the naive engine in rationals: equal boundaries, for random solids
// on a small grid, where faces, edges and vertices coincide all the time.

#include <gtest/gtest.h>

#include "engines.h"

namespace {

using Kind = reference::Expression::Kind;

constexpr std::array kinds{Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor};

std::string disagreement(const std::vector<reference::Operand>& operands,
                         const reference::Expression& expression,
                         const trisect::EvaluateOptions& options = {}) {
    std::vector<trisect::Solid> solids;
    for (const auto& o : operands) solids.push_back(engines::solid(o));
    const trisect::Solid result = trisect::evaluate(engines::formula(expression, solids), options);
    const auto expected = reference::evaluate(operands, expression);
    return engines::difference(result.to_brep(), reference::canonical_boundary(expected.cells));
}

TEST(EngineAgreement, RandomPairsOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        reference::Random random(seed);
        const auto operands = reference::random_family(random, 2);
        for (const Kind kind : kinds) {
            const auto expression = reference::pair_expression(kind);
            EXPECT_EQ(disagreement(operands, expression), "")
                << "seed " << seed << " " << reference::to_string(expression);
        }
    }
}

TEST(EngineAgreement, TheResultDoesNotDependOnTheTreesShape) {
    for (std::uint64_t seed = 1000; seed < 1040; ++seed) {
        reference::Random random(seed);
        const auto operands = reference::random_family(random, 2);
        for (const std::uint32_t leaf : {3U, 8U, 1000U}) {
            trisect::EvaluateOptions options;
            options.leaf_polygons = leaf;
            options.wall_offset = leaf == 8 ? 127 : 83;
            const auto expression = reference::pair_expression(Kind::Difference);
            EXPECT_EQ(disagreement(operands, expression, options), "")
                << "seed " << seed << " leaf size " << leaf;
        }
    }
}

TEST(EngineAgreement, RandomFormulas) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed + 77000);
        const auto operands = reference::random_family(random, 2 + random.below(4));
        const auto expression =
            reference::random_expression(random, operands.size(), 5 + random.below(6));
        EXPECT_EQ(disagreement(operands, expression), "")
            << "seed " << seed << " " << reference::to_string(expression);
    }
}

// A chain evaluates every step on the tree of the step before.
TEST(EngineAgreement, ChainsStepByStep) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        reference::Random random(seed + 99000);
        const auto operands = reference::random_family(random, 4);
        std::vector<trisect::Solid> solids;
        for (const auto& o : operands) solids.push_back(engines::solid(o));
        trisect::EvaluateOptions options;
        options.leaf_polygons = 6;
        trisect::Solid chain = solids[0];
        auto expression = reference::Expression::leaf(0);
        for (std::size_t i = 1; i < operands.size(); ++i) {
            const Kind kind = kinds[random.below(4)];
            const auto pair = reference::pair_expression(kind);
            chain = trisect::evaluate(engines::formula(pair, {chain, solids[i]}), options);
            expression =
                reference::Expression::node(kind, {expression, reference::Expression::leaf(i)});
            const auto expected = reference::evaluate(operands, expression);
            EXPECT_EQ(
                engines::difference(chain.to_brep(), reference::canonical_boundary(expected.cells)),
                "")
                << "seed " << seed << " " << reference::to_string(expression);
        }
    }
}

}  // namespace
