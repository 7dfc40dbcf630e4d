// SPDX-License-Identifier: Apache-2.0
//
// The cell-tree engine against the naive engine in rationals: equal boundaries, for random solids
// on a small grid, where faces, edges and vertices coincide all the time.

#include <gtest/gtest.h>

#include <trisect/bsp/cells/work_budget.h>

#include "engines.h"

namespace {

using Kind = reference::Expression::Kind;

constexpr std::array kinds{Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor};

std::string disagreement(const std::vector<reference::Operand>& operands,
                         const reference::Expression& expression,
                         const trisect::EvaluateOptions& options = {},
                         trisect::Embedding embedding = trisect::Embedding::Resolve, int bits = 0) {
    std::vector<trisect::Solid> solids;
    for (const auto& o : operands) solids.push_back(engines::solid(o, embedding, bits));
    const trisect::Solid result = trisect::evaluate(engines::formula(expression, solids), options);
    if (std::string why = engines::open_edge(engines::boundary_mesh(result)); !why.empty())
        return why;
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

// Seventy bits behind the point: products of such coordinates are beyond single precision.
// The last one is a pair of which a vertex inside an edge was missed: the boundary was not closed.
TEST(EngineAgreement, SolidsFarSmallerThanTheUnit) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        reference::Random random(seed);
        const auto operands = reference::random_family(random, 2);
        for (const Kind kind : kinds) {
            const auto expression = reference::pair_expression(kind);
            EXPECT_EQ(disagreement(operands, expression, {}, trisect::Embedding::Resolve, 70), "")
                << "seed " << seed << " " << reference::to_string(expression);
        }
    }
    reference::Random mix(2812 * 2);
    reference::Random random(mix.next() + 446);
    ASSERT_FALSE(random.chance(1, 2));
    const auto operands = reference::random_family(random, 2, false);
    EXPECT_EQ(disagreement(operands, reference::pair_expression(Kind::Xor), {},
                           trisect::Embedding::Resolve, 70),
              "");
}

// A result that meets a coarser lattice goes there by its boundary. Where it touches itself in a
// vertex that had one for each part, and facets that were cut and facets that were not had
// different ones; of a complement the boundary was that of crossings of the set.
TEST(EngineAgreement, ResultsThatMoveToACoarserLattice) {
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        reference::Random random(seed);
        const auto operands = reference::random_family(random, 3, seed % 2 == 0);
        const auto embedding =
            seed % 2 == 0 ? trisect::Embedding::Assume : trisect::Embedding::Resolve;
        const auto leaf = [](std::size_t i) { return reference::Expression::leaf(i); };
        const auto not_b = reference::Expression::node(Kind::Complement, {leaf(1)});
        for (const auto& before : {reference::Expression::node(Kind::Union, {leaf(0), not_b}),
                                   reference::Expression::node(Kind::Xor, {leaf(0), leaf(1)})}) {
            const std::vector<trisect::Solid> fine{engines::solid(operands[0], embedding, 2),
                                                   engines::solid(operands[1], embedding, 2)};
            const std::vector<trisect::Solid> both{
                trisect::evaluate(engines::formula(before, fine)),
                engines::solid(operands[2], embedding, 70)};
            for (const Kind kind : {Kind::Union, Kind::Intersection}) {
                const trisect::Solid result =
                    trisect::evaluate(engines::formula(reference::pair_expression(kind), both));
                const auto expression = reference::Expression::node(kind, {before, leaf(2)});
                EXPECT_EQ(engines::open_edge(engines::boundary_mesh(result)), "")
                    << "seed " << seed;
                const auto expected = reference::evaluate(operands, expression);
                EXPECT_EQ(engines::difference(result.to_brep(),
                                              reference::canonical_boundary(expected.cells)),
                          "")
                    << "seed " << seed << " " << reference::to_string(expression);
            }
        }
    }
}

// Three triangles in one place between two tetrahedra, the first one the other way round than the
// result is: it speaks for all, and its neighbours are not only those that are left.
TEST(EngineAgreement, SheetsFoldedBackOntoThemselves) {
    const reference::LatticePoint a{0, 0, 0};
    const reference::LatticePoint b{4, 0, 0};
    const reference::LatticePoint c{0, 4, 0};
    const reference::LatticePoint up{1, 1, 3};
    const reference::LatticePoint down{1, 1, -3};
    const reference::Expression alone = reference::Expression::leaf(0);
    for (int first = 0; first < 3; ++first)
        for (const auto& apex : {up, down}) {
            reference::Operand operand = reference::tetrahedron(a, b, c, apex);
            reference::Operand folds;
            for (int i = 0; i < 3; ++i)
                folds.push_back((i == first) == (apex == up) ? reference::Triangle{a, b, c}
                                                             : reference::Triangle{c, b, a});
            for (const auto& t : operand)
                if (t[0][2] != 0 || t[1][2] != 0 || t[2][2] != 0) folds.push_back(t);
            ASSERT_TRUE(reference::is_balanced(folds));
            EXPECT_EQ(disagreement({folds}, alone), "") << first;
        }
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        reference::Random random(seed);
        auto operands = reference::random_family(random, 2);
        for (auto& o : operands) o = reference::with_folds(random, o, 3);
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
            const trisect::detail::SplittingOffset offset(leaf == 8 ? 127 : 61);
            const auto expression = reference::pair_expression(Kind::Difference);
            EXPECT_EQ(disagreement(operands, expression, options), "")
                << "seed " << seed << " leaf size " << leaf;
        }
    }
}

// Small cells: facets pass through cells where nothing meets, and span many of them.
TEST(EngineAgreement, EmbeddedPairsInSmallCells) {
    for (std::uint64_t seed = 5000; seed < 5300; ++seed) {
        reference::Random random(seed);
        const auto operands = reference::random_family(random, 2, true);
        trisect::EvaluateOptions options;
        options.leaf_polygons = seed % 2 == 0 ? 3 : 8;
        const trisect::detail::SplittingOffset offset(seed % 3 == 0 ? 191 : 61);
        for (const Kind kind : {Kind::Intersection, Kind::Xor}) {
            const auto expression = reference::pair_expression(kind);
            EXPECT_EQ(disagreement(operands, expression, options, trisect::Embedding::Assume), "")
                << "seed " << seed << " " << reference::to_string(expression);
        }
    }
}

// Intersecting a tetrahedron with a box that only cuts off a corner: most facets of the tetrahedron
// are listed in cells for their boxes alone.
TEST(EngineAgreement, TetrahedronCornerInABox) {
    const reference::Operand a{{{{8, 5, 1}, {6, 6, 5}, {4, 15, 3}}},
                               {{{8, 5, 1}, {15, 4, 10}, {6, 6, 5}}},
                               {{{8, 5, 1}, {4, 15, 3}, {15, 4, 10}}},
                               {{{4, 15, 3}, {6, 6, 5}, {15, 4, 10}}}};
    const std::vector<reference::Operand> operands{a, reference::box({7, 12, 7}, {15, 14, 14})};
    trisect::EvaluateOptions options;
    options.leaf_polygons = 3;
    const trisect::detail::SplittingOffset offset(127);
    EXPECT_EQ(disagreement(operands, reference::pair_expression(Kind::Intersection), options,
                           trisect::Embedding::Assume),
              "");
}

// A cavity whose edge lies on an edge of the box around it: four facets at one edge of one operand.
TEST(EngineAgreement, CavityTouchingItsShellAlongAnEdge) {
    const reference::Operand cavity{{{{21, 6, 12}, {28, 2, 11}, {15, 7, 13}}},
                                    {{{21, 6, 12}, {15, 7, 13}, {28, 2, 14}}},
                                    {{{21, 6, 12}, {28, 2, 14}, {28, 2, 11}}},
                                    {{{28, 2, 11}, {28, 2, 14}, {15, 7, 13}}}};
    const std::vector<reference::Operand> operands{
        reference::box({-2, 9, 11}, {13, 16, 14}),
        reference::concatenated(reference::box({13, 2, 11}, {28, 9, 14}), cavity)};
    for (const Kind kind : kinds)
        EXPECT_EQ(disagreement(operands, reference::pair_expression(kind)), "");
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

// Several solids, some of them copies of each other: facets coincide, and a facet may bound the
// result whatever the operand of its copy does.
TEST(EngineAgreement, EmbeddedFormulasOverCopies) {
    for (std::uint64_t seed = 1; seed <= 160; ++seed) {
        reference::Random random(seed + 88000);
        const auto operands = reference::random_family(random, 3 + seed % 3, true);
        const auto expression = reference::random_expression(random, operands.size(),
                                                             operands.size() + seed % 5, false);
        trisect::EvaluateOptions options;
        if (seed % 2 == 0) options.leaf_polygons = 6;
        EXPECT_EQ(disagreement(operands, expression, options, trisect::Embedding::Assume), "")
            << "seed " << seed << " " << reference::to_string(expression);
    }
}

// Leaves across the axes, whose planes cross the diagonals of sides in fractions; and a chain, in
// which they cross diagonals of fragments.
TEST(EngineAgreement, BoxesWhoseDiagonalsAreCutAnywhere) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        reference::Random random(seed + 66000);
        std::vector<reference::Operand> operands;
        for (int i = 0; i < 4; ++i) {
            reference::LatticePoint lo{};
            reference::LatticePoint hi{};
            for (std::size_t k = 0; k < 3; ++k) {
                lo[k] = random.between(0, 60);
                hi[k] = lo[k] + random.between(1, 101);
            }
            operands.push_back(reference::box(lo, hi));
        }
        const auto expression = reference::random_expression(random, 4, 3 + seed % 3);
        EXPECT_EQ(disagreement(operands, expression, {}, trisect::Embedding::Assume), "")
            << "seed " << seed << " " << reference::to_string(expression);
        trisect::Solid chain = engines::solid(operands[0], trisect::Embedding::Assume);
        auto steps = reference::Expression::leaf(0);
        for (std::size_t i = 1; i < operands.size(); ++i) {
            const Kind kind = kinds[random.below(4)];
            chain = trisect::evaluate(
                engines::formula(reference::pair_expression(kind),
                                 {chain, engines::solid(operands[i], trisect::Embedding::Assume)}));
            steps = reference::Expression::node(kind, {steps, reference::Expression::leaf(i)});
        }
        const auto expected = reference::evaluate(operands, steps);
        EXPECT_EQ(
            engines::difference(chain.to_brep(), reference::canonical_boundary(expected.cells)), "")
            << "seed " << seed << " " << reference::to_string(steps);
    }
}

// A chain evaluates every step on the tree of the step before.
TEST(EngineAgreement, ChainsStepByStep) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed + 99000);
        const auto operands = reference::random_family(random, 5, seed % 2 == 0);
        std::vector<trisect::Solid> solids;
        const auto embedding =
            seed % 2 == 0 ? trisect::Embedding::Assume : trisect::Embedding::Resolve;
        for (const auto& o : operands) solids.push_back(engines::solid(o, embedding));
        trisect::EvaluateOptions options;
        options.leaf_polygons = seed % 3 == 0 ? 3 : 6;
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
