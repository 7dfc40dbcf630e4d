// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/modelling/offset_of_solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "support/solids.h"

namespace trisect {
namespace {

using Shape = SolidOffsetOptions::Shape;
using Fit = SolidOffsetOptions::Fit;

/// An L of two boxes: not convex.
Solid bracket() {
    return evaluate(solids::box({0, 0, 0}, {4, 1, 1}) | solids::box({0, 0, 0}, {1, 1, 4}));
}

TEST(OffsetOfSolid, CubesAndOctahedraAreExact) {
    const Solid box = solids::box({0, 0, 0}, {1, 2, 3});
    EXPECT_EQ(solids::volume(offset_of_solid(box, 0.5, {.shape = Shape::Cube})), "24");
    EXPECT_EQ(solids::volume(offset_of_solid(box, -0.25, {.shape = Shape::Cube})), "15/8");
    EXPECT_TRUE(offset_of_solid(box, -0.5, {.shape = Shape::Cube}).is_empty());
    // Faces by their areas, edges by quarters of a square of area 2, corners by octants.
    EXPECT_EQ(solids::volume(offset_of_solid(box, 1, {.shape = Shape::Octahedron})), "124/3");
    EXPECT_EQ(solids::volume(offset_of_solid(box, 0)), "6");
    EXPECT_TRUE(offset_of_solid(Solid(), 1).is_empty());
    const Solid tool = solids::box({-1, -1, 0}, {1, 1, 1});
    EXPECT_EQ(solids::volume(offset_of_solid(box, 0.5, tool)), "21");
    EXPECT_EQ(solids::volume(offset_of_solid(bracket(), 0.5, {.shape = Shape::Cube})), "32");
}

TEST(OffsetOfSolid, BallsHaveTheRadiusThatIsPromised) {
    const double least[]{0.79, 0.93, 0.98, 0.995};
    for (std::uint32_t s = 0; s <= 3; ++s) EXPECT_GT(icosphere_inner_radius(s), least[s]);
    EXPECT_THROW((void)icosphere_inner_radius(4), UsageError);
    EXPECT_THROW((void)offset_of_solid(bracket(), 1, {.subdivisions = 4}), UsageError);
    EXPECT_THROW((void)offset_of_solid(bracket(), std::nan("")), UsageError);
}

// Squared distances are exact.
TEST(OffsetOfSolid, PointsByTheirDistance) {
    const Solid solid = bracket();
    const BrepIndex index(solid);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-1.5, 5.5);
    const double r = 0.75;
    for (const Fit fit : {Fit::Within, Fit::Around})
        for (const double sign : {1.0, -0.4}) {
            SolidOffsetOptions options;
            options.fit = fit;
            const double distance = sign * r;
            const double inner = icosphere_inner_radius(options.subdivisions);
            const double size = std::fabs(distance);
            const double low = fit == Fit::Within ? inner * size : size;
            const double high = (fit == Fit::Within ? size : size / inner) * (1 + 1e-9);
            const BrepIndex grown(offset_of_solid(solid, distance, options));
            for (int i = 0; i < 2000; ++i) {
                const Point3d p{number(random), number(random), number(random)};
                const SignedDistance at = *index.signed_distance(p);
                const bool is_in = grown.locate(p).location != Location::Outside;
                const double d = at.distance();
                const bool must_be_in = distance > 0 ? d < low : -d > high;
                const bool must_be_out = distance > 0 ? d > high : -d < low;
                EXPECT_TRUE(is_in || !must_be_in) << d;
                EXPECT_FALSE(is_in && must_be_out) << d;
            }
        }
}

}  // namespace
}  // namespace trisect
