// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/trimmed.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include "support/solids.h"

namespace trisect {
namespace {

TEST(Trimmed, KeepsTheSideOfTheNormal) {
    const Solid box = solids::box({0, 0, 0}, {2, 2, 2});
    EXPECT_EQ(bounds(trimmed(box, {0, 0, 1, -0.5})), (Bounds{{0, 0, 0.5}, {2, 2, 2}}));
    EXPECT_EQ(bounds(trimmed(box, {0, 0, -1, 0.5})), (Bounds{{0, 0, 0}, {2, 2, 0.5}}));
    EXPECT_EQ(exact_volume(trimmed(box, {1, 1, 1, -1})).to_string(), "47/6");
    EXPECT_TRUE(trimmed(box, {0, 0, 1, -2}).is_empty());
    EXPECT_TRUE(evaluate(trimmed(box, {0, 0, 1, 0}) ^ box).is_empty());
    EXPECT_THROW((void)trimmed(box, {0, 0, 0, 1}), UsageError);
}

}  // namespace
}  // namespace trisect
