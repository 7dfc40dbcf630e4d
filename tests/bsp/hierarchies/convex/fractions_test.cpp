// SPDX-License-Identifier: Apache-2.0
//
// Hulls and closest features of points whose coordinates have bits behind the point.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/bsp/hierarchies/convex/convex_hull.h>
#include <trisect/bsp/hierarchies/convex/feature_walk.h>

#include "support/convex_oracle.h"
#include "support/fractions.h"

namespace {

using convex_oracle::Engine;
using convex_oracle::Scene;
using trisect::Coordinate;
using trisect::ExactRational;
using trisect::fraction_limit;
using trisect::Lattice;
using trisect::LatticePoint;
using trisect::Pose;
using trisect::hierarchies::CommonFrame;
using trisect::hierarchies::convex_hull;
using trisect::hierarchies::ConvexPolytope;
using trisect::hierarchies::FeatureWalk;
using trisect::test::with_fractions;

constexpr std::array<int, 4> shifts{8, 24, 56, 70};

ConvexPolytope with_fractions(const ConvexPolytope& p, int bits) {
    std::vector<LatticePoint> points;
    for (const LatticePoint& v : p.vertices()) points.push_back(with_fractions(v, bits));
    return convex_hull(points, Lattice{p.lattice().exponent + bits});
}

void expect_the_same_hull(const ConvexPolytope& p, const ConvexPolytope& same) {
    ASSERT_EQ(same.dimension(), p.dimension());
    ASSERT_EQ(same.vertices().size(), p.vertices().size());
    ASSERT_EQ(same.edges().size(), p.edges().size());
    ASSERT_EQ(same.face_count(), p.face_count());
    for (std::size_t f = 0; f < p.face_count(); ++f)
        EXPECT_TRUE(std::ranges::equal(same.corners(f), p.corners(f)));
}

TEST(ConvexFractions, KeepHullsAndClosestFeatures) {
    int apart = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        Engine engine(seed);
        const ConvexPolytope a = convex_oracle::random_polytope(engine, 4);
        const ConvexPolytope b = convex_oracle::random_polytope(engine, 4);
        const Pose pose_a = convex_oracle::random_pose(engine, 8);
        const Pose pose_b = convex_oracle::random_pose(engine, 8);
        const auto walk_of = [&](const ConvexPolytope& x, const ConvexPolytope& y) {
            const CommonFrame frame(pose_a, x.lattice(), x.largest(), pose_b, y.lattice(),
                                    y.largest());
            FeatureWalk walk(x, y, frame);
            const auto end = walk.run();
            return std::tuple(
                end.meet, walk.squared_distance(),
                end.meet ? trisect::hierarchies::FeaturePair{} : walk.smallest_pair());
        };
        const auto expected = walk_of(a, b);
        apart += std::get<0>(expected) ? 0 : 1;
        for (const int bits : shifts) {
            const ConvexPolytope x = with_fractions(a, bits);
            const ConvexPolytope y = with_fractions(b, bits);
            expect_the_same_hull(a, x);
            ASSERT_EQ(walk_of(x, y), expected);
            ASSERT_EQ(walk_of(x, b), expected);  // one has fractions, the other has not
        }
    }
    EXPECT_GT(apart, 20);
}

// Doubles as they come, of every size from 2^-40 to 2^10.
ConvexPolytope uneven_polytope(Engine& engine, double shift) {
    std::uniform_real_distribution<double> anywhere(-1, 1);
    const auto coordinate = [&](double by) {
        const double v = std::ldexp(anywhere(engine), static_cast<int>(engine() % 50) - 40) + by;
        return Coordinate(std::ldexp(std::rint(std::ldexp(v, fraction_limit)), -fraction_limit));
    };
    std::vector<LatticePoint> points;
    const auto count = 1 + engine() % 12;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back({coordinate(shift), coordinate(0), coordinate(0)});
    return convex_hull(points, {});
}

TEST(ConvexFractions, DoublesAsTheyCome) {
    int apart = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(seed);
        Engine engine(seed);
        const ConvexPolytope a = uneven_polytope(engine, 0);
        const ConvexPolytope b = uneven_polytope(engine, seed % 2 == 0 ? 700 : 0.001);
        const Pose pose = convex_oracle::random_pose(engine, 8);
        const CommonFrame frame({}, a.lattice(), a.largest(), pose, b.lattice(), b.largest());
        FeatureWalk walk(a, b, frame);
        walk.run();
        const Scene scene(a, {}, b, pose);
        if (walk.closest().meet) {
            EXPECT_TRUE(scene.proves_meeting(walk.closest().pair));
            EXPECT_EQ(walk.squared_distance().sign(), 0);
            continue;
        }
        ++apart;
        const ExactRational squared = walk.squared_distance();
        EXPECT_TRUE(scene.proves_least(walk.closest().pair, squared));
        const FeatureWalk::Bounds bounds = walk.bounds();
        const auto square = [](double v) {
            return ExactRational::from_double(v) * ExactRational::from_double(v);
        };
        EXPECT_LE(square(bounds.lower), squared);
        EXPECT_GE(square(bounds.upper), squared);
    }
    EXPECT_GT(apart, 30);
}

TEST(ConvexFractions, EnclosingHullsOfPointsThatPlanesName) {
    const LatticePoint o{};
    const auto at = [](double x, double y, double z) {
        return LatticePoint{Coordinate(x), Coordinate(y), Coordinate(z)};
    };
    const std::array corners{at(0x1p-60, 0, 0), at(0, 0x1p-60, 0), at(0, 0, 0x1p-60)};
    std::vector<trisect::Point> points{o, corners[0], corners[1], corners[2]};
    // A third of the way along: no double.
    using trisect::Plane;
    points.emplace_back(Plane::through(o, corners[0], corners[1]),
                        Plane::through(o, corners[0], corners[2]),
                        Plane(Plane::Coefficient(3).shifted_left(60), 0, 0, -1));
    ASSERT_FALSE(points.back().is_lattice());
    const ConvexPolytope hull = trisect::hierarchies::enclosing_hull(points, {});
    EXPECT_TRUE(hull.contains(o));
    for (const LatticePoint& c : corners) EXPECT_TRUE(hull.contains(c));
    for (std::size_t f = 0; f < hull.face_count(); ++f)
        EXPECT_NE(side_of(points.back(), hull.plane(f)), trisect::Side::Above);
    EXPECT_LE(hull.largest(), 0x1p-60);
}

}  // namespace
