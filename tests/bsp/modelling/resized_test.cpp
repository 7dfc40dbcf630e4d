// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/resized.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>

#include "support/solids.h"

namespace trisect {
namespace {

TEST(Resized, AsOpenScadHasIt) {
    const Solid box = solids::box({1, 1, 1}, {2, 3, 5});  // 1 x 2 x 4
    EXPECT_EQ(bounds(resized(box, {3, 0, 0})), (Bounds{{3, 1, 1}, {6, 3, 5}}));
    EXPECT_EQ(bounds(resized(box, {3, 0, 0}, {true, true, true})), (Bounds{{3, 3, 3}, {6, 9, 15}}));
    EXPECT_EQ(bounds(resized(box, {0, 8, 2}, {true, false, false})),
              (Bounds{{4, 4, 0.5}, {8, 12, 2.5}}));
    EXPECT_EQ(bounds(resized(box, {0, 0, 0}, {true, true, true})), bounds(box));
    EXPECT_TRUE(resized(Solid(), {1, 1, 1}).is_empty());
    EXPECT_THROW((void)resized(box, {std::nan(""), 1, 1}), UsageError);
}

}  // namespace
}  // namespace trisect
