// SPDX-License-Identifier: Apache-2.0
//
// Prisms along a common axis, many of whose covers lie in the same planes while their walls cross
// each other (prism_leaf.h), against the naive engine in rationals.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engines.h"

namespace {

using reference::Operand;
using Kind = reference::Expression::Kind;

struct Leaves {
    std::uint64_t prisms = 0;
    std::uint64_t mixed = 0;
};

std::int64_t turn(const std::array<std::int64_t, 2>& a, const std::array<std::int64_t, 2>& b) {
    return a[0] * b[1] - a[1] * b[0];
}

// A polygon around a point within it, which every corner sees.
reference::LatticePolygon star(reference::Random& random, std::size_t corners) {
    while (true) {
        reference::LatticePolygon p;
        for (std::size_t i = 0; i < corners; ++i)
            p.push_back({random.between(-30, 30), random.between(-30, 30)});
        const auto upper = [](const auto& a) { return a[1] > 0 || (a[1] == 0 && a[0] > 0); };
        std::sort(p.begin(), p.end(), [&](const auto& a, const auto& b) {
            return upper(a) != upper(b) ? upper(a) : turn(a, b) > 0;
        });
        bool good = true;
        for (std::size_t i = 0; i < corners; ++i)
            good = good && turn(p[i], p[(i + 1) % corners]) > 0;
        if (!good) continue;
        const std::array<std::int64_t, 2> by{random.between(-20, 20), random.between(-20, 20)};
        for (auto& c : p)
            for (std::size_t k = 0; k < 2; ++k) c[k] += by[k];
        return p;
    }
}

// Heights are few, so covers coincide.
Operand random_prism(reference::Random& random) {
    const std::array<std::int64_t, 4> heights{0, 3, 4, 9};
    const std::size_t low = random.below(3);
    const std::size_t high = low + 1 + random.below(3 - low);
    return reference::prism(star(random, 3 + random.below(4)), heights[low], heights[high]);
}

void expect_agreement(const std::vector<Operand>& operands, const reference::Expression& expression,
                      const trisect::EvaluateOptions& options, Leaves& leaves) {
    std::vector<trisect::Solid> solids;
    for (const auto& o : operands) solids.push_back(engines::solid(o, trisect::Embedding::Assume));
    trisect::EvaluateStats stats;
    const trisect::Solid result =
        trisect::evaluate(engines::formula(expression, solids), options, &stats);
    leaves.prisms += stats.prism_leaves;
    leaves.mixed += stats.mixed_leaves;
    EXPECT_EQ(engines::open_edge(result.to_mesh()), "");
    const auto expected = reference::evaluate(operands, expression);
    EXPECT_EQ(engines::difference(result.to_brep(), reference::canonical_boundary(expected.cells)),
              "");
}

TEST(Prisms, PairsAlongEveryAxis) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        reference::Random random(seed + 410000);
        std::vector<Operand> operands{random_prism(random), random_prism(random)};
        for (auto& o : operands) o = reference::axes_rotated(o, seed % 3);
        for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor}) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            expect_agreement(operands, reference::pair_expression(kind), {}, leaves);
        }
    }
    EXPECT_GT(leaves.prisms * 10, leaves.mixed * 5);
}

TEST(Prisms, FormulasOverSeveral) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 420000);
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < 3 + seed % 3; ++i) operands.push_back(random_prism(random));
        const auto expression =
            reference::random_expression(random, operands.size(), operands.size() + seed % 4);
        trisect::EvaluateOptions options;
        if (seed % 4 == 0) options.leaf_polygons = 6;
        expect_agreement(operands, expression, options, leaves);
    }
    EXPECT_GT(leaves.prisms, 50U);
}

// One operand with two prisms above each other, and one with two side by side.
TEST(Prisms, OperandsOfSeveralPrisms) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 430000);
        const Operand stacked = reference::concatenated(reference::prism(star(random, 4), 0, 3),
                                                        reference::prism(star(random, 3), 4, 9));
        const Operand beside = reference::concatenated(
            reference::prism(star(random, 4), 0, 4),
            reference::translated(reference::prism(star(random, 5), 3, 9), {101, 0, 0}));
        const Operand bar = reference::prism({{-60, -3}, {161, 5}, {160, 11}, {-61, 7}}, 0, 9);
        const auto expression =
            reference::random_expression(random, 3, 2 + static_cast<std::size_t>(seed % 3));
        expect_agreement({stacked, beside, bar}, expression, {}, leaves);
    }
    EXPECT_GT(leaves.prisms * 10, leaves.mixed * 5);
}

// Walls that three prisms have in one point, or that end on each other: these go the long way.
TEST(Prisms, WallsThroughOnePointAndWallsThatTouch) {
    Leaves leaves;
    const Operand a = reference::prism({{-10, -1}, {10, -1}, {10, 1}, {-10, 1}}, 0, 4);
    const Operand b = reference::prism({{-9, -11}, {11, 9}, {9, 11}, {-11, -9}}, 0, 4);
    const Operand c = reference::prism({{-11, 9}, {9, -11}, {11, -9}, {-9, 11}}, 0, 4);
    const Operand touching = reference::prism({{-3, 1}, {2, 1}, {0, 14}}, 0, 4);
    const Operand corner = reference::prism({{0, 1}, {7, 20}, {-7, 20}}, 0, 4);
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 440000);
        expect_agreement({a, b, c}, reference::random_expression(random, 3, 3), {}, leaves);
        expect_agreement({a, touching, b}, reference::random_expression(random, 3, 3), {}, leaves);
        expect_agreement({a, corner, c}, reference::random_expression(random, 3, 3), {}, leaves);
    }
    EXPECT_GT(leaves.prisms, 10U);
}

}  // namespace
