// SPDX-License-Identifier: Apache-2.0
//
// Motions of a degree that the search's enclosures do not reach: every pair of triangles is asked
// exactly. A motion whose shift goes with the tenth power of the time meets what the straight one
// meets, at the tenth root of its time.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/solid_motion.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/models.h"
#include "support/solids.h"

namespace {

using models::box;
using trisect::AlgebraicNumber;
using trisect::ExactRational;
using trisect::FirstContact;
using trisect::InterferenceModel;
using trisect::Motion;

constexpr std::size_t degree = 10;

// From a place, by a shift times a power of the time.
Motion shifted(const std::array<double, 3>& from, const std::array<double, 3>& by,
               std::size_t power) {
    std::array<std::vector<ExactRational>, 12> entries;
    for (std::size_t k = 0; k < 3; ++k) {
        entries[5 * k] = {1};
        std::vector<ExactRational>& shift = entries[4 * k + 3];
        shift.resize(power + 1);
        shift.front() = ExactRational::from_double(from[k]);
        shift.back() = ExactRational::from_double(by[k]);
    }
    return Motion::rational(entries, {1});
}

TEST(MotionsOfDegreeTen, BlocksFaceToFaceEdgeToEdgeAndCornerToCorner) {
    const auto unit = box(0, 0, 0, 1, 1, 1);
    const auto found = [&](const std::array<double, 3>& from, const std::array<double, 3>& by) {
        return first_contact(unit, Motion(), unit, shifted(from, by, degree));
    };
    const AlgebraicNumber half(ExactRational(1).scaled(-1));
    const FirstContact faces = found({2, 0, 0}, {-1024, 0, 0});
    ASSERT_TRUE(faces.exists());
    EXPECT_TRUE(*faces.time == half);
    const FirstContact corners = found({2, 2, 2}, {-1024, -1024, -1024});
    ASSERT_TRUE(corners.exists());
    EXPECT_TRUE(*corners.time == half);
    EXPECT_EQ(corners.witnesses.size(), 1U);
    EXPECT_FALSE(found({2, 0, 0}, {-0.5, 0, 0}).exists());
    EXPECT_TRUE(found({2, 0, 0}, {-1, 0, 0}).exists());      // at the end
    EXPECT_FALSE(found({2, 2, 0}, {-1024, 0, 0}).exists());  // past it
    EXPECT_TRUE(found({2, 1, 0}, {-1024, 0, 0}).exists());   // grazing
}

// On their own trees, in cells of few polygons.
TEST(MotionsOfDegreeTen, OfSolids) {
    trisect::EvaluateOptions options;
    options.leaf_polygons = 3;
    const trisect::Solid notched = evaluate(trisect::Expression(solids::box(0, 4)) -
                                                trisect::Expression(solids::box(-1, 1, 1, 2, 3, 3)),
                                            options);
    const trisect::Solid pin = solids::box(0, 1);
    const auto found = [&](const std::array<double, 3>& from) {
        const Motion motion = shifted(from, {4096, 0, 0}, degree);
        const auto c = first_contact(notched, Motion(), pin, motion);
        EXPECT_EQ(c.time, first_contact(InterferenceModel(notched), Motion(),
                                        InterferenceModel(pin), motion)
                              .time);
        return c;
    };
    EXPECT_EQ(found({-3, 1.5, 1.5}).time, AlgebraicNumber(ExactRational(1).scaled(-1)));
    EXPECT_FALSE(found({-5, 0, 0}).witnesses.empty());
    EXPECT_FALSE(found({-5, 9, 0}).exists());
}

TEST(MotionsOfDegreeTen, MeetAtTheTenthRootOfTheTimeOfStraightOnes) {
    int contacts = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed);
        const InterferenceModel a(engines::solid(reference::random_embedded_solid(random)));
        const InterferenceModel b(engines::solid(reference::random_embedded_solid(random)));
        std::array<double, 3> from{};
        std::array<double, 3> by{};
        for (std::size_t k = 0; k < 3; ++k) {
            from[k] = static_cast<double>(random.between(-3, 3));
            by[k] = static_cast<double>(random.between(-6, 6));
        }
        const std::size_t axis = random.below(3);
        from[axis] = 18;
        by[axis] = static_cast<double>(random.between(-30, -10));
        const FirstContact straight = first_contact(a, Motion(), b, shifted(from, by, 1));
        const FirstContact found = first_contact(a, Motion(), b, shifted(from, by, degree));
        ASSERT_EQ(found.exists(), straight.exists()) << "seed " << seed;
        if (!found.exists()) continue;
        ++contacts;
        // The straight time's polynomial, of the tenth power.
        const std::vector<ExactRational> p = straight.time->polynomial();
        std::vector<ExactRational> of_power(degree * (p.size() - 1) + 1);
        for (std::size_t i = 0; i < p.size(); ++i) of_power[degree * i] = p[i];
        EXPECT_EQ(found.time->sign_of(of_power), 0) << "seed " << seed;
        EXPECT_EQ(found.witnesses, straight.witnesses) << "seed " << seed;
    }
    EXPECT_GT(contacts, 20);
}

}  // namespace
