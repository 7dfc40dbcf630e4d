// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/projection.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include "support/solids.h"

namespace trisect {
namespace {

using solids::box;

double area_at(const Solid& solid, double height) {
    return volume(solid_of_region(section(solid, height)));
}

TEST(Projection, SectionsHaveTheirHoles) {
    const Solid hollow = evaluate(box({0, 0, -3}, {6, 6, 3}) - box({1, 1, -2}, {5, 5, 2}));
    EXPECT_EQ(area_at(hollow, 0), 20);
    EXPECT_EQ(area_at(hollow, 2.5), 36);
    EXPECT_EQ(area_at(hollow, 4), 0);
}

TEST(Projection, FacesInThePlaneCountOnBothSides) {
    const Solid steps = evaluate(box({0, 0, 0}, {2, 2, 1}) | box({1, 0, -1}, {3, 2, 0}));
    EXPECT_EQ(area_at(steps, 0), 6);
    EXPECT_EQ(area_at(steps, 1), 4);
    EXPECT_EQ(area_at(steps, -1), 4);
}

TEST(Projection, Shadows) {
    const Solid two = evaluate(box({0, 0, 0}, {2, 2, 1}) | box({1, 1, 5}, {3, 3, 9}));
    EXPECT_EQ(exact_volume(shadow(two)).to_string(), "7");
    const Solid ring = evaluate(box({0, 0, 0}, {6, 6, 1}) - box({1, 1, -1}, {5, 5, 2}));
    EXPECT_EQ(exact_volume(shadow(ring)).to_string(), "20");
    EXPECT_TRUE(shadow(Solid()).is_empty());
    const Solid ball = Solid::from_mesh(make_icosphere(1, 3));
    EXPECT_NEAR(volume(shadow(ball)), 3.1416, 0.02);
}

}  // namespace
}  // namespace trisect
