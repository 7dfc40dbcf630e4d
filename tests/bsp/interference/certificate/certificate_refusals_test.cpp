// SPDX-License-Identifier: Apache-2.0
//
// Each field of a certificate of a relation or a distance, wrong on its own in a named
// configuration: the checker says what is wrong.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/distance_certificate.h>
#include <trisect/bsp/interference/interference_certificate.h>

#include "refusals.h"
#include "support/models.h"
#include "support/numbers.h"
#include "support/placed_pair.h"
#include "support/reason.h"

namespace {

using models::box;
using numbers::exact;
using refusals::expect_refused;
using refusals::of_triangles;
using refusals::turn_over;
using trisect::ApartNode;
using trisect::CertifiedCell;
using trisect::ExactPoint;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

struct RelationCase : brute::PlacedPair {
    using Certificate = trisect::InterferenceCertificate;
    [[nodiscard]] Certificate certificate() const { return certify_relation(a, pose_a, b, pose_b); }
    [[nodiscard]] std::string check(const Certificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), pose_a, b.brep(), pose_b));
    }
};
using Relations = trisect::InterferenceCertificate;

struct DistanceCase : brute::PlacedPair {
    using Certificate = trisect::DistanceCertificate;
    [[nodiscard]] Certificate certificate() const { return certify_distance(a, pose_a, b, pose_b); }
    [[nodiscard]] std::string check(const Certificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), pose_a, b.brep(), pose_b));
    }
};
using Distances = trisect::DistanceCertificate;

ExactPoint at(double x, double y, double z) {
    return {ExactRational::from_double(x), ExactRational::from_double(y),
            ExactRational::from_double(z)};
}

TEST(CertificateRefusals, OfBoxesThatOverlap) {
    const RelationCase c{{box(0, 0, 0, 4, 4, 4), box(2, 2, 2, 6, 6, 6), Pose(), Pose()}};
    Relations right = c.certificate();
    ASSERT_EQ(right.relation, Relation::Overlapping);
    ASSERT_TRUE(right.is_complete);
    const auto claim = [](Relation r) { return [r](Relations& d) { d.relation = r; }; };
    expect_refused<RelationCase, Relations>(
        c, right,
        {
            {"a point is not inside both", [](Relations& d) { d.in_both = at(1, 1, 1); }},
            {"a point is not inside both", [](Relations& d) { d.in_both = at(5, 5, 5); }},
            {"a point is not inside both", [](Relations& d) { d.in_both = at(2, 3, 3); }},
            {"a point is not inside A alone", [](Relations& d) { d.only_in_a = at(3, 3, 3); }},
            {"a point is not inside A alone", [](Relations& d) { d.only_in_a = at(7, 7, 7); }},
            {"a point is not inside A alone", [](Relations& d) { d.only_in_a = at(0, 1, 1); }},
            {"a point is not inside B alone", [](Relations& d) { d.only_in_b = at(3, 3, 3); }},
            {"a point is not inside B alone", [](Relations& d) { d.only_in_b = at(7, 7, 7); }},
            {"a point is not inside B alone", [](Relations& d) { d.only_in_b = at(4, 3, 3); }},
            {"a point is not on both boundaries", [](Relations& d) { d.on_both = at(1, 1, 0); }},
            {"a point is not on both boundaries", [](Relations& d) { d.on_both = at(5, 5, 6); }},
            {"", [](Relations& d) { d.on_both = at(2, 3, 4); }},
            {"points are missing", [](Relations& d) { d.in_both.reset(); }},
            {"points are missing", [](Relations& d) { d.only_in_a.reset(); }},
            {"points are missing", [](Relations& d) { d.only_in_b.reset(); }},
            {"", [](Relations& d) { d.only_in_b.reset(), d.is_complete = false; }},
            {"interiors meet", claim(Relation::Disjoint)},
            {"interiors meet", claim(Relation::Touching)},
            {"a point of A is outside B", claim(Relation::Inside)},
            {"a point of A is outside B", claim(Relation::Equal)},
            {"a point of B is outside A", claim(Relation::Contains)},
            {"a point of B is outside A",
             [](Relations& d) { d.only_in_a.reset(), d.relation = Relation::Equal; }},
            {"the plane does not separate the solids",
             [](Relations& d) {
                 d.plane = {{at(1, 0, 0), exact(-3)}};
             }},
        });
}

TEST(CertificateRefusals, OfBoxesSideBySide) {
    const RelationCase c{{box(0, 0, 0, 1, 1, 1), box(1, 0, 0, 2, 1, 1), Pose(), Pose()}};
    Relations right = c.certificate();
    ASSERT_EQ(right.relation, Relation::Touching);
    ASSERT_TRUE(right.plane);
    expect_refused<RelationCase, Relations>(
        c, right,
        {
            {"the plane does not separate the solids", [](Relations& d) { turn_over(*d.plane); }},
            {"the plane does not separate the solids",
             [](Relations& d) { d.plane->normal = at(0, 0, 0), d.plane->offset = exact(0); }},
            {"the plane does not separate the solids",
             [](Relations& d) {
                 d.plane = {{at(1, 0, 0), exact(-0.5)}};
             }},
            {"the plane does not separate the solids",
             [](Relations& d) {
                 d.plane = {{at(1, 0, 0), exact(-1.5)}};
             }},
            {"no proof that interiors are apart", [](Relations& d) { d.plane.reset(); }},
            {"no common point", [](Relations& d) { d.on_both.reset(); }},
            {"the boundaries meet", [](Relations& d) { d.relation = Relation::Disjoint; }},
            {"a plane separates the solids", [](Relations& d) { d.relation = Relation::Equal; }},
            {"the boundaries are different",
             [](Relations& d) { d.plane.reset(), d.relation = Relation::Equal; }},
            {"points are missing",
             [](Relations& d) { d.plane.reset(), d.relation = Relation::Overlapping; }},
            {"no proof that the boundaries are apart",
             [](Relations& d) { d.plane.reset(), d.relation = Relation::Inside; }},
            {"no proof that the boundaries are apart",
             [](Relations& d) { d.plane.reset(), d.relation = Relation::Contains; }},
        });
}

TEST(CertificateRefusals, OfBoxesThatAreApart) {
    const RelationCase c{{box(0, 0, 0, 1, 1, 1), box(2, 0, 0, 3, 1, 1), Pose(), Pose()}};
    Relations right = c.certificate();
    ASSERT_EQ(right.relation, Relation::Disjoint);
    ASSERT_EQ(right.apart.size(), 1U);
    const ApartNode split_a{ApartNode::Kind::SplitA, 1, {}};
    auto changes = of_triangles(&Relations::triangles_a);
    const auto of_b = of_triangles(&Relations::triangles_b);
    changes.insert(changes.end(), of_b.begin(), of_b.end());
    changes.push_back(
        {"no proof that the boundaries are apart", [](Relations& d) { d.apart.clear(); }});
    changes.push_back({"a plane of the tree does not separate",
                       [](Relations& d) { turn_over(d.apart[0].plane); }});
    // Through a face of A, of B, and nothing at all.
    for (const double x : {1.0, 2.0})
        changes.push_back({"a plane of the tree does not separate", [x](Relations& d) {
                               d.apart[0].plane = {at(1, 0, 0), exact(-x)};
                           }});
    changes.push_back(
        {"a plane of the tree does not separate", [](Relations& d) { d.apart[0].plane = {}; }});
    // Both children are the same node; there is none; a tree that goes on below one triangle.
    changes.push_back(
        {"the tree is no tree", [&](Relations& d) { d.apart.insert(d.apart.begin(), split_a); }});
    changes.push_back({"the tree is no tree", [](Relations& d) {
                           d.apart.insert(d.apart.begin(), {ApartNode::Kind::SplitB, 7, {}});
                       }});
    for (const auto kind : {ApartNode::Kind::SplitA, ApartNode::Kind::SplitB})
        changes.push_back({"the tree splits a single triangle", [kind](Relations& d) {
                               // 12, 6, 3, 1 triangles.
                               const ApartNode leaf = d.apart[0];
                               d.apart.assign(8, leaf);
                               for (std::uint32_t i = 0; i < 4; ++i)
                                   d.apart[i] = {kind, 4 + i, leaf.plane};
                           }});
    for (const Relation r : {Relation::Inside, Relation::Contains})
        changes.push_back({"the shells lie otherwise", [r](Relations& d) { d.relation = r; }});
    expect_refused(c, right, changes);
}

// A claim of boundaries that are apart, by the planes in the middle of slabs between them.
Relations claim_of(Relation relation, const trisect::DistanceCertificate& distance) {
    Relations r;
    r.relation = relation;
    r.is_complete = true;
    r.triangles_a = distance.triangles_a;
    r.triangles_b = distance.triangles_b;
    for (const trisect::SlabNode& n : distance.slabs)
        r.apart.push_back({static_cast<ApartNode::Kind>(n.kind),
                           n.other,
                           {n.slab.normal, -(n.slab.below + n.slab.above) / ExactRational(2)}});
    return r;
}

// Which solid is in the other one follows from their shells: a box in a hollow box, in its cavity,
// around it, and around the cavity only, where neither is in the other.
TEST(CertificateRefusals, OfAHollowBoxAndABox) {
    const InterferenceModel hollow(
        evaluate(trisect::Expression(Solid::from_mesh(trisect::make_box({0, 0, 0}, {9, 9, 9}))) -
                 trisect::Expression(Solid::from_mesh(trisect::make_box({3, 3, 3}, {6, 6, 6})))));
    const auto expect = [&](const InterferenceModel& other, Relation relation, Relation turned) {
        const RelationCase c{{hollow, other, Pose(), Pose()}};
        const RelationCase exchanged{{other, hollow, Pose(), Pose()}};
        EXPECT_EQ(c.certificate().relation, relation);
        const auto distance = DistanceCase{c}.certificate();
        const auto back = DistanceCase{exchanged}.certificate();
        for (const Relation r : {Relation::Disjoint, Relation::Inside, Relation::Contains}) {
            EXPECT_EQ(c.check(claim_of(r, distance)),
                      r == relation ? "" : "the shells lie otherwise");
            EXPECT_EQ(exchanged.check(claim_of(r, back)),
                      r == turned ? "" : "the shells lie otherwise");
        }
    };
    expect(box(4, 4, 4, 5, 5, 5), Relation::Disjoint, Relation::Disjoint);
    expect(box(1, 4, 4, 2, 5, 5), Relation::Contains, Relation::Inside);
    expect(box(-1, -1, -1, 10, 10, 10), Relation::Inside, Relation::Contains);
    expect(box(2, 2, 2, 7, 7, 7), Relation::Overlapping, Relation::Overlapping);
}

TEST(CertificateRefusals, OfAPinInAHole) {
    const auto expr = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return trisect::Expression(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
    };
    const InterferenceModel plate(evaluate(expr(-4, -4, 0, 4, 4, 1) - expr(-1, -1, -1, 1, 1, 2)));
    const RelationCase c{{plate, box(-1, -1, 0, 1, 1, 1), Pose(), Pose()}};
    const Relations right = c.certificate();
    ASSERT_EQ(right.relation, Relation::Touching);
    ASSERT_GT(right.cells.size(), 1U);
    ASSERT_EQ(right.cells[0].kind, CertifiedCell::Kind::Split);
    const auto leaf = [](Relations& d) -> CertifiedCell& {
        std::size_t i = 0;
        while (d.cells[i].kind == CertifiedCell::Kind::Split) ++i;
        return d.cells[i];
    };
    auto changes = of_triangles(&Relations::triangles_a);
    const auto of_b = of_triangles(&Relations::triangles_b);
    changes.insert(changes.end(), of_b.begin(), of_b.end());
    changes.insert(
        changes.end(),
        {
            {"no proof that interiors are apart", [](Relations& d) { d.cells.clear(); }},
            {"the cells are no tree", [](Relations& d) { d.cells[0].other = 0; }},
            {"the cells are no tree", [](Relations& d) { d.cells[0].other = 1; }},
            {"the cells are no tree",
             [](Relations& d) { d.cells[0].other = static_cast<std::uint32_t>(d.cells.size()); }},
            {"a plane of a cell has no normal",
             [](Relations& d) { d.cells[0].plane.normal = at(0, 0, 0); }},
            {"the point of a cell is not in it",
             [=](Relations& d) { leaf(d).point = at(1000, 1000, 1000); }},
            {"cells say nothing about such solids",
             [](Relations& d) { d.relation = Relation::Equal; }},
            {"cells say nothing about such solids",
             [](Relations& d) { d.relation = Relation::Overlapping; }},
            {"the boundaries meet", [](Relations& d) { d.relation = Relation::Disjoint; }},
            {"a boundary reaches into a cell",
             [](Relations& d) {
                 d.cells = {{CertifiedCell::Kind::WithoutA, 0, {}, at(100, 0, 0)}};
             }},
            {"a boundary reaches into a cell",
             [](Relations& d) {
                 d.cells = {{CertifiedCell::Kind::WithoutB, 0, {}, at(100, 0, 0)}};
             }},
        });
    expect_refused(c, right, changes);
}

// A box in a corner of another one: all of it is inside, and faces are shared.
TEST(CertificateRefusals, OfABoxInACorner) {
    const RelationCase c{{box(0, 0, 0, 1, 1, 1), box(0, 0, 0, 2, 2, 2), Pose(), Pose()}};
    const Relations right = c.certificate();
    ASSERT_EQ(right.relation, Relation::Inside);
    ASSERT_FALSE(right.cells.empty());
    expect_refused<RelationCase, Relations>(
        c, right,
        {
            {"no point of B alone", [](Relations& d) { d.only_in_b.reset(); }},
            {"a cell is on the wrong side", [](Relations& d) { d.relation = Relation::Touching; }},
            {"a cell is on the wrong side", [](Relations& d) { d.relation = Relation::Contains; }},
            {"no proof that the boundaries are apart", [](Relations& d) { d.cells.clear(); }},
        });
    const RelationCase turned{{c.b, c.a, Pose(), Pose()}};
    const Relations contains = turned.certificate();
    ASSERT_EQ(contains.relation, Relation::Contains);
    expect_refused<RelationCase, Relations>(
        turned, contains,
        {
            {"no point of A alone", [](Relations& d) { d.only_in_a.reset(); }},
            {"no proof that the boundaries are apart", [](Relations& d) { d.cells.clear(); }},
        });
}

TEST(CertificateRefusals, OfEqualBoxesAndOfNothing) {
    const RelationCase same{{box(0, 0, 0, 1, 1, 1), box(0, 0, 0, 1, 1, 1), Pose(), Pose()}};
    const Relations equal = same.certificate();
    ASSERT_EQ(equal.relation, Relation::Equal);
    EXPECT_EQ(same.check(equal), "");
    RelationCase moved = same;
    moved.pose_b = Pose::from_translation({0, 0, 0x1p-60});
    Relations claim = equal;
    claim.on_both.reset();
    EXPECT_EQ(same.check(claim), "");
    EXPECT_EQ(moved.check(claim), "the boundaries are different");

    const RelationCase nothing{{InterferenceModel(Solid()), same.b, Pose(), Pose()}};
    expect_refused<RelationCase, Relations>(
        nothing, nothing.certificate(),
        {{"an empty solid is disjoint", [](Relations& d) { d.relation = Relation::Inside; }}});
    const RelationCase of_nothing{{same.a, InterferenceModel(Solid()), Pose(), Pose()}};
    expect_refused<RelationCase, Relations>(
        of_nothing, of_nothing.certificate(),
        {{"an empty solid is disjoint", [](Relations& d) { d.relation = Relation::Contains; }}});
}

// Faces that are 2 apart.
TEST(DistanceRefusals, OfBoxesFaceToFace) {
    const DistanceCase c{{box(0, 0, 0, 1, 1, 1), box(3, 0, 0, 4, 1, 1), Pose(), Pose()}};
    const Distances right = c.certificate();
    ASSERT_TRUE(right.is_complete);
    ASSERT_EQ(right.slabs.size(), 1U);
    auto changes = of_triangles(&Distances::triangles_a);
    const auto of_b = of_triangles(&Distances::triangles_b);
    changes.insert(changes.end(), of_b.begin(), of_b.end());
    const char* off = "a point is not on its face";
    const char* thin = "a slab is thinner than the distance";
    changes.insert(
        changes.end(),
        {
            {"the square is negative", [](Distances& d) { d.squared = -d.squared; }},
            {off, [](Distances& d) { d.on_a.face = trisect::FaceId(); }},
            {off, [](Distances& d) { d.on_b.face = trisect::FaceId(); }},
            {off, [](Distances& d) { d.on_a.point[0] -= exact(0.5); }},
            {off, [](Distances& d) { d.on_b.point[0] += exact(0.5); }},
            {off, [](Distances& d) { d.on_a.point[1] += exact(5); }},
            {off, [](Distances& d) { d.on_b.point[2] -= exact(5); }},
            {"the points are farther apart", [](Distances& d) { d.squared = exact(3.999); }},
            {"the points are farther apart", [](Distances& d) { d.squared = exact(0); }},
            {"there are no slabs", [](Distances& d) { d.slabs.clear(); }},
            {"", [](Distances& d) { d.slabs.clear(), d.is_complete = false; }},
            // It claims nothing.
            {"", [](Distances& d) { d = Distances(); }},
            {"a slab is thinner than the distance", [](Distances& d) { d.squared = exact(4.001); }},
            {thin,
             [](Distances& d) {
                 d.slabs[0].slab = {at(1, 0, 0), exact(1), exact(2.99)};
             }},
            {thin,
             [](Distances& d) {
                 d.slabs[0].slab = {at(2, 0, 0), exact(2), exact(5)};
             }},
            {thin,
             [](Distances& d) {
                 d.slabs[0].slab = {at(1, 0, 0), exact(3), exact(1)};
             }},
            {"triangles reach into a slab",
             [](Distances& d) {
                 d.slabs[0].slab = {at(1, 0, 0), exact(0.5), exact(3)};
             }},
            {"triangles reach into a slab",
             [](Distances& d) {
                 d.slabs[0].slab = {at(1, 0, 0), exact(1), exact(3.5)};
             }},
            {"triangles reach into a slab",
             [](Distances& d) {
                 d.slabs[0].slab = {at(0, 0, 0), exact(0), exact(1)};
             }},
            {"the tree is no tree",
             [](Distances& d) { d.slabs[0].kind = trisect::SlabNode::Kind::SplitA; }},
        });
    expect_refused(c, right, changes);
    // The thickest slab there is, and the same one twice as long.
    expect_refused<DistanceCase, Distances>(
        c, right,
        {
            {"",
             [](Distances& d) {
                 d.slabs[0].slab = {at(1, 0, 0), exact(1), exact(3)};
             }},
            {"",
             [](Distances& d) {
                 d.slabs[0].slab = {at(2, 0, 0), exact(2), exact(6)};
             }},
        });
}

// A box in the middle of a hollow one is as far from all its walls.
TEST(DistanceRefusals, TooFewNodesAreIncomplete) {
    const InterferenceModel hollow(
        evaluate(trisect::Expression(Solid::from_mesh(trisect::make_box({0, 0, 0}, {9, 9, 9}))) -
                 trisect::Expression(Solid::from_mesh(trisect::make_box({2, 2, 2}, {7, 7, 7})))));
    const DistanceCase c{{hollow, box(4, 4, 4, 5, 5, 5), Pose(), Pose()}};
    const Distances right = c.certificate();
    EXPECT_TRUE(right.is_complete);
    EXPECT_EQ(right.squared, ExactRational(4));
    const Distances few = certify_distance(c.a, c.pose_a, c.b, c.pose_b, 3);
    EXPECT_FALSE(few.is_complete);
    EXPECT_EQ(c.check(few), "");
}

TEST(DistanceRefusals, OfNothing) {
    const InterferenceModel nothing{Solid()};
    const DistanceCase cases[]{{{nothing, box(0, 0, 0, 1, 1, 1), Pose(), Pose()}},
                               {{box(0, 0, 0, 1, 1, 1), nothing, Pose(), Pose()}}};
    for (const DistanceCase& c : cases)
        expect_refused<DistanceCase, Distances>(
            c, c.certificate(),
            {{"an empty solid has no distance", [](Distances& d) { d.is_complete = true; }}});
}

}  // namespace
