// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/modelling/extrusion.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/solids.h"

namespace trisect {
namespace {

PlaneRegion square() { return region_of_outline({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}); }

TEST(Extrusion, StraightIsExact) {
    const std::vector<FlatOutline> frame{{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                         {{1, 1}, {3, 1}, {3, 3}, {1, 3}}};
    EXPECT_EQ(solids::volume(extrusion(region_of_outlines(frame), -1, 0.5)), "18");
    EXPECT_EQ(solids::volume(extrusion(region_of_outlines(frame, OutlineRule::Positive), 0, 1)),
              "16");
    EXPECT_TRUE(extrusion(PlaneRegion(), 0, 1).is_empty());
}

TEST(Extrusion, TapersToAPointAndALine) {
    ExtrusionOptions options;
    options.scale = {0, 0};
    EXPECT_EQ(solids::volume(extrusion(square(), 0, 3, options)), "4");
    options.scale = {1, 0};
    EXPECT_EQ(solids::volume(extrusion(square(), 0, 3, options)), "6");
    options.scale = {0.5, 0.5};
    EXPECT_EQ(solids::volume(extrusion(square(), 0, 3, options)), "7");
    options.divisions = 5;
    EXPECT_NEAR(volume(extrusion(square(), 0, 3, options)), 7, 1e-12);
}

TEST(Extrusion, TwistsComeNearToTheirArea) {
    ExtrusionOptions options;
    options.twist = 90;
    double before = 100;
    for (const std::uint32_t divisions : {4U, 16U, 64U}) {
        options.divisions = divisions;
        const Solid solid = extrusion(square(), 0, 2, options);
        EXPECT_TRUE(is_embedded(import_mesh(solid.to_mesh()).mesh));
        const double excess = volume(solid) - 8;  // shorter diagonals bulge
        EXPECT_GT(excess, 0);
        EXPECT_LT(excess, before / 3);
        before = excess;
    }
    // Counter-clockwise: what was at +x is at +y.
    options.twist = 90;
    options.divisions = 0;
    const PlaneRegion far = region_of_outline({{5, -1}, {7, -1}, {7, 1}, {5, 1}});
    const PolygonMesh mesh = extrusion_mesh(far, 0, 1, options);
    EXPECT_EQ(mesh.points.size(), 40U);  // nine layers
    EXPECT_EQ(mesh.points[36][2], 1);
    EXPECT_GT(mesh.points[36][1], 4.9);
    options.twist = -90;
    EXPECT_LT(extrusion_mesh(far, 0, 1, options).points[36][1], -4.9);
}

TEST(Extrusion, ManyTurnsInOneLayerAreResolved) {
    ExtrusionOptions options;
    options.twist = 175;
    options.divisions = 1;
    const Solid solid = evaluate(extrusion(square(), 0, 1, options));
    EXPECT_TRUE(is_embedded(import_mesh(solid.to_mesh()).mesh));
    EXPECT_GT(volume(solid), 0);
}

TEST(Extrusion, NamesWhatIsWrong) {
    EXPECT_THROW((void)extrusion(square(), 1, 1), UsageError);
    EXPECT_THROW((void)extrusion(square(), 0, std::nan("")), UsageError);
    EXPECT_THROW((void)extrusion(square(), 0, 1, {.scale = {-1, 1}}), UsageError);
    EXPECT_THROW((void)extrusion(square(), 0, 1, {.twist = std::nan("")}), UsageError);
    EXPECT_THROW((void)extrusion(square(), 0, 1, {.twist = 1, .divisions = 1U << 31}), LimitError);
}

TEST(PlaneRegion, OfPrismsAndOfOthers) {
    const auto area = [](const PlaneRegion& r) { return volume(solid_of_region(r)); };
    EXPECT_EQ(area(region_of_prism(solids::box({0, 0, 5}, {2, 3, 9}))), 6);
    EXPECT_EQ(area(region_of_prism(solid_of_region(square(), -7, -2))), 4);
    EXPECT_TRUE(region_of_prism(Solid()).loops.empty());
    const Solid step =
        evaluate(solids::box({0, 0, 0}, {2, 2, 1}) | solids::box({0, 0, 0}, {1, 1, 2}));
    EXPECT_THROW((void)region_of_prism(step), UsageError);
}

}  // namespace
}  // namespace trisect
