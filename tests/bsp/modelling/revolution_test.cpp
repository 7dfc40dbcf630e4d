// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/modelling/revolution.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trisect {
namespace {

constexpr double pi = std::numbers::pi;

/// Pappus: the area times the way of its centre, on a circle of radius `radius`, made of segments
/// of `step` degrees.
double expected(double area, double radius, double degrees, double step) {
    const double d = step * pi / 180;
    return area * radius * (degrees * pi / 180) * std::sin(d) / d;
}

PlaneRegion rectangle(double x0, double x1, double y0, double y1) {
    return region_of_outline({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

TEST(Revolution, VolumesByPappus) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(0, 5);
    for (std::uint32_t i = 0; i < 40; ++i) {
        const double x = i % 4 == 0 ? 0 : number(random);
        const double y = number(random);
        const double w = number(random) + 0.1;
        const double h = number(random) + 0.1;
        RevolutionOptions options;
        options.segments = 8 * (1 + i % 5);
        options.angle = i % 3 == 0 ? 360 : 90 * (1 + i % 3);
        if (i % 2 == 1) options.angle = -options.angle;
        const bool mirrored = i % 5 == 0;
        const Solid solid = revolution(
            mirrored ? rectangle(-x - w, -x, y, y + h) : rectangle(x, x + w, y, y + h), options);
        const double step = 360.0 / options.segments;
        EXPECT_NEAR(volume(solid) / expected(w * h, x + w / 2, std::fabs(options.angle), step), 1,
                    1e-12)
            << i;
        EXPECT_TRUE(is_embedded(import_mesh(solid.to_mesh()).mesh)) << i;
    }
}

TEST(Revolution, BeginsWhereItIsToldTo) {
    const auto box = [](double angle, double start) {
        RevolutionOptions options;
        options.angle = angle;
        options.start = start;
        return *bounds(revolution(rectangle(1, 2, 0, 1), options));
    };
    EXPECT_EQ(box(90, 0), (Bounds{{0, 0, 0}, {2, 2, 1}}));
    EXPECT_EQ(box(-90, 0), (Bounds{{0, -2, 0}, {2, 0, 1}}));
    EXPECT_EQ(box(90, 90), (Bounds{{-2, 0, 0}, {0, 2, 1}}));
}

TEST(Revolution, NamesWhatIsWrong) {
    EXPECT_THROW((void)revolution(rectangle(-1, 1, 0, 1)), UsageError);
    EXPECT_THROW((void)revolution(rectangle(1, 2, 0, 1), {.angle = 0}), UsageError);
    EXPECT_THROW((void)revolution(rectangle(1, 2, 0, 1), {.angle = std::nan("")}), UsageError);
    EXPECT_THROW((void)revolution(rectangle(1, 2, 0, 1), {.segments = 2}), UsageError);
    EXPECT_THROW((void)revolution(rectangle(1, 2, 0, 1), {.segments = 1U << 31}), LimitError);
    EXPECT_TRUE(revolution(PlaneRegion()).is_empty());
}

}  // namespace
}  // namespace trisect
