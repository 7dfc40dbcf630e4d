// SPDX-License-Identifier: Apache-2.0
//
// Formulas over many operands that fill the same cells, where halves of the formula are evaluated
// one after the other (Worker::halve), against the naive engine in rationals.

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <trisect/kernel/stop_scope.h>

#include "engines.h"
#include "evaluate_stats.h"

namespace {

using reference::Expression;
using reference::Operand;
using Kind = Expression::Kind;
using trisect::test::EvaluateStats;

std::vector<trisect::Solid> solids_of(const std::vector<Operand>& operands,
                                      trisect::Embedding embedding) {
    std::vector<trisect::Solid> solids;
    solids.reserve(operands.size());
    for (const Operand& o : operands) solids.push_back(engines::solid(o, embedding));
    return solids;
}

// Leaves of a few polygons: then operands of a dozen are many.
std::uint64_t expect_agreement(const std::vector<Operand>& operands, const Expression& expression,
                               trisect::Embedding embedding = trisect::Embedding::Assume) {
    SCOPED_TRACE(to_string(expression));
    const auto expected =
        reference::canonical_boundary(reference::evaluate(operands, expression).cells);
    const auto solids = solids_of(operands, embedding);
    std::uint64_t halved = 0;
    for (const std::uint32_t leaf : {8U, 30U}) {
        SCOPED_TRACE("leaf size " + std::to_string(leaf));
        trisect::EvaluateOptions options;
        options.leaf_polygons = leaf;
        EvaluateStats stats;
        const auto result =
            trisect::test::evaluate(engines::formula(expression, solids), options, &stats);
        halved += stats.halved_cells;
        EXPECT_EQ(engines::difference(result.to_brep(), expected), "");
        EXPECT_EQ(engines::open_edge(engines::boundary_mesh(result)), "");
        std::set<std::uint32_t> names;
        for (const auto& s : solids) names.insert(s.source_id());
        const trisect::Brep brep = result.to_brep();
        for (const trisect::FaceId f : brep.faces())
            EXPECT_TRUE(names.contains(brep.source(f).operand));
    }
    return halved;
}

Expression all_of(Kind kind, std::size_t first, std::size_t end) {
    std::vector<Expression> terms;
    for (std::size_t i = first; i < end; ++i) terms.push_back(Expression::leaf(i));
    return Expression::node(kind, std::move(terms));
}

// Pair by pair where they go so, and by cells: a limit of work is counted by these.
TEST(CrowdedFormulas, OneOperationOnTheSmallGrid) {
    std::uint64_t halved = 0;
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 510000);
        const std::size_t n = 6 + seed % 4;
        const auto operands = reference::random_family(random, n, true);
        std::vector<Expression> all;
        for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Xor})
            all.push_back(all_of(kind, 0, n));
        all.push_back(
            Expression::node(Kind::Difference, {Expression::leaf(0), all_of(Kind::Union, 1, n)}));
        for (const Expression& e : all) {
            expect_agreement(operands, e);
            const trisect::StopScope by_cells({.max_work = std::uint64_t{1} << 60});
            halved += expect_agreement(operands, e);
        }
    }
    EXPECT_GT(halved, 50U);
}

TEST(CrowdedFormulas, NestedOnTheSmallGrid) {
    std::uint64_t halved = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 520000);
        const std::size_t n = 6 + seed % 4;
        const auto operands = reference::random_family(random, n, true);
        halved += expect_agreement(operands,
                                   reference::random_expression(random, n, n - 1 + seed % 6, true));
    }
    EXPECT_GT(halved, 10U);
}

TEST(CrowdedFormulas, OperandsThatMeetThemselves) {
    std::uint64_t halved = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 530000);
        const std::size_t n = 6 + seed % 3;
        const auto operands = reference::random_family(random, n);
        halved += expect_agreement(operands, reference::random_expression(random, n, n - 1, true),
                                   trisect::Embedding::Resolve);
    }
    EXPECT_GT(halved, 10U);
}

TEST(CrowdedFormulas, OutOfTheGridOfOneAnother) {
    std::uint64_t halved = 0;
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 540000);
        const std::size_t n = 6 + seed % 4;
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < n; ++i)
            operands.push_back(engines::mapped(reference::random_embedded_solid(random), random));
        const std::vector<Kind> kinds{Kind::Union, Kind::Intersection, Kind::Xor};
        halved += expect_agreement(operands, all_of(kinds[seed % 3], 0, n));
        halved += expect_agreement(operands, reference::random_expression(random, n, n + 1, true));
    }
    EXPECT_GT(halved, 10U);
}

// All facets coincide: the first operand that is in the formula of a cell names them.
TEST(CrowdedFormulas, EqualOperands) {
    const std::vector<Operand> operands(
        9, reference::tetrahedron({0, 0, 0}, {9, 1, 0}, {2, 8, 1}, {3, 2, 7}));
    for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Xor})
        (void)expect_agreement(operands, all_of(kind, 0, operands.size()));
    const auto solids = solids_of(operands, trisect::Embedding::Assume);
    trisect::EvaluateOptions options;
    options.leaf_polygons = 8;
    const auto both = trisect::evaluate(
        engines::formula(all_of(Kind::Intersection, 0, operands.size()), solids), options);
    const trisect::Brep brep = both.to_brep();
    for (const trisect::FaceId f : brep.faces())
        EXPECT_EQ(brep.source(f).operand, solids[0].source_id());
}

}  // namespace
