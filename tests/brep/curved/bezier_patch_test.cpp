// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/curved/bezier_patch.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include <trisect/brep/curved/control_net.h>
#include <trisect/kernel/error.h>

#include "support/random_patch.h"

namespace {

using trisect::BezierPatch;
using trisect::ExactRational;
using trisect::Point3d;
using trisect::detail::ControlNet;
using trisect::test::exact_point;
using trisect::test::is_within;
using trisect::test::random_patch;

TEST(BezierPatch, PointsAreWithinTheirError) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> parameter(0, 1);
    for (int k = 0; k < 200; ++k) {
        const BezierPatch patch = random_patch(random, k % 2 == 0);
        const double u = k % 10 == 0 ? 1 : parameter(random);
        const double v = parameter(random);
        const auto p = evaluate(patch, u, v);
        EXPECT_LT(p.error, 1e-12);
        EXPECT_TRUE(is_within(
            exact_point(patch, ExactRational::from_double(u), ExactRational::from_double(v)),
            p.position, 1.74 * p.error));
    }
}

TEST(BezierPatch, HalvesAreTheSameSurface) {
    std::mt19937_64 random(2);
    for (int k = 0; k < 100; ++k) {
        const BezierPatch patch = random_patch(random, k % 2 == 0);
        const auto [low, high] = ControlNet(patch).halves_in_u();
        const auto [a, b] = high.halves_in_v();
        const auto p = a.at(0.25, 0.75);  // u = 1/2 + 1/8, v = 3/8
        EXPECT_TRUE(is_within(exact_point(patch, ExactRational::from_double(0.625),
                                          ExactRational::from_double(0.375)),
                              p.position, 1.74 * p.error));
        const auto q = low.at(0.5, 0.5);
        EXPECT_TRUE(is_within(
            exact_point(patch, ExactRational::from_double(0.25), ExactRational::from_double(0.5)),
            q.position, 1.74 * q.error));
    }
}

TEST(BezierPatch, SecondDerivativesContainDifferences) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> parameter(0.125, 0.875);
    const double h = 0.125;
    for (int k = 0; k < 200; ++k) {
        const BezierPatch patch = random_patch(random, k % 2 == 0);
        const auto ranges = ControlNet(patch).second_derivatives();
        const double u = parameter(random);
        const double v = parameter(random);
        const auto at = [&](double du, double dv) {
            return evaluate(patch, u + du, v + dv).position;
        };
        const auto expect_in = [](double x, const trisect::detail::Range& range) {
            const double slack = 1e-6 * std::abs(x) + 1e-9;
            EXPECT_GE(x, range.lo - slack);
            EXPECT_LE(x, range.hi + slack);
        };
        // A difference is a mean of derivatives.
        for (std::size_t c = 0; c < 3; ++c) {
            expect_in((at(h, 0)[c] - 2 * at(0, 0)[c] + at(-h, 0)[c]) / (h * h), ranges.uu[c]);
            expect_in((at(0, h)[c] - 2 * at(0, 0)[c] + at(0, -h)[c]) / (h * h), ranges.vv[c]);
            expect_in((at(h, h)[c] - at(h, -h)[c] - at(-h, h)[c] + at(-h, -h)[c]) / (4 * h * h),
                      ranges.uv[c]);
        }
    }
}

TEST(BezierPatch, SecondDerivativesOfAPlaneAreZero) {
    const BezierPatch flat(1, 1, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}});
    const auto m = ControlNet(flat).second_derivatives();
    for (const auto& vector : {m.uu, m.uv, m.vv})
        for (const auto& range : vector) {
            EXPECT_LE(range.lo, 0);
            EXPECT_GE(range.hi, 0);
            EXPECT_LT(range.hi - range.lo, 1e-13);
        }
}

TEST(BezierPatch, MovedNetsContainTheMovedSurface) {
    std::mt19937_64 random(4);
    const std::array<double, 12> map{0.36, 0.48, -0.8, 1, -0.8, 0.6, 0, -2, 0.48, 0.64, 0.6, 1e3};
    for (int k = 0; k < 50; ++k) {
        const BezierPatch patch = random_patch(random, k % 2 == 0);
        const auto p = ControlNet(patch).moved(map).at(0.25, 0.5);
        const auto exact =
            exact_point(patch, ExactRational::from_double(0.25), ExactRational::from_double(0.5));
        trisect::test::ExactPoint3 image;
        for (std::size_t i = 0; i < 3; ++i) {
            image[i] = ExactRational::from_double(map[4 * i + 3]);
            for (std::size_t j = 0; j < 3; ++j)
                image[i] += ExactRational::from_double(map[4 * i + j]) * exact[j];
        }
        EXPECT_TRUE(is_within(image, p.position, 1.74 * p.error));
    }
}

TEST(BezierPatch, RefusesWhatIsNoPatch) {
    const std::vector<Point3d> four{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    EXPECT_THROW(BezierPatch(0, 1, four), trisect::UsageError);
    EXPECT_THROW(BezierPatch(1, 25, four), trisect::UsageError);
    EXPECT_THROW(BezierPatch(1, 2, four), trisect::UsageError);
    EXPECT_THROW(BezierPatch(1, 1, four, {1, 1, 1}), trisect::UsageError);
    EXPECT_THROW(BezierPatch(1, 1, four, {1, 1, 0, 1}), trisect::UsageError);
    EXPECT_THROW(BezierPatch(1, 1, four, {1, 1, -1, 1}), trisect::UsageError);
    auto broken = four;
    broken[2][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(BezierPatch(1, 1, broken), trisect::UsageError);
    EXPECT_THROW((void)evaluate(BezierPatch(1, 1, four), 0.5, 1.5), trisect::UsageError);
}

}  // namespace
