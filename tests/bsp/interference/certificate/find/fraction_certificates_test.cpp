// SPDX-License-Identifier: Apache-2.0
//
// Certificates for solids whose coordinates have bits behind the point: they are as complete as
// those of the same solids without, hold, and do not hold where one digit is cut off.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/interference/contact_certificate.h>
#include <trisect/bsp/interference/distance_certificate.h>
#include <trisect/bsp/interference/enclosed_certificate.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/overlap_certificate.h>

#include "support/fraction_models.h"
#include "support/moving_pair.h"
#include "support/placed_pair.h"
#include "support/reason.h"

namespace {

using trisect::InterferenceModel;
using trisect::Pose;
using trisect::test::model_in_units_of;
using trisect::test::with_fractions;

constexpr std::array<std::array<int, 2>, 5> both_bits{
    {{8, 0}, {0, 24}, {56, 56}, {70, 3}, {24, 66}}};

TEST(FractionCertificates, OfRelationsAndDistances) {
    for (std::uint64_t seed = 5000; seed < 5060; ++seed) {
        reference::Random random(seed);
        const brute::PlacedPair p = brute::placed_pair(random);
        const auto& bits = both_bits[seed % both_bits.size()];
        const InterferenceModel a = with_fractions(p.a, bits[0]);
        const InterferenceModel b = with_fractions(p.b, bits[1]);
        const auto whole = certify_relation(p.a, p.pose_a, p.b, p.pose_b);
        const auto found = certify_relation(a, p.pose_a, b, p.pose_b);
        EXPECT_EQ(found.relation, whole.relation) << "seed " << seed;
        EXPECT_EQ(found.is_complete, whole.is_complete) << "seed " << seed;
        EXPECT_EQ(refusals::reason(check(found, a.brep(), p.pose_a, b.brep(), p.pose_b)), "")
            << "seed " << seed;
        const auto distance = certify_distance(a, p.pose_a, b, p.pose_b);
        EXPECT_EQ(distance.is_complete, certify_distance(p.a, p.pose_a, p.b, p.pose_b).is_complete)
            << "seed " << seed;
        EXPECT_EQ(refusals::reason(check(distance, a.brep(), p.pose_a, b.brep(), p.pose_b)), "")
            << "seed " << seed;
    }
}

TEST(FractionCertificates, OfContactsAndOverlapsInMotion) {
    int contacts = 0;
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        const moving::Pair p = moving::random_pair(seed);
        const auto& bits = both_bits[seed % both_bits.size()];
        const InterferenceModel a = with_fractions(p.a, bits[0]);
        const InterferenceModel b = with_fractions(p.b, bits[1]);
        const auto contact = certify_first_contact(a, p.motion_a, b, p.motion_b);
        EXPECT_TRUE(contact.is_complete) << "seed " << seed;
        contacts += contact.is_contact ? 1 : 0;
        EXPECT_EQ(refusals::reason(check(contact, a.brep(), p.motion_a, b.brep(), p.motion_b)), "")
            << "seed " << seed;
        if (seed % 5 != 0) continue;
        const auto whole = certify_first_overlap(p.a, p.motion_a, p.b, p.motion_b);
        const auto overlap = certify_first_overlap(a, p.motion_a, b, p.motion_b);
        EXPECT_EQ(overlap.is_complete, whole.is_complete) << "seed " << seed;
        EXPECT_EQ(overlap.is_overlap, whole.is_overlap) << "seed " << seed;
        EXPECT_EQ(refusals::reason(check(overlap, a.brep(), p.motion_a, b.brep(), p.motion_b)), "")
            << "seed " << seed;
        const trisect::EnclosedMotion enclosed_a(p.motion_a);
        const trisect::EnclosedMotion enclosed_b(p.motion_b);
        const auto enclosed = certify_enclosed_contact(a, enclosed_a, b, enclosed_b, {1e-3});
        EXPECT_EQ(refusals::reason(check(enclosed, a.brep(), enclosed_a, b.brep(), enclosed_b)), "")
            << "seed " << seed;
    }
    EXPECT_GT(contacts, 4);
}

// Boxes flush at 0.3, on lattices of their own: the proof is for these coordinates and no others.
TEST(FractionCertificates, OfFlushBoxesSayTheLastDigit) {
    const auto box = [](double low, double high, int exponent) {
        return model_in_units_of(trisect::make_box({low, -1, -1}, {high, 1, 1}), exponent);
    };
    const InterferenceModel a = box(-0.1, 0.3, -46);
    const InterferenceModel b = box(0.3, 1000, -36);
    const InterferenceModel cut = box(0.3 - 0x1p-54, 1000, -36);
    const InterferenceModel apart = box(0.3 + 0x1p-54, 1000, -36);
    const auto touching = certify_relation(a, Pose(), b, Pose());
    EXPECT_EQ(touching.relation, trisect::Relation::Touching);
    EXPECT_TRUE(touching.is_complete);
    EXPECT_EQ(refusals::reason(check(touching, a.brep(), Pose(), b.brep(), Pose())), "");
    EXPECT_NE(refusals::reason(check(touching, a.brep(), Pose(), cut.brep(), Pose())), "");
    EXPECT_NE(refusals::reason(check(touching, a.brep(), Pose(), apart.brep(), Pose())), "");
    const auto disjoint = certify_relation(a, Pose(), apart, Pose());
    EXPECT_EQ(disjoint.relation, trisect::Relation::Disjoint);
    EXPECT_EQ(refusals::reason(check(disjoint, a.brep(), Pose(), apart.brep(), Pose())), "");
    EXPECT_NE(refusals::reason(check(disjoint, a.brep(), Pose(), b.brep(), Pose())), "");
}

}  // namespace
