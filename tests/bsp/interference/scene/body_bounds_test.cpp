// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/exact_rational.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/scene/body_bounds.h>
#include <trisect/bsp/solid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "exact_pose.h"
#include "reference/random_solids.h"

namespace body_bounds_test {
namespace {

using scene_test::exact;
using scene_test::ExactPose;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Solid;
using trisect::detail::BodyBounds;
using trisect::detail::BodyBox;

/// The exact box of the moved vertices of a mesh.
struct ExactBox {
    std::array<ExactRational, 3> lo;
    std::array<ExactRational, 3> hi;
};

ExactBox moved_box(const std::vector<trisect::Point3d>& points, const Pose& pose) {
    const ExactPose map = exact(pose);
    ExactBox box;
    for (std::size_t n = 0; n < points.size(); ++n) {
        for (std::size_t i = 0; i < 3; ++i) {
            ExactRational v = map.rows[i][3];
            for (std::size_t k = 0; k < 3; ++k)
                v += map.rows[i][k] * ExactRational::from_double(points[n][k]);
            if (n == 0 || v < box.lo[i]) box.lo[i] = v;
            if (n == 0 || v > box.hi[i]) box.hi[i] = v;
        }
    }
    return box;
}

void expect_contains(const BodyBox& box, const ExactBox& inner) {
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(ExactRational::from_double(box.lo[i]), inner.lo[i]) << i;
        EXPECT_GE(ExactRational::from_double(box.hi[i]), inner.hi[i]) << i;
    }
}

Pose random_pose(reference::Random& random) {
    std::array<std::int64_t, 4> q{};
    while (q == std::array<std::int64_t, 4>{}) {
        for (std::int64_t& c : q) c = random.between(-9, 9);
    }
    std::array<double, 3> t{};
    for (double& c : t)
        c = std::ldexp(static_cast<double>(random.between(-1000, 1000)),
                       static_cast<int>(random.between(-40, 40)));
    return Pose::from_quaternion(q, t);
}

TEST(BodyBounds, ContainTurnedBodiesAndAreNotMuchLarger) {
    reference::Random random(3);
    const auto ball = trisect::make_icosphere(1.0, 2);
    const auto brick = trisect::make_box({-1, 2, 3}, {1e-3, 2.5, 1e6});
    for (const auto& mesh : {ball, brick}) {
        const Solid solid = Solid::from_mesh(mesh);
        const std::vector<trisect::Point3d> points = solid.to_mesh().points;  // as imported
        const InterferenceModel model(solid);
        const BodyBounds bounds(trisect::detail::data_of(model));
        for (int i = 0; i < 50; ++i) {
            const Pose pose = random_pose(random);
            const BodyBox box = bounds.under(pose);
            const ExactBox exact_box = moved_box(points, pose);
            expect_contains(box, exact_box);
            for (std::size_t k = 0; k < 3; ++k) {
                const double side = (exact_box.hi[k] - exact_box.lo[k]).to_double();
                const double size = std::max(std::abs(box.lo[k]), std::abs(box.hi[k]));
                EXPECT_LE(box.hi[k] - box.lo[k], 1.5 * side + size * 1e-12) << k;
            }
        }
    }
}

TEST(BodyBounds, OfCutSolidsContainVerticesOffTheLattice) {
    // The corner is cut off obliquely: vertices with thirds as coordinates, off the lattice.
    const Solid cube = Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1}));
    const Solid below = Solid::half_space(trisect::Plane(3, 7, 11, -13), {});
    const InterferenceModel model(trisect::evaluate(cube & below));
    const BodyBounds bounds(trisect::detail::data_of(model));
    reference::Random random(4);
    for (int i = 0; i < 20; ++i) {
        const Pose pose = random_pose(random);
        const BodyBox box = bounds.under(pose);
        const ExactPose map = exact(pose);
        // 3 x + 7 y + 11 z = 13 meets the edge (1, 1, z) at z = 3/11 and (1, 0, z) at z = 10/11.
        for (const auto& p : std::vector<std::array<ExactRational, 3>>{
                 {1, 1, ExactRational(3) / 11}, {1, 0, ExactRational(10) / 11}, {0, 0, 1}}) {
            for (std::size_t k = 0; k < 3; ++k) {
                const ExactRational v = map.rows[k][0] * p[0] + map.rows[k][1] * p[1] +
                                        map.rows[k][2] * p[2] + map.rows[k][3];
                EXPECT_LE(ExactRational::from_double(box.lo[k]), v);
                EXPECT_GE(ExactRational::from_double(box.hi[k]), v);
            }
        }
    }
}

TEST(BodyBounds, NumbersBeyondTheDoublesGiveUnboundedBoxes) {
    const InterferenceModel model(
        Solid::from_mesh(trisect::make_box({0, 0, 0}, {1e300, 1e300, 1e300})));
    const BodyBox box = BodyBounds(trisect::detail::data_of(model))
                            .under(Pose::from_doubles({1e20, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}));
    EXPECT_EQ(box.lo[0], -HUGE_VAL);
    EXPECT_EQ(box.hi[0], HUGE_VAL);
    EXPECT_GE(box.hi[1], 1e300);
    EXPECT_TRUE(std::isfinite(box.hi[1]));
}

}  // namespace
}  // namespace body_bounds_test
