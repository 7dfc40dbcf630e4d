// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/hierarchies/motion/space_time_boxes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/scene/body_bounds.h>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::Pose;
using trisect::Relation;
using trisect::Screw;
using trisect::Solid;
using trisect::hierarchies::SpaceTimeBox;
using trisect::hierarchies::SpaceTimeBoxes;
using trisect::hierarchies::SpaceTimePair;

InterferenceModel bar() {
    return InterferenceModel(Solid::from_mesh(trisect::make_box({-4, -1, -1}, {4, 1, 1})));
}

Motion random_motion(Random& random) {
    const auto number = [&random](std::int64_t n) {
        return static_cast<double>(random.between(-n, n));
    };
    const Pose start = Pose::from_quaternion({random.between(1, 4), random.between(-3, 3), 1, 2},
                                             {number(25), number(25), number(25)});
    switch (random.below(4)) {
        case 0:
            return Motion(start);
        case 1:
            return Motion::translation(start, {number(40), number(40), number(40)});
        case 2:
            return Motion::screw(start, Screw{{1, random.between(-2, 2), 2, 1},
                                              {number(9), number(9), number(9)},
                                              {number(20), number(20), number(20)}});
        default: {
            const Motion first = Motion::translation(start, {number(30), 0, number(30)});
            return first.then(
                Motion::translation(first.pose_at(ExactRational(1)), {0, number(30), 0}));
        }
    }
}

/// A value of the parameter, and the pose there; at rest behind the end.
Pose pose_at(const Motion& m, double s) {
    return m.pose_at(ExactRational::from_double(std::min(s, static_cast<double>(m.piece_count()))));
}

TEST(SpaceTimeBoxes, ContainTheBodyAtAllTimesAndFollowEachOther) {
    Random random(1);
    const InterferenceModel model = bar();
    const trisect::detail::BodyBounds body(trisect::detail::data_of(model));
    for (int i = 0; i < 60; ++i) {
        const Motion motion = random_motion(random);
        SpaceTimeBoxes boxes;
        boxes.add(model, motion);
        const auto list = boxes.boxes(0);
        EXPECT_LE(list.size(), SpaceTimeBoxes::most_boxes * motion.piece_count() + 1);
        double last = 0;
        for (const SpaceTimeBox& b : list) {
            EXPECT_EQ(b.from, last);
            last = b.to;
            const double end = std::min(b.to, b.from + 1);
            for (int k = 0; k <= 4; ++k) {
                const auto inner = body.under(pose_at(motion, b.from + (end - b.from) * k / 4));
                for (std::size_t c = 0; c < 3; ++c) {
                    // Both are rounded outwards.
                    EXPECT_GE(inner.lo[c], b.space.lo[c] - 1e-9);
                    EXPECT_LE(inner.hi[c], b.space.hi[c] + 1e-9);
                }
            }
        }
        EXPECT_EQ(last, std::numeric_limits<double>::infinity());
    }
}

TEST(SpaceTimeBoxes, AMotionThatGoesFarHasManySmallBoxes) {
    SpaceTimeBoxes boxes;
    const InterferenceModel model = bar();
    boxes.add(model, Motion::translation(Pose(), {200, 0, 0}));
    boxes.add(model, Motion());
    EXPECT_GT(boxes.boxes(0).size(), 16U);
    for (const SpaceTimeBox& b : boxes.boxes(0)) EXPECT_LT(b.space.hi[0] - b.space.lo[0], 24);
    EXPECT_EQ(boxes.boxes(1).size(), 2U);
    // It leaves the other's box at s = 8 / 200.
    const auto pairs = boxes.pairs(0, 1);
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].from, 0);
    EXPECT_GE(pairs[0].to, 0.04);
    EXPECT_LE(pairs[0].to, 0.2);
    EXPECT_TRUE(boxes.pairs(0.25, 1).empty());
}

TEST(SpaceTimeBoxes, PairsAreThoseOfAllBoxesWithinTheTime) {
    Random random(2);
    const InterferenceModel model = bar();
    SpaceTimeBoxes boxes;
    for (int i = 0; i < 30; ++i) boxes.add(model, random_motion(random));
    for (const auto& [from, to] : {std::pair{0.0, 2.0}, {0.25, 0.25}, {0.5, 1.0}, {3.0, 9.0}}) {
        const auto pairs = boxes.pairs(from, to);
        EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end(),
                                   [](const auto& a, const auto& b) { return a.from < b.from; }));
        const auto covered = [&pairs](std::uint32_t i, std::uint32_t j, double s, double t) {
            return std::count_if(pairs.begin(), pairs.end(), [&](const SpaceTimePair& p) {
                return p.first == i && p.second == j && p.from <= s && t <= p.to;
            });
        };
        std::size_t met = 0;
        for (std::uint32_t j = 0; j < 30; ++j)
            for (std::uint32_t i = 0; i < j; ++i)
                for (const SpaceTimeBox& a : boxes.boxes(i))
                    for (const SpaceTimeBox& b : boxes.boxes(j)) {
                        const double s = std::max({a.from, b.from, from});
                        const double t = std::min({a.to, b.to, to});
                        if (s > t || !a.space.meets(b.space)) continue;
                        ++met;
                        EXPECT_EQ(covered(i, j, s, t), 1);
                    }
        EXPECT_GT(met, 0U);
    }
}

TEST(SpaceTimeBoxes, NoInterferenceIsOutsideOfThePairs) {
    Random random(3);
    const InterferenceModel model = bar();
    std::vector<Motion> motions;
    SpaceTimeBoxes boxes;
    for (int i = 0; i < 36; ++i) {
        motions.push_back(random_motion(random));
        boxes.add(model, motions.back());
    }
    const auto pairs = boxes.pairs(0, 2);
    std::size_t met = 0;
    for (int k = 0; k <= 16; ++k) {
        const double s = k / 8.0;
        for (std::uint32_t j = 0; j < motions.size(); ++j)
            for (std::uint32_t i = 0; i < j; ++i) {
                const auto r =
                    interfere(model, pose_at(motions[i], s), model, pose_at(motions[j], s));
                if (r.relation == Relation::Disjoint) continue;
                ++met;
                EXPECT_TRUE(std::any_of(pairs.begin(), pairs.end(), [&](const SpaceTimePair& p) {
                    return p.first == i && p.second == j && p.from <= s && s <= p.to;
                })) << s;
            }
    }
    EXPECT_GT(met, 5U);
}

}  // namespace
