// SPDX-License-Identifier: Apache-2.0
//
// Laws of exact volumes: inclusion and exclusion.

#include <gtest/gtest.h>

#include "algebra.h"

namespace {

using algebra::Family;
using algebra::volume;
using trisect::ExactRational;
using trisect::Expression;
using trisect::Solid;

TEST(Volumes, UnionAndIntersectionAddUp) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const auto options = algebra::options_of(seed);
        const Family f(seed, 2);
        const Solid& a = f.solids[0];
        const Solid& b = f.solids[1];
        const ExactRational both = volume(a & b, options);
        EXPECT_EQ(volume(a | b, options) + both, volume(a, options) + volume(b, options));
        EXPECT_EQ(volume(a - b, options) + both, volume(a, options));
        EXPECT_EQ(volume(a ^ b, options), volume(a | b, options) - both);
        EXPECT_EQ(volume(~a, options), -volume(a, options));
        EXPECT_GE(both.sign(), 0);
    }
}

TEST(Volumes, OfAnEmbeddedOperandIsItsMeshs) {
    for (std::uint64_t seed = 3; seed <= 90; seed += 3) {
        SCOPED_TRACE(seed);
        const Family f(seed, 1);
        EXPECT_EQ(volume(f.solids[0]).to_string(),
                  reference::signed_volume(f.operands[0]).get_str());
    }
}

// The volume of the union of all, from the intersections of all subsets.
void check_inclusion_exclusion(std::uint64_t seed, std::size_t count) {
    SCOPED_TRACE(seed);
    const auto options = algebra::options_of(seed);
    const Family f(seed, count);
    const std::vector<Expression> all(f.solids.begin(), f.solids.end());
    ExactRational sum;
    for (std::size_t subset = 1; subset < (std::size_t{1} << count); ++subset) {
        std::vector<Expression> chosen;
        for (std::size_t i = 0; i < count; ++i)
            if ((subset >> i & 1U) != 0) chosen.push_back(all[i]);
        const ExactRational common = volume(Expression::all_of(chosen), options);
        if (chosen.size() % 2 == 1) {
            sum += common;
        } else {
            sum -= common;
        }
    }
    EXPECT_EQ(volume(Expression::any_of(all), options), sum);
}

TEST(Volumes, InclusionAndExclusionOfThree) {
    for (std::uint64_t seed = 100; seed < 125; ++seed) check_inclusion_exclusion(seed, 3);
}

TEST(Volumes, InclusionAndExclusionOfFour) {
    for (std::uint64_t seed = 200; seed < 212; ++seed) check_inclusion_exclusion(seed, 4);
}

}  // namespace
