// SPDX-License-Identifier: Apache-2.0
//
// Certificates of random scenes and models: all are accepted, and what is changed so that it proves
// nothing any more is not.

#include <trisect/bsp/interference/interference_certificate.h>

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>

#include "support/placed_pair.h"
#include "support/reason.h"

namespace {

using trisect::ApartNode;
using trisect::certify_relation;
using trisect::ExactPoint;
using trisect::ExactRational;
using trisect::InterferenceCertificate;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

struct Case : brute::PlacedPair {
    explicit Case(std::uint64_t seed) : PlacedPair(pair_of(seed)) {}
    static brute::PlacedPair pair_of(std::uint64_t seed) {
        reference::Random random(seed);
        return brute::placed_pair(random);
    }
    [[nodiscard]] InterferenceCertificate certificate() const {
        return certify_relation(a, pose_a, b, pose_b);
    }
    [[nodiscard]] std::string check(const InterferenceCertificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), pose_a, b.brep(), pose_b));
    }
};

TEST(Certificates, OfRandomScenesAreAccepted) {
    std::map<Relation, int> all;
    std::map<Relation, int> complete;
    for (std::uint64_t seed = 5000; seed < 5600; ++seed) {
        const Case c(seed);
        const InterferenceCertificate certificate = c.certificate();
        EXPECT_EQ(c.check(certificate), "") << "seed " << seed;
        ++all[certificate.relation];
        complete[certificate.relation] += certificate.is_complete ? 1 : 0;
    }
    EXPECT_EQ(complete, all);
    EXPECT_EQ(all.size(), 6U);
    for (const auto& [relation, count] : all)
        RecordProperty(to_string(relation), std::to_string(complete[relation]) + " complete of " +
                                                std::to_string(count));
}

ExactPoint far_away(ExactPoint p) {
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

// Changes to the cells of a certificate.
bool corrupt_cells(InterferenceCertificate& c, reference::Random& random) {
    using Kind = trisect::CertifiedCell::Kind;
    if (c.cells.empty()) return false;
    trisect::CertifiedCell& cell = c.cells[random.below(c.cells.size())];
    if (cell.kind == Kind::Split) {
        switch (random.below(4)) {
            case 0:
                cell.other = 0;  // its own ancestor
                return true;
            case 1:
                for (ExactRational& x : cell.plane.normal) x = -x;
                cell.plane.offset = -cell.plane.offset;
                return true;
            case 2:
                cell.plane.normal = {};
                return true;
            default:
                cell.kind = Kind::WithoutA;  // with a point that belongs to nothing
                cell.point = {ExactRational(1), ExactRational(1), ExactRational(1)};
                cell.other = 0;
                c.cells.resize(c.cells.size() - 1);
                return true;
        }
    }
    switch (random.below(3)) {
        case 0:
            // The point of another cell is not in this one.
            for (const trisect::CertifiedCell& other : c.cells)
                if (other.kind != Kind::Split && other.point != cell.point) {
                    cell.point = other.point;
                    return true;
                }
            return false;
        case 1:
            cell.kind = Kind::Split;
            return true;
        default:
            c.cells.pop_back();
            return true;
    }
}

TEST(Certificates, CorruptedCellsAreRejected) {
    reference::Random random(2);
    int corrupted = 0;
    for (std::uint64_t seed = 9000; corrupted < 1000; ++seed) {
        const Case c(seed);
        if (c.a.is_empty() || c.b.is_empty()) continue;
        const InterferenceCertificate right = c.certificate();
        for (int k = 0; k < 40; ++k) {
            InterferenceCertificate wrong = right;
            if (!corrupt_cells(wrong, random)) continue;
            EXPECT_NE(c.check(wrong), "") << "seed " << seed << ", change " << k;
            ++corrupted;
        }
    }
}

TEST(Certificates, OfTouchingThatNoPlaneSeparates) {
    const auto box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return trisect::Expression(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
    };
    // A key in its keyway; a pin in a hole, flush at both ends; a box in a room.
    const auto way = box(0, 0, 0, 9, 9, 3) - box(3, -1, 1, 6, 10, 4) - box(2, -1, 1, 7, 10, 2);
    const auto key = box(3, 0, 1, 6, 9, 3) | box(2, 0, 1, 7, 9, 2);
    const auto plate = box(-4, -4, 0, 4, 4, 1) - box(-1, -1, -1, 1, 1, 2);
    const auto pin = box(-1, -1, 0, 1, 1, 1);
    const auto room = box(-5, -5, -5, 5, 5, 5) - box(-3, -3, -3, 3, 3, 3);
    const auto lodger = box(-3, -3, -3, 0, 3, 0);
    for (const auto& [a, b] : {std::pair{way, key}, {plate, pin}, {room, lodger}, {lodger, room}}) {
        const InterferenceModel ma(evaluate(a));
        const InterferenceModel mb(evaluate(b));
        for (const Pose& pose : {Pose(), Pose::from_quaternion({3, 1, -2, 1}, {0.1, 7, 1e-3})}) {
            const InterferenceCertificate c = certify_relation(ma, pose, mb, pose);
            EXPECT_EQ(c.relation, Relation::Touching);
            EXPECT_TRUE(c.is_complete);
            EXPECT_FALSE(c.cells.empty());
            EXPECT_EQ(refusals::reason(trisect::check(c, ma.brep(), pose, mb.brep(), pose)), "");
        }
    }
}

TEST(Certificates, OfContainmentWithContact) {
    const auto solid = [](const trisect::Expression& e) { return InterferenceModel(evaluate(e)); };
    const auto box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return trisect::Expression(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
    };
    const auto ball = trisect::Expression(Solid::from_mesh(trisect::make_icosphere(1, 1)));
    for (const auto& [a, b] :
         {std::pair{box(0, 0, 0, 1, 1, 1), box(0, 0, 0, 2, 2, 2)},     // in a corner
          {box(1, 1, 0, 2, 2, 1), box(0, 0, 0, 4, 4, 4)},              // on the ground
          {ball & box(-2, -2, 0, 2, 2, 2), ball},                      // half of it
          {ball - box(-0.25, -0.25, -0.25, 0.25, 0.25, 0.25), ball}})  // hollow
    {
        const InterferenceModel ma = solid(a);
        const InterferenceModel mb = solid(b);
        const Pose pose = Pose::from_quaternion({2, 1, 0, -1}, {0.25, 0, 1});
        const InterferenceCertificate inside = certify_relation(ma, pose, mb, pose);
        EXPECT_EQ(inside.relation, Relation::Inside);
        EXPECT_TRUE(inside.is_complete);
        EXPECT_EQ(refusals::reason(trisect::check(inside, ma.brep(), pose, mb.brep(), pose)), "");
        InterferenceCertificate contains = certify_relation(mb, pose, ma, pose);
        EXPECT_EQ(contains.relation, Relation::Contains);
        EXPECT_TRUE(contains.is_complete);
        EXPECT_EQ(refusals::reason(trisect::check(contains, mb.brep(), pose, ma.brep(), pose)), "");
        contains.relation = Relation::Inside;
        EXPECT_NE(refusals::reason(trisect::check(contains, mb.brep(), pose, ma.brep(), pose)), "");
        // Cells about another pose prove nothing about this one.
        EXPECT_NE(refusals::reason(trisect::check(inside, ma.brep(), Pose(), mb.brep(), pose)), "");
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
        const InterferenceCertificate c = certify_relation(a, Pose(), b, pose);
        EXPECT_EQ(c.relation, relation);
        EXPECT_TRUE(c.is_complete);
        EXPECT_EQ(refusals::reason(trisect::check(c, a.brep(), Pose(), b.brep(), pose)), "");
    };
    check(torus, ball, Pose(), Relation::Disjoint);  // in the hole: no plane separates them
    check(torus, ball, Pose::from_translation({1.5, 0, 0}), Relation::Overlapping);
    check(torus, torus, Pose::from_quaternion({3, 3, 0, 1}, {3, 0, 0}),
          Relation::Disjoint);  // links
    check(torus, ball, Pose::from_doubles({0.3, 0, 0, 3, 0, 0.3, 0, 0, 0, 0, 0.3, 0}),
          Relation::Contains);
}

}  // namespace
