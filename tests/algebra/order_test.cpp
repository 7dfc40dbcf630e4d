// SPDX-License-Identifier: Apache-2.0
//
// The order of operations must not show: equal sets have equal boundaries, face by face, vertex by
// vertex, however they were reached.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "algebra.h"

namespace {

using algebra::difference;
using algebra::Family;
using trisect::Brep;
using trisect::evaluate;
using trisect::Expression;
using trisect::Solid;

enum class Chain { Union, Intersection, Difference, Xor };

Solid step(Chain chain, const Solid& a, const Solid& b, const trisect::EvaluateOptions& options) {
    switch (chain) {
        case Chain::Union:
            return evaluate(a | b, options);
        case Chain::Intersection:
            return evaluate(a & b, options);
        case Chain::Difference:
            return evaluate(a - b, options);
        default:
            return evaluate(a ^ b, options);
    }
}

// One formula for all operands in their first order.
Expression at_once(Chain chain, const std::vector<Solid>& solids) {
    Expression e = solids[0];
    for (std::size_t i = 1; i < solids.size(); ++i) {
        switch (chain) {
            case Chain::Union:
                e = e | solids[i];
                break;
            case Chain::Intersection:
                e = e & solids[i];
                break;
            case Chain::Difference:
                e = e - solids[i];
                break;
            default:
                e = e ^ solids[i];
                break;
        }
    }
    return e;
}

Brep balanced(Chain chain, std::vector<Solid> level, const trisect::EvaluateOptions& options) {
    while (level.size() > 1) {
        std::vector<Solid> next;
        for (std::size_t i = 0; i + 1 < level.size(); i += 2)
            next.push_back(step(chain, level[i], level[i + 1], options));
        if (level.size() % 2 == 1) next.push_back(level.back());
        level = std::move(next);
    }
    return level[0].to_brep();
}

void check_orders(Chain chain, std::uint64_t first_seed, std::uint64_t count) {
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
        SCOPED_TRACE(seed);
        const Family f(seed, 5);
        reference::Random random(seed * 31);
        const Brep expected = evaluate(at_once(chain, f.solids)).to_brep();
        const auto options = algebra::options_of(seed);
        for (int round = 0; round < 2; ++round) {
            std::vector<Solid> shuffled = f.solids;
            // The minuend of a difference stays in front.
            for (std::size_t i = shuffled.size() - 1; i > 1; --i)
                std::swap(shuffled[i], shuffled[1 + random.below(i)]);
            Solid result = shuffled[0];
            for (std::size_t i = 1; i < shuffled.size(); ++i)
                result = step(chain, result, shuffled[i], options);
            EXPECT_EQ(difference(result.to_brep(), expected), "");
        }
        if (chain == Chain::Difference) continue;
        EXPECT_EQ(difference(balanced(chain, f.solids, options), expected), "");
    }
}

TEST(Order, OfAUnionDoesNotShow) { check_orders(Chain::Union, 1, 20); }

TEST(Order, OfAnIntersectionDoesNotShow) { check_orders(Chain::Intersection, 100, 20); }

TEST(Order, OfSubtractionsDoesNotShow) { check_orders(Chain::Difference, 200, 20); }

TEST(Order, OfASymmetricDifferenceDoesNotShow) { check_orders(Chain::Xor, 300, 20); }

TEST(Order, EvaluatingAgainChangesNothing) {
    for (std::uint64_t seed = 400; seed < 430; ++seed) {
        SCOPED_TRACE(seed);
        const Family f(seed, 2);
        const auto options = algebra::options_of(seed);
        const Solid u = evaluate(f.solids[0] ^ f.solids[1], options);
        const Brep expected = u.to_brep();
        const Solid far = engines::solid(reference::box({90, 90, 90}, {91, 91, 91}));
        EXPECT_EQ(difference(u.to_brep(), expected), "");
        EXPECT_EQ(difference(evaluate(u | Solid(), options).to_brep(), expected), "");
        EXPECT_EQ(difference(evaluate(u & Solid::whole_space(), options).to_brep(), expected), "");
        EXPECT_EQ(difference(evaluate(u - far, options).to_brep(), expected), "");
        EXPECT_EQ(difference(evaluate(u | u, options).to_brep(), expected), "");
        EXPECT_EQ(difference(evaluate(~~u, options).to_brep(), expected), "");
    }
}

}  // namespace
