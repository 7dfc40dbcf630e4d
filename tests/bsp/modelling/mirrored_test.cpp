// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/mirrored.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>

#include "support/solids.h"

namespace trisect {
namespace {

Solid part() {
    return evaluate(solids::box({1, 2, 3}, {4, 6, 8}) - solids::box({1, 2, 3}, {2, 3, 4}));
}

TEST(Mirrored, BoxesGoWhereTheyShould) {
    EXPECT_EQ(bounds(mirrored(part(), 0)), (Bounds{{-4, 2, 3}, {-1, 6, 8}}));
    EXPECT_EQ(bounds(mirrored(part(), Point3d{0, -5, 0})), (Bounds{{1, -6, 3}, {4, -2, 8}}));
    EXPECT_EQ(bounds(mirrored(part(), Point3d{1, -1, 0})), (Bounds{{2, 1, 3}, {6, 4, 8}}));
    EXPECT_EQ(bounds(mirrored(part(), {0, 0, 2, -4})), (Bounds{{1, 2, -4}, {4, 6, 1}}));
}

TEST(Mirrored, TwiceIsTheSolid) {
    for (const Point3d& n : {Point3d{1, 0, 0}, {1, 1, 0}, {0, 1, -1}, {-3, 0, 0}}) {
        LatticeReport report;
        const Solid once = mirrored(part(), n, &report);
        EXPECT_TRUE(report.lossless);
        EXPECT_EQ(exact_volume(once), exact_volume(part()));
        EXPECT_TRUE(evaluate(mirrored(once, n) ^ part()).is_empty());
    }
    const Solid tilted = mirrored(part(), {1, 2, 3, -0.5});
    EXPECT_NEAR(volume(tilted), volume(part()), 1e-12);
    EXPECT_NEAR(volume(evaluate(mirrored(tilted, {1, 2, 3, -0.5}) ^ part())), 0, 1e-12);
}

TEST(Mirrored, NamesWhatIsWrong) {
    EXPECT_THROW((void)mirrored(part(), Point3d{0, 0, 0}), UsageError);
    EXPECT_THROW((void)mirrored(part(), Point3d{0, std::nan(""), 1}), UsageError);
    EXPECT_THROW((void)mirrored(part(), 3), UsageError);
    EXPECT_THROW((void)mirror_map({1e-300, 0, 0, 1e300}), UsageError);
    EXPECT_EQ(mirror_map({1e-300, 0, 0, 0}), AffineMap::mirror(0));
    EXPECT_EQ(mirror_map({1e300, 0, 0, 0}), AffineMap::mirror(0));
}

}  // namespace
}  // namespace trisect
