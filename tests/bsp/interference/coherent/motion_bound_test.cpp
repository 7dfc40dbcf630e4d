// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/coherent/motion_bound.h>

#include <gtest/gtest.h>

#include <cmath>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/support/due_list.h>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Solid;
using trisect::detail::approximate_map;
using trisect::detail::DueList;
using trisect::detail::MotionBound;

double uniform(Random& random) { return static_cast<double>(random.between(-1000, 1000)) / 1000; }

std::array<double, 12> random_rows(Random& random, bool turned) {
    std::array<double, 12> rows{};
    if (turned) {
        rows = Pose::from_quaternion(
                   {random.between(-9, 9), random.between(-9, 9), random.between(-9, 9), 10}, {})
                   .approximate();
    } else {
        for (double& c : rows) c = uniform(random);
        for (std::size_t i = 0; i < 3; ++i) rows[5 * i] += 2;
    }
    for (std::size_t i = 0; i < 3; ++i) rows[4 * i + 3] = 5 * uniform(random);
    return rows;
}

// Whenever a reserve covers new poses, no vertex of B has moved by as much in A's coordinates.
TEST(MotionBound, NoVertexMovesFartherThanACoveredReserve) {
    const InterferenceModel a(Solid::from_mesh(trisect::make_box({1, 2, 3}, {2, 3, 5})));
    const InterferenceModel b(Solid::from_mesh(trisect::make_torus(1, 0.25, 16, 8)));
    Random random(91);
    MotionBound reserve(trisect::detail::data_of(a), trisect::detail::data_of(b));
    int covered = 0;
    double most = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const auto rows_a = random_rows(random, trial % 2 == 0);
        const auto rows_b = random_rows(random, trial % 3 != 0);
        const double size = std::ldexp(1.0, static_cast<int>(random.between(-12, 0)));
        const auto nearby = [&](std::array<double, 12> rows, bool moves) {
            if (moves)
                for (double& c : rows) c += 0.3 * size * uniform(random);
            return Pose::from_doubles(rows);
        };
        const Pose pose_a = Pose::from_doubles(rows_a);
        const Pose pose_b = Pose::from_doubles(rows_b);
        const Pose next_a = nearby(rows_a, trial % 5 < 3);
        const Pose next_b = nearby(rows_b, trial % 5 != 1);
        const auto map = approximate_map(pose_a, a.lattice(), pose_b, b.lattice());
        const auto next = approximate_map(next_a, a.lattice(), next_b, b.lattice());
        const double left = std::ldexp(size, -a.lattice().exponent);
        reserve.set(pose_a, pose_b, map, left);
        EXPECT_TRUE(reserve.covers(pose_a, pose_b));
        if (!reserve.covers(next_a, next_b)) continue;
        ++covered;
        for (const auto& x : trisect::detail::data_of(b).positions) {
            const auto p = map(x);
            const auto q = next(x);
            const double way = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
            ASSERT_LT(way, left) << trial;
            most = std::max(most, way / left);
        }
    }
    EXPECT_GT(covered, 200);
    EXPECT_GT(most, 0.5);
    reserve.clear();
    EXPECT_FALSE(reserve.covers(Pose(), Pose()));
}

TEST(DueList, ReadingsAgainstAPlainArray) {
    Random random(92);
    DueList list;
    std::vector<double> plain;
    double now = 0;
    for (int step = 0; step < 2000; ++step) {
        if (plain.size() < 100 && random.chance(1, 4)) {
            plain.push_back(now + std::abs(uniform(random)));
            list.set(static_cast<std::uint32_t>(plain.size() - 1), plain.back());
        }
        if (!plain.empty() && random.chance(1, 8)) {
            const auto name =
                static_cast<std::uint32_t>(random.between(0, static_cast<int>(plain.size()) - 1));
            plain[name] = DueList::never;
            list.drop(name);
        }
        now += 0.01;
        std::size_t due = 0;
        for (const double d : plain) due += d <= now ? 1 : 0;
        EXPECT_EQ(list.count_due(now), due);
        // Some get a new reading at once, the others afterwards.
        std::vector<std::uint32_t> left{17};
        std::vector<std::uint32_t> kept_due;
        std::size_t looked_at = 0;
        list.take(
            now,
            [&](std::uint32_t name) {
                ++looked_at;
                EXPECT_LE(plain[name], now);
                if (random.chance(1, 2))
                    return plain[name] = now + std::abs(uniform(random)) + 0.001;
                kept_due.push_back(name);
                return random.chance(1, 2) ? now : std::nan("");
            },
            left);
        EXPECT_EQ(looked_at, due);
        EXPECT_EQ(left.front(), 17U);
        left.erase(left.begin());
        EXPECT_EQ(left, kept_due);
        for (const std::uint32_t name : left) {
            EXPECT_EQ(list[name], plain[name]);
            plain[name] = now + std::abs(uniform(random)) + 0.001;
            list.set(name, plain[name]);
        }
        double first = DueList::never;
        for (const double d : plain) first = std::min(first, d);
        EXPECT_LE(list.first(), first);
        EXPECT_GT(list.first(), now);
    }
}

}  // namespace
