// SPDX-License-Identifier: Apache-2.0
//
// Scenes as a whole under a scale for which products of doubles vanish or overflow: relations stay
// as they are, also where a query keeps an answer for poses that are near each other.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/kernel/error.h>

#include "support/models.h"
#include "support/placed_pair.h"

namespace {

using models::box;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::LimitError;
using trisect::Pose;
using trisect::Relation;

// A turn with a stretch, of a solid that was moved before, and all of it 2^exponent times as large.
Pose scaled_pose(const std::array<double, 3>& by, int exponent) {
    std::array<double, 12> rows{3, -1, 0, 0, 1, 3, 0, 0, 0, 1, 2, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) rows[4 * i + 3] += rows[4 * i + k] * by[k];
        for (std::size_t k = 0; k < 4; ++k) rows[4 * i + k] = std::ldexp(rows[4 * i + k], exponent);
    }
    return Pose::from_doubles(rows);
}

TEST(ExtremePoses, AScaleOfTheWholeSceneChangesNoRelation) {
    const InterferenceModel big = box(0, 0, 0, 4, 4, 4);
    const InterferenceModel unit = box(0, 0, 0, 1, 1, 1);
    struct Case {
        std::array<double, 3> by;
        Relation relation;
    };
    const Case cases[]{{{10, 0, 0}, Relation::Disjoint},   {{4, 1, 1}, Relation::Touching},
                       {{-1, -1, -1}, Relation::Touching}, {{1, 2, 1}, Relation::Inside},
                       {{0, 3, 0}, Relation::Inside},      {{-0.5, 0, 0}, Relation::Overlapping},
                       {{3.75, 4, 3}, Relation::Touching}};
    for (const int e : {-440, -400, -300, -270, -200, -100, 0, 100, 300, 400, 440}) {
        trisect::InterferenceQuery query(unit, big);
        const Pose all = scaled_pose({0, 0, 0}, e);
        for (const Case& c : cases) {
            const Pose moved = scaled_pose(c.by, e);
            const auto found = interfere(unit, moved, big, all).relation;
            EXPECT_EQ(found, c.relation) << e << ", " << c.by[0];
            EXPECT_EQ(query.relation(moved, all), found) << e << ", " << c.by[0];
        }
        // All at once, and moved one by one.
        trisect::Scene scene;
        const auto moving = scene.add(unit, scaled_pose(cases[0].by, e));
        (void)scene.add(big, all);
        for (const Case& c : cases) {
            scene.set_pose(moving, scaled_pose(c.by, e));
            const auto pairs = scene.interfering();
            ASSERT_EQ(pairs.size(), c.relation == Relation::Disjoint ? 0U : 1U)
                << e << ", " << c.by[0];
            if (!pairs.empty()) {
                EXPECT_EQ(pairs[0].relation, c.relation) << e << ", " << c.by[0];
            }
        }
        // Doubles give a distance or none, never a wrong one.
        try {
            const auto squared = exact_squared_distance(unit, scaled_pose({40, 0, 0}, e), big, all);
            const auto plain = exact_squared_distance(unit, scaled_pose({40, 0, 0}, 0), big,
                                                      scaled_pose({0, 0, 0}, 0));
            ASSERT_TRUE(squared && plain);
            EXPECT_EQ(*squared, plain->scaled(2 * e)) << e;
        } catch (const LimitError& error) {
            EXPECT_GE(std::abs(e), 300) << error.what();
        }
    }
}

}  // namespace
