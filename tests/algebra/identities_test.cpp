// SPDX-License-Identifier: Apache-2.0
//
// Laws of set algebra: the symmetric difference of both sides is the empty set, exactly.

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra.h"

namespace {

using algebra::Family;
using trisect::evaluate;
using trisect::Expression;
using trisect::Solid;

constexpr std::uint64_t families = 40;

// Runs body(a, b, c, same) for every family; `same` compares with the family's options.
template <class Body>
void for_all_families(std::uint64_t first_seed, Body&& body) {
    for (std::uint64_t seed = first_seed; seed < first_seed + families; ++seed) {
        SCOPED_TRACE(seed);
        const Family f(seed, 3);
        const auto options = algebra::options_of(seed);
        const auto same = [&](const Expression& x, const Expression& y) {
            // Both sides are evaluated, so that the comparison is not a formula's tautology.
            return algebra::same_set(evaluate(x, options), evaluate(y, options), options);
        };
        body(f.solids[0], f.solids[1], f.solids[2], same);
    }
}

TEST(Identities, DeMorgan) {
    for_all_families(1000, [](const Solid& a, const Solid& b, const Solid&, const auto& same) {
        EXPECT_TRUE(same(a - b, a & ~b));
        EXPECT_TRUE(same(~(a | b), ~a & ~b));
        EXPECT_TRUE(same(~(a & b), ~a | ~b));
        EXPECT_TRUE(same(~~a, a));
    });
}

TEST(Identities, IdempotenceAndCommutativity) {
    for_all_families(2000, [](const Solid& a, const Solid& b, const Solid&, const auto& same) {
        EXPECT_TRUE(same(a | a, a));
        EXPECT_TRUE(same(a & a, a));
        EXPECT_TRUE(same(a | b, b | a));
        EXPECT_TRUE(same(a & b, b & a));
        EXPECT_TRUE(same(a ^ b, b ^ a));
        EXPECT_TRUE(same(~a ^ ~b, a ^ b));
    });
}

TEST(Identities, Associativity) {
    for_all_families(3000, [](const Solid& a, const Solid& b, const Solid& c, const auto& same) {
        EXPECT_TRUE(same((a | b) | c, a | (b | c)));
        EXPECT_TRUE(same((a & b) & c, a & (b & c)));
        EXPECT_TRUE(same((a ^ b) ^ c, a ^ (b ^ c)));
    });
}

TEST(Identities, Distributivity) {
    for_all_families(4000, [](const Solid& a, const Solid& b, const Solid& c, const auto& same) {
        EXPECT_TRUE(same(a & (b | c), (a & b) | (a & c)));
        EXPECT_TRUE(same(a | (b & c), (a | b) & (a | c)));
        EXPECT_TRUE(same(a & (b ^ c), (a & b) ^ (a & c)));
        EXPECT_TRUE(same(a - (b | c), (a - b) - c));
    });
}

TEST(Identities, AbsorptionAndMonotony) {
    for_all_families(5000, [](const Solid& a, const Solid& b, const Solid&, const auto& same) {
        EXPECT_TRUE(same(a | (a & b), a));
        EXPECT_TRUE(same(a & (a | b), a));
        EXPECT_TRUE(same(a - (a | b), Solid()));
        EXPECT_TRUE(same((a & b) - a, Solid()));
    });
}

TEST(Identities, WhatIsCutApartFitsTogether) {
    for_all_families(6000, [](const Solid& a, const Solid& b, const Solid&, const auto& same) {
        EXPECT_TRUE(same((a - b) | (a & b), a));
        EXPECT_TRUE(same((a | b) - b, a - b));
        EXPECT_TRUE(same((a ^ b) ^ b, a));
        EXPECT_TRUE(same((a - b) & b, Solid()));
    });
}

// The same on evaluated intermediate results: every step works on the tree of the step before.
TEST(Identities, WhatIsCutApartFitsTogetherStepByStep) {
    for_all_families(7000, [](const Solid& a, const Solid& b, const Solid&, const auto& same) {
        const Solid left = evaluate(a - b);
        const Solid common = evaluate(a & b);
        const Solid either = evaluate(a ^ b);
        EXPECT_TRUE(same(left | common, a));
        EXPECT_TRUE(same(evaluate(a | b) - b, left));
        EXPECT_TRUE(same(either ^ b, a));
        EXPECT_TRUE(same(either | common, evaluate(a | b)));
        EXPECT_TRUE(same(left & b, Solid()));
    });
}

TEST(Identities, TheEmptySetAndWholeSpaceAreNeutralOrDominate) {
    const Solid none;
    const Solid all = Solid::whole_space();
    for_all_families(8000, [&](const Solid& a, const Solid&, const Solid&, const auto& same) {
        EXPECT_TRUE(same(a | none, a));
        EXPECT_TRUE(same(a & all, a));
        EXPECT_TRUE(same(a - none, a));
        EXPECT_TRUE(same(a ^ none, a));
        EXPECT_TRUE(same(a ^ all, ~a));
        EXPECT_TRUE(same(all - a, ~a));
        EXPECT_TRUE(same(a | ~a, all));
        EXPECT_TRUE(evaluate(a & none).is_empty());
        EXPECT_TRUE(evaluate(a | all).is_whole_space());
        EXPECT_TRUE(evaluate(a - all).is_empty());
        EXPECT_TRUE(evaluate(none - a).is_empty());
    });
}

// Every face of the complement is the face of the set, turned over.
TEST(Identities, TheComplementHasTheSameBoundaryTurnedOver) {
    for_all_families(9000, [](const Solid& a, const Solid& b, const Solid&, const auto&) {
        const Solid u = evaluate(a | b);
        const trisect::Brep there = u.to_brep();
        const trisect::Brep back = evaluate(~u).to_brep();
        std::vector<reference::Polygon> turned;
        for (reference::Polygon p : engines::polygons(back)) {
            p.plane = p.plane.flipped();
            for (auto& loop : p.loops) std::ranges::reverse(loop);
            turned.push_back(std::move(p));
        }
        EXPECT_EQ(
            reference::explain_difference(reference::canonical_boundary(engines::polygons(there)),
                                          reference::canonical_boundary(turned)),
            "");
        EXPECT_EQ(there.counts().faces, back.counts().faces);
    });
}

}  // namespace
