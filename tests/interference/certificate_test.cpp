// SPDX-License-Identifier: Apache-2.0
//
// Certificates of random scenes and models: all are accepted, and what is changed so that it proves
// nothing any more is not.

#include <trisect/bsp/interference_certificate.h>

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>

#include "interference/brute_force.h"

namespace {

using trisect::ApartNode;
using trisect::certify;
using trisect::check_certificate;
using trisect::ExactRational;
using trisect::InterferenceCertificate;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::RationalPoint;
using trisect::Relation;
using trisect::Solid;

struct Case {
    InterferenceModel a;
    InterferenceModel b;
    Pose pose_a;
    Pose pose_b;

    explicit Case(std::uint64_t seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        a = InterferenceModel(scene.a.solid());
        b = InterferenceModel(scene.b.solid());
        pose_a = scene.pose_a;
        pose_b = scene.pose_b;
    }
    [[nodiscard]] InterferenceCertificate certificate() const {
        return certify(a, pose_a, b, pose_b);
    }
    [[nodiscard]] std::string check(const InterferenceCertificate& c) const {
        return check_certificate(c, a.brep(), pose_a, b.brep(), pose_b);
    }
};

TEST(Certificates, OfRandomScenesAreAccepted) {
    std::map<Relation, int> all;
    std::map<Relation, int> complete;
    for (std::uint64_t seed = 5000; seed < 5300; ++seed) {
        const Case c(seed);
        const InterferenceCertificate certificate = c.certificate();
        EXPECT_EQ(c.check(certificate), "") << "seed " << seed;
        ++all[certificate.relation];
        complete[certificate.relation] += certificate.is_complete ? 1 : 0;
    }
    EXPECT_EQ(complete[Relation::Disjoint], all[Relation::Disjoint]);
    EXPECT_EQ(complete[Relation::Equal], all[Relation::Equal]);
    EXPECT_EQ(complete[Relation::Overlapping], all[Relation::Overlapping]);
    EXPECT_GT(complete[Relation::Touching], all[Relation::Touching] / 2);
    for (const auto& [relation, count] : all)
        RecordProperty(to_string(relation), std::to_string(complete[relation]) + " complete of " +
                                                std::to_string(count));
}

RationalPoint far_away(RationalPoint p) {
    p[1] += ExactRational(1000000);
    return p;
}

// Changes that take the proof away. Returns false where there is nothing to change.
bool corrupt(InterferenceCertificate& c, reference::Random& random) {
    switch (random.below(10)) {
        case 0:
            if (!c.in_both) return false;
            c.in_both = far_away(*c.in_both);
            return true;
        case 1:
            if (!c.only_in_a || !c.in_both) return false;
            std::swap(c.only_in_a, c.in_both);
            return true;
        case 2:
            if (!c.only_in_b) return false;
            c.only_in_b = far_away(*c.only_in_b);
            return true;
        case 3:
            if (!c.on_both || c.relation == Relation::Equal) return false;
            c.on_both = far_away(*c.on_both);
            return true;
        case 4: {
            if (!c.plane) return false;
            for (ExactRational& x : c.plane->normal) x = -x;
            c.plane->offset = -c.plane->offset;
            return true;
        }
        case 5:
            if (!c.plane) return false;
            c.plane->offset += ExactRational(1);
            return true;
        case 6: {
            if (c.apart.empty()) return false;
            ApartNode& n = c.apart[random.below(c.apart.size())];
            if (n.kind == ApartNode::Kind::Separated) {
                for (ExactRational& x : n.plane.normal) x = -x;
            } else {
                n.other = 0;  // its own ancestor
            }
            return true;
        }
        case 7:
            if (c.triangles_a.empty()) return false;
            c.triangles_a.pop_back();
            return true;
        case 8:
            if (c.triangles_b.empty()) return false;
            c.triangles_b[random.below(c.triangles_b.size())].vertex[0] = trisect::VertexId();
            return true;
        default: {
            if (!c.is_complete) return false;
            const auto other =
                static_cast<Relation>((static_cast<int>(c.relation) + random.between(1, 5)) % 6);
            c.relation = other;
            return true;
        }
    }
}

TEST(Certificates, CorruptedAreRejected) {
    reference::Random random(1);
    int corrupted = 0;
    for (std::uint64_t seed = 7000; corrupted < 1000; ++seed) {
        const Case c(seed);
        if (c.a.is_empty() || c.b.is_empty()) continue;
        const InterferenceCertificate right = c.certificate();
        for (int k = 0; k < 12; ++k) {
            InterferenceCertificate wrong = right;
            if (!corrupt(wrong, random)) continue;
            EXPECT_NE(c.check(wrong), "") << "seed " << seed << ", change " << k;
            ++corrupted;
        }
    }
}

TEST(Certificates, OfCurvedParts) {
    const auto torus = InterferenceModel(Solid::from_mesh(trisect::make_torus(3, 1, 24, 12)));
    const auto ball = InterferenceModel(Solid::from_mesh(trisect::make_icosphere(1, 2)));
    const auto check = [](const InterferenceModel& a, const InterferenceModel& b, const Pose& pose,
                          Relation relation) {
        const InterferenceCertificate c = certify(a, Pose(), b, pose);
        EXPECT_EQ(c.relation, relation);
        EXPECT_TRUE(c.is_complete);
        EXPECT_EQ(check_certificate(c, a.brep(), Pose(), b.brep(), pose), "");
    };
    check(torus, ball, Pose(), Relation::Disjoint);  // in the hole: no plane separates them
    check(torus, ball, Pose::from_translation({1.5, 0, 0}), Relation::Overlapping);
    check(torus, torus, Pose::from_quaternion({3, 3, 0, 1}, {3, 0, 0}),
          Relation::Disjoint);  // links
    check(torus, ball, Pose::from_doubles({0.3, 0, 0, 3, 0, 0.3, 0, 0, 0, 0, 0.3, 0}),
          Relation::Contains);
}

}  // namespace
