// SPDX-License-Identifier: Apache-2.0
//
// Roots are known because the polynomials are products of factors with known roots; what the
// isolation must not do is lose one, invent one or take two for one.

#include <trisect/brep/algebraic_number.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <trisect/kernel/error.h>

#include "support/numbers.h"

namespace {

using numbers::q;
using trisect::AlgebraicNumber;
using trisect::ExactRational;
using trisect::roots_between;
using trisect::UsageError;

using Coefficients = std::vector<ExactRational>;

ExactRational power_of_ten(int negative_exponent) {
    return q(("1/1" + std::string(static_cast<std::size_t>(negative_exponent), '0')).c_str());
}

Coefficients product(const Coefficients& a, const Coefficients& b) {
    Coefficients r(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) r[i + j] += a[i] * b[j];
    return r;
}

Coefficients with_roots(const std::vector<ExactRational>& roots) {
    Coefficients p{1};
    for (const ExactRational& r : roots) p = product(p, {-r, 1});
    return p;
}

ExactRational value(const Coefficients& p, const ExactRational& s) {
    ExactRational r;
    for (std::size_t i = p.size(); i-- > 0;) r = r * s + p[i];
    return r;
}

void expect_roots(const Coefficients& p, const ExactRational& from, const ExactRational& to,
                  std::vector<ExactRational> expected) {
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    std::erase_if(expected, [&](const ExactRational& r) { return r < from || r > to; });
    const std::vector<AlgebraicNumber> found = roots_between(p, from, to);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i], AlgebraicNumber(expected[i])) << expected[i].to_string();
        EXPECT_EQ(found[i].sign_of(p), 0);
        EXPECT_EQ(found[i].to_double(), expected[i].to_double());
    }
}

TEST(Roots, SimpleOnesInsideAndOutsideTheInterval) {
    expect_roots(with_roots({q("1/3"), q("1/2"), q("2")}), 0, 1, {q("1/3"), q("1/2")});
}

TEST(Roots, AtBothEndsOfTheInterval) {
    expect_roots(with_roots({0, 1}), 0, 1, {0, 1});
    expect_roots(with_roots({0, q("1/2"), 1}), 0, 1, {0, q("1/2"), 1});
    expect_roots(with_roots({q("1/4"), q("3/4")}), q("1/4"), q("3/4"), {q("1/4"), q("3/4")});
    expect_roots(with_roots({q("1/4"), q("3/4")}), q("1/4"), q("1/4"), {q("1/4")});
}

TEST(Roots, MultipleOnesAreReportedOnce) {
    expect_roots(with_roots({q("1/2"), q("1/2"), q("1/2")}), 0, 1, {q("1/2")});
    expect_roots(with_roots({0, 0, q("2/3"), q("2/3"), 1, 1}), 0, 1, {0, q("2/3"), 1});
}

TEST(Roots, ClusteredWithin1e30) {
    const ExactRational gap = power_of_ten(30);
    const ExactRational third = q("1/3");
    expect_roots(with_roots({third, third + gap, third - gap, third + gap * q("1/7")}), 0, 1,
                 {third, third + gap, third - gap, third + gap * q("1/7")});
    // Both sides of a point of division.
    expect_roots(with_roots({q("1/2") - gap, q("1/2") + gap}), 0, 1,
                 {q("1/2") - gap, q("1/2") + gap});
}

TEST(Roots, NearMissHasNone) {
    // (s - 1/3)^2 + 1e-60
    Coefficients p = with_roots({q("1/3"), q("1/3")});
    p[0] += power_of_ten(60);
    EXPECT_TRUE(roots_between(p, 0, 1).empty());
    p[0] -= power_of_ten(60) * ExactRational(2);
    EXPECT_EQ(roots_between(p, 0, 1).size(), 2U);
}

TEST(Roots, IrrationalOnesAreBracketed) {
    const std::vector<AlgebraicNumber> roots = roots_between(Coefficients{-2, 0, 1}, 0, 2);
    ASSERT_EQ(roots.size(), 1U);
    EXPECT_NEAR(roots[0].to_double(), std::sqrt(2.0), 1e-15);
    const AlgebraicNumber narrow = roots[0].refined(power_of_ten(50));
    EXPECT_LE(narrow.upper() - narrow.lower(), power_of_ten(50));
    EXPECT_LT(narrow.lower() * narrow.lower(), ExactRational(2));
    EXPECT_GT(narrow.upper() * narrow.upper(), ExactRational(2));
    EXPECT_EQ(narrow, roots[0]);
    EXPECT_THROW((void)roots[0].refined(0), UsageError);
}

TEST(Roots, ConstantsHaveNoneAndZeroIsRefused) {
    EXPECT_TRUE(roots_between(Coefficients{5}, 0, 1).empty());
    EXPECT_THROW((void)roots_between(Coefficients{}, 0, 1), UsageError);
    EXPECT_THROW((void)roots_between(Coefficients{0, 0}, 0, 1), UsageError);
    EXPECT_THROW((void)roots_between(Coefficients{0, 1}, 1, 0), UsageError);
}

TEST(Roots, RandomProductsOnACoarseGrid) {
    std::mt19937 random(11);
    for (int round = 0; round < 2000; ++round) {
        std::vector<ExactRational> roots;
        const std::size_t degree = 1 + random() % 12;
        for (std::size_t i = 0; i < degree; ++i)
            roots.push_back(ExactRational(static_cast<int>(random() % 25) - 8) /
                            ExactRational(static_cast<int>(1 + random() % 8)));
        Coefficients p = with_roots(roots);
        if (random() % 2 == 0) p = product(p, {3, -2, 1});  // no real root
        expect_roots(p, 0, 1, roots);
    }
}

TEST(Roots, CountAgreesWithSignsOnAFineGrid) {
    // Small random coefficients: where the sign changes between neighbours there is a root.
    std::mt19937 random(5);
    for (int round = 0; round < 1000; ++round) {
        Coefficients p;
        for (int i = 0; i < 8; ++i) p.emplace_back(static_cast<int>(random() % 13) - 6);
        if (std::all_of(p.begin(), p.end(), [](const auto& c) { return c.sign() == 0; })) continue;
        const std::vector<AlgebraicNumber> roots = roots_between(p, 0, 1);
        for (std::size_t i = 1; i < roots.size(); ++i) EXPECT_LT(roots[i - 1], roots[i]);
        int last = value(p, 0).sign();
        ExactRational last_at = 0;
        for (int k = 1; k <= 64; ++k) {
            const ExactRational s = ExactRational(k) / ExactRational(64);
            const int sign = value(p, s).sign();
            if (sign != last && sign != 0 && last != 0) {
                const auto between = std::count_if(roots.begin(), roots.end(), [&](const auto& r) {
                    return r > AlgebraicNumber(last_at) && r < AlgebraicNumber(s);
                });
                EXPECT_EQ(between % 2, 1);
            }
            last = sign;
            last_at = s;
        }
    }
}

TEST(Comparison, EqualRootsOfDifferentPolynomials) {
    const Coefficients two{-2, 0, 1};
    const auto a = roots_between(product(two, {-1, 3}), 0, 2);
    const auto b = roots_between(product(two, {5, 0, 0, 1}), 0, 2);
    ASSERT_EQ(a.size(), 2U);
    ASSERT_EQ(b.size(), 1U);
    EXPECT_EQ(a[1], b[0]);
    EXPECT_LT(a[0], b[0]);
}

TEST(Comparison, NeighboursCloserThanDoubles) {
    // sqrt 2 and a root of s^2 - 2 - 1e-40.
    Coefficients near{-2, 0, 1};
    near[0] -= power_of_ten(40);
    const auto a = roots_between(Coefficients{-2, 0, 1}, 0, 2);
    const auto b = roots_between(near, 0, 2);
    EXPECT_LT(a[0], b[0]);
    EXPECT_GT(b[0], a[0]);
    EXPECT_EQ(a[0].to_double(), b[0].to_double());
    EXPECT_EQ(b[0].sign_of(Coefficients{-2, 0, 1}), 1);
    EXPECT_EQ(a[0].sign_of(near), -1);
}

TEST(Comparison, IsATotalOrderOfRandomRoots) {
    std::mt19937 random(3);
    std::vector<AlgebraicNumber> numbers;
    while (numbers.size() < 60) {
        Coefficients p;
        for (int i = 0; i < 4; ++i) p.emplace_back(static_cast<int>(random() % 7) - 3);
        if (std::all_of(p.begin(), p.end(), [](const auto& c) { return c.sign() == 0; })) continue;
        for (AlgebraicNumber& r : roots_between(p, 0, 1)) numbers.push_back(std::move(r));
    }
    for (const AlgebraicNumber& a : numbers)
        for (const AlgebraicNumber& b : numbers) {
            const auto order = a <=> b;
            EXPECT_EQ(order, 0 <=> (b <=> a));
            if (order == 0) {
                EXPECT_EQ(a.sign_of(b.polynomial()), 0);
                EXPECT_EQ(a.to_double(), b.to_double());
            } else {
                EXPECT_EQ(order < 0, a.to_double() < b.to_double() ||
                                         (a.to_double() == b.to_double() && order < 0));
            }
        }
}

TEST(SignAtARoot, IsZeroForTheDefiningAndForMultiples) {
    const auto r = roots_between(Coefficients{-1, 1, 0, 1}, 0, 1);  // s^3 + s - 1
    ASSERT_EQ(r.size(), 1U);
    EXPECT_EQ(r[0].sign_of(product({-1, 1, 0, 1}, {7, -3, 2})), 0);
    EXPECT_EQ(r[0].sign_of(Coefficients{-1, 1}), -1);
    EXPECT_EQ(r[0].sign_of(Coefficients{}), 0);
    EXPECT_EQ(r[0].sign_of(Coefficients{-3}), -1);
}

TEST(AlgebraicNumbers, CopiesMovesAndRationals) {
    AlgebraicNumber a(q("2/3"));
    const AlgebraicNumber b = a;
    const AlgebraicNumber c = std::move(a);
    EXPECT_EQ(b, c);
    EXPECT_TRUE(c.is_rational());
    EXPECT_EQ(c.lower(), q("2/3"));
    EXPECT_EQ(AlgebraicNumber().to_double(), 0.0);
    ASSERT_EQ(c.polynomial().size(), 2U);
    EXPECT_EQ(c.sign_of(c.polynomial()), 0);
}

TEST(AlgebraicNumber, IsARegularValue) {
    const auto is_root_of_two = [](const AlgebraicNumber& x) {
        return x.sign_of(Coefficients{-2, 0, 1}) == 0 && x > AlgebraicNumber(0);
    };
    const auto roots = roots_between(Coefficients{-2, 0, 1}, 0, 2);
    ASSERT_EQ(roots.size(), 1U);
    const AlgebraicNumber root = roots[0];
    AlgebraicNumber copy(5);
    copy = root;
    EXPECT_TRUE(is_root_of_two(copy));
    const AlgebraicNumber& same = copy;
    copy = same;
    EXPECT_TRUE(is_root_of_two(copy));
    AlgebraicNumber moved(std::move(copy));
    EXPECT_TRUE(is_root_of_two(moved));
    copy = moved;  // what was moved from takes a value again
    EXPECT_TRUE(is_root_of_two(copy));
    AlgebraicNumber target;
    EXPECT_EQ(target, AlgebraicNumber(0));
    target = std::move(moved);
    EXPECT_TRUE(is_root_of_two(target));
    moved = AlgebraicNumber(q("3/7"));
    EXPECT_EQ(moved.lower(), q("3/7"));
}

}  // namespace
