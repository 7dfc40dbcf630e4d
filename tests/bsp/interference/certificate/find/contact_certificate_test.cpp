// SPDX-License-Identifier: Apache-2.0
//
// Certificates of first contact: those of random scenes are accepted, corrupted ones are not.

#include <trisect/bsp/interference/contact_certificate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/primitives/torus.h>

#include "support/certified_pair.h"
#include "support/models.h"
#include "support/moving_pair.h"

namespace contact_certificate_test {
namespace {

using models::box;
using moving::by;
using trisect::CommonPoint;
using trisect::ContactCertificate;
using trisect::ExactRational;
using trisect::FreedomNode;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::MovingSeparator;
using trisect::Pose;
using trisect::Screw;
using trisect::Solid;

using Case = moving::ContactPair;

void expect_proved(const Case& c, bool is_contact) {
    const ContactCertificate certificate = c.certificate();
    EXPECT_EQ(certificate.is_contact, is_contact);
    EXPECT_TRUE(certificate.is_complete);
    EXPECT_EQ(c.check(certificate), "");
}

TEST(ContactCertificates, OfNamedConfigurations) {
    const auto floor = box(0, 0, 0, 4, 4, 1);
    expect_proved({{floor, Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -4)}}, true);  // flat
    expect_proved({{floor, Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -1)}}, false);
    expect_proved({{floor, Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -2)}}, true);  // at the end
    expect_proved({{floor, Motion(), box(0, 0, 3, 4, 4, 4), by(0, 0, -4)}},
                  true);                                                            // the same face
    expect_proved({{floor, Motion(), box(4, 4, 3, 5, 5, 4), by(0, 0, -4)}}, true);  // one corner
    expect_proved({{floor, Motion(), box(4, 0, 3, 5, 4, 4), by(0, 0, -4)}}, true);  // one edge
    expect_proved({{floor, Motion(), box(5, 5, 2, 6, 6, 3), by(-1, -1, -1)}}, true);
    expect_proved({{floor, Motion(), box(5, 5, 2, 6, 6, 3), by(-2, -2, -1)}}, true);
    expect_proved({{floor, Motion(), box(1, 1, 0, 2, 2, 4), by(0, 0, -4)}},
                  true);  // at the start
    Screw screw;
    screw.turn = {2, 0, 1, 0};
    expect_proved({{floor, Motion(), box(1, 1, 3, 2, 2, 4), Motion::screw(Pose(), screw)}}, true);
    screw.turn = {1, 0, 0, 1};
    const auto arm = box(0, 0, 0, 3, 4, 1);
    expect_proved({{box(-1, 5, 0, 1, 6, 1), Motion(), arm, Motion::screw(Pose(), screw)}}, true);
    expect_proved({{box(-1, 5 + 0x1p-20, 0, 1, 6, 1), Motion(), arm, Motion::screw(Pose(), screw)}},
                  false);
}

TEST(ContactCertificates, OfPiecesAndBothMoving) {
    const std::vector<Pose> poses{Pose(), Pose::from_translation({1, 0, 3}),
                                  Pose::from_translation({2, 0, -4})};
    const auto floor = box(0, 0, 0, 8, 8, 1);
    expect_proved({{floor, Motion(), box(1, 1, 2, 2, 2, 3), Motion::through(poses)}}, true);
    expect_proved({{floor, Motion::through(poses), box(1, 1, 2, 2, 2, 3), Motion::through(poses)}},
                  false);
    Screw screw;
    screw.turn = {3, 1, 0, 1};
    screw.shift = {1, 0, -2};
    expect_proved({{floor, Motion::screw(Pose(), screw), box(1, 1, 4, 2, 2, 5), by(0, 0, -8)}},
                  true);
}

TEST(ContactCertificates, OfLinkedRings) {
    const auto ring = InterferenceModel(Solid::from_mesh(trisect::make_torus(3, 0.75, 12, 6)));
    const Pose link = Pose::from_quaternion({1, 1, 0, 0}, {3, 0, 0});
    expect_proved({{ring, Motion(), ring, Motion::translation(link, {-0.5, 0.25, 0.25})}}, false);
    expect_proved({{ring, Motion(), ring, Motion::translation(link, {3, 1, 0.5})}}, true);
}

Case random_case(std::uint64_t seed) { return {moving::random_pair(seed)}; }

TEST(ContactCertificates, OfRandomScenesAreAccepted) {
    int contacts = 0;
    int complete = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const Case c = random_case(seed);
        const ContactCertificate certificate = c.certificate();
        EXPECT_EQ(c.check(certificate), "") << "seed " << seed;
        contacts += certificate.is_contact ? 1 : 0;
        complete += certificate.is_complete ? 1 : 0;
        if (!certificate.is_contact) {
            EXPECT_TRUE(certificate.is_complete) << "seed " << seed;
        }
    }
    EXPECT_GT(contacts, 60);
    EXPECT_GT(300 - contacts, 50);
    EXPECT_EQ(complete, 300);
    RecordProperty("contacts", contacts);
    RecordProperty("complete", complete);
}

// Takes the proof away; false where there is nothing to change.
bool corrupt(ContactCertificate& c, reference::Random& random) {
    if (c.freedom.empty()) return false;
    auto& tree = c.freedom[random.below(c.freedom.size())];
    FreedomNode& n = tree[random.below(tree.size())];
    switch (random.below(9)) {
        case 0:
            if (n.kind == FreedomNode::Kind::Separated) return false;
            n.other = 0;
            return true;
        case 1:
            if (n.kind != FreedomNode::Kind::Separated) return false;
            if (n.separator.kind == MovingSeparator::Kind::Edges) {
                n.separator.flipped = !n.separator.flipped;
                return true;
            }
            for (ExactRational& x : n.separator.plane.normal) x = -x;
            n.separator.plane.offset = -n.separator.plane.offset;
            return true;
        case 2:
            if (n.kind != FreedomNode::Kind::SplitTime) return false;
            n.time += ExactRational(2);
            return true;
        case 3:
            tree.pop_back();
            return true;
        case 4:
            if (!c.is_contact) return false;
            // The solids are free up to there, and for longer.
            c.lower = (c.lower + c.upper) / ExactRational(2);
            c.polynomial = {-c.lower, ExactRational(1)};
            c.lower -= ExactRational(1).scaled(-90);
            return true;
        case 5:
            if (!c.is_contact) return false;
            c.polynomial[0] += ExactRational(1);
            return true;
        case 6:
            c.triangles_a.pop_back();
            return true;
        case 7:
            if (!c.is_contact) {
                c.is_contact = true;
                return true;
            }
            // No contact at all: the tree ends before the time does.
            c.is_contact = false;
            return true;
        default:
            if (!c.is_contact) return false;
            std::swap(c.common_point.triangle_a.vertex[0], c.common_point.triangle_a.vertex[1]);
            return true;
    }
}

TEST(ContactCertificates, CorruptedAreRejected) {
    reference::Random random(5);
    int corrupted = 0;
    for (std::uint64_t seed = 400; corrupted < 1000; ++seed) {
        const Case c = random_case(seed);
        const ContactCertificate right = c.certificate();
        if (!right.is_complete) continue;
        for (int k = 0; k < 20; ++k) {
            ContactCertificate wrong = right;
            const std::string before = std::to_string(k);
            if (!corrupt(wrong, random)) continue;
            EXPECT_NE(c.check(wrong), "") << "seed " << seed << ", change " << before;
            ++corrupted;
        }
    }
}

// A corner that passes the plane of a plate beside it, and comes over the plate when it is below.
// Contact is claimed for the first moment, which is a double root of the polynomial.
TEST(ContactCertificates, ABlockThatPassesUnderAPlateDoesNotTouchItBeside) {
    const Case c{{box(0, 0, 0.875, 4, 4, 1), Motion(), box(5, 1, 0.25, 6, 2, 1.25), by(-2, 0, -1)}};
    ContactCertificate claim = c.certificate();
    ASSERT_TRUE(claim.is_complete);
    ASSERT_FALSE(claim.is_contact);
    ASSERT_EQ(c.check(claim), "");
    const auto corners = trisect::to_polygon_mesh(c.b.brep()).points;
    const auto at = std::ranges::find(corners, trisect::Point3d{5, 1, 1.25});
    ASSERT_NE(at, corners.end());
    const trisect::VertexId corner(static_cast<std::uint32_t>(at - corners.begin()));
    claim.is_contact = true;
    claim.lower = ExactRational(1).scaled(-3);
    claim.upper = ExactRational(9).scaled(-4);
    // The plane through the lower edge of the plate, parallel to the corner's way.
    FreedomNode node;
    node.separator.plane = {{1, 0, -2}, ExactRational(-19).scaled(-3)};
    claim.freedom = {{node}};
    claim.common_point.kind = CommonPoint::Kind::VertexOfB;
    claim.common_point.vertex_b = corner;
    for (const trisect::CertifiedTriangle& t : claim.triangles_b)
        if (std::ranges::find(t.vertex, corner) != t.vertex.end())
            claim.common_point.triangle_b = t;
    for (const std::vector<ExactRational>& polynomial :
         {std::vector<ExactRational>{-1, 4}, std::vector<ExactRational>{1, -8, 16}}) {
        claim.polynomial = polynomial;
        for (const trisect::CertifiedTriangle& t : claim.triangles_a) {
            claim.common_point.triangle_a = t;
            EXPECT_EQ(c.check(claim), "the triangles do not meet at the time of contact");
        }
    }
}

}  // namespace
}  // namespace contact_certificate_test
