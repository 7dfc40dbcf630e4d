// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/level_set.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/solids.h"

namespace trisect {
namespace {

TEST(LevelSet, IsAnOperandLikeAnyOther) {
    const auto ball = [](const Point3d& p) { return 1 - std::hypot(p[0], p[1], p[2]); };
    const Bounds box{{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}};
    const Solid solid = level_set(ball, box, 0.25);
    const Solid half = evaluate(solid & solids::box({0, -2, -2}, {2, 2, 2}));
    EXPECT_NEAR(volume(half), 2 * std::numbers::pi / 3, 0.05);
    EXPECT_EQ(exact_volume(half) + exact_volume(evaluate(solid - half)), exact_volume(solid));
    const auto many = [&](std::span<const Point3d> places, std::span<double> values) {
        for (std::size_t i = 0; i < places.size(); ++i) values[i] = ball(places[i]);
    };
    EXPECT_EQ(level_set_by_batches(many, box, 0.25).to_mesh(), solid.to_mesh());
    EXPECT_TRUE(level_set([](const Point3d&) { return -1.0; }, box, 1).is_empty());
}

}  // namespace
}  // namespace trisect
