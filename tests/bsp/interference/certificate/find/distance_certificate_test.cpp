// SPDX-License-Identifier: Apache-2.0
//
// Certificates of distances: those of random scenes are accepted, corrupted ones are not.

#include <trisect/bsp/interference/distance_certificate.h>

#include <gtest/gtest.h>

#include <string>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/boundary_distance.h>

#include "support/models.h"
#include "support/placed_pair.h"
#include "support/reason.h"

namespace distance_certificate_test {
namespace {

using models::box;
using trisect::certify_distance;
using trisect::DistanceCertificate;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::SlabNode;
using trisect::Solid;

struct Case : brute::PlacedPair {
    [[nodiscard]] DistanceCertificate certificate() const {
        return certify_distance(a, pose_a, b, pose_b);
    }
    [[nodiscard]] std::string check(const DistanceCertificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), pose_a, b.brep(), pose_b));
    }
};

// Every other pair is moved apart; pairs of a small grid have many closest features then.
Case random_case(std::uint64_t seed) {
    reference::Random random(seed);
    Case c{brute::placed_pair(random)};
    if (seed % 2 == 0) return c;
    std::array<double, 3> by{};
    for (double& x : by) x = static_cast<double>(random.between(-6, 6));
    by[random.below(3)] += random.chance(1, 2) ? 14 : -14;
    c.pose_b =
        random.chance(1, 2) ? Pose::from_translation(by) : Pose::from_quaternion({3, 1, -1, 2}, by);
    c.pose_a = Pose();
    return c;
}

void expect_proved(const Case& c, const std::string& squared = {}) {
    const DistanceCertificate certificate = c.certificate();
    EXPECT_TRUE(certificate.is_complete);
    EXPECT_EQ(c.check(certificate), "");
    EXPECT_EQ(certificate.squared, *trisect::exact_squared_distance(c.a, c.pose_a, c.b, c.pose_b));
    if (!squared.empty()) {
        EXPECT_EQ(certificate.squared.to_string(), squared);
    }
}

TEST(DistanceCertificates, OfNamedConfigurations) {
    const auto unit = box(0, 0, 0, 1, 1, 1);
    expect_proved({{unit, box(3, 0, 0, 4, 1, 1), Pose(), Pose()}}, "4");   // faces
    expect_proved({{unit, box(3, 3, 0, 4, 4, 1), Pose(), Pose()}}, "8");   // edges, parallel
    expect_proved({{unit, box(2, 3, 4, 5, 5, 5), Pose(), Pose()}}, "14");  // corners
    expect_proved({{unit, box(1, 0, 0, 2, 1, 1), Pose(), Pose()}}, "0");   // touching
    expect_proved({{unit, box(-4, -4, -4, 5, 5, 5), Pose(), Pose()}},
                  "16");  // within: the clearance
    expect_proved({{unit, unit, Pose(), Pose()}}, "0");
    // Edges that are askew; a corner over a face that is turned.
    expect_proved({{unit, unit, Pose(), Pose::from_quaternion({3, 1, 1, 0}, {0, 3, 1})}});
    expect_proved({{unit, unit, Pose(), Pose::from_quaternion({5, 1, -2, 3}, {3, -2, 1})}});
    expect_proved({{unit, unit, Pose(),
                    Pose::from_doubles({1, 0, 0, 1 + 0x1p-40, 0, 1, 0, 0.1, 0, 0, 1, 0.3})}});
}

TEST(DistanceCertificates, OfEmptySolidsAreIncomplete) {
    const Case c{{InterferenceModel(Solid()), box(0, 0, 0, 1, 1, 1), Pose(), Pose()}};
    DistanceCertificate certificate = c.certificate();
    EXPECT_FALSE(certificate.is_complete);
    EXPECT_EQ(c.check(certificate), "");
    certificate.is_complete = true;
    EXPECT_NE(c.check(certificate), "");
}

TEST(DistanceCertificates, OfCurvedParts) {
    const auto torus = InterferenceModel(Solid::from_mesh(trisect::make_torus(3, 1, 24, 12)));
    const auto ball = InterferenceModel(Solid::from_mesh(trisect::make_icosphere(1, 2)));
    expect_proved({{torus, ball, Pose(), Pose()}});  // in the hole, equally far all around
    expect_proved({{torus, torus, Pose(), Pose::from_quaternion({1, 1, 0, 0}, {3, 0, 0})}});
    expect_proved({{torus, ball, Pose(), Pose::from_quaternion({3, 1, 2, 0}, {4, 4, 1})}});
}

TEST(DistanceCertificates, OfRandomScenesAreAccepted) {
    int apart = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        const Case c = random_case(seed);
        if (c.a.is_empty() || c.b.is_empty()) continue;
        const DistanceCertificate certificate = c.certificate();
        EXPECT_TRUE(certificate.is_complete) << "seed " << seed;
        EXPECT_EQ(c.check(certificate), "") << "seed " << seed;
        apart += certificate.squared.sign() > 0 ? 1 : 0;
    }
    EXPECT_GT(apart, 200);
}

// Takes the proof away; false where there is nothing to change.
bool corrupt(DistanceCertificate& c, reference::Random& random) {
    const ExactRational half = ExactRational(1).scaled(-1);
    SlabNode* node = c.slabs.empty() ? nullptr : &c.slabs[random.below(c.slabs.size())];
    switch (random.below(10)) {
        case 0:
            c.squared += ExactRational(1).scaled(-60);
            return !c.slabs.empty();  // nearer than claimed, but not the slabs
        case 1:
            c.squared -= ExactRational(1).scaled(-60);
            return true;
        case 2:
            c.on_a.point[random.below(3)] += half;
            return true;
        case 3:
            c.on_b.face = trisect::FaceId();
            return true;
        case 4:
            if (node == nullptr) return false;
            if (node->kind == SlabNode::Kind::Separated)
                for (ExactRational& x : node->slab.normal) x = -x;
            else
                node->other = 0;
            return true;
        case 5:
            if (node == nullptr || node->kind != SlabNode::Kind::Separated) return false;
            node->slab.above = node->slab.below;
            return true;
        case 6:
            if (node == nullptr || node->kind != SlabNode::Kind::Separated) return false;
            for (ExactRational& x : node->slab.normal) x = x * half;
            return true;
        case 7:
            if (c.slabs.empty()) return false;
            c.triangles_a.pop_back();
            return true;
        case 8:
            if (c.slabs.empty()) return false;
            c.slabs.pop_back();
            return c.slabs.size() > 0;
        default:
            if (c.triangles_b.empty()) return false;
            c.triangles_b[random.below(c.triangles_b.size())].vertex[1] = trisect::VertexId();
            return true;
    }
}

TEST(DistanceCertificates, CorruptedAreRejected) {
    reference::Random random(3);
    int corrupted = 0;
    for (std::uint64_t seed = 2000; corrupted < 1000; ++seed) {
        const Case c = random_case(seed);
        if (c.a.is_empty() || c.b.is_empty()) continue;
        const DistanceCertificate right = c.certificate();
        for (int k = 0; k < 20; ++k) {
            DistanceCertificate wrong = right;
            if (!corrupt(wrong, random)) continue;
            EXPECT_NE(c.check(wrong), "") << "seed " << seed << ", change " << k;
            ++corrupted;
        }
    }
}

}  // namespace
}  // namespace distance_certificate_test
