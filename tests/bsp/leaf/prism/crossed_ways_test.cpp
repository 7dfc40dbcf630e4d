// SPDX-License-Identifier: Apache-2.0
//
// Ways that side faces cross, from points on or next to their ends and their lines, against
// rationals.

#include <trisect/bsp/leaf/prism/crossed_ways.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include <gtest/gtest.h>

#include <trisect/bsp/cells/cell.h>

#include "support/gmp_oracle.h"

namespace crossed_ways_test {
namespace {

using namespace trisect::detail;
using trisect::Coordinate;

struct Flat {
    mpq_class u;
    mpq_class v;
};

mpq_class rational(Coordinate c) { return mpq_class(c.to_double()); }
Flat rational(const FlatCorner& p) { return {rational(p.u), rational(p.v)}; }

bool oracle(const PrismSideFace& w, const Flat& p) {
    const Flat a = rational(w.from);
    const Flat b = rational(w.to);
    if ((a.v > p.v) == (b.v > p.v)) return false;
    const mpq_class turn = (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
    return (turn > 0) == (b.v > a.v);
}

PrismSideFace side_face(const FlatCorner& a, const FlatCorner& b) {
    PrismSideFace out;
    out.from = std::min(a, b);
    out.to = std::max(a, b);
    return out;
}

// Corners of few bits at some height, with many bits or without any behind the point; now and then
// one double further.
class Corners {
public:
    explicit Corners(std::uint64_t seed) : source_(seed) {}

    FlatCorner next(int exponent) { return {number(exponent), number(exponent)}; }
    oracle::Source& source() { return source_; }

private:
    Coordinate number(int exponent) {
        const double grid = std::ldexp(static_cast<double>(source_.between(-6, 6)), exponent);
        if (exponent < -18 || exponent > 47 || source_.below(3) != 0) return Coordinate(grid);
        const double next = std::nextafter(grid, source_.coin() ? 0x1p60 : -0x1p60);
        return Coordinate(grid == 0 ? std::ldexp(1.0, exponent - 50) : next);
    }

    oracle::Source source_;
};

TEST(CrossedWays, FromCorners) {
    Corners corners(20261201);
    int crossed = 0;
    for (int round = 0; round < 30000; ++round) {
        const int exponent = static_cast<int>(corners.source().between(-70, 50));
        const PrismSideFace w = side_face(corners.next(exponent), corners.next(exponent));
        const FlatCorner p = corners.next(exponent);
        const bool expected = oracle(w, rational(p));
        crossed += expected ? 1 : 0;
        ASSERT_EQ(crosses_way(w, p), expected);
    }
    EXPECT_GT(crossed, 3000);
}

// What doubles decide is right for every point within the error.
TEST(CrossedWays, FromRoundedPoints) {
    Corners corners(20261202);
    int decided = 0;
    int undecided = 0;
    for (int round = 0; round < 30000; ++round) {
        const int exponent = static_cast<int>(corners.source().between(-18, 47));
        const PrismSideFace w = side_face(corners.next(exponent), corners.next(exponent));
        const FlatCorner p = corners.next(exponent);
        const std::array<double, 2> at{p.u.to_double(), p.v.to_double()};
        const double error =
            round % 2 == 0 ? 0 : std::ldexp(1.0, exponent - static_cast<int>(round % 53));
        const std::optional<bool> found = crosses_way(w, at, error);
        if (!found) {
            ++undecided;
            continue;
        }
        ++decided;
        for (const int du : {-1, 0, 1})
            for (const int dv : {-1, 0, 1}) {
                const Flat q{rational(p.u) + du * mpq_class(error),
                             rational(p.v) + dv * mpq_class(error)};
                ASSERT_EQ(*found, oracle(w, q));
            }
    }
    EXPECT_GT(decided, 5000);
    EXPECT_GT(undecided, 1000);
}

// Reference points may have a coordinate of a corner, where that is a multiple of 1/64.
TEST(CrossedWays, FromPointsOfThePartition) {
    Corners corners(20261203);
    oracle::Source& source = corners.source();
    int equal = 0;
    int crossed = 0;
    for (int round = 0; round < 30000; ++round) {
        const int exponent = static_cast<int>(source.between(-9, 50));
        const PrismSideFace w = side_face(corners.next(exponent), corners.next(exponent));
        const auto position = [&] {
            const double grid = std::ldexp(static_cast<double>(source.between(-6, 6)), exponent);
            return static_cast<std::int64_t>(std::floor(grid * dyadic_scale)) * 3 +
                   (source.below(3) == 0 ? source.between(-2, 2) : 0);
        };
        const FlatFinePoint p{position(), position()};
        const Flat exact{mpq_class(static_cast<long>(p[0]), splitting_scale),
                         mpq_class(static_cast<long>(p[1]), splitting_scale)};
        const bool expected = oracle(w, exact);
        crossed += expected ? 1 : 0;
        ASSERT_EQ(crosses_way(w, p), expected);
        for (const Coordinate c : {w.from.u, w.from.v, w.to.u, w.to.v}) {
            const int sign = cmp(rational(c) * splitting_scale, mpq_class(static_cast<long>(p[1])));
            equal += sign == 0 ? 1 : 0;
            ASSERT_EQ(compare(c, p[1]), (sign > 0) - (sign < 0));
        }
    }
    EXPECT_GT(equal, 500);
    EXPECT_GT(crossed, 3000);
}

}  // namespace
}  // namespace crossed_ways_test
