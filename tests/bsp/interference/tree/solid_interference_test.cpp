// SPDX-License-Identifier: Apache-2.0
//
// Interference of solids on their own trees against that of models, which are made of B-reps.

#include <trisect/bsp/interference/solid_interference.h>

#include <gtest/gtest.h>

#include <map>

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

}  // namespace
