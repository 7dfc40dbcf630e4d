// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/hull_of_solids.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include <array>

#include "support/solids.h"

namespace trisect {
namespace {

using solids::box;

TEST(HullOfSolids, OfSolidsTogether) {
    const std::array solids{box({0, 0, 0}, {1, 1, 1}), box({3, 0, 0}, {4, 1, 1})};
    EXPECT_EQ(exact_volume(hull(solids)).to_string(), "4");
    EXPECT_EQ(exact_volume(hull(solids[0])).to_string(), "1");
}

TEST(HullOfSolids, CornersOfADifference) {
    const Solid cut = evaluate(box({0, 0, 0}, {4, 4, 4}) - box({2, 2, -1}, {5, 5, 5}));
    // A square without one of its corners, four high.
    EXPECT_EQ(exact_volume(hull(cut)).to_string(), "56");
}

TEST(HullOfSolids, NothingIsEmpty) {
    EXPECT_TRUE(hull(Solid()).is_empty());
    EXPECT_TRUE(hull(std::span<const Solid>()).is_empty());
    EXPECT_THROW((void)hull(Solid::half_space({0, 0, 1, 0})), UnsupportedError);
}

}  // namespace
}  // namespace trisect
