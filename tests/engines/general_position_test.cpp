// SPDX-License-Identifier: Apache-2.0
//
// Solids in general position, whose leaves are arranged in doubles (filtered_leaf.h), against the
// naive engine in rationals. Within a solid facets lie in common planes as often as on the small
// grid; an integer map of its own takes every solid out of the grid of the others.

#include <thread>
#include <variant>

#include <gtest/gtest.h>

#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/kernel/error.h>

#include "engines.h"
#include "evaluate_stats.h"

namespace {

using engines::mapped;
using reference::Operand;
using Kind = reference::Expression::Kind;

struct Leaves {
    std::uint64_t plain = 0;
    std::uint64_t mixed = 0;
};

void expect_agreement(const std::vector<Operand>& operands, const reference::Expression& expression,
                      std::uint32_t leaf_polygons, Leaves& leaves) {
    std::vector<trisect::Solid> solids;
    for (const auto& o : operands) solids.push_back(engines::solid(o, trisect::Embedding::Assume));
    trisect::EvaluateOptions options;
    options.leaf_polygons = leaf_polygons;
    trisect::test::EvaluateStats stats;
    const trisect::Solid result = evaluate(engines::formula(expression, solids), options, &stats);
    leaves.plain += stats.filtered_leaves;
    leaves.mixed += stats.mixed_leaves;
    EXPECT_EQ(engines::open_edge(engines::boundary_mesh(result)), "");
    const auto expected = reference::evaluate(operands, expression);
    EXPECT_EQ(engines::difference(result.to_brep(), reference::canonical_boundary(expected.cells)),
              "");
}

TEST(GeneralPosition, PairsInOneLeafAndInManySmallOnes) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        reference::Random random(seed + 310000);
        const std::vector<Operand> operands{
            mapped(reference::random_embedded_solid(random), random),
            mapped(reference::random_embedded_solid(random), random)};
        const auto kind = seed % 2 == 0 ? reference::Expression::Kind::Xor
                                        : reference::Expression::Kind::Difference;
        for (const std::uint32_t leaf : {3U, 10U, 100U}) {
            SCOPED_TRACE("seed " + std::to_string(seed) + " leaf size " + std::to_string(leaf));
            expect_agreement(operands, reference::pair_expression(kind), leaf, leaves);
        }
    }
    EXPECT_GT(leaves.mixed, 300U);
    EXPECT_GT(leaves.plain * 10, leaves.mixed * 8);
}

TEST(GeneralPosition, FormulasOverSeveralSolids) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 320000);
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < 3 + seed % 3; ++i)
            operands.push_back(mapped(reference::random_embedded_solid(random), random));
        const auto expression =
            reference::random_expression(random, operands.size(), operands.size() + seed % 4);
        expect_agreement(operands, expression, seed % 2 == 0 ? 100 : 12, leaves);
    }
    EXPECT_GT(leaves.mixed, 100U);
    EXPECT_GT(leaves.plain * 10, leaves.mixed * 7);
}

// Both halves of a bar's side cut the other bar along one line, and end on it inside of it.
TEST(GeneralPosition, BarsWhoseSidesAreCutInTwoTriangles) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 330000);
        const std::vector<Operand> operands{mapped(reference::box({0, 5, 6}, {15, 9, 10}), random),
                                            mapped(reference::box({5, 0, 4}, {8, 15, 9}), random)};
        expect_agreement(operands, reference::pair_expression(reference::Expression::Kind::Union),
                         100, leaves);
    }
    EXPECT_GT(leaves.plain * 10, leaves.mixed * 8);
}

// The second step comes to leaves whose facets the first one has not cut yet, and passes others on.
TEST(GeneralPosition, AStepAfterTheOther) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 350000);
        std::vector<Operand> operands;
        std::vector<trisect::Solid> solids;
        for (int i = 0; i < 3; ++i) {
            operands.push_back(mapped(reference::random_embedded_solid(random), random));
            solids.push_back(engines::solid(operands.back(), trisect::Embedding::Assume));
        }
        trisect::EvaluateOptions options;
        options.leaf_polygons = seed % 3 == 0 ? 3 : (seed % 3 == 1 ? 10 : 100);
        const trisect::Solid first = trisect::evaluate(solids[0] - solids[1], options);
        const trisect::Solid second = trisect::evaluate(first | solids[2], options);
        const auto expected = reference::evaluate(
            operands,
            reference::Expression::node(Kind::Union, {reference::pair_expression(Kind::Difference),
                                                      reference::Expression::leaf(2)}));
        EXPECT_EQ(
            engines::difference(second.to_brep(), reference::canonical_boundary(expected.cells)),
            "");
        EXPECT_EQ(engines::open_edge(engines::boundary_mesh(second)), "");
    }
}

// Several threads ask for what one of them has to cut.
TEST(GeneralPosition, ThreadsAskForTheSameLeaf) {
    reference::Random random(360001);
    const trisect::Solid a = engines::solid(mapped(reference::box({0, 5, 6}, {15, 9, 10}), random),
                                            trisect::Embedding::Assume);
    for (int round = 0; round < 20; ++round) {
        const trisect::Solid b = engines::solid(
            mapped(reference::box({5, 0, 4}, {8, 15, 9}), random), trisect::Embedding::Assume);
        const trisect::Solid result = trisect::evaluate(a | b);
        std::vector<trisect::PolygonMesh> meshes(4);
        {
            std::vector<std::jthread> threads;
            for (trisect::PolygonMesh& mesh : meshes)
                threads.emplace_back(
                    [&] { mesh = engines::boundary_mesh(trisect::evaluate(result | a)); });
        }
        for (const trisect::PolygonMesh& mesh : meshes) {
            EXPECT_EQ(mesh.corners, meshes[0].corners);
            EXPECT_TRUE(mesh.points == meshes[0].points);
        }
    }
}

// The outlines of cut facets follow from their crossings, or pieces are put together: the same
// mesh, corner by corner. Some walls of cells run through the crossings.
TEST(GeneralPosition, TracedOutlinesAreThoseOfThePieces) {
    std::uint64_t traced = 0;
    std::uint64_t worked = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 340000);
        std::vector<trisect::Expression> terms;
        for (int i = 0; i < 2; ++i) {
            const trisect::Solid solid =
                engines::solid(mapped(reference::random_embedded_solid(random), random),
                               trisect::Embedding::Assume);
            terms.push_back(random.between(0, 1) == 0 ? trisect::Expression(solid) : ~solid);
        }
        trisect::EvaluateOptions options;
        options.leaf_polygons = seed % 3 == 0 ? 3 : (seed % 3 == 1 ? 10 : 100);
        const trisect::Expression expression =
            seed % 2 == 0 ? ~(terms[0] | terms[1]) : terms[0] - terms[1];
        const trisect::Solid result = engines::evaluate_by_cells(expression, options);
        trisect::detail::SolidState without = *trisect::detail::state_of(result);
        std::get<trisect::detail::CellTree>(without.form).crossings.reset();
        trisect::detail::AssemblyStats stats;
        trisect::PolygonMesh expected;
        try {
            expected = trisect::detail::assemble_mesh(without);
        } catch (const trisect::UnsupportedError&) {
            continue;  // unbounded
        }
        const trisect::PolygonMesh mesh =
            trisect::detail::assemble_mesh(*trisect::detail::state_of(result), &stats);
        traced += stats.traced_facets;
        worked += stats.worked_facets;
        EXPECT_EQ(mesh.corners, expected.corners);
        EXPECT_TRUE(mesh.points == expected.points);
        const trisect::Brep brep =
            trisect::detail::assemble_brep(*trisect::detail::state_of(result), {});
        const trisect::Brep joined = trisect::detail::assemble_brep(without, {});
        EXPECT_EQ(brep.vertices().size(), joined.vertices().size());
        EXPECT_EQ(brep.faces().size(), joined.faces().size());
    }
    EXPECT_GT(traced * 10, worked * 7);
}

// Whatever touches is left to the exact way.
TEST(GeneralPosition, FlushBoxesAreNotInGeneralPosition) {
    Leaves leaves;
    expect_agreement(
        {reference::box({0, 0, 0}, {10, 10, 10}), reference::box({3, 3, 10}, {7, 7, 20})},
        reference::pair_expression(reference::Expression::Kind::Union), 100, leaves);
    expect_agreement(
        {reference::box({0, 0, 0}, {10, 10, 10}), reference::box({3, 3, 5}, {7, 7, 10})},
        reference::pair_expression(reference::Expression::Kind::Difference), 100, leaves);
    EXPECT_EQ(leaves.plain, 0U);
    EXPECT_GT(leaves.mixed, 0U);
}

}  // namespace
