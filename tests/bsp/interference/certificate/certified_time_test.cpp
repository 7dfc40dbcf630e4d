// SPDX-License-Identifier: Apache-2.0
//
// What checkers of certificates ask of polynomials and of roots in brackets, against polynomials
// made of roots that are known: simple and repeated ones, at ends of ranges and brackets, and at
// the event itself.

#include <trisect/bsp/interference/certificate/certified_time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reference/random_solids.h"

namespace {

using trisect::ExactRational;
using trisect::detail::certified::bernstein_coefficients;
using trisect::detail::certified::common_divisor;
using trisect::detail::certified::Polynomial;
using trisect::detail::certified::roots_between;
using trisect::detail::certified::RootTime;

Polynomial polynomial(std::vector<ExactRational> coefficients) {
    return Polynomial(std::move(coefficients));
}

ExactRational sixteenths(std::int64_t n) { return ExactRational(n).scaled(-4); }

// Roots at sixteenths with their multiplicities, a sign, and perhaps a factor without real roots.
struct Factored {
    std::map<std::int64_t, int> roots;
    int sign = 1;
    bool has_no_more_roots = true;

    [[nodiscard]] Polynomial expanded() const {
        Polynomial p = ExactRational(3 * sign);
        for (const auto& [root, count] : roots)
            for (int k = 0; k < count; ++k) p = p * polynomial({-sixteenths(root), 1});
        return has_no_more_roots ? p : p * polynomial({1, 1, 1});
    }
    [[nodiscard]] int multiplicity_at(std::int64_t at) const {
        const auto root = roots.find(at);
        return root == roots.end() ? 0 : root->second;
    }
    // Just after a place, or before it.
    [[nodiscard]] int sign_after(std::int64_t at) const {
        int s = sign;
        for (const auto& [root, count] : roots)
            if (root > at && count % 2 != 0) s = -s;
        return s;
    }
    [[nodiscard]] int sign_at(std::int64_t at) const {
        return multiplicity_at(at) > 0 ? 0 : sign_after(at);
    }
    [[nodiscard]] bool is_positive(std::int64_t from, std::int64_t to) const {
        for (std::int64_t at = from; at <= to; ++at)
            if (sign_at(at) <= 0) return false;
        return true;
    }
    [[nodiscard]] bool is_not_negative(std::int64_t from, std::int64_t to) const {
        for (std::int64_t at = from; at < to; ++at)
            if (sign_after(at) < 0) return false;
        return true;
    }
    [[nodiscard]] int roots_within(std::int64_t from, std::int64_t to) const {
        return static_cast<int>(std::ranges::count_if(
            roots, [&](const auto& r) { return from < r.first && r.first < to; }));
    }
    [[nodiscard]] bool changes_within(std::int64_t from, std::int64_t to) const {
        return std::ranges::any_of(roots, [&](const auto& r) {
            return from < r.first && r.first < to && r.second % 2 != 0;
        });
    }
};

Factored random_factored(reference::Random& random) {
    Factored f;
    for (std::int64_t n = random.between(0, 4); n > 0; --n)
        f.roots[random.between(0, 16)] = static_cast<int>(random.between(1, 3));
    f.sign = random.chance(1, 2) ? 1 : -1;
    f.has_no_more_roots = random.chance(2, 3);
    return f;
}

// An event, and the polynomial that has it for its only root in a bracket.
struct Event {
    std::int64_t lower, at, upper;
    Factored factored;

    [[nodiscard]] RootTime time() const {
        const Polynomial p = factored.expanded();
        std::vector<ExactRational> c;
        for (std::size_t i = 0; i <= p.degree(); ++i) c.push_back(p.coefficient(i));
        return {c, sixteenths(lower), sixteenths(upper)};
    }
};

Event random_event(reference::Random& random) {
    Event e;
    e.at = random.between(2, 14);
    e.lower = random.between(1, e.at - 1);
    e.upper = random.between(e.at + 1, 16);
    for (const auto& [root, count] : random_factored(random).roots)
        if (root < e.lower || root > e.upper) e.factored.roots[root] = count;
    e.factored.roots[e.at] = static_cast<int>(random.between(1, 3));
    return e;
}

TEST(CertifiedPolynomials, DistinctRootsInAnOpenRange) {
    reference::Random random(11);
    for (int round = 0; round < 600; ++round) {
        const Factored f = random_factored(random);
        const std::int64_t from = random.between(0, 15);
        const std::int64_t to = random.between(from + 1, 16);
        const auto count = roots_between(f.expanded(), sixteenths(from), sixteenths(to));
        if (f.sign_at(from) == 0 || f.sign_at(to) == 0)
            EXPECT_EQ(count, std::nullopt);
        else
            EXPECT_EQ(count, f.roots_within(from, to));
    }
}

TEST(CertifiedPolynomials, SignsOverClosedRanges) {
    reference::Random random(12);
    int positive = 0;
    int zero_somewhere = 0;
    for (int round = 0; round < 1500; ++round) {
        const Factored f = random_factored(random);
        const Polynomial p = f.expanded();
        const std::int64_t from = random.between(0, 15);
        const std::int64_t to = random.between(from + 1, 16);
        const bool is_positive =
            trisect::detail::certified::is_positive(p, sixteenths(from), sixteenths(to));
        const bool is_not_negative =
            trisect::detail::certified::is_not_negative(p, sixteenths(from), sixteenths(to));
        EXPECT_EQ(is_positive, f.is_positive(from, to)) << round;
        EXPECT_EQ(is_not_negative, f.is_not_negative(from, to)) << round;
        EXPECT_EQ(is_positive_on_unit(p), f.is_positive(0, 16)) << round;
        EXPECT_EQ(is_positive_after_zero(p, sixteenths(to)),
                  f.sign_after(0) > 0 && f.is_positive(1, to) && f.roots_within(0, to) == 0)
            << round;
        positive += is_positive ? 1 : 0;
        zero_somewhere += is_not_negative && !is_positive ? 1 : 0;
    }
    EXPECT_GT(positive, 100);
    EXPECT_GT(zero_somewhere, 100);
    // A range of one moment, and the zero polynomial.
    EXPECT_FALSE(trisect::detail::certified::is_not_negative(ExactRational(1), 1, 1));
    EXPECT_TRUE(trisect::detail::certified::is_not_negative(Polynomial(), 0, 1));
    EXPECT_FALSE(trisect::detail::certified::is_positive(Polynomial(), 0, 1));
    EXPECT_FALSE(trisect::detail::certified::is_positive_after_zero(Polynomial(), 1));
    EXPECT_FALSE(trisect::detail::certified::is_positive_on_unit(Polynomial()));
}

TEST(CertifiedPolynomials, BernsteinCoefficientsAreWeightsOfTheirPowers) {
    reference::Random random(13);
    for (int round = 0; round < 100; ++round) {
        const Polynomial p = random_factored(random).expanded();
        const std::size_t degree = p.degree() + random.below(3);
        const ExactRational from = sixteenths(random.between(0, 15));
        const ExactRational to = from + sixteenths(random.between(1, 16));
        const auto c = bernstein_coefficients(p, degree, from, to);
        const ExactRational u = sixteenths(random.between(0, 16));
        // De Casteljau.
        auto means = c;
        for (std::size_t n = degree; n > 0; --n)
            for (std::size_t k = 0; k < n; ++k)
                means[k] = means[k] * (ExactRational(1) - u) + means[k + 1] * u;
        EXPECT_EQ(means[0], p.value_at(from + u * (to - from)));
    }
    EXPECT_EQ(bernstein_coefficients(Polynomial(), 2, 0, 1), std::vector<ExactRational>(3));
}

TEST(RootTimes, SignsAtTheEventAndAroundIt) {
    reference::Random random(14);
    int roots_at_event = 0;
    int signs = 0;
    int before = 0;
    int after = 0;
    for (int round = 0; round < 4000; ++round) {
        const Event e = random_event(random);
        const RootTime time = e.time();
        ASSERT_EQ(time.wrong(), "") << round;
        Factored f = random_factored(random);
        if (random.chance(1, 3)) f.roots[e.at] = static_cast<int>(random.between(1, 3));
        if (random.chance(1, 4)) f.roots[e.upper] = static_cast<int>(random.between(1, 3));
        const Polynomial p = f.expanded();
        const bool is_root = f.sign_at(e.at) == 0;
        EXPECT_EQ(time.is_root_of(p), is_root) << round;
        EXPECT_EQ(time.sign_of(p), f.sign_at(e.at)) << round;
        roots_at_event += is_root ? 1 : 0;
        signs += is_root ? 0 : 1;

        // Nothing is said where the rest of the bracket has roots of its own.
        const std::int64_t from = random.between(0, e.lower);
        const bool free_behind = f.roots_within(e.at, e.upper) == 0;
        const bool is_before = f.is_positive(from, e.at - 1) && f.sign_after(e.at - 1) > 0;
        EXPECT_EQ(time.is_positive_before(p, sixteenths(from)), is_before && free_behind) << round;
        const bool is_not_negative = from < e.lower && f.is_not_negative(from, e.at);
        EXPECT_EQ(time.is_not_negative_before(p, sixteenths(from)),
                  is_not_negative && !f.changes_within(e.at, e.upper + 1))
            << round;

        const std::int64_t until = random.between(e.upper, 16);
        const bool is_after = f.sign_after(e.at) > 0 && f.is_positive(e.at + 1, until);
        const bool free_ahead = f.roots_within(e.lower - 1, e.at) == 0;
        EXPECT_EQ(time.is_positive_after(p, sixteenths(until)), is_after && free_ahead) << round;
        before += is_before && free_behind ? 1 : 0;
        after += is_after && free_ahead ? 1 : 0;
        EXPECT_FALSE(time.is_positive_after(p, sixteenths(e.upper) - sixteenths(1).scaled(-4)));
    }
    EXPECT_GT(roots_at_event, 500);
    EXPECT_GT(signs, 500);
    EXPECT_GT(before, 300);
    EXPECT_GT(after, 300);
}

// Between the roots 1/4 and 1/2 the cubic is negative; the bracket ends at its third root.
TEST(RootTimes, ACubicWithRootsBeforeAtAndAtTheEndOfTheBracket) {
    const RootTime half({-1, 2}, sixteenths(2), sixteenths(12));
    ASSERT_EQ(half.wrong(), "");
    const Factored cubic{{{4, 1}, {8, 1}, {12, 1}}, -1};
    EXPECT_FALSE(half.is_positive_before(cubic.expanded(), 0));
    const Factored without_the_first{{{8, 1}, {12, 1}}, 1};
    EXPECT_TRUE(half.is_positive_before(without_the_first.expanded(), 0));
}

// Halving a bracket by signs alone would leave the root behind.
TEST(RootTimes, ADoubleRootIsAtItsPlace) {
    const RootTime quarter({1, -8, 16}, sixteenths(2), sixteenths(15));
    ASSERT_EQ(quarter.wrong(), "");
    EXPECT_EQ(quarter.sign_of(polynomial({-1, 2})), -1);
    EXPECT_EQ(quarter.sign_of(polynomial({-1, 8})), 1);
    EXPECT_EQ(quarter.sign_of(polynomial({-1, 4})), 0);
}

// The root of 2 x x = 1.
TEST(RootTimes, AnIrrationalTime) {
    const RootTime time({-1, 0, 2}, 0, 1);
    ASSERT_EQ(time.wrong(), "");
    EXPECT_EQ(time.sign_of(polynomial({-7, 10})), 1);     // 7/10 is before it
    EXPECT_EQ(time.sign_of(polynomial({-71, 100})), -1);  // 71/100 is not
    EXPECT_TRUE(time.is_root_of(polynomial({-1, 0, 2}) * polynomial({-3, 1})));
    EXPECT_TRUE(time.is_root_of(Polynomial()));
    EXPECT_FALSE(time.is_root_of(polynomial({-1, 0, 3})));
}

// Nearer to the event than any bracket of 2000 halvings is.
TEST(RootTimes, ASignThatNoBracketShows) {
    const RootTime third({-1, 3}, 0, 1);
    ASSERT_EQ(third.wrong(), "");
    EXPECT_EQ(third.sign_of(polynomial({ExactRational(-1) + ExactRational(1).scaled(-2100), 3})),
              2);
}

TEST(RootTimes, BracketsThatAreRefused) {
    const std::vector<ExactRational> half{-1, 2};
    EXPECT_EQ(RootTime(half, 1, 0).wrong(), "there is no bracket");
    EXPECT_EQ(RootTime(half, 1, 1).wrong(), "there is no bracket");
    EXPECT_EQ(RootTime({}, 0, 1).wrong(), "there is no bracket");
    EXPECT_EQ(RootTime({0, 0}, 0, 1).wrong(), "there is no bracket");
    EXPECT_EQ(RootTime(half, -1, 1).wrong(), "the bracket is elsewhere");
    EXPECT_EQ(RootTime({-3, 2}, sixteenths(17), 2).wrong(), "the bracket is elsewhere");
    EXPECT_EQ(RootTime(half, 0, sixteenths(8)).wrong(), "the bracket holds no single root");
    EXPECT_EQ(RootTime(half, sixteenths(8), 1).wrong(), "the bracket holds no single root");
    EXPECT_EQ(RootTime(half, 0, sixteenths(7)).wrong(), "the bracket holds no single root");
    EXPECT_EQ(RootTime({3, -16, 16}, 0, 1).wrong(), "the bracket holds no single root");
    EXPECT_EQ(RootTime({-5, 4}, 0, 2).wrong(), "the contact is after the end");
    // At the end, and before it in a bracket that goes on.
    EXPECT_EQ(RootTime({-1, 1}, 0, 2).wrong(), "");
    EXPECT_EQ(RootTime({-3, 4}, 0, 2).wrong(), "");
}

}  // namespace
