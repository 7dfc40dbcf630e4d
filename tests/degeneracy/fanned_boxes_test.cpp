// SPDX-License-Identifier: Apache-2.0
//
// Boxes whose faces are cut into four triangles around a point: every facet is across an axis and
// has two slanted sides, so that what is left of it need not be a rectangle with a corner cut off.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engines/engines.h"
#include "reference/naive_boolean.h"
#include "reference/random_solids.h"

namespace {

using reference::LatticePoint;
using reference::Operand;
using reference::Random;
using trisect::Embedding;
using trisect::Solid;

// Sides of at least 2. The point of each face is anywhere in its inside.
Operand fanned_box(Random& random, const LatticePoint& low, const LatticePoint& high) {
    Operand out;
    const std::array<std::int64_t, 3> lo{low[0], low[1], low[2]};
    const std::array<std::int64_t, 3> hi{high[0], high[1], high[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        for (const bool above : {false, true}) {
            const auto point = [&](std::int64_t x, std::int64_t y) {
                LatticePoint p{};
                p[axis] = above ? hi[axis] : lo[axis];
                p[u] = x;
                p[v] = y;
                return p;
            };
            const std::array<LatticePoint, 4> ring{point(lo[u], lo[v]), point(hi[u], lo[v]),
                                                   point(hi[u], hi[v]), point(lo[u], hi[v])};
            const LatticePoint middle =
                point(random.between(lo[u] + 1, hi[u] - 1), random.between(lo[v] + 1, hi[v] - 1));
            for (std::size_t i = 0; i < 4; ++i) {
                const LatticePoint& a = ring[i];
                const LatticePoint& b = ring[(i + 1) % 4];
                out.push_back(above ? reference::Triangle{a, b, middle}
                                    : reference::Triangle{b, a, middle});
            }
        }
    }
    return out;
}

Operand random_box(Random& random) {
    LatticePoint low{};
    LatticePoint high{};
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = random.between(0, 6);
        high[k] = low[k] + random.between(2, 6);
    }
    return fanned_box(random, low, high);
}

void expect_agreement(const Solid& result, const std::vector<Operand>& operands,
                      const reference::Expression& expression) {
    const auto expected = reference::evaluate(operands, expression);
    EXPECT_EQ(engines::open_edge(result.to_mesh()), "");
    EXPECT_EQ(engines::difference(result.to_brep(), reference::canonical_boundary(expected.cells)),
              "");
}

TEST(FannedBoxes, FormulasOverSeveral) {
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed + 910000);
        std::vector<Operand> operands;
        std::vector<Solid> solids;
        for (std::size_t i = 0; i < 2 + seed % 4; ++i) {
            operands.push_back(random_box(random));
            solids.push_back(engines::solid(operands.back(), Embedding::Assume));
        }
        const auto expression = reference::random_expression(
            random, operands.size(), operands.size() + seed % 3, /*with_complements=*/false);
        trisect::EvaluateOptions options;
        if (seed % 3 == 0) options.leaf_polygons = 6;
        expect_agreement(evaluate(engines::formula(expression, solids), options), operands,
                         expression);
    }
}

TEST(FannedBoxes, ChainsCutWhatIsLeftOfFacets) {
    using Kind = reference::Expression::Kind;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed + 920000);
        std::vector<Operand> operands{random_box(random)};
        Solid result = engines::solid(operands[0], Embedding::Assume);
        reference::Expression expression = reference::Expression::leaf(0);
        for (std::size_t step = 1; step <= 4; ++step) {
            operands.push_back(random_box(random));
            const Solid next = engines::solid(operands.back(), Embedding::Assume);
            trisect::EvaluateOptions options;
            if (seed % 2 == 0) options.leaf_polygons = 10;
            const auto other = reference::Expression::leaf(step);
            const bool unite = random.chance(1, 2);
            result = evaluate(unite ? result | next : result - next, options);
            expression = reference::Expression::node(unite ? Kind::Union : Kind::Difference,
                                                     {expression, other});
            expect_agreement(result, operands, expression);
        }
    }
}

}  // namespace
