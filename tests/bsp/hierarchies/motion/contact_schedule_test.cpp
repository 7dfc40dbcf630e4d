// SPDX-License-Identifier: Apache-2.0
//
// A schedule against looking at all pairs at every moment.

#include <trisect/bsp/hierarchies/motion/contact_schedule.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <trisect/bsp/hierarchies/convex/feature_walk.h>
#include <trisect/kernel/error.h>

#include "support/convex_oracle.h"
#include "support/lattice_arithmetic.h"

namespace {

using namespace trisect::hierarchies;
using convex_oracle::Engine;
using trisect::Pose;
using trisect::UsageError;
using trisect::detail::BodyBox;

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

BodyBox box_of(const ConvexPolytope& p) {
    BodyBox r;
    for (std::size_t k = 0; k < 3; ++k) {
        r.lo[k] = std::numeric_limits<double>::infinity();
        r.hi[k] = -r.lo[k];
        for (const auto& v : p.vertices()) {
            r.lo[k] = std::min(r.lo[k], v[static_cast<int>(k)].to_double());
            r.hi[k] = std::max(r.hi[k], v[static_cast<int>(k)].to_double());
        }
    }
    return r;
}

// Tumbling polytopes that start and stop now and then.
struct Swarm {
    explicit Swarm(std::uint64_t seed, std::uint32_t count) {
        Engine engine(seed);
        const auto any = [&](int reach) {
            return std::uniform_int_distribution(-reach, reach)(engine);
        };
        for (std::uint32_t i = 0; i < count; ++i) {
            polytopes.push_back(convex_oracle::random_polytope(engine, 4));
            at.push_back({any(20), any(20), any(20)});
            way.push_back({any(4), any(4), any(4)});
            turn.push_back({any(3), any(3), any(3)});
        }
    }
    [[nodiscard]] Pose pose(std::uint32_t i, int frame) const {
        std::array<double, 3> t{};
        for (std::size_t k = 0; k < 3; ++k) t[k] = at[i][k] + way[i][k] * frame / 16.0;
        return Pose::from_quaternion(
            {64, turn[i][0] * frame, turn[i][1] * frame, turn[i][2] * frame}, t);
    }
    [[nodiscard]] FeatureWalk::Bounds bounds(std::uint32_t i, std::uint32_t j, int frame,
                                             bool& meet) const {
        const CommonFrame f(pose(i, frame), {}, polytopes[i].largest(), pose(j, frame), {},
                            polytopes[j].largest());
        FeatureWalk walk(polytopes[i], polytopes[j], f);
        meet = walk.run().meet;
        return walk.bounds();
    }

    std::vector<ConvexPolytope> polytopes;
    std::vector<std::array<int, 3>> at;
    std::vector<std::array<int, 3>> way;
    std::vector<std::array<int, 3>> turn;
};

TEST(ContactSchedule, FindsTheContactsOfAllPairsInEveryFrame) {
    constexpr std::uint32_t count = 40;
    constexpr int frames = 60;
    const Swarm swarm(1, count);
    std::vector<double> speeds;
    for (std::uint32_t i = 0; i < count; ++i) {
        double most = 0;
        for (int f = 0; f + 1 < frames; ++f)
            most = std::max(most, displacement_bound(box_of(swarm.polytopes[i]), swarm.pose(i, f),
                                                     swarm.pose(i, f + 1)));
        speeds.push_back(most);
    }
    ContactSchedule schedule(speeds);
    std::size_t tests = 0;
    std::size_t contacts = 0;
    for (int f = 0; f < frames; ++f) {
        Pairs found;
        tests += schedule.due(f, [&](std::uint32_t i, std::uint32_t j) {
            bool meet = false;
            const double d = swarm.bounds(i, j, f, meet).lower;
            if (meet) {
                EXPECT_TRUE(found.insert({i, j}).second);
            }
            return d;
        });
        Pairs all;
        for (std::uint32_t j = 0; j < count; ++j)
            for (std::uint32_t i = 0; i < j; ++i) {
                bool meet = false;
                (void)swarm.bounds(i, j, f, meet);
                if (meet) all.insert({i, j});
            }
        EXPECT_EQ(found, all);
        contacts += all.size();
    }
    EXPECT_GT(contacts, 0U);
    EXPECT_LT(tests, schedule.pair_count() * frames / 4);
}

TEST(ContactSchedule, ABodyThatStartsToMove) {
    // On a line, at 0 and 10; still at first.
    ContactSchedule schedule(std::vector<double>{0, 0});
    double x = 10;
    const auto test = [&](std::uint32_t, std::uint32_t) { return x; };
    EXPECT_EQ(schedule.due(0, test), 1U);
    EXPECT_EQ(schedule.next(), std::numeric_limits<double>::infinity());
    EXPECT_EQ(schedule.due(100, test), 0U);
    schedule.set_speed(1, 2, 100);
    EXPECT_LE(schedule.next(), 105);
    EXPECT_GT(schedule.next(), 104.99);
    x = 2;
    schedule.set_speed(0, 1, 104);  // 2 left, at 3
    EXPECT_LE(schedule.next(), 104 + 2 / 3.0);
    EXPECT_GT(schedule.next(), 104.66);
    x = 0;
    EXPECT_EQ(schedule.due(105, test), 1U);
    // In contact: due in every frame, once.
    EXPECT_EQ(schedule.due(105, test), 1U);
    EXPECT_EQ(schedule.due(106, test), 1U);
}

TEST(ContactSchedule, RefusesWhatHasNoMeaning) {
    const auto zero = [](std::uint32_t, std::uint32_t) { return 0.0; };
    EXPECT_THROW(ContactSchedule(std::vector<double>{-1}), UsageError);
    ContactSchedule schedule(std::vector<double>{1, 1});
    (void)schedule.due(1, zero);
    EXPECT_THROW((void)schedule.due(0, zero), UsageError);
    EXPECT_THROW(schedule.set_speed(2, 1, 1), UsageError);
    EXPECT_EQ(ContactSchedule(std::vector<double>{}).pair_count(), 0U);
}

TEST(ContactSchedule, BoundsOfSpeedAndDisplacementAreAbove) {
    EXPECT_GT(speed_bound({3, 4, 0}, 0, 7), 5);
    EXPECT_GT(speed_bound({0, 0, 0}, 2, 7), 14);
    EXPECT_LT(speed_bound({3, 4, 0}, 2, 7), 19.0001);
    const BodyBox box{{-1, -1, -1}, {1, 1, 1}};
    const double quarter =
        displacement_bound(box, Pose(), Pose::from_quaternion({1, 0, 0, 1}, {0, 0, 5}));
    // The corner (1, 1) goes to (-1, 1), and up by 5.
    EXPECT_GE(quarter, std::sqrt(29.0));
    EXPECT_LT(quarter, std::sqrt(29.0) + 1e-9);
}

}  // namespace
