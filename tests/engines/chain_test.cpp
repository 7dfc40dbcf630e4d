// SPDX-License-Identifier: Apache-2.0
//
// Chains of operations whose leaves are arranged in doubles (filtered_leaf.h) although they hold
// fragments of the steps before, against the naive engine in rationals. In general position, on a
// small grid, and where a symmetric tool moves along an axis, so that edges meet edges at every
// step.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "engines.h"
#include "evaluate_stats.h"

namespace {

using reference::Operand;
using Kind = reference::Expression::Kind;

struct Counts {
    std::uint64_t plain = 0;
    std::uint64_t mixed = 0;
    std::uint64_t fragments = 0;
    std::uint64_t near = 0;    // traces from where an earlier one had ended
    std::uint64_t linked = 0;  // facets beside all of the other operand
};

// The first operand, then one step with each of the others.
reference::Expression chain_of(std::size_t operands, const std::vector<Kind>& kinds) {
    reference::Expression out = reference::Expression::leaf(0);
    for (std::size_t i = 1; i < operands; ++i)
        out = reference::Expression::node(kinds[i - 1], {out, reference::Expression::leaf(i)});
    return out;
}

// Every result of a chain is the next step's operand. Compared is the last one, as a boundary with
// maximal faces and as a mesh, with what one and three threads make of it.
void expect_agreement(const std::vector<Operand>& operands, const std::vector<Kind>& kinds,
                      std::uint32_t leaf_polygons, Counts& counts) {
    std::vector<trisect::PolygonMesh> meshes;
    const auto expected = reference::evaluate(operands, chain_of(operands.size(), kinds));
    for (const std::uint32_t threads : {1U, 3U}) {
        trisect::EvaluateOptions options;
        options.leaf_polygons = leaf_polygons;
        options.threads = threads;
        trisect::Solid result = engines::solid(operands[0], trisect::Embedding::Assume);
        for (std::size_t i = 1; i < operands.size(); ++i) {
            const trisect::Solid tool = engines::solid(operands[i], trisect::Embedding::Assume);
            trisect::test::EvaluateStats stats;
            result =
                evaluate(engines::formula(reference::pair_expression(kinds[i - 1]), {result, tool}),
                         options, &stats);
            counts.plain += stats.filtered_leaves;
            counts.mixed += stats.mixed_leaves;
            counts.fragments += stats.filtered_fragments;
            counts.near += stats.traces_near;
            counts.linked += stats.linked;
        }
        EXPECT_EQ(
            engines::difference(result.to_brep(), reference::canonical_boundary(expected.cells)),
            "");
        meshes.push_back(result.to_mesh());
        EXPECT_EQ(engines::open_edge(meshes.back()), "");
    }
    EXPECT_EQ(meshes[0].corners, meshes[1].corners);
    EXPECT_TRUE(meshes[0].points == meshes[1].points);
}

// Two to four steps with random solids.
template <class MakeOperand>
Counts random_chains(std::uint64_t first_seed, std::uint64_t count, const MakeOperand& operand) {
    constexpr std::uint32_t leaf_sizes[] = {3, 10, 100};
    Counts counts;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + first_seed);
        std::vector<Operand> operands;
        std::vector<Kind> kinds;
        const std::size_t steps = 2 + seed % 3;
        for (std::size_t i = 0; i <= steps; ++i) {
            operands.push_back(operand(random));
            kinds.push_back(random.chance(1, 4)
                                ? Kind::Union
                                : (random.chance(1, 6) ? Kind::Intersection : Kind::Difference));
        }
        expect_agreement(operands, kinds, leaf_sizes[seed % 3], counts);
    }
    return counts;
}

TEST(Chain, StepsInGeneralPosition) {
    const Counts counts = random_chains(370000, 160, [](reference::Random& random) {
        return engines::mapped(reference::random_embedded_solid(random), random);
    });
    EXPECT_GT(counts.plain * 10, counts.mixed * 7);
    EXPECT_GT(counts.fragments, 1000U);
    EXPECT_GT(counts.near, 500U);
    EXPECT_GT(counts.linked, 1000U);
}

// Corners lie on facets, on edges and on corners of others.
TEST(Chain, StepsOnASmallGrid) {
    const Counts counts = random_chains(375000, 160, [](reference::Random& random) {
        return reference::random_embedded_solid(random);
    });
    EXPECT_GT(counts.plain * 10, counts.mixed * 6);
    EXPECT_GT(counts.fragments, 3000U);
}

// Everywhere between two places of the tool the edges of one cross the edges of the other; with
// rows side by side up to four facets meet in a point there.
TEST(Chain, SymmetricToolAlongTheAxes) {
    Counts counts;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 380000);
        const std::int64_t a = random.between(40, 60);
        const std::int64_t b = random.between(40, 60);
        const std::int64_t c = random.between(30, 70);
        const auto tool_at = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
            Operand tool;
            for (const int sx : {-1, 1})
                for (const int sy : {-1, 1})
                    for (const int sz : {-1, 1}) {
                        std::array<reference::LatticePoint, 3> t{
                            {{x + sx * a, y, z}, {x, y + sy * b, z}, {x, y, z + sz * c}}};
                        if (sx * sy * sz < 0) std::swap(t[1], t[2]);
                        tool.push_back({t[0], t[1], t[2]});
                    }
            return tool;
        };
        std::vector<Operand> operands{reference::box({-71, -113, -97}, {227, 211, 1})};
        std::vector<Kind> kinds;
        const std::int64_t step_x = random.between(17, 43);
        const std::int64_t step_y = random.between(23, 59);
        for (std::int64_t row = 0; row < 2; ++row)
            for (std::int64_t column = 0; column < 3; ++column)
                operands.push_back(tool_at((row == 0 ? column : 2 - column) * step_x, row * step_y,
                                           random.chance(1, 8) ? 3 : 2));
        kinds.assign(operands.size(), Kind::Difference);
        expect_agreement(operands, kinds, seed % 2 == 0 ? 100 : 15, counts);
    }
    EXPECT_GT(counts.plain * 10, counts.mixed * 9);
    EXPECT_GT(counts.fragments, 500U);
}

}  // namespace
