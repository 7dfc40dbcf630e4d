// SPDX-License-Identifier: Apache-2.0
//
// Boxes cut off by slanted planes: their corners are fractions, named by three planes. The same
// scene six times as large has corners on the lattice, so all answers about it follow ways that
// know no fractions; times and relations must be the same, squared distances 36 times as large.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_query.h>

#include "reference/random_solids.h"

namespace {

using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::LatticePoint;
using trisect::Motion;
using trisect::Plane;
using trisect::Pose;
using trisect::Screw;
using trisect::Solid;

constexpr std::int64_t times = 6;

std::array<double, 3> scaled(std::array<double, 3> v, double by) {
    for (double& x : v) x *= by;
    return v;
}

// A box, and what of it is below n·x = d; coefficients are 1, 2 or 3, so that corners are sixths.
struct CutBox {
    std::array<double, 3> hi{};
    std::array<std::int64_t, 3> normal{};
    std::int64_t level = 0;

    static CutBox random(reference::Random& random) {
        CutBox c;
        double most = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            c.hi[k] = static_cast<double>(random.between(2, 5));
            c.normal[k] = random.between(1, 3);
            most += c.hi[k] * static_cast<double>(c.normal[k]);
        }
        c.level = random.between(2, static_cast<std::int64_t>(most) - 2);
        return c;
    }
    [[nodiscard]] Solid solid(std::int64_t by) const {
        const auto box =
            Solid::from_mesh(trisect::make_box({0, 0, 0}, scaled(hi, static_cast<double>(by))));
        // Through the points where it meets the axes, 6 times as far away as the level says.
        const std::int64_t d = by * level;
        const Plane plane(normal[0], normal[1], normal[2], Plane::Coefficient(-d));
        return evaluate(trisect::Expression(box) &
                        trisect::Expression(Solid::half_space(plane, {})));
    }
    [[nodiscard]] InterferenceModel model() const { return InterferenceModel(solid(1)); }
    // Of triangles with lattice corners.
    [[nodiscard]] InterferenceModel large() const {
        return InterferenceModel(Solid::from_mesh(solid(times).to_mesh()));
    }
};

bool has_fractions(const InterferenceModel& m) {
    for (const trisect::Point& p : m.brep().points())
        if (!p.is_lattice()) return true;
    return false;
}

std::array<double, 3> place(reference::Random& random, std::int64_t reach) {
    return {static_cast<double>(random.between(-reach, reach)),
            static_cast<double>(random.between(-reach, reach)),
            static_cast<double>(random.between(-reach, reach))};
}

std::array<std::int64_t, 4> turn(reference::Random& random) {
    if (random.chance(1, 2)) return {1, 0, 0, 0};
    return {random.between(1, 3), random.between(-2, 2), random.between(-2, 2),
            random.between(-2, 2)};
}

TEST(RationalCorners, RelationsAndDistancesAreThoseOfTheLargeScene) {
    int with_fractions = 0;
    std::array<int, 6> relations{};
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed);
        const CutBox cut_a = CutBox::random(random);
        const CutBox cut_b = random.chance(1, 8) ? cut_a : CutBox::random(random);
        const InterferenceModel a = cut_a.model();
        const InterferenceModel b = cut_b.model();
        const InterferenceModel large_a = cut_a.large();
        const InterferenceModel large_b = cut_b.large();
        ASSERT_FALSE(has_fractions(large_a) || has_fractions(large_b)) << "seed " << seed;
        with_fractions += has_fractions(a) && has_fractions(b) ? 1 : 0;
        trisect::InterferenceQuery query(a, b);
        for (int i = 0; i < 3; ++i) {
            const auto q = i == 0 ? std::array<std::int64_t, 4>{1, 0, 0, 0} : turn(random);
            const auto at = place(random, i == 0 ? 0 : 5);
            const Pose pose = Pose::from_quaternion(q, at);
            const Pose large = Pose::from_quaternion(q, scaled(at, times));
            const auto relation = interfere(a, Pose(), b, pose).relation;
            EXPECT_EQ(relation, interfere(large_a, Pose(), large_b, large).relation)
                << "seed " << seed << ", pose " << i;
            EXPECT_EQ(query.relation(Pose(), pose), relation) << "seed " << seed;
            ++relations[static_cast<std::size_t>(relation)];
            const auto squared = exact_squared_distance(a, Pose(), b, pose);
            const auto large_squared = exact_squared_distance(large_a, Pose(), large_b, large);
            ASSERT_TRUE(squared && large_squared);
            EXPECT_EQ(*squared * ExactRational(times * times), *large_squared)
                << "seed " << seed << ", pose " << i;
        }
    }
    EXPECT_GT(with_fractions, 20);
    for (std::size_t i = 0; i < relations.size(); ++i) EXPECT_GT(relations[i], 0) << i;
}

TEST(RationalCorners, FirstContactsAreAtTheTimesOfTheLargeScene) {
    int contacts = 0;
    int overlaps = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        reference::Random random(seed + 500);
        const CutBox cut_a = CutBox::random(random);
        const CutBox cut_b = CutBox::random(random);
        const auto q = turn(random);
        std::array<double, 3> at = place(random, 4);
        const std::size_t axis = random.below(3);
        const double side = random.chance(1, 2) ? 1 : -1;
        at[axis] = 14 * side;
        Screw screw;
        screw.turn = turn(random);
        screw.center = place(random, 3);
        screw.shift = place(random, 3);
        screw.shift[axis] = -20 * side;
        const auto motion = [&](double by) {
            Screw s = screw;
            s.center = scaled(s.center, by);
            s.shift = scaled(s.shift, by);
            return Motion::screw(Pose::from_quaternion(q, scaled(at, by)), s);
        };
        for (const auto event : {trisect::ContactEvent::Touch, trisect::ContactEvent::Overlap}) {
            trisect::FirstContactOptions options;
            options.event = event;
            const auto found =
                first_contact(cut_a.model(), Motion(), cut_b.model(), motion(1), options);
            const auto large = first_contact(cut_a.large(), Motion(), cut_b.large(),
                                             motion(static_cast<double>(times)), options);
            EXPECT_EQ(found.at_start, large.at_start) << "seed " << seed;
            ASSERT_EQ(found.exists(), large.exists()) << "seed " << seed;
            if (!found.exists()) continue;
            EXPECT_TRUE(*found.time == *large.time) << "seed " << seed;
            EXPECT_EQ(found.witnesses.size(), large.witnesses.size()) << "seed " << seed;
            ++(event == trisect::ContactEvent::Touch ? contacts : overlaps);
        }
    }
    EXPECT_GT(contacts, 20);
    EXPECT_GT(overlaps, 20);
}

}  // namespace
