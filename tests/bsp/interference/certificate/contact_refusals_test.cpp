// SPDX-License-Identifier: Apache-2.0
//
// Each field of a certificate of first contact, wrong on its own in a named configuration: the
// checker says what is wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/contact_certificate.h>
#include <trisect/bsp/interference/motion/motion_piece.h>

#include "refusals.h"
#include "support/certified_pair.h"
#include "support/models.h"
#include "support/moving_pair.h"

namespace contact_refusals_test {
namespace {

using models::box;
using moving::by;
using refusals::expect_refused;
using refusals::of_triangles;
using trisect::CommonPoint;
using trisect::ContactCertificate;
using trisect::ExactRational;
using trisect::FreedomNode;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::MovingSeparator;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using trisect::VertexId;
using Changes = std::vector<refusals::Change<ContactCertificate>>;

using Case = moving::ContactPair;

constexpr const char* no_meeting = "the triangles do not meet at the time of contact";
constexpr const char* not_separate = "a plane does not separate";

// A leaf that a plane carried along with either solid, or the plane of two edges, keeps apart.
FreedomNode leaf_of(MovingSeparator separator) {
    FreedomNode n;
    n.separator = std::move(separator);
    return n;
}

trisect::SeparatingPlane horizontal(double height) {
    return {{0, 0, 1}, -ExactRational::from_double(height)};
}

// A block that falls 4 within the time onto a floor 2 below: flat, at half time.
TEST(ContactRefusals, OfABlockThatFallsOnAFloor) {
    const Case c{{box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -4)}};
    const ContactCertificate right = c.certificate();
    ASSERT_TRUE(right.is_complete && right.is_contact);
    auto changes = of_triangles(&ContactCertificate::triangles_a);
    const auto of_b = of_triangles(&ContactCertificate::triangles_b);
    changes.insert(changes.end(), of_b.begin(), of_b.end());
    using C = ContactCertificate;
    const Changes more{
        {"at the start: no proof that the boundaries are apart",
         [](C& d) { d.at_start.apart.clear(); }},
        {"the start is not proved", [](C& d) { d.at_start.is_complete = false; }},
        {"", [](C& d) { d.at_start.is_complete = false, d.is_complete = false; }},
        {"pieces of the motion are missing", [](C& d) { d.piece = 1; }},
        {"pieces of the motion are missing", [](C& d) { d.freedom.clear(); }},
        {"pieces of the motion are missing", [](C& d) { d.freedom.push_back(d.freedom[0]); }},
        {"pieces of the motion are missing", [](C& d) { d.freedom.clear(), d.is_contact = false; }},
        {"the tree is no tree", [](C& d) { d.freedom[0].clear(); }},
        {"there is no bracket", [](C& d) { d.polynomial.clear(); }},
        {"there is no bracket", [](C& d) { std::swap(d.lower, d.upper); }},
        {"the bracket is elsewhere", [](C& d) { d.lower = ExactRational(-1); }},
        {"the bracket holds no single root",
         [](C& d) { d.lower = 0, d.upper = ExactRational(1).scaled(-2); }},
        // At any other time the corner is not on the floor.
        {no_meeting,
         [](C& d) {
             d.lower = ExactRational(3).scaled(-3);
             d.upper = ExactRational(5).scaled(-3);
             d.polynomial = {ExactRational(-33).scaled(-6), 1};
         }},
        {no_meeting, [](C& d) { d.common_point.triangle_a.vertex[0] = VertexId(); }},
        {no_meeting, [](C& d) { d.common_point.triangle_b.vertex[0] = VertexId(); }},
        {no_meeting, [](C& d) { d.common_point.triangle_a.face = trisect::FaceId(); }},
        {no_meeting,
         [](C& d) {
             d.common_point.kind = CommonPoint::Kind::VertexOfB, d.common_point.vertex_b = {};
         }},
        {no_meeting,
         [](C& d) {
             d.common_point.kind = CommonPoint::Kind::VertexOfA, d.common_point.vertex_a = {};
         }},
        {no_meeting,
         [](C& d) {
             d.common_point.kind = CommonPoint::Kind::Edges;
             d.common_point.edge_a = d.common_point.edge_b = {};
         }},
        // Planes at rest with the floor, below its top, within the gap for a while, and on top.
        {not_separate,
         [](C& d) {
             d.freedom = {{leaf_of({MovingSeparator::Kind::OfA, horizontal(0.5), {}, {}, false})}};
         }},
        {not_separate,
         [](C& d) {
             d.freedom = {{leaf_of({MovingSeparator::Kind::OfA, horizontal(2), {}, {}, false})}};
         }},
        {"",
         [](C& d) {
             d.freedom = {{leaf_of({MovingSeparator::Kind::OfA, horizontal(1), {}, {}, false})}};
         }},
        // Carried along with the block: above its bottom, too far below it, and at it.
        {not_separate,
         [](C& d) {
             d.freedom = {{leaf_of({MovingSeparator::Kind::OfB, horizontal(3.5), {}, {}, false})}};
         }},
        {not_separate,
         [](C& d) {
             d.freedom = {{leaf_of({MovingSeparator::Kind::OfB, horizontal(2), {}, {}, false})}};
         }},
        {"",
         [](C& d) {
             d.freedom = {{leaf_of({MovingSeparator::Kind::OfB, horizontal(3), {}, {}, false})}};
         }},
        // No edges at all, of A or of B.
        {not_separate,
         [](C& d) {
             d.freedom = {{leaf_of({MovingSeparator::Kind::Edges, {}, {}, {}, false})}};
         }},
        {not_separate,
         [](C& d) {
             const std::array<VertexId, 2> edge{VertexId(0), VertexId(1)};
             d.freedom = {{leaf_of({MovingSeparator::Kind::Edges, {}, edge, {}, false})}};
         }},
        {"a time is not in its range",
         [](C& d) {
             FreedomNode split;
             split.kind = FreedomNode::Kind::SplitTime;
             split.other = 2;
             split.time = d.upper;
             const FreedomNode leaf =
                 leaf_of({MovingSeparator::Kind::OfA, horizontal(1), {}, {}, false});
             d.freedom = {{split, leaf, leaf}};
         }},
        {"",
         [](C& d) {
             FreedomNode split;
             split.kind = FreedomNode::Kind::SplitTime;
             split.other = 2;
             split.time = ExactRational(1).scaled(-2);
             const FreedomNode leaf =
                 leaf_of({MovingSeparator::Kind::OfA, horizontal(1), {}, {}, false});
             d.freedom = {{split, leaf, leaf}};
         }},
    };
    changes.insert(changes.end(), more.begin(), more.end());
    expect_refused(c, right, changes);
}

// The vertices of a model at places of its own coordinates.
VertexId vertex_at(const InterferenceModel& m, const trisect::Point3d& at) {
    const auto points = trisect::to_polygon_mesh(m.brep()).points;
    const auto found = std::ranges::find(points, at);
    return found == points.end() ? VertexId()
                                 : VertexId(static_cast<std::uint32_t>(found - points.begin()));
}

// All triangles of one list with these vertices.
std::vector<trisect::CertifiedTriangle> around(const std::vector<trisect::CertifiedTriangle>& all,
                                               const std::vector<VertexId>& vertices) {
    std::vector<trisect::CertifiedTriangle> r;
    for (const auto& t : all)
        if (std::ranges::all_of(vertices, [&t](VertexId v) {
                return std::ranges::find(t.vertex, v) != t.vertex.end();
            }))
            r.push_back(t);
    return r;
}

// Every kind of common point between two triangles that meet, whichever the certificate names.
int count_accepted(const Case& c, ContactCertificate claim, const CommonPoint& point,
                   const std::vector<trisect::CertifiedTriangle>& of_a,
                   const std::vector<trisect::CertifiedTriangle>& of_b) {
    int accepted = 0;
    for (const auto& a : of_a)
        for (const auto& b : of_b) {
            claim.common_point = point;
            claim.common_point.triangle_a = a;
            claim.common_point.triangle_b = b;
            const std::string refusal = c.check(claim);
            EXPECT_TRUE(refusal.empty() || refusal == no_meeting) << refusal;
            accepted += refusal.empty() ? 1 : 0;
        }
    return accepted;
}

// The block's lower corners come to lie on the floor's top, which has two triangles: each corner
// is on one of them, or on the diagonal.
TEST(ContactRefusals, VerticesOfTheBlockOnTheFloor) {
    const Case c{{box(0, 0, 0, 4, 4, 1), Motion(), box(1, 2, 3, 2, 3, 4), by(0, 0, -4)}};
    const ContactCertificate right = c.certificate();
    ASSERT_TRUE(right.is_contact);
    ASSERT_EQ(c.check(right), "");
    for (const trisect::Point3d& at : {trisect::Point3d{1, 2, 3}, {2, 3, 3}, {1, 2, 4}}) {
        CommonPoint p;
        p.vertex_b = vertex_at(c.b, at);
        const auto of_b = around(right.triangles_b, {p.vertex_b});
        const int accepted = count_accepted(c, right, p, right.triangles_a, of_b);
        const auto each = static_cast<int>(of_b.size());
        // Of the floor, 1 triangle of 12, not more than 2 where they meet; above it none.
        EXPECT_TRUE(at[2] == 3 ? accepted == each || accepted == 2 * each : accepted == 0) << at[2];
        // It must be a corner of the triangle that is named.
        p.vertex_b = vertex_at(c.b, {2, 2, 4});
        EXPECT_EQ(count_accepted(c, right, p, right.triangles_a, around(of_b, {})), 0);
    }
    // The same seen from the other side: the block is at rest, the floor rises.
    const Case turned{{c.b, Motion(), c.a, by(0, 0, 4)}};
    const ContactCertificate risen = turned.certificate();
    ASSERT_EQ(turned.check(risen), "");
    CommonPoint p;
    p.kind = CommonPoint::Kind::VertexOfA;
    p.vertex_a = vertex_at(turned.a, {1, 2, 3});
    const auto of_a = around(risen.triangles_a, {p.vertex_a});
    const int accepted = count_accepted(turned, risen, p, of_a, risen.triangles_b);
    EXPECT_TRUE(accepted == static_cast<int>(of_a.size()) ||
                accepted == 2 * static_cast<int>(of_a.size()));
}

// A bar comes down across another one: edges meet edges crosswise. Edges of either that are beside
// the crossing, parallel to it or above it do not meet.
TEST(ContactRefusals, EdgesOfBarsThatCross) {
    const Case c{{box(0, 1, 0, 4, 2, 1), Motion(), box(1, 0, 3, 2, 4, 4), by(0, 0, -4)}};
    const ContactCertificate right = c.certificate();
    ASSERT_TRUE(right.is_contact);
    ASSERT_EQ(c.check(right), "");
    const auto accepted = [&](const trisect::Point3d& a0, const trisect::Point3d& a1,
                              const trisect::Point3d& b0, const trisect::Point3d& b1) {
        CommonPoint p;
        p.kind = CommonPoint::Kind::Edges;
        p.edge_a = {vertex_at(c.a, a0), vertex_at(c.a, a1)};
        p.edge_b = {vertex_at(c.b, b0), vertex_at(c.b, b1)};
        return count_accepted(c, right, p, around(right.triangles_a, {p.edge_a[0], p.edge_a[1]}),
                              around(right.triangles_b, {p.edge_b[0], p.edge_b[1]}));
    };
    const trisect::Point3d a0{0, 1, 1};
    const trisect::Point3d a1{4, 1, 1};
    const trisect::Point3d b0{1, 0, 3};
    const trisect::Point3d b1{1, 4, 3};
    EXPECT_EQ(accepted(a0, a1, b0, b1), 4);  // two triangles on each edge
    EXPECT_EQ(accepted(a1, a0, b0, b1), 4);
    EXPECT_EQ(accepted(a0, a1, {2, 0, 3}, {2, 4, 3}), 4);
    EXPECT_EQ(accepted(a0, a1, {1, 0, 4}, {1, 4, 4}), 0);  // above
    EXPECT_EQ(accepted({0, 1, 0}, {4, 1, 0}, b0, b1), 0);  // below
    EXPECT_EQ(accepted({0, 1, 1}, {0, 2, 1}, b0, b1), 0);  // parallel
    EXPECT_EQ(accepted(a0, a1, {1, 0, 3}, {2, 0, 3}), 0);  // parallel too
    EXPECT_EQ(accepted({0, 1, 0}, {0, 1, 1}, b0, b1), 0);  // beside, upright
    EXPECT_EQ(accepted(a0, a1, {1, 4, 3}, {1, 4, 4}), 0);
    // Edges that are not of the triangles.
    CommonPoint p;
    p.kind = CommonPoint::Kind::Edges;
    p.edge_a = {vertex_at(c.a, a0), vertex_at(c.a, a1)};
    p.edge_b = {vertex_at(c.b, b0), vertex_at(c.b, b1)};
    EXPECT_EQ(count_accepted(c, right, p, right.triangles_a, right.triangles_b), 4);
}

// An edge over a crossing edge, in the plane through both directions; turned round, or made of
// edges that are parallel, it separates nothing.
TEST(ContactRefusals, PlanesThroughEdgesOfBarsThatCross) {
    const Case c{{box(0, 1, 0, 4, 2, 1), Motion(), box(1, 0, 3, 2, 4, 4), by(0, 0, -4)}};
    const ContactCertificate right = c.certificate();
    ASSERT_TRUE(right.is_contact);
    const std::array<VertexId, 2> along_x{vertex_at(c.a, {0, 1, 1}), vertex_at(c.a, {4, 1, 1})};
    const std::array<VertexId, 2> low{vertex_at(c.a, {0, 1, 0}), vertex_at(c.a, {4, 1, 0})};
    const std::array<VertexId, 2> upright{vertex_at(c.a, {0, 1, 0}), vertex_at(c.a, {0, 1, 1})};
    const std::array<VertexId, 2> along_y{vertex_at(c.b, {1, 0, 3}), vertex_at(c.b, {1, 4, 3})};
    const std::array<VertexId, 2> none{VertexId(), VertexId(0)};
    using Kind = MovingSeparator::Kind;
    const auto by_edges = [](const std::array<VertexId, 2>& a, const std::array<VertexId, 2>& b,
                             bool flipped) {
        return [=](ContactCertificate& d) {
            d.freedom = {{leaf_of({Kind::Edges, {}, a, b, flipped})}};
        };
    };
    const Changes changes{
        {"", by_edges(along_x, along_y, false)},
        {not_separate, by_edges(along_x, along_y, true)},
        {not_separate, by_edges(low, along_y, false)},
        {not_separate, by_edges(upright, along_y, false)},
        {not_separate, by_edges(along_x, {along_y[0], along_y[0]}, false)},
        {not_separate, by_edges(none, along_y, false)},
        {not_separate, by_edges(along_x, none, false)},
    };
    expect_refused(c, right, changes);
}

TEST(ContactRefusals, OfAContactAtTheStartAndOfNone) {
    using C = ContactCertificate;
    const Case touching{{box(0, 0, 0, 1, 1, 1), Motion(), box(1, 0, 0, 2, 1, 1), by(1, 0, 0)}};
    const C at_start = touching.certificate();
    ASSERT_TRUE(at_start.is_contact);
    expect_refused<Case, C>(
        touching, at_start,
        {{"the solids meet at the start", [](C& d) { d.is_contact = false; }},
         {"at the start: no common point", [](C& d) { d.at_start.on_both.reset(); }}});

    const Case past{{box(0, 0, 0, 1, 1, 1), Motion(), box(3, 0, 0, 4, 1, 1), by(-1, 0, 0)}};
    const C free = past.certificate();
    ASSERT_FALSE(free.is_contact);
    expect_refused<Case, C>(
        past, free,
        {{"pieces of the motion are missing", [](C& d) { d.freedom.clear(); }},
         {"there is no bracket", [](C& d) { d.is_contact = true; }},
         {"a plane does not separate", [](C& d) {
              d.freedom = {{leaf_of({MovingSeparator::Kind::OfA, {{1, 0, 0}, -2}, {}, {}, false})}};
          }}});

    for (const Case& nothing : {Case{{InterferenceModel(Solid()), Motion(), past.b, by(1, 0, 0)}},
                                Case{{past.a, by(1, 0, 0), InterferenceModel(Solid()), Motion()}}})
        expect_refused<Case, C>(
            nothing, nothing.certificate(),
            {{"an empty solid touches nothing", [](C& d) { d.is_contact = true; }}});
}

// A frame that comes down around a post, which no single plane keeps from it.
TEST(ContactRefusals, TooFewNodesAreIncomplete) {
    const auto of_box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return trisect::Expression(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
    };
    const Case c{
        {box(-1, -1, 0, 1, 1, 4), Motion(),
         InterferenceModel(evaluate(of_box(-4, -4, 5, 4, 4, 6) - of_box(-2, -2, 4, 2, 2, 7))),
         by(0, 0, -4)}};
    for (const std::size_t most : {std::size_t{1}, std::size_t{3}}) {
        const ContactCertificate few =
            certify_first_contact(c.a, c.motion_a, c.b, c.motion_b, most);
        EXPECT_FALSE(few.is_complete);
        EXPECT_FALSE(few.is_contact);
        EXPECT_EQ(c.check(few), "");
    }
    EXPECT_TRUE(c.certificate().is_complete);
}

// Between a pose and its mirror image a solid becomes flat, so nothing is seen from it. Motions
// that users can make refuse that.
TEST(ContactRefusals, MotionsThatFlattenASolid) {
    const Case c{{box(0, 0, 0, 1, 1, 1), Motion(), box(3, 0, 0, 4, 1, 1), Motion()}};
    const ContactCertificate right = c.certificate();
    ASSERT_EQ(c.check(right), "");
    auto piece = trisect::detail::MotionPiece::still();
    piece.matrix[2][2] = trisect::detail::IntegerPolynomial({1, -2});
    const Motion turning_over = trisect::detail::motion_of(piece);
    EXPECT_EQ((Case{{c.a, turning_over, c.b, Motion()}}.check(right)), "a solid becomes flat");
    EXPECT_EQ((Case{{c.a, Motion(), c.b, turning_over}}.check(right)), "a solid becomes flat");
}

}  // namespace
}  // namespace contact_refusals_test
