// SPDX-License-Identifier: Apache-2.0
//
// Unions, intersections and differences of several solids, whose cut facets are traced by their
// crossings (facet_outline.h), against the naive engine in rationals and against what the pieces
// of the cells are put together to.

#include <gtest/gtest.h>

#include <variant>

#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/formula_operands.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include "engines.h"

namespace {

using reference::Expression;
using reference::Operand;
using Kind = Expression::Kind;

struct Count {
    std::uint64_t traced = 0;
    std::uint64_t worked = 0;
    std::uint64_t bounded = 0;  // results that have meshes to compare
};

trisect::Solid evaluate(const std::vector<Operand>& operands, const Expression& expression,
                        std::uint32_t leaf_polygons) {
    std::vector<trisect::Solid> solids;
    solids.reserve(operands.size());
    for (const auto& o : operands) solids.push_back(engines::solid(o, trisect::Embedding::Assume));
    trisect::EvaluateOptions options;
    options.leaf_polygons = leaf_polygons;
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});  // counted by cells
    // Also operands that are out of reach.
    return trisect::detail::evaluate_translation(
        trisect::detail::with_named_slots(
            trisect::detail::translate_without_constants(engines::formula(expression, solids))),
        options, nullptr);
}

// The same mesh, corner by corner, whether facets are traced or put together from pieces.
void expect_same_as_pieces(const trisect::Solid& result, Count& count) {
    ASSERT_NE(trisect::detail::state_of(result)->tree().crossings, nullptr);
    trisect::detail::SolidState without = *trisect::detail::state_of(result);
    std::get<trisect::detail::CellTree>(without.form).crossings.reset();
    trisect::PolygonMesh expected;
    try {
        expected = trisect::detail::assemble_mesh(without);
    } catch (const trisect::UnsupportedError&) {
        return;  // unbounded
    }
    trisect::detail::AssemblyStats stats;
    const trisect::PolygonMesh mesh =
        trisect::detail::assemble_mesh(*trisect::detail::state_of(result), &stats);
    count.traced += stats.traced_facets;
    count.worked += stats.worked_facets;
    ++count.bounded;
    EXPECT_EQ(mesh.corners, expected.corners);
    EXPECT_TRUE(mesh.points == expected.points);
    EXPECT_EQ(engines::open_edge(mesh), "");
}

void expect_agreement(const std::vector<Operand>& operands, const Expression& expression,
                      Count& count) {
    const auto expected = reference::evaluate(operands, expression);
    for (const std::uint32_t leaf : {4U, 15U, 100U}) {
        SCOPED_TRACE("leaf size " + std::to_string(leaf));
        const trisect::Solid result = evaluate(operands, expression, leaf);
        expect_same_as_pieces(result, count);
        try {
            EXPECT_EQ(engines::difference(result.to_brep(),
                                          reference::canonical_boundary(expected.cells)),
                      "");
        } catch (const trisect::UnsupportedError&) {
        }
    }
}

Expression all_of(Kind kind, std::size_t n) {
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < n; ++i) terms.push_back(Expression::leaf(i));
    return Expression::node(kind, std::move(terms));
}

// The first one without all others.
Expression first_without(std::size_t n) {
    Expression out = Expression::leaf(0);
    for (std::size_t i = 1; i < n; ++i)
        out = Expression::node(Kind::Difference, {out, Expression::leaf(i)});
    return out;
}

void expect_agreement_of_all(const std::vector<Operand>& operands, Count& count) {
    expect_agreement(operands, all_of(Kind::Union, operands.size()), count);
    expect_agreement(operands, all_of(Kind::Intersection, operands.size()), count);
    expect_agreement(operands, first_without(operands.size()), count);
}

// Twenty times as large, and sheared a little: out of the planes of all others.
Operand tilted(const Operand& operand, std::int64_t a, std::int64_t b) {
    Operand out = operand;
    for (auto& triangle : out)
        for (auto& p : triangle) {
            const std::array<std::int64_t, 3> q{20 * p[0] + a * p[1] + b * p[2],
                                                20 * p[1] - a * p[0] + 2 * b * p[2],
                                                20 * p[2] - b * p[0] - a * p[1]};
            p = {q[0], q[1], q[2]};
        }
    return out;
}

Operand random_solid(reference::Random& random) {
    return tilted(reference::random_embedded_solid(random), random.between(-7, 7),
                  random.between(-7, 7));
}

TEST(TracedFormulas, RandomSolids) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 410000);
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < 3 + seed % 3; ++i) operands.push_back(random_solid(random));
        std::vector<Expression> terms;
        for (std::size_t i = 0; i < operands.size(); ++i) {
            const Expression leaf = Expression::leaf(i);
            terms.push_back(random.between(0, 2) == 0 ? Expression::node(Kind::Complement, {leaf})
                                                      : leaf);
        }
        expect_agreement(operands,
                         Expression::node(seed % 2 == 0 ? Kind::Union : Kind::Intersection, terms),
                         count);
    }
    EXPECT_GT(count.bounded, 90U);
    EXPECT_GT(count.traced * 10, count.worked * 5);
}

// On the small grid nearly everything touches: then facets must not be traced.
TEST(TracedFormulas, RandomSolidsOnTheSmallGrid) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 420000);
        const auto operands = reference::random_family(random, 3 + seed % 3, true);
        expect_agreement(
            operands,
            seed % 2 == 0 ? all_of(Kind::Union, operands.size()) : first_without(operands.size()),
            count);
    }
    EXPECT_EQ(count.bounded, 3U * 60);
    EXPECT_GT(count.worked, 1000U);
    EXPECT_LT(count.traced * 2, count.worked);
}

TEST(TracedFormulas, ThreeBarsCrossOnOneSideOfABlock) {
    Count count;
    expect_agreement_of_all({tilted(reference::box({0, 0, 0}, {30, 30, 6}), 0, 0),
                             tilted(reference::box({5, 10, -3}, {20, 14, 12}), 2, 1),
                             tilted(reference::box({10, 4, -2}, {14, 22, 11}), -3, 1),
                             tilted(reference::box({8, 8, -4}, {17, 17, 9}), 1, -2)},
                            count);
    EXPECT_EQ(count.traced, count.worked);
}

TEST(TracedFormulas, AThinBarWithinAThickOneThroughASide) {
    Count count;
    expect_agreement_of_all({tilted(reference::box({0, 0, 0}, {30, 30, 6}), 0, 0),
                             tilted(reference::box({5, 5, -3}, {13, 12, 11}), 1, 3),
                             tilted(reference::box({7, 8, -4}, {9, 10, 13}), 2, -1),
                             tilted(reference::box({20, 4, -5}, {24, 8, 11}), 1, -2)},
                            count);
    EXPECT_GT(count.traced, 0U);
}

TEST(TracedFormulas, CornersThroughASide) {
    Count count;
    expect_agreement_of_all(
        {tilted(reference::box({0, 0, 0}, {30, 30, 6}), 0, 0),
         reference::tetrahedron({100, 100, 150}, {140, 130, 30}, {100, 190, 160}, {40, 110, 170}),
         reference::tetrahedron({130, 100, 155}, {150, 133, 25}, {130, 190, 166}, {70, 110, 171}),
         reference::tetrahedron({430, 400, 155}, {451, 433, 35}, {433, 490, 166}, {375, 414, 171})},
        count);
    EXPECT_GT(count.traced * 10, count.worked * 9);
}

TEST(TracedFormulas, CoincidentSidesOfTwoOthersCrossAFacet) {
    Count count;
    const Operand left = tilted(reference::box({5, 5, -3}, {10, 12, 12}), 1, 2);
    const Operand right = tilted(reference::box({10, 5, -3}, {15, 12, 12}), 1, 2);
    expect_agreement_of_all({tilted(reference::box({0, 0, 0}, {30, 30, 6}), 0, 0), left, right},
                            count);
    EXPECT_LT(count.traced, count.worked);
}

TEST(TracedFormulas, AVertexOfOneOnAnEdgeOfAnother) {
    Count count;
    expect_agreement_of_all(
        {reference::box({0, 0, 0}, {10, 10, 10}),
         reference::tetrahedron({5, 0, 10}, {3, -4, 14}, {8, -3, 15}, {6, 4, 16}),
         reference::tetrahedron({2, 3, 5}, {4, 8, 14}, {9, 2, 13}, {5, 4, 16})},
        count);
    EXPECT_LT(count.traced, count.worked);
}

// Four planes of four solids in one point of the first one's side.
TEST(TracedFormulas, ThreeOthersMeetInOnePointOfAFacet) {
    Count count;
    expect_agreement_of_all(
        {reference::box({-20, -20, -20}, {20, 20, 0}),
         reference::tetrahedron({-10, 0, -7}, {10, 0, -7}, {0, 0, 9}, {0, 12, -3}),
         reference::tetrahedron({0, -10, -8}, {0, 10, -6}, {0, 1, 9}, {13, 2, -2}),
         reference::tetrahedron({-9, -9, -8}, {9, 9, -8}, {1, 1, 11}, {12, -11, -2})},
        count);
    EXPECT_LT(count.traced, count.worked);
}

// Cells within the large block are done at once, whatever the others have there.
TEST(TracedFormulas, SolidsThatCrossWithinAnotherAndReachOutOfIt) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 430000);
        std::vector<Operand> operands{tilted(reference::box({0, 0, 0}, {30, 30, 30}), 0, 0)};
        for (int i = 0; i < 5; ++i) {
            const std::int64_t x = random.between(2, 22);
            const std::int64_t y = random.between(2, 22);
            const std::int64_t z = random.between(-6, 24);
            operands.push_back(tilted(
                reference::box({x, y, z}, {x + random.between(2, 12), y + random.between(2, 12),
                                           z + random.between(8, 20)}),
                random.between(-4, 4), random.between(-4, 4)));
        }
        expect_agreement(operands, all_of(Kind::Union, operands.size()), count);
    }
    EXPECT_GT(count.traced * 10, count.worked * 6);
}

// In small cells facets are listed that only come near, and crossings that lie behind a wall.
TEST(TracedFormulas, ManySolidsInSmallCells) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 440000);
        std::vector<Operand> operands;
        for (int i = 0; i < 14; ++i) {
            const std::int64_t x = random.between(0, 30);
            const std::int64_t y = random.between(0, 30);
            const std::int64_t z = random.between(0, 30);
            operands.push_back(tilted(
                reference::box({x, y, z}, {x + random.between(4, 24), y + random.between(4, 24),
                                           z + random.between(4, 24)}),
                random.between(-7, 7), random.between(-7, 7)));
        }
        for (const std::uint32_t leaf : {8U, 20U, 50U})
            expect_same_as_pieces(evaluate(operands, all_of(Kind::Union, operands.size()), leaf),
                                  count);
    }
    EXPECT_GT(count.traced * 10, count.worked * 5);
}

TEST(TracedFormulas, MoreSolidsThroughAFacetThanItIsTracedFor) {
    std::vector<Operand> operands{tilted(reference::box({0, 0, 0}, {90, 90, 6}), 0, 0)};
    for (std::int64_t i = 0; i < 72; ++i) {
        const std::int64_t x = 2 + 10 * (i % 8);
        const std::int64_t y = 2 + 9 * (i / 8);
        operands.push_back(
            tilted(reference::box({x, y, -3}, {x + 6, y + 11, 9}), 1 + i % 3, i % 2 == 0 ? 1 : -1));
    }
    Count count;
    expect_same_as_pieces(evaluate(operands, all_of(Kind::Union, operands.size()), 100), count);
    EXPECT_LT(count.traced, count.worked);
    EXPECT_GT(count.traced, 0U);
}

}  // namespace
