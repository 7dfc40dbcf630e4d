// SPDX-License-Identifier: Apache-2.0
//
// Each field of a certificate of the first overlap, wrong on its own in a named configuration: the
// checker says what is wrong.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/overlap_certificate.h>

#include "refusals.h"
#include "support/certified_pair.h"
#include "support/models.h"
#include "support/moving_pair.h"
#include "support/numbers.h"

namespace overlap_refusals_test {
namespace {

using models::box;
using moving::by;
using numbers::exact;
using refusals::expect_refused;
using refusals::of_triangles;
using trisect::ClearanceNode;
using trisect::ExactPoint;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::OverlapCertificate;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using trisect::SupportingPlane;
using Changes = std::vector<refusals::Change<OverlapCertificate>>;

using Case = moving::OverlapPair;

constexpr const char* not_separate = "a plane does not separate";
constexpr const char* not_within = "a tetrahedron is not within its solid";
constexpr const char* no_overlap = "the tetrahedra do not overlap right after the event";

ExactPoint at(double x, double y, double z) { return {exact(x), exact(y), exact(z)}; }

ClearanceNode leaf_of(SupportingPlane plane) {
    ClearanceNode n;
    n.plane = std::move(plane);
    return n;
}
ClearanceNode horizontal(SupportingPlane::Kind kind, double height) {
    return leaf_of({kind, {at(0, 0, 1), exact(-height)}, {}, {}, {}});
}
ClearanceNode by_edges(const ExactPoint& along_a, const ExactPoint& along_b,
                       const ExactPoint& through) {
    return leaf_of({SupportingPlane::Kind::Edges, {}, along_a, along_b, through});
}

// A block that falls 4 within the time onto a floor 2 below, and on into it.
TEST(OverlapRefusals, OfABlockThatFallsThroughAFloor) {
    const Case c{{box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -4)}};
    const OverlapCertificate right = c.certificate();
    ASSERT_TRUE(right.is_complete && right.is_overlap);
    ASSERT_EQ(right.polynomial.size(), 2U);
    using C = OverlapCertificate;
    using Kind = SupportingPlane::Kind;
    const auto only = [](const ClearanceNode& node) {
        return [node](C& d) { d.clearance = {{node}}; };
    };
    auto changes = of_triangles(&C::triangles_a);
    const auto of_b = of_triangles(&C::triangles_b);
    changes.insert(changes.end(), of_b.begin(), of_b.end());
    const Changes more{
        {"at the start: no proof that the boundaries are apart",
         [](C& d) { d.at_start.apart.clear(); }},
        {"the start is not proved", [](C& d) { d.at_start.is_complete = false; }},
        {"", [](C& d) { d.at_start.is_complete = false, d.is_complete = false; }},
        {"there is no such piece", [](C& d) { d.piece = 1; }},
        {"pieces of the motion are missing", [](C& d) { d.clearance.clear(); }},
        {"pieces of the motion are missing", [](C& d) { d.polynomial.clear(); }},
        {"there is no bracket", [](C& d) { std::swap(d.lower, d.upper); }},
        // The planes of the proof do not hold to the end.
        {not_separate, [](C& d) { d.is_overlap = false; }},
        {"no time after the event", [](C& d) { d.after.until = 0; }},
        {"no time after the event", [](C& d) { d.after.until = exact(1.5); }},
        {no_overlap, [](C& d) { d.after.until = d.lower; }},
        // The block has left the floor below it.
        {no_overlap, [](C& d) { d.after.until = 1; }},
        // Not in the solid, flat, and around all of it.
        {not_within, [](C& d) { d.after.in_a[0] = at(0, 0, 9); }},
        {not_within, [](C& d) { d.after.in_b[0] = at(0, 0, 9); }},
        {not_within, [](C& d) { d.after.in_a[1] = d.after.in_a[0]; }},
        {not_within,
         [](C& d) {
             d.after.in_a = {at(-50, -50, -50), at(90, -50, -50), at(-50, 90, -50),
                             at(-50, -50, 90)};
         }},
        {not_within,
         [](C& d) {
             d.after.in_a = {at(9, 9, 9), at(8, 9, 9), at(9, 8, 9), at(9, 9, 8)};
         }},
        // Within, and not where they meet: the floor's far corner and the block's top.
        {no_overlap,
         [](C& d) {
             d.after.in_a = {at(4, 4, 0), at(3.5, 4, 0), at(4, 3.5, 0), at(4, 4, 0.5)};
         }},
        {no_overlap,
         [](C& d) {
             d.after.in_b = {at(1, 1, 4), at(2, 1, 4), at(1, 2, 4), at(1, 1, 3.5)};
         }},
        // Corners in any order, turned inside out.
        {"", [](C& d) { std::swap(d.after.in_a[0], d.after.in_a[1]); }},
        {"", [](C& d) { std::swap(d.after.in_b[2], d.after.in_b[3]); }},
        // Planes at rest with the floor: on it, in it, in the gap.
        {"", only(horizontal(Kind::OfA, 1))},
        {not_separate, only(horizontal(Kind::OfA, 0.5))},
        {not_separate, only(horizontal(Kind::OfA, 2))},
        // Carried along with the block: at its bottom, in it, below it.
        {"", only(horizontal(Kind::OfB, 3))},
        {not_separate, only(horizontal(Kind::OfB, 3.5))},
        {not_separate, only(horizontal(Kind::OfB, 2))},
        {not_separate, only(leaf_of({}))},
        // Products of directions along both: x times y is up.
        {"", only(by_edges(at(1, 0, 0), at(0, 1, 0), at(1, 1, 1)))},
        {not_separate, only(by_edges(at(0, 1, 0), at(1, 0, 0), at(1, 1, 1)))},
        {not_separate, only(by_edges(at(1, 0, 0), at(0, 1, 0), at(1, 1, 0.5)))},
        {not_separate, only(by_edges(at(1, 0, 0), at(1, 0, 0), at(1, 1, 1)))},
    };
    changes.insert(changes.end(), more.begin(), more.end());
    expect_refused(c, right, changes);
}

// Trees over time, parts of A and triangles of B, all with the floor's top for their plane.
TEST(OverlapRefusals, TreesOverABlockThatFallsThroughAFloor) {
    const Case c{{box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -4)}};
    const OverlapCertificate right = c.certificate();
    ASSERT_TRUE(right.is_complete && right.is_overlap);
    using Kind = ClearanceNode::Kind;
    const ClearanceNode leaf = horizontal(SupportingPlane::Kind::OfA, 1);
    const auto split = [](Kind kind, std::uint32_t other) {
        ClearanceNode n;
        n.kind = kind;
        n.other = other;
        n.time = exact(0.25);
        n.cut = {at(1, 0, 0), exact(-2)};
        return n;
    };
    const auto tree = [](std::vector<ClearanceNode> nodes) {
        return [nodes = std::move(nodes)](OverlapCertificate& d) { d.clearance = {nodes}; };
    };
    ClearanceNode late = split(Kind::SplitTime, 2);
    late.time = 1;
    ClearanceNode early = split(Kind::SplitTime, 2);
    early.time = 0;
    ClearanceNode no_cut = split(Kind::SplitA, 2);
    no_cut.cut.normal = at(0, 0, 0);
    ClearanceNode beside = split(Kind::SplitA, 2);
    beside.cut.offset = exact(-100);
    std::vector<ClearanceNode> deep(8, leaf);
    for (std::uint32_t i = 0; i < 4; ++i) deep[i] = split(Kind::SplitB, 4 + i);
    const Changes changes{
        {"", tree({leaf})},
        {"", tree({split(Kind::SplitTime, 2), leaf, leaf})},
        {"", tree({split(Kind::SplitA, 2), leaf, leaf})},
        {"", tree({split(Kind::SplitB, 2), leaf, leaf})},
        // No part of the floor is above this cut, so anything keeps away from it.
        {"", tree({beside, leaf, leaf_of({})})},
        {not_separate, tree({beside, leaf_of({}), leaf})},
        {"a time is not in its range", tree({late, leaf, leaf})},
        {"a time is not in its range", tree({early, leaf, leaf})},
        {"a plane that divides has no normal", tree({no_cut, leaf, leaf})},
        {"the tree splits a single triangle", tree(deep)},
        {"the tree is no tree", tree({})},
        {"the tree is no tree", tree({split(Kind::SplitB, 1), leaf})},
        {"the tree is no tree", tree({split(Kind::SplitB, 2), leaf})},
    };
    expect_refused(c, right, changes);
}

// Sunk into the floor from flush contact: the event is where the motion begins, and needs neither
// a polynomial nor a tree.
TEST(OverlapRefusals, OfABlockThatSinksIntoAFloor) {
    const Case c{{box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 1, 2, 2, 2), by(0, 0, -1)}};
    const OverlapCertificate right = c.certificate();
    ASSERT_TRUE(right.is_complete && right.is_overlap);
    ASSERT_TRUE(right.polynomial.empty());
    using C = OverlapCertificate;
    expect_refused<Case, C>(
        c, right,
        {{"pieces of the motion are missing", [](C& d) { d.is_overlap = false; }},
         {"pieces of the motion are missing",
          [](C& d) {
              d.polynomial = {-1, 2};
          }},
         {"at the start: no common point", [](C& d) { d.at_start.on_both.reset(); }},
         {"a tetrahedron is not within its solid", [](C& d) { d.after.in_b[3] = at(9, 9, 9); }},
         // All the way down is also after the event.
         {"", [](C& d) { d.after.until = d.after.until / ExactRational(2); }}});
}

TEST(OverlapRefusals, OfAnOverlapAtTheStartAndOfNone) {
    using C = OverlapCertificate;
    const Case within{{box(0, 0, 0, 4, 4, 4), Motion(), box(1, 1, 1, 2, 2, 2), by(9, 0, 0)}};
    expect_refused<Case, C>(
        within, within.certificate(),
        {{"the solids overlap at the start", [](C& d) { d.is_overlap = false; }}});
    const Case past{{box(0, 0, 0, 1, 1, 1), Motion(), box(1, 0, 0, 2, 1, 1), by(0, 3, 0)}};
    const C free = past.certificate();
    ASSERT_FALSE(free.is_overlap);
    expect_refused<Case, C>(
        past, free,
        {{"pieces of the motion are missing", [](C& d) { d.clearance.clear(); }},
         {"pieces of the motion are missing", [](C& d) { d.is_overlap = true; }},
         {"no time after the event", [](C& d) { d.is_overlap = true, d.clearance.clear(); }}});
    for (const Case& nothing : {Case{{InterferenceModel(Solid()), Motion(), past.b, by(1, 0, 0)}},
                                Case{{past.a, by(1, 0, 0), InterferenceModel(Solid()), Motion()}}})
        expect_refused<Case, C>(
            nothing, nothing.certificate(),
            {{"an empty solid overlaps nothing", [](C& d) { d.is_overlap = true; }}});
}

// A block that falls through a hole that just fits takes many planes.
TEST(OverlapRefusals, TooFewNodesAreIncompleteAndSayWhy) {
    const auto of_box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return trisect::Expression(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
    };
    const Case c{{InterferenceModel(evaluate(of_box(0, 0, 0, 6, 6, 1) - of_box(2, 2, -1, 4, 4, 2))),
                  Motion(), box(2, 2, 3, 4, 4, 4), by(0, 0, -9)}};
    const OverlapCertificate few = certify_first_overlap(c.a, c.motion_a, c.b, c.motion_b, 3);
    EXPECT_FALSE(few.is_complete);
    EXPECT_FALSE(few.is_overlap);
    EXPECT_EQ(few.missing, "the limit of nodes");
    EXPECT_EQ(c.check(few), "");
    EXPECT_TRUE(c.certificate().is_complete);
}

// Between a pose and its mirror image a solid becomes flat, so nothing is seen from it. Motions
// that users can make refuse that.
TEST(OverlapRefusals, MotionsThatFlattenASolid) {
    auto piece = trisect::detail::MotionPiece::still();
    piece.matrix[2][2] = trisect::detail::IntegerPolynomial({1, -2});
    const Motion turning_over = trisect::detail::motion_of(piece);
    const Case apart{{box(0, 0, 0, 1, 1, 1), Motion(), box(3, 0, 0, 4, 1, 1), Motion()}};
    const OverlapCertificate never = apart.certificate();
    ASSERT_EQ(apart.check(never), "");
    EXPECT_EQ((Case{{apart.a, turning_over, apart.b, Motion()}}.check(never)),
              "a solid becomes flat");
    EXPECT_EQ((Case{{apart.a, Motion(), apart.b, turning_over}}.check(never)),
              "a solid becomes flat");
    const Case sinking{{box(0, 0, 0, 4, 4, 1), Motion(), box(1, 1, 1, 2, 2, 2), by(0, 0, -1)}};
    const OverlapCertificate from_start = sinking.certificate();
    ASSERT_EQ(sinking.check(from_start), "");
    EXPECT_EQ((Case{{sinking.a, turning_over, sinking.b, Motion()}}.check(from_start)),
              "a solid becomes flat");
}

}  // namespace
}  // namespace overlap_refusals_test
