// SPDX-License-Identifier: Apache-2.0
//
// The error bounds of the filters (kernel/number/filters.h) in binary formats of six and eleven
// bits.
//
// In double the bounds are theorems that random input hardly touches: an error of five roundings in
// the worst direction has a probability of nearly nothing. In six bits all inputs of a formula, or
// all that matter, can be tried, and the largest error that occurs is a good part of the bound. The
// formulas are the same templates. Exponents are not limited, which is what the proofs assume of
// double as well. Determinants of differences have bounds of 64 roundings, which six bits have no
// room for: these run in eleven bits.

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

// Numbers of a few bits. One operation on two of them is exact in double; Veltkamp's splitting then
// rounds to the nearest.
template <int bits>
struct Format {
    static constexpr double u = 1.0 / (1 << bits);

    Format() = default;
    explicit Format(double exact) {
        constexpr double splitter = static_cast<double>(std::int64_t{1} << (53 - bits)) + 1;
        const double c = exact * splitter;
        v = c - (c - exact);
    }
    double v = 0;

    friend Format operator+(Format a, Format b) { return Format(a.v + b.v); }
    friend Format operator-(Format a, Format b) { return Format(a.v - b.v); }
    friend Format operator*(Format a, Format b) { return Format(a.v * b.v); }
    friend Format operator-(Format a) { return Format(-a.v); }
    friend bool operator<(Format a, Format b) { return a.v < b.v; }
    friend bool operator>(Format a, Format b) { return a.v > b.v; }
};

using Tiny = Format<6>;
using Small = Format<11>;

}  // namespace

template <int bits>
struct trisect::detail::Roundoff<Format<bits>> {
    inline static const Format<bits> times_8{8 * Format<bits>::u};
    inline static const Format<bits> times_16{16 * Format<bits>::u};
    inline static const Format<bits> slack{1 + 8 * Format<bits>::u};
};

namespace {

using trisect::detail::cross;
using trisect::detail::dot;
using trisect::detail::Filtered;
using trisect::detail::minus;

// Collects what a filter said about exact values.
class Verdict {
public:
    template <class F>
    void see(const Filtered<F>& f, double exact) {
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

// Calls visit with all vectors of these components.
template <class F>
void each_vector(const std::vector<int>& of, F&& visit) {
    for (const int x : of)
        for (const int y : of)
            for (const int z : of) visit(std::array<int, 3>{x, y, z});
}

template <class F>
std::array<F, 3> in_format(const std::array<int, 3>& p) {
    return {F(p[0]), F(p[1]), F(p[2])};
}

double exact_det(const std::array<int, 3>& p, const std::array<int, 3>& q,
                 const std::array<int, 3>& r, const std::array<int, 3>& from) {
    const auto a = [&](std::size_t k) { return double{1} * (p[k] - from[k]); };
    const auto b = [&](std::size_t k) { return double{1} * (q[k] - from[k]); };
    const auto c = [&](std::size_t k) { return double{1} * (r[k] - from[k]); };
    return a(0) * (b(1) * c(2) - b(2) * c(1)) + a(1) * (b(2) * c(0) - b(0) * c(2)) +
           a(2) * (b(0) * c(1) - b(1) * c(0));
}

// Coordinates are numbers of the format; their differences have up to twelve bits and are rounded,
// as those of coordinates with bits behind the point are.
TEST(FilterBounds, OrientationOfPointsWhoseDifferencesRound) {
    Verdict verdict;
    const auto as = values({0, 63, 66, 2016});
    const auto bs = values({0, 34, 2112});
    const auto cs = values({62, 2112}, true);
    for (const std::array<int, 3>& d :
         {std::array{0, 0, 0}, std::array{31, -31, 31}, std::array{-1, 63, 33}})
        each_vector(as, [&](const auto& a) {
            each_vector(bs, [&](const auto& b) {
                each_vector(cs, [&](const auto& c) {
                    verdict.see(
                        trisect::detail::filter_orientation(in_format<Tiny>(a), in_format<Tiny>(b),
                                                            in_format<Tiny>(c), in_format<Tiny>(d)),
                        exact_det(a, b, c, d));
                });
            });
        });
    verdict.expect(1'000'000, 0.3);
}

// n · (p - a), n = (b - a) × (c - a), with the bound of difference_determinant_rounding, as sides
// of triangles are found where coordinates have bits behind the point.
TEST(FilterBounds, DeterminantOfDifferencesThatRound) {
    Verdict verdict;
    const auto far = values({2047, 4094});
    const auto near = values({5, 1025, 4094});
    const std::array<int, 3> a{1, -1, 3};
    each_vector(far, [&](const auto& b) {
        each_vector(near, [&](const auto& c) {
            each_vector(far, [&](const auto& p) {
                const auto from = in_format<Small>(a);
                const auto u = minus(in_format<Small>(b), from);
                const auto v = minus(in_format<Small>(c), from);
                const auto w = minus(in_format<Small>(p), from);
                const auto largest = [](const std::array<Small, 3>& x) {
                    return std::max({std::fabs(x[0].v), std::fabs(x[1].v), std::fabs(x[2].v)});
                };
                const Small edge(std::max(largest(u), largest(v)));
                const Small bound = edge * edge * (Small(64 * Small::u) * Small(largest(w)));
                verdict.see(Filtered<Small>{dot(cross(u, v), w), bound}, exact_det(p, b, c, a));
            });
        });
    });
    verdict.expect(500'000, 0.1);
}

// The same where differences are off by e before they are rounded.
TEST(FilterBounds, DeterminantOfDifferencesThatAreOff) {
    Verdict determinants;
    Verdict minors;
    const auto far = values({2047, 4094});
    for (const int e : {1, 7, 33})
        each_vector(far, [&](const auto& p) {
            each_vector(far, [&](const auto& q) {
                each_vector(far, [&](const auto& r) {
                    const auto moved = [&](std::array<int, 3> x, int way) {
                        for (std::size_t k = 0; k < 3; ++k) x[k] += (way >> k & 1) != 0 ? e : -e;
                        return x;
                    };
                    const auto u = in_format<Small>(p);
                    const auto v = in_format<Small>(q);
                    const auto w = in_format<Small>(r);
                    // difference_determinant_bound and difference_minor_bound for this format.
                    const double g = 4094;
                    const Small bound(g * g * (20 * e + 64 * Small::u * g));
                    const Small minor_bound(g * (5 * e + 16 * Small::u * g));
                    for (int way = 0; way < 8; ++way) {
                        const auto [x, y, z] =
                            std::array{moved(p, way), moved(q, way * 3 % 8), moved(r, way * 5 % 8)};
                        determinants.see(Filtered<Small>{dot(cross(u, v), w), bound},
                                         exact_det(x, y, z, {0, 0, 0}));
                        minors.see(Filtered<Small>{u[0] * v[1] - u[1] * v[0], minor_bound},
                                   double{1} * x[0] * y[1] - double{1} * x[1] * y[0]);
                    }
                });
            });
        });
    determinants.expect(1'000'000, 0.1);
    minors.expect(1'000'000, 0.3);
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
