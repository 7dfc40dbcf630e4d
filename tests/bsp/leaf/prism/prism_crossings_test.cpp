// SPDX-License-Identifier: Apache-2.0
//
// Places where side faces cross, some of which are the same or next to each other, against
// rationals.

#include <trisect/bsp/leaf/prism/prism_crossings.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "support/gmp_oracle.h"

namespace prism_crossings_test {
namespace {

using namespace trisect::detail;
using trisect::Coordinate;

struct Flat {
    mpq_class u;
    mpq_class v;
};

Flat rational(const FlatCorner& p) {
    return {mpq_class(p.u.to_double()), mpq_class(p.v.to_double())};
}

mpq_class turn(const Flat& a, const Flat& b, const Flat& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// The part of the way along a side face where another one crosses it.
mpq_class place(const PrismSideFace& on, const PrismSideFace& other) {
    const mpq_class from = turn(rational(other.from), rational(other.to), rational(on.from));
    const mpq_class to = turn(rational(other.from), rational(other.to), rational(on.to));
    return from / (from - to);
}

bool do_cross(const PrismSideFace& a, const PrismSideFace& b) {
    const auto are_apart = [](const PrismSideFace& of, const PrismSideFace& ends) {
        return sgn(turn(rational(of.from), rational(of.to), rational(ends.from))) *
                   sgn(turn(rational(of.from), rational(of.to), rational(ends.to))) <
               0;
    };
    return are_apart(a, b) && are_apart(b, a);
}

PrismSideFace side_face(LeafIndex operand, const FlatCorner& a, const FlatCorner& b) {
    PrismSideFace out;
    out.operand = operand;
    out.from = std::min(a, b);
    out.to = std::max(a, b);
    out.hi = Coordinate(1);
    return out;
}

struct Counts {
    int crossings = 0;
    int equal = 0;  // neighbours at one place
    int near = 0;   // others that doubles do not tell apart
};

// False when side faces touch.
bool check(const std::vector<PrismSideFace>& side_faces, Counts& counts) {
    const EvaluateSettings options;
    LeafProblem problem;
    problem.options = &options;
    EvaluateStats stats;
    PrismCrossings crossings;
    if (!crossings.find(problem, side_faces, stats)) return false;
    bool coincide = false;
    for (std::size_t i = 0; i < side_faces.size(); ++i) {
        const auto found = crossings.of(static_cast<LeafIndex>(i));
        std::size_t expected = 0;
        for (std::size_t j = 0; j < side_faces.size(); ++j)
            expected += j != i && do_cross(side_faces[i], side_faces[j]) ? 1 : 0;
        EXPECT_EQ(found.size(), expected);
        std::optional<mpq_class> before;
        for (std::size_t k = 0; k < found.size(); ++k) {
            const mpq_class at = place(side_faces[i], side_faces[as_index(found[k].side_face)]);
            EXPECT_LE(abs(at - mpq_class(found[k].at)), mpq_class(place_error));
            ++counts.crossings;
            if (before) {
                EXPECT_LE(*before, at);
                EXPECT_EQ(crossings.compare(found[k - 1], found[k]), *before < at ? -1 : 0);
                EXPECT_EQ(crossings.compare(found[k], found[k - 1]), *before < at ? 1 : 0);
                coincide = coincide || *before == at;
                counts.equal += *before == at ? 1 : 0;
                counts.near += *before < at && at - *before < 0x1p-36 ? 1 : 0;
            }
            before = at;
        }
    }
    EXPECT_EQ(crossings.any_coincide(), coincide);
    return true;
}

// Side faces through one point, some of them a unit off at an end.
TEST(PrismCrossings, NextToOnePoint) {
    for (const int bits : {0, 1, 30, 50, 73}) {
        oracle::Source source(20261204 + static_cast<std::uint64_t>(bits));
        Counts counts;
        for (int round = 0; round < 400; ++round) {
            const auto coordinate = [&](std::int64_t v) {
                return Coordinate(std::ldexp(static_cast<double>(v), -bits));
            };
            const std::int64_t u = source.coordinate(51);
            const std::int64_t v = source.coordinate(51);
            const int reach = static_cast<int>(source.between(4, 40));
            std::vector<PrismSideFace> side_faces;
            for (LeafIndex o = 0; o < 6; ++o) {
                const std::int64_t du = source.coordinate(reach);
                const std::int64_t dv = source.coordinate(reach);
                const std::int64_t s = source.between(1, 500);
                const std::int64_t t = source.between(1, 500);
                const std::int64_t off = source.below(3) == 0 ? 1 : 0;
                side_faces.push_back(
                    side_face(o, {coordinate(u - s * du), coordinate(v - s * dv)},
                              {coordinate(u + t * du + off), coordinate(v + t * dv)}));
            }
            (void)check(side_faces, counts);
        }
        EXPECT_GT(counts.crossings, 3000) << bits;
        EXPECT_GT(counts.equal, 300) << bits;
        EXPECT_GT(counts.near, 300) << bits;
    }
}

// Corners with up to 53 bits before the point and 73 behind it.
TEST(PrismCrossings, CoordinatesOfAllSizes) {
    oracle::Source source(20261205);
    Counts counts;
    int touching = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<PrismSideFace> side_faces;
        const auto corner = [&] {
            return FlatCorner{Coordinate(source.fraction(53, 73)),
                              Coordinate(source.fraction(53, 73))};
        };
        for (LeafIndex o = 0; o < 8; ++o) side_faces.push_back(side_face(o, corner(), corner()));
        touching += check(side_faces, counts) ? 0 : 1;
    }
    EXPECT_LT(touching, 100);
    EXPECT_GT(counts.crossings, 1000);
    EXPECT_GT(counts.near, 10);
}

}  // namespace
}  // namespace prism_crossings_test
