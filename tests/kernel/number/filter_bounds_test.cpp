// SPDX-License-Identifier: Apache-2.0
//
// The error bounds of the filters (kernel/number/filters.h) in a binary format of six bits.
//
// In double the bounds are theorems that random input hardly touches: an error of five roundings in
// the worst direction has a probability of nearly nothing. In six bits all inputs of a formula, or
// all that matter, can be tried, and the largest error that occurs is a good part of the bound. The
// formulas are the same templates. Exponents are not limited, which is what the proofs assume of
// double as well.

#include <trisect/kernel/number/filters.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

#include "support/gmp_oracle.h"

namespace {

// Numbers of six bits. One operation on two of them is exact in double; Veltkamp's splitting then
// rounds to the nearest.
struct Tiny {
    static constexpr double u = 0x1p-6;

    Tiny() = default;
    explicit Tiny(double exact) {
        const double c = exact * (0x1p47 + 1);  // 2^(53 - 6) + 1
        v = c - (c - exact);
    }
    double v = 0;

    friend Tiny operator+(Tiny a, Tiny b) { return Tiny(a.v + b.v); }
    friend Tiny operator-(Tiny a, Tiny b) { return Tiny(a.v - b.v); }
    friend Tiny operator*(Tiny a, Tiny b) { return Tiny(a.v * b.v); }
    friend Tiny operator-(Tiny a) { return Tiny(-a.v); }
    friend bool operator<(Tiny a, Tiny b) { return a.v < b.v; }
    friend bool operator>(Tiny a, Tiny b) { return a.v > b.v; }
};

}  // namespace

template <>
struct trisect::detail::Roundoff<Tiny> {
    inline static const Tiny times_8{8 * Tiny::u};
    inline static const Tiny times_16{16 * Tiny::u};
    inline static const Tiny slack{1 + 8 * Tiny::u};
};

namespace {

using trisect::detail::Filtered;

// Collects what a filter said about exact values.
class Verdict {
public:
    void see(const Filtered<Tiny>& f, double exact) {
        ++cases_;
        const int sign = f.sign();
        if (sign != 0) ++decided_;
        if (sign != 0 && sign != (exact > 0) - (exact < 0)) ++wrong_;
        const double error = std::fabs(f.value.v - exact);
        if (error > f.bound.v) ++beyond_;
        if (f.bound.v > 0) largest_ = std::max(largest_, error / f.bound.v);
    }
    // `tight`: the least part of the bound that errors have to reach, or the inputs prove little.
    void expect(std::uint64_t at_least, double tight) const {
        EXPECT_GE(cases_, at_least);
        EXPECT_EQ(wrong_, 0U);
        EXPECT_EQ(beyond_, 0U) << "errors beyond the bound, of " << cases_;
        EXPECT_GT(decided_, cases_ / 20) << "a filter that decides nothing is never wrong";
        EXPECT_GT(largest_, tight);
        testing::Test::RecordProperty("cases", std::to_string(cases_));
        testing::Test::RecordProperty("largest_part_of_bound", std::to_string(largest_));
    }

private:
    std::uint64_t cases_ = 0;
    std::uint64_t decided_ = 0;
    std::uint64_t wrong_ = 0;
    std::uint64_t beyond_ = 0;
    double largest_ = 0;
};

// Integers whose rounding to six bits errs most, up or down, between small ones. In `half` only
// those that are not negative: signs that only turn the whole formula need no second run.
std::vector<int> values(std::initializer_list<int> of, bool half = false) {
    std::vector<int> out(of);
    if (!half)
        for (const int v : of)
            if (v != 0) out.push_back(-v);
    return out;
}

// All a d - b c with |entries| < 72: six bits hold those up to 64 exactly, and the others are
// rounded.
TEST(FilterBounds, CrossOfAllSmallIntegers) {
    Verdict verdict;
    for (int a = 0; a < 72; ++a)
        for (int b = 0; b < 72; ++b)
            for (int c = 0; c < 72; ++c)
                for (int d = -71; d < 72; d += 1)
                    verdict.see(trisect::detail::filter_cross(Tiny(a), Tiny(b), Tiny(c), Tiny(d)),
                                a * d - b * c);
    verdict.expect(50'000'000, 0.3);
}

TEST(FilterBounds, DotOfIntegersAtTheRoundings) {
    Verdict verdict;
    const auto us = values({0, 1, 33, 35, 63, 65, 67, 97, 127}, true);
    const auto vs = values({0, 1, 33, 63, 65, 67, 95, 127});
    for (const int a0 : us)
        for (const int a1 : us)
            for (const int a2 : us)
                for (const int b0 : vs)
                    for (const int b1 : vs)
                        for (const int b2 : vs)
                            verdict.see(
                                trisect::detail::filter_dot<Tiny>({Tiny(a0), Tiny(a1), Tiny(a2)},
                                                                  {Tiny(b0), Tiny(b1), Tiny(b2)}),
                                a0 * b0 + a1 * b1 + a2 * b2);
    verdict.expect(2'000'000, 0.3);
}

// The coordinates are those of the filter moved by the error, in all directions.
void side_cases(Verdict& verdict, const std::vector<int>& ns, const std::vector<int>& cs,
                const std::vector<int>& ds, int error) {
    for (const int n0 : ns)
        for (const int n1 : ns)
            for (const int n2 : ns)
                for (const int d : ds)
                    for (const int c0 : cs)
                        for (const int c1 : cs)
                            for (const int c2 : cs) {
                                const auto f = trisect::detail::filter_side<Tiny>(
                                    {Tiny(n0), Tiny(n1), Tiny(n2)}, Tiny(d),
                                    {Tiny(c0), Tiny(c1), Tiny(c2)}, Tiny(error));
                                const double at = n0 * c0 + n1 * c1 + n2 * c2 + d;
                                const double reach = error * (n0 + n1 + n2);
                                verdict.see(f, at + reach);
                                if (error != 0) verdict.see(f, at - reach);
                            }
}

TEST(FilterBounds, SideOfExactPoints) {
    Verdict verdict;
    // Coordinates are exact in the format; coefficients are rounded.
    side_cases(verdict, values({0, 1, 65, 67, 97, 127}, true), values({0, 1, 33, 47, 63}),
               values({0, 65, 1027, 4095, 6209}), 0);
    verdict.expect(1'000'000, 0.3);
}

TEST(FilterBounds, SideOfApproximatePoints) {
    Verdict verdict;
    for (const int error : {1, 3, 9})
        side_cases(verdict, values({0, 1, 65, 67, 127}, true), values({0, 33, 47, 63}),
                   values({0, 1027, 4095}), error);
    verdict.expect(1'000'000, 0.5);
}

TEST(FilterBounds, DeterminantOfIntegersAtTheRoundings) {
    Verdict verdict;
    const auto as = values({0, 33, 67, 127}, true);
    const auto bs = values({0, 65, 127}, true);
    const auto cs = values({33, 67, 127});
    const auto each = [](const auto& of, auto&& visit) {
        for (const int x : of)
            for (const int y : of)
                for (const int z : of)
                    visit(std::array<double, 3>{double(x), double(y), double(z)});
    };
    const auto tiny = [](const std::array<double, 3>& v) {
        return std::array{Tiny(v[0]), Tiny(v[1]), Tiny(v[2])};
    };
    each(as, [&](const auto& a) {
        each(bs, [&](const auto& b) {
            each(cs, [&](const auto& c) {
                const double det = a[0] * (b[1] * c[2] - b[2] * c[1]) +
                                   a[1] * (b[2] * c[0] - b[0] * c[2]) +
                                   a[2] * (b[0] * c[1] - b[1] * c[0]);
                verdict.see(trisect::detail::filter_det(tiny(a), tiny(b), tiny(c)), det);
            });
        });
    });
    verdict.expect(300'000, 0.15);
}

// predicates.h has the formula written out for double.
TEST(FilterBounds, FilteredSideIsTheTemplate) {
    oracle::Source random(7);
    for (int round = 0; round < 100'000; ++round) {
        const int bits = static_cast<int>(1 + random.below(53));
        const auto plane = random.plane(bits);
        const trisect::LatticePoint p = random.point(bits);
        trisect::Approximation a = approximate(p);
        if (random.coin()) a.error = static_cast<double>(random.below(1000));
        const int expected =
            trisect::detail::filter_side(
                {plane.approx_normal(0), plane.approx_normal(1), plane.approx_normal(2)},
                plane.approx_offset(), a.c, a.error)
                .sign();
        const auto side = filtered_side(a, plane);
        EXPECT_EQ(side ? trisect::sign_of(*side) : 0, expected);
    }
}

}  // namespace
