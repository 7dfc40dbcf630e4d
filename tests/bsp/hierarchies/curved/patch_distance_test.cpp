// SPDX-License-Identifier: Apache-2.0
//
// Surfaces at known distances.

#include <trisect/bsp/hierarchies/curved/patch_distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include <trisect/brep/curved/curved_shapes.h>
#include <trisect/kernel/error.h>

#include "support/random_patch.h"

namespace {

using trisect::BezierPatch;
using trisect::Point3d;
using trisect::Pose;
using trisect::hierarchies::patch_distance;
using trisect::hierarchies::PatchDistance;
using trisect::hierarchies::patches_interfere;
using trisect::hierarchies::PatchInterference;
using trisect::hierarchies::PatchTree;
using trisect::hierarchies::SurfacePoint;

PatchTree sphere(double radius) {
    const auto s = trisect::make_curved_sphere(radius);
    return PatchTree(s.patches());
}

void expect_distance(const PatchDistance& d, double known, double tolerance) {
    EXPECT_TRUE(d.reached) << d.lower << " " << d.upper << " tests " << d.tests;
    EXPECT_LE(d.lower, known * (1 + 1e-15) + 1e-300);
    EXPECT_GE(d.upper, known * (1 - 1e-15));
    EXPECT_LE(d.upper - d.lower, tolerance);
}

TEST(PatchDistance, SpheresApartNestedTouchingAndCrossing) {
    PatchTree one = sphere(1);
    PatchTree two = sphere(2);
    std::mt19937_64 random(9);
    std::uniform_int_distribution<std::int64_t> number(-9, 9);
    const double tolerance = 1e-7;
    for (const double x : {4.0, 3.25, 3.0, 2.0, 0.5, 1.0}) {
        const double known = x >= 3 ? x - 3 : (x <= 1 ? 1 - x : 0);
        for (int k = 0; k < 3; ++k) {
            const Pose turn_a = Pose::from_quaternion({number(random), 1, number(random), 2});
            const Pose turn_b = Pose::from_quaternion({number(random), 3, number(random), 1});
            const Pose along = Pose::from_quaternion({1, 1, number(random), 2}, {1e3, -7, 0.3});
            const PatchDistance d =
                patch_distance(one, along * Pose::from_translation({x, 0, 0}) * turn_a, two,
                               along * turn_b, {.tolerance = tolerance});
            expect_distance(d, known, tolerance);
        }
    }
}

TEST(PatchDistance, LinkedTori) {
    const auto t = trisect::make_curved_torus(5, 1);
    PatchTree a(t.patches());
    PatchTree b(t.patches());
    // A quarter turn about x, moved by the major radius: the ring passes through the other's hole.
    const Pose linked = Pose::from_translation({5, 0, 0}) * Pose::from_quaternion({1, 1, 0, 0});
    const PatchDistance d = patch_distance(a, Pose(), b, linked, {.tolerance = 1e-6});
    expect_distance(d, 3, 1e-6);
    EXPECT_EQ(patches_interfere(a, Pose(), b, linked), PatchInterference::Apart);
    // Side by side on one axis: the upper one's lowest circle is over the lower one's highest.
    const Pose above = Pose::from_translation({0, 0, 2.5});
    const PatchDistance stacked = patch_distance(a, Pose(), b, above, {.tolerance = 0.25});
    expect_distance(stacked, 0.5, 0.25);
}

TEST(PatchDistance, ParallelPlanesAreEquallyNearEverywhere) {
    const std::vector<BezierPatch> flat{
        BezierPatch(1, 1, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}})};
    PatchTree a(flat);
    PatchTree b(flat);
    expect_distance(patch_distance(a, Pose(), b, Pose::from_translation({0.25, 0.5, 0.125})), 0.125,
                    1e-9);
    expect_distance(patch_distance(a, Pose(), b, Pose::from_translation({4, 5, 0})), 5, 1e-9);
}

// Points of both surfaces bound the distance from above, whatever the search says.
TEST(PatchDistance, RandomPatchesAreNotNearerThanTheLowerBound) {
    std::mt19937_64 random(10);
    std::uniform_real_distribution<double> parameter(0, 1);
    for (int k = 0; k < 40; ++k) {
        const std::vector<BezierPatch> p{trisect::test::random_patch(random, k % 2 == 0)};
        const std::vector<BezierPatch> q{trisect::test::random_patch(random, k % 3 == 0)};
        PatchTree a(p);
        PatchTree b(q);
        const Point3d shift{double(k % 5) * 5, 3, 1};
        const PatchDistance d =
            patch_distance(a, Pose(), b, Pose::from_translation(shift), {.tolerance = 1e-4});
        ASSERT_TRUE(d.reached);
        double nearest = INFINITY;
        for (int i = 0; i < 400; ++i) {
            const Point3d x = evaluate(p[0], parameter(random), parameter(random)).position;
            const Point3d y = evaluate(q[0], parameter(random), parameter(random)).position;
            nearest = std::min(nearest, std::hypot(x[0] - y[0] - shift[0], x[1] - y[1] - shift[1],
                                                   x[2] - y[2] - shift[2]));
        }
        EXPECT_LE(d.lower, nearest);
        const Point3d x = evaluate(p[d.a.patch], d.a.u, d.a.v).position;
        const Point3d y = evaluate(q[d.b.patch], d.b.u, d.b.v).position;
        EXPECT_LE(
            std::hypot(x[0] - y[0] - shift[0], x[1] - y[1] - shift[1], x[2] - y[2] - shift[2]),
            d.upper * (1 + 1e-12));
    }
}

TEST(PatchDistance, InterferenceIsProvedOrRefuted) {
    PatchTree one = sphere(1);
    PatchTree two = sphere(1);
    const auto at = [](double x) { return Pose::from_translation({x, 0, 0}); };
    EXPECT_EQ(patches_interfere(one, Pose(), two, at(2 + 1e-8)), PatchInterference::Apart);
    EXPECT_EQ(patches_interfere(one, Pose(), two, at(2), {.tolerance = 1e-7}),
              PatchInterference::Near);
    EXPECT_EQ(patches_interfere(one, Pose(), two, at(1.5)), PatchInterference::Near);
    EXPECT_EQ(patches_interfere(one, Pose(), two, at(2), {.tolerance = 1e-9, .max_tests = 10}),
              PatchInterference::Undecided);
    EXPECT_THROW((void)patch_distance(one, Pose(), two, Pose(), {.tolerance = 0}),
                 trisect::UsageError);
}

}  // namespace
