// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/interference_query.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <thread>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boxes/obb_walk.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>
#include <trisect/kernel/diagnostics.h>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::Diagnostics;
using trisect::interfere;
using trisect::InterferenceModel;
using trisect::InterferenceQuery;
using trisect::InterferenceQueryCounters;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

Pose turned(double degrees, const std::array<double, 3>& by) {
    const double c = std::cos(degrees * std::numbers::pi / 180);
    const double s = std::sin(degrees * std::numbers::pi / 180);
    return Pose::from_doubles({c, 0, s, by[0], 0, 1, 0, by[1], -s, 0, c, by[2]});
}

// Two linked tori; the second one turns and swings so that the gap between the tubes goes from wide
// to less than nothing. No point moves by more than a hundredth of the diameter, 2.5, from one pose
// to the next.
std::vector<Pose> swing(int frames) {
    std::vector<Pose> poses;
    for (int i = 0; i < frames; ++i) {
        const double t = static_cast<double>(i);
        poses.push_back(turned(90 + 10 * std::sin(0.01 * t),
                               {1 + 0.3 * std::cos(0.013 * t), 0, 0.3 * std::sin(0.019 * t)}));
    }
    return poses;
}

std::uint64_t fresh_node_tests(const InterferenceModel& a, const InterferenceModel& b,
                               const Pose& pose, Relation expected) {
    trisect::detail::ObbWalk::Stack stack;
    trisect::detail::WalkCounters counters;
    EXPECT_EQ(trisect::detail::quick_relation(trisect::detail::data_of(a), Pose(),
                                              trisect::detail::data_of(b), pose, stack, &counters),
              expected);
    return counters.node_tests;
}

TEST(InterferenceQuery, MotionOfAHundredthOfTheDiameterVisitsAThirdOfTheNodes) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 100, 64)));
    InterferenceQuery query(torus, torus);
    const Diagnostics<InterferenceQueryCounters> diagnostics;
    std::uint64_t fresh = 0;
    std::map<Relation, int> seen;
    for (const Pose& pose : swing(600)) {
        const Relation r = query.relation(Pose(), pose);
        ++seen[r];
        fresh += fresh_node_tests(torus, torus, pose, r);
    }
    EXPECT_GT(seen[Relation::Disjoint], 50);
    EXPECT_GT(seen[Relation::Overlapping], 50);
    EXPECT_LT(3 * diagnostics.counters().node_tests, fresh);
    EXPECT_GT(diagnostics.counters().kept, 0U);
    EXPECT_EQ(diagnostics.counters().exact, 0U);
}

// Small steps, jumps, touching and flush poses in any order: always what a fresh question says.
TEST(InterferenceQuery, AnswersAreThoseOfFreshQuestions) {
    const InterferenceModel box(Solid::from_mesh(trisect::make_box({0, 0, 0}, {2, 2, 2})));
    const InterferenceModel small(Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1})));
    const InterferenceModel hollow(
        evaluate(trisect::Expression(Solid::from_mesh(trisect::make_box({-3, -3, -3}, {3, 3, 3}))) -
                 Solid::from_mesh(trisect::make_box({-2, -2, -2}, {2, 2, 2}))));
    std::map<Relation, int> seen;
    for (const auto& [a, b] : {std::pair(&box, &small), std::pair(&hollow, &small),
                               std::pair(&small, &hollow), std::pair(&box, &box)}) {
        InterferenceQuery query(*a, *b);
        Random random(51);
        std::array<double, 3> at{4, 0.25, 0.125};
        for (int i = 0; i < 400; ++i) {
            if (random.chance(1, 20)) {
                for (double& c : at) c = static_cast<double>(random.between(-4, 4));
            } else {
                for (double& c : at) c += 0.03125 * static_cast<double>(random.between(-2, 2));
            }
            const Pose pose = random.chance(1, 8)
                                  ? Pose::from_quaternion({20, random.between(-1, 1), 1, 0}, at)
                                  : Pose::from_translation(at);
            const Relation r = query.relation(Pose(), pose);
            EXPECT_EQ(r, interfere(*a, Pose(), *b, pose).relation) << i;
            ++seen[r];
        }
    }
    for (const Relation r : {Relation::Disjoint, Relation::Touching, Relation::Overlapping,
                             Relation::Inside, Relation::Contains})
        EXPECT_GT(seen[r], 5) << to_string(r);
}

// Questions enough that there are balls inside; both bodies move, together and against each other,
// in and out of depth.
TEST(InterferenceQuery, OverlapInDepthIsKeptWhileBodiesMoveLess) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 40, 24)));
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(0.5, 3)));
    const InterferenceModel speck(Solid::from_mesh(trisect::make_icosphere(0.03, 1)));
    for (const InterferenceModel* m : {&torus, &ball, &speck})
        for (int i = 0; i < 1100; ++i) (void)trisect::detail::data_of(*m).balls_in_time();
    std::map<Relation, int> seen;
    for (const auto& [a, b] : {std::pair(&torus, &ball), std::pair(&torus, &torus),
                               std::pair(&torus, &speck), std::pair(&speck, &ball)}) {
        InterferenceQuery query(*a, *b);
        const Diagnostics<InterferenceQueryCounters> diagnostics;
        for (int i = 0; i < 800; ++i) {
            const double t = static_cast<double>(i);
            const Pose pose_a = turned(0.2 * t, {0.01 * t, 0.3 * std::sin(0.002 * t), 0.5});
            const Pose pose_b =
                i % 200 < 50 ? turned(0.2 * t + 90, {0.01 * t + 0.9, 0.1, 0.5})
                             : turned(0.3 * t, {0.01 * t + 1.1 * std::sin(0.01 * t), 0.1, 0.5});
            const Relation r = query.relation(pose_a, pose_b);
            ASSERT_EQ(r, interfere(*a, pose_a, *b, pose_b).relation) << i;
            ++seen[r];
        }
        const auto counters = diagnostics.counters();
        EXPECT_EQ(counters.asked, 800U);
        EXPECT_GT(counters.kept, 100U);
        if (a != &speck && b != &speck) {
            EXPECT_GT(counters.by_balls, 0U);
        }
    }
    for (const Relation r :
         {Relation::Disjoint, Relation::Overlapping, Relation::Inside, Relation::Contains})
        EXPECT_GT(seen[r], 20) << to_string(r);
}

// Poses that differ by a hair on both sides of a touch: a reserve never reaches across.
TEST(InterferenceQuery, StepsTowardsATouchAndBack) {
    const InterferenceModel box(Solid::from_mesh(trisect::make_box({0, 0, 0}, {2, 2, 2})));
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(1, 2)));
    for (const InterferenceModel* b : {&box, &ball}) {
        InterferenceQuery query(box, *b);
        std::map<Relation, int> seen;
        const double touch = b == &box ? 2 : 3;
        for (int i = -40; i <= 40; ++i) {
            const double gap = std::copysign(i == 0 ? 0 : std::ldexp(1.0, -std::abs(i)), i);
            for (const double g : {gap, 0.0, -gap}) {
                const Pose pose = Pose::from_translation({touch + g, 0.5, 0.25});
                const Relation r = query.relation(Pose(), pose);
                ASSERT_EQ(r, interfere(box, Pose(), *b, pose).relation) << i << " " << g;
                ++seen[r];
            }
        }
        EXPECT_GT(seen[Relation::Touching], 40);
        EXPECT_GT(seen[Relation::Overlapping], 20);
        EXPECT_GT(seen[Relation::Disjoint], 20);
    }
}

// All ways to move in and out of shallow contact, with balls along the boundaries: sliding,
// vibrating, turning in place, jumps and jumps back to where the bodies had been.
TEST(InterferenceQuery, RandomWalksInShallowContact) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 40, 24)));
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(0.5, 4)));
    const InterferenceModel rough(
        evaluate(trisect::Expression(Solid::from_mesh(trisect::make_icosphere(0.5, 3))) -
                 Solid::from_mesh(trisect::make_torus(0.4, 0.125, 24, 12))));
    for (const InterferenceModel* m : {&torus, &ball, &rough})
        (void)trisect::detail::data_of(*m).balls();
    std::map<Relation, int> seen;
    for (const auto& [a, b] : {std::pair(&torus, &ball), std::pair(&rough, &ball),
                               std::pair(&torus, &torus), std::pair(&rough, &rough)}) {
        InterferenceQuery query(*a, *b);
        const Diagnostics<InterferenceQueryCounters> diagnostics;
        Random random(77);
        // B's middle about A's, and the angle of B.
        const auto pose_at = [](const std::array<double, 3>& place) {
            return turned(place[2],
                          {place[0] * std::cos(place[1]), 0.01, place[0] * std::sin(place[1])});
        };
        const double touching = a == &rough ? 0.99 : b == &torus ? 1.1 : 1.7;
        std::array<double, 3> place{touching, 0, 0};
        std::vector<std::array<double, 3>> been{place};
        for (int i = 0; i < 150; ++i) {
            const auto way = random.between(0, 5);
            for (int k = 0; k < 6; ++k) {
                const double sign = k % 2 == 0 ? 1 : -1;
                if (way <= 1) place[1] += 0.01;
                if (way == 1) place[0] += 0.001 * static_cast<double>(random.between(-3, 3));
                if (way == 2) place[0] += sign * 0.004;
                if (way == 3) place[2] += 0.5;
                if (way == 4 && k == 0)
                    place = {touching + 0.05 * static_cast<double>(random.between(-6, 2)),
                             0.1 * static_cast<double>(random.between(0, 60)),
                             5.0 * static_cast<double>(random.between(0, 70))};
                if (way == 5 && k == 0)
                    place = been[static_cast<std::size_t>(
                        random.between(0, static_cast<std::int64_t>(been.size()) - 1))];
                const Pose pose = pose_at(place);
                const Relation r = query.relation(Pose(), pose);
                ASSERT_EQ(r, interfere(*a, Pose(), *b, pose).relation) << i << " " << k;
                ++seen[r];
            }
            been.push_back(place);
        }
        EXPECT_GT(diagnostics.counters().by_balls, 20U);
        EXPECT_GT(diagnostics.counters().kept, 100U);
    }
    EXPECT_GT(seen[Relation::Disjoint], 300);
    EXPECT_GT(seen[Relation::Overlapping], 300);
}

TEST(InterferenceQuery, ALostCrossingGoesOnFromTheFrontBefore) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 60, 40)));
    for (const double amplitude : {0.005, 0.01}) {
        InterferenceQuery query(torus, torus);
        const Diagnostics<InterferenceQueryCounters> diagnostics;
        for (int i = 0; i < 400; ++i) {
            // In and out of contact along a short way.
            const double gap = amplitude * std::sin(0.3 * i);
            const Pose pose = turned(90 + 0.01 * i, {1.12 + gap, 0, 0});
            ASSERT_EQ(query.relation(Pose(), pose), interfere(torus, Pose(), torus, pose).relation)
                << i;
        }
        EXPECT_GT(diagnostics.counters().resumed_fronts, 3U);
        EXPECT_LT(diagnostics.counters().fresh_walks, 10U);
        EXPECT_GT(diagnostics.counters().plane_tests, 0U);
    }
}

// A body that jumps through a wall between two questions is on the other side.
TEST(InterferenceQuery, ThinWallPassedBetweenTwoQuestions) {
    const InterferenceModel shell(
        evaluate(trisect::Expression(Solid::from_mesh(trisect::make_icosphere(1, 3))) -
                 Solid::from_mesh(trisect::make_icosphere(0.999, 3))));
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(1, 3)));
    const InterferenceModel speck(Solid::from_mesh(trisect::make_icosphere(0.01, 1)));
    InterferenceQuery in_shell(shell, speck);
    InterferenceQuery in_ball(ball, speck);
    for (int i = 0; i < 40; ++i) {
        const Pose pose = Pose::from_translation({0.8 + 0.0078125 * i, 0.1, 0.05});
        EXPECT_EQ(in_shell.relation(Pose(), pose), interfere(shell, Pose(), speck, pose).relation);
        EXPECT_EQ(in_ball.relation(Pose(), pose), interfere(ball, Pose(), speck, pose).relation);
    }
    const Pose in = Pose::from_translation({0.95, 0, 0});
    const Pose out = Pose::from_translation({1.05, 0, 0});
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(in_ball.relation(Pose(), in), Relation::Contains);
        EXPECT_EQ(in_ball.relation(Pose(), out), Relation::Disjoint);
    }
}

// Bodies that grow and shrink change which of two boxes is the larger one.
TEST(InterferenceQuery, PosesThatChangeTheSizeOfABody) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 24, 12)));
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(1, 2)));
    InterferenceQuery query(torus, ball);
    std::map<Relation, int> seen;
    for (int i = 0; i < 400; ++i) {
        const double scale = 0.6 + 0.5 * std::sin(0.02 * i);
        const Pose pose = Pose::from_doubles(
            {scale, 0, 0, 0.01, 0, scale, 0, 0.4 * std::sin(0.05 * i), 0, 0, scale, 0.02});
        const Relation r = query.relation(Pose(), pose);
        EXPECT_EQ(r, interfere(torus, Pose(), ball, pose).relation) << i;
        ++seen[r];
    }
    EXPECT_GT(seen[Relation::Disjoint], 20);
    EXPECT_GT(seen[Relation::Overlapping], 20);
}

TEST(InterferenceQuery, ModelsAreSharedByManyThreads) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 32, 16)));
    const auto poses = swing(100);
    std::vector<std::vector<Relation>> answers(4);
    std::vector<std::thread> threads;
    for (auto& mine : answers)
        threads.emplace_back([&] {
            InterferenceQuery query(torus, torus);
            for (const Pose& p : poses) mine.push_back(query.relation(Pose(), p));
        });
    for (auto& t : threads) t.join();
    for (const auto& mine : answers) EXPECT_EQ(mine, answers.front());
}

TEST(InterferenceQuery, EmptyModelsAndForgetting) {
    const InterferenceModel box(Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1})));
    InterferenceQuery empty(box, InterferenceModel{});
    EXPECT_EQ(empty.relation(Pose(), Pose()), Relation::Disjoint);
    InterferenceQuery query(box, box);
    const Diagnostics<InterferenceQueryCounters> diagnostics;
    EXPECT_EQ(query.relation(Pose(), Pose::from_translation({3, 0, 0})), Relation::Disjoint);
    query.forget();
    EXPECT_EQ(query.relation(Pose(), Pose()), Relation::Equal);
    EXPECT_EQ(diagnostics.counters().asked, 2U);
}

}  // namespace
