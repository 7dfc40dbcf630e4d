// SPDX-License-Identifier: Apache-2.0
//
// What is said to be a pose by doubles is one exactly; nearly all poses of parts are found so.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <trisect/kernel/error.h>
#include <trisect/kernel/pose.h>

#include "trisect/clash_files.h"

namespace {

using Numbers = std::array<double, 12>;
using trisect::app::is_pose_for_certain;

bool is_pose(const Numbers& numbers) {
    try {
        (void)trisect::Pose::from_doubles(numbers);
        return true;
    } catch (const trisect::Error&) {
        return false;
    }
}

TEST(PoseForCertain, UsualOnes) {
    EXPECT_TRUE(is_pose_for_certain({1, 0, 0, 200.1, 0, 1, 0, -3e6, 0, 0, 1, 0}));
    EXPECT_TRUE(is_pose_for_certain({0.6, -0.8, 0, 1, 0.8, 0.6, 0, 1, 0, 0, -1, 1e-9}));
    EXPECT_TRUE(is_pose_for_certain({0, 1e-3, 0, 1, 0, 0, 1e-3, 1, 1e-3, 0, 0, 1}));
}

TEST(PoseForCertain, NoneOfThese) {
    const double infinite = std::numeric_limits<double>::infinity();
    for (const Numbers& numbers : {Numbers{}, Numbers{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0},
                                   Numbers{0.1, 0.2, 0, 0, 0.3, 0.6, 0, 0, 0, 0, 1, 0},
                                   Numbers{1, 0, 0, infinite, 0, 1, 0, 0, 0, 0, 1, 0},
                                   Numbers{1, 0, 0, 1e300, 0, 1, 0, 1e-300, 0, 0, 1, 0},
                                   Numbers{1, 0, 0, std::nan(""), 0, 1, 0, 0, 0, 0, 1, 0}})
        EXPECT_FALSE(is_pose_for_certain(numbers));
}

TEST(PoseForCertain, IsOneExactly) {
    std::mt19937 random(27);
    std::uniform_int_distribution<int> small(-2, 2);
    std::uniform_real_distribution<double> real(-1, 1);
    std::uniform_int_distribution<int> power(-80, 80);
    int certain = 0;
    for (int i = 0; i < 20000; ++i) {
        Numbers numbers{};
        for (double& v : numbers)
            v = i % 3 == 0 ? small(random)
                           : std::ldexp(real(random), i % 3 == 1 ? 0 : power(random));
        // Nearly singular: a row is a multiple of another one, but for the last digits.
        if (i % 5 == 0)
            for (std::size_t j = 0; j < 3; ++j)
                numbers[8 + j] = 3 * numbers[j] * (1 + (i % 2) * 1e-15 * real(random));
        if (!is_pose_for_certain(numbers)) continue;
        ++certain;
        EXPECT_TRUE(is_pose(numbers));
    }
    EXPECT_GT(certain, 8000);
}

}  // namespace
