// SPDX-License-Identifier: Apache-2.0
//
// Relations and contacts of random scenes on a small grid against brute force in rationals.

#include <trisect/bsp/interference/interference.h>

#include <gtest/gtest.h>

#include <map>

#include "support/interference_oracle.h"

namespace {

using trisect::Relation;

TEST(Interference, OfRandomScenesIsWhatBruteForceSays) {
    std::map<Relation, int> seen;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        Relation relation{};
        EXPECT_EQ(brute::difference(scene, &relation), "") << "seed " << seed;
        ++seen[relation];
    }
    for (const Relation r : {Relation::Disjoint, Relation::Touching, Relation::Overlapping,
                             Relation::Inside, Relation::Contains, Relation::Equal})
        EXPECT_GT(seen[r], 10) << to_string(r);
}

}  // namespace
