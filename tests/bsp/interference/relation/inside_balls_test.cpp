// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/relation/inside_balls.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>

#include "reference/random_solids.h"
#include "support/models.h"

namespace {

using models::box;
using reference::Random;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using trisect::detail::approximate_map;
using trisect::detail::InsideBall;
using trisect::detail::InsideBalls;
using trisect::detail::relation_by_balls;
using trisect::detail::touching_ball;

InterferenceModel hollow_box() {
    return InterferenceModel(
        evaluate(trisect::Expression(Solid::from_mesh(trisect::make_box({-4, -4, -4}, {4, 4, 4}))) -
                 Solid::from_mesh(trisect::make_box({-2, -2, -2}, {2, 2, 2}))));
}

std::optional<Relation> by_balls(const InterferenceModel& a, const InterferenceModel& b,
                                 const Pose& pose) {
    return relation_by_balls(trisect::detail::data_of(a), trisect::detail::data_of(a).balls(),
                             trisect::detail::data_of(b), trisect::detail::data_of(b).balls(),
                             approximate_map(Pose(), a.lattice(), pose, b.lattice()));
}

// A ball's centre is inside, and no corner or other point of a triangle is in the ball.
void expect_inside(const InterferenceModel& model, const InsideBall& ball, Random& random) {
    const auto& data = trisect::detail::data_of(model);
    std::array<double, 3> user = ball.center;
    for (double& c : user) c = std::ldexp(c, model.lattice().exponent);
    EXPECT_EQ(model.index().locate(user).location, trisect::Location::Inside);
    for (const auto& t : data.triangles)
        for (int n = 0; n < 20; ++n) {
            // Corners first, then points within.
            std::array<double, 3> w{n == 0 ? 1.0 : 0.0, n == 1 ? 1.0 : 0.0, n == 2 ? 1.0 : 0.0};
            if (n > 2) {
                for (double& c : w) c = static_cast<double>(random.between(0, 1000));
                const double sum = w[0] + w[1] + w[2] + 1e-9;
                for (double& c : w) c /= sum;
            }
            double square = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                double c = -ball.center[k];
                for (std::size_t j = 0; j < 3; ++j) c += w[j] * data.position(t.vertex[j])[k];
                square += c * c;
            }
            EXPECT_GT(std::sqrt(square) * (1 + 1e-6), ball.radius);
        }
}

TEST(InsideBalls, NoPointOfTheBoundaryIsInThem) {
    Random random(81);
    const std::vector<InterferenceModel> models{
        InterferenceModel(Solid::from_mesh(trisect::make_torus(1, 0.25, 40, 24))), hollow_box(),
        InterferenceModel(Solid::from_mesh(trisect::make_icosphere(1, 3))), box(0, 1)};
    for (const InterferenceModel& model : models) {
        const InsideBalls& balls = trisect::detail::data_of(model).balls();
        ASSERT_GT(balls.size(), 0U);
        for (std::size_t i = 0; i < balls.size(); ++i)
            expect_inside(model, {balls.center(i), balls.radius(i)}, random);
        int found = 0;
        for (std::size_t i = 0; i < balls.along_boundary().size(); i += 20)
            if (const InsideBall& ball = balls.along_boundary()[i]; ball.radius > 0) {
                expect_inside(model, ball, random);
                ++found;
            }
        const auto count = static_cast<std::uint32_t>(model.triangle_count());
        EXPECT_EQ(balls.region_of(count - 1) + 1, balls.along_boundary().size());
        for (std::uint32_t t = 0; t < count; t += 1 + count / 50)
            if (const auto ball = touching_ball(trisect::detail::data_of(model), t)) {
                expect_inside(model, *ball, random);
                ++found;
            }
        EXPECT_GT(found, 3);
    }
}

// Boxes, hollow ones and balls on a small grid, where faces coincide: whatever balls tell is what
// the exact comparison tells.
TEST(InsideBalls, RelationsOnASmallGridAreTheExactOnes) {
    const std::vector<InterferenceModel> models{
        box(-3, 3), box(0, 1), hollow_box(),
        InterferenceModel(Solid::from_mesh(trisect::make_icosphere(4, 2)))};
    Random random(82);
    std::array<int, 6> told{};
    for (const auto& a : models)
        for (const auto& b : models)
            for (int i = 0; i < 300; ++i) {
                std::array<double, 3> by{};
                for (double& c : by) c = static_cast<double>(random.between(-4, 4));
                const Pose pose = i % 2 == 0
                                      ? Pose::from_translation(by)
                                      : Pose::from_quaternion({2, random.between(-2, 2), 1, 0}, by);
                const auto quick = by_balls(a, b, pose);
                if (!quick) continue;
                EXPECT_EQ(*quick, interfere(a, Pose(), b, pose).relation);
                ++told[static_cast<std::size_t>(*quick)];
            }
    EXPECT_GT(told[static_cast<std::size_t>(Relation::Overlapping)], 30);
    EXPECT_GT(told[static_cast<std::size_t>(Relation::Inside)], 3);
    EXPECT_GT(told[static_cast<std::size_t>(Relation::Contains)], 3);
}

TEST(InsideBalls, DeepOverlapAndContainmentLookAtNoFace) {
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(1, 4)));
    const InterferenceModel speck(Solid::from_mesh(trisect::make_icosphere(0.125, 3)));
    (void)trisect::detail::data_of(ball).balls();
    (void)trisect::detail::data_of(speck).balls();
    const auto ask = [](const InterferenceModel& a, const InterferenceModel& b, const Pose& pose,
                        Relation expected) {
        trisect::detail::ObbWalk::Stack stack;
        trisect::detail::WalkCounters counters;
        EXPECT_EQ(
            trisect::detail::quick_relation(trisect::detail::data_of(a), Pose(),
                                            trisect::detail::data_of(b), pose, stack, &counters),
            expected);
        return counters;
    };
    const Pose near = Pose::from_translation({0.25, 0.125, 0.25});
    for (const auto& counters :
         {ask(ball, speck, near, Relation::Contains), ask(speck, ball, near, Relation::Inside),
          ask(ball, ball, near, Relation::Overlapping)}) {
        EXPECT_EQ(counters.by_balls, 1U);
        EXPECT_EQ(counters.node_tests, 0U);
        EXPECT_EQ(counters.triangle_pairs, 0U);
    }
    const auto apart = ask(ball, speck, Pose::from_translation({1.5, 0, 0}), Relation::Disjoint);
    EXPECT_EQ(apart.by_balls, 0U);
    EXPECT_GT(apart.node_tests, 0U);
}

TEST(InsideBalls, MapsThatAreNotSimilaritiesTellNothing) {
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(1, 2)));
    EXPECT_FALSE(
        by_balls(ball, ball, Pose::from_doubles({1, 0.5, 0, 0, 0, 1, 0, 0.5, 0, 0, 1, 0})));
    EXPECT_TRUE(by_balls(ball, ball, Pose::from_translation({0.5, 0, 0})));
}

}  // namespace
