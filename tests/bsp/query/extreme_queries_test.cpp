// SPDX-License-Identifier: Apache-2.0
//
// Queries with coordinates that doubles hardly hold, with rationals, about half-spaces, and queries
// that are refused.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::BrepIndex;
using trisect::ExactRational;
using trisect::Expression;
using trisect::LatticePoint;
using trisect::Location;
using trisect::Plane;
using trisect::PlaneRelation;
using trisect::Ray;
using trisect::Segment;
using trisect::Solid;
using trisect::UsageError;
using Rational3 = std::array<ExactRational, 3>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();

BrepIndex cube() { return BrepIndex(Solid::from_mesh(trisect::make_box({0, 0, 0}, {4, 4, 4}))); }

Location location(const BrepIndex& index, const std::array<double, 3>& point) {
    return index.locate(point).location;
}

ExactRational part(std::int64_t a, std::int64_t b) { return ExactRational(a) / ExactRational(b); }

TEST(ExtremeQueries, PointsFarOffAndHardlyOff) {
    const BrepIndex index = cube();
    EXPECT_EQ(location(index, {largest, 1, 1}), Location::Outside);
    EXPECT_EQ(location(index, {1, -largest, largest}), Location::Outside);
    EXPECT_EQ(location(index, {-least, 1, 1}), Location::Outside);
    EXPECT_EQ(location(index, {least, 1, 1}), Location::Inside);
    EXPECT_EQ(location(index, {0, least, 1}), Location::OnFace);
    EXPECT_EQ(location(index, {0, least, 4}), Location::OnEdge);
    EXPECT_EQ(location(index, {-0.0, 4, 4}), Location::OnVertex);
    EXPECT_EQ(index.nearest({1, 1, -least})->squared_distance,
              ExactRational(1).scaled(-1074) * ExactRational(1).scaled(-1074));
    EXPECT_EQ(index.nearest({1, 1, largest})->place.location, Location::OnFace);
    // Their squares are no doubles: bounds may be infinite, not wrong.
    const auto bounds = index.distance({1, 1, 0x1p700});
    ASSERT_TRUE(bounds);
    EXPECT_LE(bounds->lo, 0x1p700);
    EXPECT_GE(bounds->hi, 0x1p700);
}

TEST(ExtremeQueries, RationalPoints) {
    const BrepIndex index = cube();
    const ExactRational third = part(1, 3);
    EXPECT_EQ(index.locate(Rational3{third, third, third}).location, Location::Inside);
    EXPECT_EQ(index.locate(Rational3{third, third, 4}).location, Location::OnFace);
    EXPECT_EQ(index.locate(Rational3{0, third, 4}).location, Location::OnEdge);
    EXPECT_EQ(index.locate(Rational3{0, 4, 4}).location, Location::OnVertex);
    const ExactRational a_bit = ExactRational(1).scaled(-3000);
    EXPECT_EQ(index.locate(Rational3{third, third, -a_bit}).location, Location::Outside);
    EXPECT_EQ(index.locate(Rational3{third, third, a_bit}).location, Location::Inside);
    EXPECT_EQ(index.locate(Rational3{third, a_bit, 0}).location, Location::OnFace);
    const ExactRational huge = ExactRational(1).scaled(3000);
    EXPECT_EQ(index.locate(Rational3{huge, third, third}).location, Location::Outside);
    EXPECT_EQ(index.locate(Rational3{third, -huge, huge}).location, Location::Outside);
}

// Parameters are exact whatever the length of the direction.
TEST(ExtremeQueries, RaysOfAnyLength) {
    const BrepIndex index = cube();
    for (const int e : {-1060, -700, -60, 0, 60, 700, 1020}) {
        const double d = std::ldexp(1.0, e);
        const auto hits = index.all_hits(Ray{{-3, 1, 2}, {d, 0, 0}});
        ASSERT_EQ(hits.size(), 2U) << e;
        EXPECT_EQ(hits[0].enter.exact(), ExactRational(3).scaled(-e)) << e;
        EXPECT_EQ(hits[1].enter.exact(), ExactRational(7).scaled(-e)) << e;
        EXPECT_EQ(hits[0].place.location, Location::OnFace);
        EXPECT_TRUE(hits[0].enter < hits[1].enter);
        EXPECT_EQ(index.first_hit(Ray{{-3, 1, 2}, {d, 0, 0}})->enter, hits[0].enter);
        EXPECT_FALSE(index.first_hit(Ray{{-3, 1, 2}, {-d, 0, 0}}));
        // Askew, through an edge and the opposite one.
        const auto askew = index.all_hits(Ray{{-2, -2, 1}, {d, d, 0}});
        ASSERT_EQ(askew.size(), 2U) << e;
        EXPECT_EQ(askew[0].place.location, Location::OnEdge) << e;
        EXPECT_EQ(askew[1].enter.exact(), ExactRational(6).scaled(-e)) << e;
    }
    const auto across = index.all_hits(Segment{{-largest, 1, 1}, {largest, 1, 1}});
    ASSERT_EQ(across.size(), 2U);
    EXPECT_TRUE(across[0].enter < across[1].enter);
    EXPECT_EQ(
        (across[1].enter.exact() - across[0].enter.exact()) * ExactRational::from_double(largest),
        ExactRational(2));
}

// Of a half-space and of what is left of space around the cube: rays go on in them for ever.
TEST(ExtremeQueries, OfHalfSpaces) {
    const auto level = [](std::int64_t z) {
        return Plane::through(LatticePoint{0, 0, z}, LatticePoint{1, 0, z}, LatticePoint{0, 1, z});
    };
    const auto reversed = [](std::int64_t z) {
        return Plane::through(LatticePoint{0, 0, z}, LatticePoint{0, 1, z}, LatticePoint{1, 0, z});
    };
    const Plane slanted =
        Plane::through(LatticePoint{0, 0, 0}, LatticePoint{1, 0, 1}, LatticePoint{0, 1, 0});
    for (const bool turned : {false, true}) {
        const BrepIndex index(Solid::half_space(turned ? reversed(5) : level(5), {}));
        EXPECT_EQ(location(index, {1e200, -3, 5}), Location::OnFace);
        const Location below = location(index, {7, 7, 4});
        EXPECT_NE(below, location(index, {7, 7, 6}));
        EXPECT_EQ(index.relation_to(level(6), {}), PlaneRelation::Below);
        EXPECT_EQ(index.relation_to(reversed(6), {}), PlaneRelation::Above);
        EXPECT_EQ(index.relation_to(level(4), {}), PlaneRelation::Above);
        EXPECT_EQ(index.relation_to(slanted, {}), PlaneRelation::Straddling);
        // It touches its own plane from the side on which it is.
        const bool is_below = below == Location::Inside;
        EXPECT_EQ(index.relation_to(level(5), {}),
                  is_below ? PlaneRelation::TouchingBelow : PlaneRelation::TouchingAbove);
        EXPECT_EQ(index.relation_to(reversed(5), {}),
                  is_below ? PlaneRelation::TouchingAbove : PlaneRelation::TouchingBelow);
        EXPECT_EQ(index.in_box({0, 0, 0}, {9, 9, 9}).faces.size(), 1U);
        EXPECT_EQ(index.in_box({0, 0, 5}, {9, 9, 9}).faces.size(), 1U);
        EXPECT_TRUE(index.in_box({0, 0, 0}, {9, 9, 4.5}).faces.empty());
        EXPECT_TRUE(index.in_box({-1e30, 0, 5.5}, {1e30, 9, 9}).faces.empty());
        const auto along = index.all_hits(Ray{{1, 2, 5}, {1, 1, 0}});
        ASSERT_EQ(along.size(), 1U);
        EXPECT_TRUE(along[0].is_interval);
        EXPECT_TRUE(along[0].leave.is_infinite());
        EXPECT_EQ(along[0].place.location, Location::OnFace);
        EXPECT_TRUE(along[0].enter < along[0].leave);
        const auto down = index.first_hit(Ray{{1e100, 2, 25}, {0, 0, -4}});
        ASSERT_TRUE(down);
        EXPECT_EQ(down->enter.exact(), ExactRational(5));
        EXPECT_FALSE(index.first_hit(Ray{{0, 0, 25}, {1, 1, 0}}));
        EXPECT_EQ(index.nearest({3, 4, 8})->squared_distance, ExactRational(9));
        // As far off as that it is the same.
        EXPECT_EQ(index.nearest({1e100, -1e200, 8})->squared_distance, ExactRational(9));
        EXPECT_EQ(index.in_box({1e30, 0, 0}, {1e31, 9, 9}).faces.size(), 1U);
        EXPECT_EQ(location(index, {1e30, -1e30, 5}), Location::OnFace);
        EXPECT_EQ(location(index, {1e30, -1e30, 4}), below);
    }
    EXPECT_EQ(BrepIndex(Solid::whole_space()).relation_to(level(0), {}), PlaneRelation::Empty);
    EXPECT_EQ(location(BrepIndex(Solid::whole_space()), {9, 9, 9}), Location::Inside);
    EXPECT_EQ(BrepIndex(Solid()).relation_to(level(0), {}), PlaneRelation::Empty);

    const BrepIndex around(
        evaluate(~Expression(Solid::from_mesh(trisect::make_box({0, 0, 0}, {4, 4, 4})))));
    EXPECT_EQ(location(around, {largest, 0, 0}), Location::Inside);
    EXPECT_EQ(location(around, {2, 2, 2}), Location::Outside);
    std::vector<std::array<double, 3>> points{{9e99, 1, 1}, {2, 2, 2}, {2, 2, 4}, {least, 2, 2}};
    std::vector<Location> found(points.size());
    around.classify(points, found);
    EXPECT_EQ(found, (std::vector{Location::Inside, Location::Outside, Location::OnFace,
                                  Location::Outside}));
}

TEST(ExtremeQueries, WhatIsRefused) {
    const BrepIndex index = cube();
    const auto refused = [](const auto& query) { EXPECT_THROW((void)query(), UsageError); };
    for (const double x : {infinity, -infinity, not_a_number}) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<double, 3> p{1, 1, 1};
            p[k] = x;
            refused([&] { return index.locate(p); });
            refused([&] { return index.nearest(p); });
            refused([&] { return index.distance(p); });
            refused([&] { return index.signed_distance(p); });
            refused([&] { return index.cell_at(p); });
            refused([&] { return index.first_hit(Ray{p, {1, 0, 0}}); });
            refused([&] { return index.first_hit(Ray{{1, 1, 1}, p}); });
            refused([&] { return index.all_hits(Segment{p, {1, 2, 0}}); });
            refused([&] { return index.all_hits(Segment{{1, 2, 0}, p}); });
            refused([&] { return index.in_box(p, {9, 9, 9}); });
            refused([&] { return index.locate(std::vector{p}); });
        }
    }
    refused([&] { return index.first_hit(Ray{{1, 1, 1}, {0, 0, 0}}); });
    refused([&] { return index.first_facet(Segment{{1, 1, 1}, {1, 1, 1}}); });
    refused([&] { return index.in_box({2, 0, 0}, {1, 9, 9}); });
    const std::vector<std::array<double, 3>> two(2);
    std::vector<Location> one(1);
    EXPECT_THROW(index.classify(two, one), UsageError);
}

TEST(ExtremeQueries, NamesOfLocations) {
    EXPECT_STREQ(to_string(Location::Outside), "outside");
    EXPECT_STREQ(to_string(Location::OnFace), "face");
    EXPECT_STREQ(to_string(Location::OnEdge), "edge");
    EXPECT_STREQ(to_string(Location::OnVertex), "vertex");
    EXPECT_STREQ(to_string(Location::Inside), "inside");
}

}  // namespace
