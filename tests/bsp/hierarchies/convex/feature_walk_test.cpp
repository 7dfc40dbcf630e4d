// SPDX-License-Identifier: Apache-2.0
//
// Closest features by walking against all pairs of features, from any start and along motions.

#include <trisect/bsp/hierarchies/convex/feature_walk.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <trisect/bsp/hierarchies/convex/convex_hull.h>

#include "support/convex_oracle.h"

namespace {

using convex_oracle::Engine;
using convex_oracle::Scene;
using trisect::ExactRational;
using trisect::LatticePoint;
using trisect::Pose;
using trisect::hierarchies::CommonFrame;
using trisect::hierarchies::convex_hull;
using trisect::hierarchies::ConvexPolytope;
using trisect::hierarchies::FeaturePair;
using trisect::hierarchies::FeatureWalk;
using trisect::hierarchies::PolytopeFeature;
using trisect::hierarchies::WalkCounts;

CommonFrame frame_of(const ConvexPolytope& a, const Pose& pose_a, const ConvexPolytope& b,
                     const Pose& pose_b) {
    return {pose_a, a.lattice(), a.largest(), pose_b, b.lattice(), b.largest()};
}

std::vector<PolytopeFeature> features(const ConvexPolytope& p) {
    std::vector<PolytopeFeature> r;
    for (std::size_t i = 0; i < p.vertices().size(); ++i) r.push_back(PolytopeFeature::vertex(i));
    for (std::size_t i = 0; i < p.edges().size(); ++i) r.push_back(PolytopeFeature::edge(i));
    for (std::size_t i = 0; i < p.face_count(); ++i) r.push_back(PolytopeFeature::face(i));
    return r;
}

void expect_right(const ConvexPolytope& a, const Pose& pose_a, const ConvexPolytope& b,
                  const Pose& pose_b, FeatureWalk& walk) {
    const Scene scene(a, pose_a, b, pose_b);
    // Both answers are proved, so neither can stand for the other.
    if (walk.closest().meet) {
        EXPECT_TRUE(scene.proves_meeting(walk.closest().pair));
        EXPECT_EQ(walk.squared_distance().sign(), 0);
        return;
    }
    const Scene::Least least = scene.least();
    EXPECT_EQ(walk.squared_distance(), least.squared);
    EXPECT_TRUE(scene.proves_least(walk.closest().pair, least.squared));
    EXPECT_EQ(walk.smallest_pair(), least.pair);
    const FeatureWalk::Bounds bounds = walk.bounds();
    const auto square = [](double v) {
        return ExactRational::from_double(v) * ExactRational::from_double(v);
    };
    EXPECT_LE(square(bounds.lower), least.squared);
    EXPECT_GE(square(bounds.upper), least.squared);
    EXPECT_LE(bounds.upper - bounds.lower, 1e-6 * bounds.upper);
}

TEST(FeatureWalk, RandomPolytopesOnASmallGridAgainstAllPairsOfFeatures) {
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        SCOPED_TRACE(seed);
        Engine engine(seed);
        const ConvexPolytope a = convex_oracle::random_polytope(engine, 4);
        const ConvexPolytope b = convex_oracle::random_polytope(engine, 4);
        const Pose pose_a = convex_oracle::random_pose(engine, 8);
        const Pose pose_b = convex_oracle::random_pose(engine, 8);
        const CommonFrame frame = frame_of(a, pose_a, b, pose_b);
        FeatureWalk walk(a, b, frame);
        walk.run();
        expect_right(a, pose_a, b, pose_b, walk);
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(FeatureWalk, EveryStartEndsAtTheSameDistanceAndTheSameSmallestPair) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        Engine engine(seed);
        const ConvexPolytope a = convex_oracle::random_polytope(engine, 3);
        const ConvexPolytope b = convex_oracle::random_polytope(engine, 3);
        const Pose pose_a = convex_oracle::random_pose(engine, 5);
        const Pose pose_b = convex_oracle::random_pose(engine, 5);
        const CommonFrame frame = frame_of(a, pose_a, b, pose_b);
        FeatureWalk first(a, b, frame);
        first.run();
        const ExactRational distance = first.squared_distance();
        const FeaturePair pair = first.smallest_pair();
        const auto of_a = features(a);
        const auto of_b = features(b);
        for (std::size_t i = 0; i < of_a.size(); ++i)
            for (std::size_t j = i % 3; j < of_b.size(); j += 3) {
                FeatureWalk walk(a, b, frame);
                walk.run({of_a[i], of_b[j]});
                ASSERT_EQ(walk.closest().meet, first.closest().meet);
                ASSERT_EQ(walk.squared_distance(), distance);
                if (!walk.closest().meet) {
                    ASSERT_EQ(walk.smallest_pair(), pair);
                }
            }
    }
}

ConvexPolytope box(int x, int y, int z) {
    std::vector<LatticePoint> p;
    for (unsigned i = 0; i < 8; ++i)
        p.push_back({(i & 1U) != 0 ? x : -x, (i & 2U) != 0 ? y : -y, (i & 4U) != 0 ? z : -z});
    return convex_hull(p, {});
}

// Points near a sphere.
ConvexPolytope ball(std::uint64_t seed, int count, int radius) {
    Engine engine(seed);
    std::normal_distribution<double> normal;
    std::vector<LatticePoint> p;
    while (static_cast<int>(p.size()) < count) {
        const std::array<double, 3> v{normal(engine), normal(engine), normal(engine)};
        const double n = std::hypot(v[0], v[1], v[2]);
        const auto c = [&](double t) { return std::llround(t / n * radius); };
        p.push_back({c(v[0]), c(v[1]), c(v[2])});
    }
    return convex_hull(p, {});
}

// Follows a motion, comparing every frame.
WalkCounts track(const ConvexPolytope& a, const ConvexPolytope& b, int frames,
                 const std::function<std::array<Pose, 2>(int)>& poses) {
    WalkCounts counts;
    FeaturePair pair;
    for (int i = 0; i < frames; ++i) {
        const auto [pose_a, pose_b] = poses(i);
        const CommonFrame frame = frame_of(a, pose_a, b, pose_b);
        FeatureWalk walk(a, b, frame, &counts);
        pair = walk.run(pair).pair;
        SCOPED_TRACE(i);
        expect_right(a, pose_a, b, pose_b, walk);
        if (::testing::Test::HasFailure()) break;
    }
    return counts;
}

TEST(FeatureWalk, TumblingPastEachOtherAndThroughEqualsAllPairsOnEveryFrame) {
    const ConvexPolytope a = ball(1, 40, 1000);
    const ConvexPolytope b = ball(2, 60, 800);
    const WalkCounts counts = track(a, b, 400, [](int i) {
        const double x = 20.0 * (i - 200);
        return std::array{Pose::from_quaternion({1000, i, 2 * i, -i}),
                          Pose::from_quaternion({1000, -3 * i, i, i}, {x, 1500, 0.125 * x})};
    });
    EXPECT_EQ(counts.walks, 400U);
    // Nearly constant: about a step a frame.
    EXPECT_LT(counts.steps, 2 * counts.walks);
}

TEST(FeatureWalk, SlidingAlongParallelFacesAndEdgesEqualsAllPairsOnEveryFrame) {
    const ConvexPolytope a = box(40, 30, 20);
    const ConvexPolytope b = box(10, 20, 15);
    // Along the top, one apart, then down until it touches, then across an edge, then flush along
    // a side; a quarter turn of both in between keeps everything parallel.
    const WalkCounts counts = track(a, b, 400, [](int i) {
        std::array<double, 3> at{-60.0 + i, 0, 36};
        if (i >= 100) at = {40.0, 0, 36.0 - (i - 100) / 16.0};
        if (i >= 200) at = {40.0 + (i - 200) / 4.0, (i - 200) / 2.0, 35};
        if (i >= 300) at = {50.0 + (i - 300) % 2, -60.0 + (i - 300), 0};
        const std::array<std::int64_t, 4> turn{1, i % 2, 0, 0};
        const Pose both = Pose::from_quaternion(turn, {7, 8, 9});
        return std::array{both, both * Pose::from_translation(at)};
    });
    EXPECT_LT(counts.steps, 3 * counts.walks);
}

TEST(FeatureWalk, DimensionsBelowThree) {
    const auto hull = [](std::vector<LatticePoint> p) { return convex_hull(p, {}); };
    const std::vector<ConvexPolytope> all{hull({{0, 0, 0}}), hull({{0, 0, 0}, {4, 0, 0}}),
                                          hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}), box(2, 2, 2)};
    for (const auto& a : all)
        for (const auto& b : all)
            for (int x = -6; x <= 6; ++x)
                for (int z = -3; z <= 3; ++z) {
                    const Pose pose_b = Pose::from_translation({x + 0.5 * (z % 2), 1, 1.0 * z});
                    const CommonFrame frame = frame_of(a, Pose(), b, pose_b);
                    FeatureWalk walk(a, b, frame);
                    walk.run();
                    expect_right(a, Pose(), b, pose_b, walk);
                }
}

TEST(FeatureWalk, PosesOfAllBitsFarFromTheOrigin) {
    const ConvexPolytope a = ball(3, 30, 1 << 20);
    const ConvexPolytope b = ball(4, 30, 1 << 20);
    Engine engine(5);
    std::uniform_real_distribution<double> any(-1, 1);
    FeaturePair pair;
    for (int i = 0; i < 40; ++i) {
        std::array<std::array<double, 12>, 2> rows{};
        for (auto& r : rows)
            for (std::size_t k = 0; k < 12; ++k)
                r[k] = any(engine) * (k % 4 == 3 ? 3e6 : 1) + (k % 4 == 3 ? 1e9 : 0);
        const Pose pose_a = Pose::from_doubles(rows[0]);
        const Pose pose_b = Pose::from_doubles(rows[1]);
        const CommonFrame frame = frame_of(a, pose_a, b, pose_b);
        FeatureWalk walk(a, b, frame);
        pair = walk.run(pair).pair;
        const Scene scene(a, pose_a, b, pose_b);
        EXPECT_TRUE(walk.closest().meet ? scene.proves_meeting(pair)
                                        : scene.proves_least(pair, walk.squared_distance()));
    }
}

TEST(FeatureWalk, DistancesInTheLatticeOfA) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Engine engine(seed);
        const ConvexPolytope a = convex_oracle::random_polytope(engine, 4);
        const ConvexPolytope b = convex_oracle::random_polytope(engine, 4);
        const Pose pose_a = convex_oracle::random_pose(engine, 8);
        const Pose pose_b = convex_oracle::random_pose(engine, 8);
        const CommonFrame frame = CommonFrame::in_lattice_of_a(pose_a, a.lattice(), a.largest(),
                                                               pose_b, b.lattice(), b.largest());
        FeatureWalk walk(a, b, frame);
        walk.run();
        SCOPED_TRACE(seed);
        expect_right(a, Pose(), b, pose_a.inverse() * pose_b, walk);
    }
}

}  // namespace
