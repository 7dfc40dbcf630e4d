// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::Expression;
using trisect::InterferenceModel;
using trisect::InterferenceOptions;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using trisect::detail::ObbWalk;
using trisect::detail::quick_relation;
using trisect::detail::WalkCounters;

Pose random_pose(Random& random, std::int64_t spread) {
    const auto q = [&random] { return random.between(-1000, 1000); };
    const auto t = [&random, spread] {
        return 0x1p-10 * static_cast<double>(random.between(-spread, spread));
    };
    return Pose::from_quaternion({q(), q(), q(), 1 + std::abs(q())}, {t(), t(), t()});
}

// The full walk, which asks for exact contacts, says the same.
TEST(QuickRelation, AgreesWithTheFullWalkInGeneralPosition) {
    const InterferenceModel hollow(
        evaluate(Expression(Solid::from_mesh(trisect::make_icosphere(1, 2))) -
                 Solid::from_mesh(trisect::make_icosphere(0.75, 2))));
    const InterferenceModel speck(Solid::from_mesh(trisect::make_icosphere(0.0625, 1)));
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(1.25, 2)));
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 24, 12)));
    Random random(41);
    std::map<Relation, int> seen;
    int certain = 0;
    int asked = 0;
    for (int i = 0; i < 80; ++i)
        for (const InterferenceModel* a : {&hollow, &torus, &ball})
            for (const InterferenceModel* b : {&speck, &ball, &torus}) {
                const Pose pa = random_pose(random, i % 2 == 0 ? 100 : 1000);
                const Pose pb = random_pose(random, i % 2 == 0 ? 100 : 1000);
                InterferenceOptions full;
                full.contacts = true;
                const Relation expected = interfere(*a, pa, *b, pb, full).relation;
                ObbWalk::Stack stack;
                const auto quick = quick_relation(trisect::detail::data_of(*a), pa,
                                                  trisect::detail::data_of(*b), pb, stack);
                ++asked;
                certain += quick ? 1 : 0;
                EXPECT_EQ(quick.value_or(expected), expected);
                EXPECT_EQ(interfere(*a, pa, *b, pb).relation, expected);
                ++seen[expected];
            }
    EXPECT_EQ(certain, asked);
    EXPECT_GT(seen[Relation::Disjoint], 10);
    EXPECT_GT(seen[Relation::Overlapping], 10);
    EXPECT_GT(seen[Relation::Inside], 10);
    EXPECT_GT(seen[Relation::Contains], 10);
}

// The top of a block on which a tent stands with an edge. Bars that go through it cross triangles
// that are not clear; away from the edge this shows an overlap all the same, and never anything
// wrong next to it.
TEST(QuickRelation, CrossingsOfAFaceInWhichAnEdgeLies) {
    trisect::PolygonMesh tent;
    tent.points = {{1, 3, 4}, {3, 3, 4}, {1, 4, 7}, {3, 0, 7}};
    for (const auto& [i, j, k] : {std::tuple(0U, 2U, 1U), std::tuple(0U, 1U, 3U),
                                  std::tuple(1U, 2U, 3U), std::tuple(2U, 0U, 3U)})
        tent.add_triangle(i, j, k);
    const Solid block = Solid::from_mesh(trisect::make_box({0, 0, 0}, {4, 4, 4}));
    const InterferenceModel whole(evaluate(Expression(block) | Solid::from_mesh(tent)));
    ASSERT_TRUE(trisect::detail::data_of(whole).touches_itself());
    const InterferenceModel bar(
        Solid::from_mesh(trisect::make_box({-0.25, -0.25, -1}, {0.25, 0.25, 1})));
    Random random(43);
    int told = 0;
    for (int i = 0; i < 600; ++i) {
        const auto at = [&random](std::int64_t lo, std::int64_t hi) {
            return 0.125 * static_cast<double>(random.between(lo, hi));
        };
        const Pose pose = i % 2 == 0 ? Pose::from_translation({at(-4, 36), at(-4, 36), at(24, 44)})
                                     : Pose::from_quaternion({9, random.between(-3, 3), 2, 1},
                                                             {at(0, 32), at(0, 32), at(28, 40)});
        InterferenceOptions full;
        full.contacts = true;
        const Relation expected = interfere(whole, Pose(), bar, pose, full).relation;
        EXPECT_EQ(interfere(whole, Pose(), bar, pose).relation, expected) << i;
        ObbWalk::Stack stack;
        const auto quick = quick_relation(trisect::detail::data_of(whole), Pose(),
                                          trisect::detail::data_of(bar), pose, stack);
        EXPECT_EQ(quick.value_or(expected), expected) << i;
        told += quick == Relation::Overlapping ? 1 : 0;
    }
    EXPECT_GT(told, 150);
}

// Flush and touching solids are left to the exact tests, never guessed.
TEST(QuickRelation, ContactIsNotDecidedByDoubles) {
    const InterferenceModel box(Solid::from_mesh(trisect::make_box({0, 0, 0}, {2, 2, 2})));
    WalkCounters counters;
    ObbWalk::Stack stack;
    for (const std::array<double, 3>& by :
         {std::array<double, 3>{2, 0, 0}, {2, 2, 2}, {2, 2, 0}, {0, 0, 0}})
        EXPECT_FALSE(quick_relation(trisect::detail::data_of(box), Pose(),
                                    trisect::detail::data_of(box), Pose::from_translation(by),
                                    stack, &counters));
    EXPECT_EQ(quick_relation(trisect::detail::data_of(box), Pose(), trisect::detail::data_of(box),
                             Pose::from_translation({2.001, 0, 0}), stack, &counters),
              Relation::Disjoint);
    EXPECT_GT(counters.unknown, 0U);
}

}  // namespace
