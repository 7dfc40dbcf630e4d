// SPDX-License-Identifier: Apache-2.0
//
// The oracle against CGAL's Nef polyhedra with rational coordinates: an engine of entirely
// different construction (spheres around vertices) must find the same boundaries, face by face, for
// random pairs of solids on a small grid, which touch and coincide more often than not.
#include <gtest/gtest.h>

#include <vector>

#include "canonical_boundary.h"
#include "naive_boolean.h"
#include "nef_polyhedron.h"
#include "random_solids.h"

namespace {

using namespace reference;
using Kind = Expression::Kind;

TEST(NaiveAgainstNef, single_solids) {
    Random random(21);
    for (int round = 0; round < 30; ++round) {
        SCOPED_TRACE(round);
        const Operand solid = random_embedded_solid(random);
        EXPECT_EQ(
            explain_difference(canonical_boundary(polygons_of(solid)), boundary_of(to_nef(solid))),
            "");
    }
}

TEST(NaiveAgainstNef, pairs) {
    Random random(22);
    for (int round = 0; round < 100; ++round) {
        SCOPED_TRACE(round);
        const std::vector<Operand> pair = random_family(random, 2, true);
        const Nef a = to_nef(pair[0]);
        const Nef b = to_nef(pair[1]);
        const auto compare = [&](Kind kind, const Nef& nef) {
            const Result result = evaluate(pair, pair_expression(kind));
            const CanonicalBoundary naive = canonical_boundary(result.cells);
            const CanonicalBoundary expected = boundary_of(nef);
            EXPECT_EQ(volume(naive), volume(expected));
            EXPECT_EQ(explain_difference(naive, expected), "");
        };
        compare(Kind::Union, a + b);
        compare(Kind::Intersection, a * b);
        compare(Kind::Difference, a - b);
        compare(Kind::Xor, a ^ b);
    }
}

TEST(NaiveAgainstNef, three_operands_in_a_chain) {
    Random random(23);
    for (int round = 0; round < 20; ++round) {
        SCOPED_TRACE(round);
        const std::vector<Operand> family = random_family(random, 3, true);
        const Nef a = to_nef(family[0]);
        const Nef b = to_nef(family[1]);
        const Nef c = to_nef(family[2]);
        const Expression expression =
            Expression::node(Kind::Difference, {pair_expression(Kind::Union), Expression::leaf(2)});
        const Result result = evaluate(family, expression);
        EXPECT_EQ(explain_difference(canonical_boundary(result.cells), boundary_of((a + b) - c)),
                  "");
        const Expression mixed =
            Expression::node(Kind::Intersection, {pair_expression(Kind::Xor), Expression::leaf(2)});
        EXPECT_EQ(explain_difference(canonical_boundary(evaluate(family, mixed).cells),
                                     boundary_of((a ^ b) * c)),
                  "");
    }
}

}  // namespace
