// SPDX-License-Identifier: Apache-2.0
//
// Interference of solids on their own trees against that of models, which are made of B-reps.

#include <trisect/bsp/interference/solid_interference.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include <trisect/brep/primitives/cylinder.h>
#include <trisect/bsp/solid.h>

#include "support/solid_interference_oracle.h"

namespace {

using trisect::Relation;

TEST(SolidInterference, OfRandomScenesIsThatOfModels) {
    std::map<Relation, int> seen;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        Relation relation{};
        EXPECT_EQ(
            brute::difference_of_solids(scene, static_cast<std::uint32_t>(1 + seed % 7), &relation),
            "")
            << "seed " << seed;
        ++seen[relation];
    }
    for (const Relation r : {Relation::Disjoint, Relation::Touching, Relation::Overlapping,
                             Relation::Inside, Relation::Contains, Relation::Equal})
        EXPECT_GT(seen[r], 10) << to_string(r);
}

TEST(SolidInterference, AlongCutsOfRandomSolidsIsThatOfModels) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        EXPECT_EQ(brute::difference_along_cuts(scene, static_cast<std::uint32_t>(1 + seed % 7),
                                               random, 3),
                  "")
            << "seed " << seed;
    }
}

// The hull of a leaf reaches beyond the leaf's bounds, with its centre in the other solid, while
// the boundary in the leaf is outside.
TEST(SolidInterference, CentresOfHullsSayNothing) {
    constexpr std::uint64_t seed = 20263293;
    reference::Random random(seed);
    const brute::Scene scene = brute::random_scene(random);
    EXPECT_EQ(
        brute::difference_along_cuts(scene, static_cast<std::uint32_t>(1 + seed % 7), random, 3),
        "");
}

// All pairs of triangles that lie above each other are equally near.
TEST(SolidInterference, PairsOfParallelFacesAreComparedAlongTheirNormal) {
    const trisect::Solid disc =
        trisect::Solid::from_mesh(trisect::make_cylinder(1, 1, 240), trisect::SolidOptions{});
    const auto above = [](double z) { return trisect::Pose::from_translation({0.25, 0.125, z}); };
    EXPECT_EQ(exact_squared_distance(disc, trisect::Pose(), disc, above(4)),
              trisect::ExactRational(9));
    EXPECT_FALSE(are_nearer_than(disc, trisect::Pose(), disc, above(4), 3));
    EXPECT_TRUE(are_nearer_than(disc, trisect::Pose(), disc, above(4), std::nextafter(3, 4)));
    EXPECT_TRUE(are_nearer_than(disc, trisect::Pose(), disc, above(std::nextafter(4, 3)), 3));
}

}  // namespace
