// SPDX-License-Identifier: Apache-2.0
//
// First contact of solids on their own trees against that of models, which are made of B-reps.

#include <trisect/bsp/interference/solid_motion.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/moving_points.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/interference_oracle.h"
#include "support/motion_oracle.h"
#include "support/moving_pair.h"
#include "support/numbers.h"
#include "support/solids.h"

namespace {

using moving::by;
using moving::small;
using numbers::q;
using oracle::Placement;
using reference::Random;
using trisect::AlgebraicNumber;
using trisect::ContactEvent;
using trisect::EntityName;
using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::first_contact;
using trisect::FirstContact;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::NamedFirstContact;
using trisect::Pose;
using trisect::Relation;
using trisect::Screw;
using trisect::Solid;

// In cells of so few polygons, resolved.
Solid solid_of(const brute::Body& body, std::uint32_t leaf_polygons) {
    std::vector<Solid> operands;
    for (const auto& operand : body.operands) operands.push_back(engines::solid(operand));
    EvaluateOptions options;
    options.leaf_polygons = leaf_polygons;
    return evaluate(engines::formula(body.formula, operands), options);
}

bool touches_itself(const Solid& solid) {
    return trisect::detail::data_of(InterferenceModel(solid)).touches_itself();
}

using Kinds = std::set<std::pair<int, int>>;

Kinds kinds_of(const FirstContact& c) {
    Kinds out;
    for (const auto& w : c.witnesses)
        out.emplace(static_cast<int>(w.a.kind()), static_cast<int>(w.b.kind()));
    return out;
}

Kinds kinds_of(const NamedFirstContact& c) {
    Kinds out;
    for (const auto& w : c.witnesses)
        out.emplace(static_cast<int>(w.a.kind), static_cast<int>(w.b.kind));
    return out;
}

struct Seen {
    std::size_t contacts = 0;
    std::size_t later = 0;  // than the start
    std::size_t none = 0;
};

void expect_same(const Solid& a, const Motion& motion_a, const Solid& b, const Motion& motion_b,
                 ContactEvent event, bool names, Seen& seen) {
    const FirstContact expected =
        first_contact(InterferenceModel(a), motion_a, InterferenceModel(b), motion_b, {event});
    const NamedFirstContact found = first_contact(a, motion_a, b, motion_b, {event});
    EXPECT_EQ(found.at_start, expected.at_start);
    ASSERT_EQ(found.exists(), expected.exists());
    if (!found.exists()) {
        ++seen.none;
        return;
    }
    EXPECT_EQ(*found.time, *expected.time);
    if (names) {
        EXPECT_EQ(kinds_of(found), kinds_of(expected));
    }
    ++seen.contacts;
    if (*found.time > AlgebraicNumber(0)) ++seen.later;
}

void expect_at(const NamedFirstContact& c, const char* time) {
    ASSERT_TRUE(c.exists());
    EXPECT_EQ(*c.time, AlgebraicNumber(q(time)));
}

// Named configurations ----------------------------------------------------------------------------

TEST(SolidFirstContact, CornerFallsOntoAFace) {
    const Solid floor = solids::box(0, 0, 0, 8, 8, 1);
    trisect::PolygonMesh mesh;
    mesh.points = {{2, 2, 3}, {3, 2, 5}, {2, 3, 5}, {1, 1, 5}};
    for (const std::array<std::uint32_t, 3>& face :
         {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}})
        mesh.add_face(face);
    const Solid spike = Solid::from_mesh(mesh);
    const NamedFirstContact c = first_contact(floor, Motion(), spike, by(0, 0, -4));
    expect_at(c, "1/2");
    ASSERT_EQ(c.witnesses.size(), 1U);
    EXPECT_EQ(c.witnesses[0].a.kind, EntityName::Kind::Face);
    EXPECT_EQ(c.witnesses[0].a.faces[0].operand, floor.source_id());
    EXPECT_EQ(c.witnesses[0].b.kind, EntityName::Kind::Vertex);
    EXPECT_EQ(c.witnesses[0].b.corner.operand, spike.source_id());
    EXPECT_EQ(c.witnesses[0].b.corner.corner, 0U);
}

// The walls of the cells end in the middle of faces and edges: what meets has the same names.
TEST(SolidFirstContact, WallsOfCellsAreNoEntities) {
    const auto carved = [](std::uint32_t leaf_polygons) {
        EvaluateOptions options;
        options.leaf_polygons = leaf_polygons;
        Solid s = solids::box(0, 16);
        for (double x = 1; x < 16; x += 4)
            s = evaluate(Expression(s) - Expression(solids::box(x, 1, 1, x + 2, 3, 3)), options);
        return s;
    };
    const Solid roof = solids::box(2, 2, 20, 14, 14, 21);
    const Motion down = by(0, 0, -8);
    const NamedFirstContact whole = first_contact(carved(1000), Motion(), roof, down);
    expect_at(whole, "1/2");
    EXPECT_EQ(whole.witnesses.size(), 4U);
    for (const std::uint32_t few : {1U, 2U, 4U}) {
        const NamedFirstContact c = first_contact(carved(few), Motion(), roof, down);
        expect_at(c, "1/2");
        EXPECT_EQ(kinds_of(c), kinds_of(whole));
        EXPECT_EQ(c.witnesses.size(), whole.witnesses.size());
    }
}

TEST(SolidFirstContact, SlidesOnAFloorAgainstAWall) {
    EvaluateOptions options;
    options.leaf_polygons = 2;
    const Solid room = evaluate(
        Expression(solids::box(0, 0, 0, 8, 2, 2)) - Expression(solids::box(-1, 1, -1, 6, 3, 3)),
        options);
    const Solid block = solids::box(1, 1, 0, 2, 2, 2);
    const FirstContact expected =
        first_contact(InterferenceModel(room), Motion(), InterferenceModel(block), by(8, 0, 0),
                      {ContactEvent::Overlap});
    const NamedFirstContact c =
        first_contact(room, Motion(), block, by(8, 0, 0), {ContactEvent::Overlap});
    expect_at(c, "1/2");
    EXPECT_EQ(c.at_start, Relation::Touching);
    EXPECT_EQ(kinds_of(c), kinds_of(expected));
    EXPECT_FALSE(
        first_contact(room, Motion(), block, by(4, 0, 0), {ContactEvent::Overlap}).exists());
}

// Flush all around, and near at all times: each pair of parts is solved once, however many searches
// and intervals come to it, and what is coplanar for good is seen at once.
TEST(SolidFirstContact, APegSlidesFlushToTheEndOfItsHole) {
    constexpr double height = 0.75;
    const auto cylinder = [](double length, double from) {
        return transformed(Solid::from_mesh(trisect::make_cylinder(2, length, 24)),
                           Pose::from_translation({0, 0, from}));
    };
    Solid peg = cylinder(height, 0);
    for (int ring = 1; ring < 3; ++ring)
        peg = evaluate(Expression(peg) | Expression(cylinder(height, height * ring)));
    const Solid block = evaluate(Expression(solids::box(-4, -4, -2, 4, 4, 4)) - Expression(peg) -
                                 Expression(cylinder(8, 1)));
    const Motion down = Motion::translation(Pose::from_translation({0, 0, 3}), {0, 0, -4});
    const trisect::Diagnostics<trisect::FirstContactCounters> search;
    const trisect::Diagnostics<trisect::MotionCounters> pairs;
    const NamedFirstContact c = first_contact(peg, down, block, Motion(), {ContactEvent::Overlap});
    expect_at(c, "3/4");
    EXPECT_EQ(c.at_start, Relation::Touching);
    EXPECT_EQ(c.witnesses.size(), 24U);
    EXPECT_GT(search.counters().triangle_pairs, 0U);
    EXPECT_LT(search.counters().triangle_pairs, 60000U);
    EXPECT_GT(pairs.counters().coplanar, 0U);
    const FirstContact expected = first_contact(
        InterferenceModel(peg), down, InterferenceModel(block), Motion(), {ContactEvent::Overlap});
    EXPECT_EQ(*c.time, *expected.time);
    EXPECT_EQ(kinds_of(c), kinds_of(expected));
}

TEST(SolidFirstContact, WithinEachOtherAtTheStart) {
    const Solid outer = solids::box(0, 4);
    const NamedFirstContact c = first_contact(outer, Motion(), solids::box(1, 2), by(9, 0, 0));
    expect_at(c, "0");
    EXPECT_EQ(c.at_start, Relation::Contains);
    EXPECT_TRUE(c.witnesses.empty());
    const NamedFirstContact flush =
        first_contact(outer, Motion(), solids::box(4, 0, 0, 5, 4, 4), by(1, 0, 0));
    expect_at(flush, "0");
    EXPECT_EQ(flush.at_start, Relation::Touching);
    EXPECT_FALSE(flush.witnesses.empty());
    EXPECT_FALSE(first_contact(outer, Motion(), Solid(), by(9, 0, 0)).exists());
}

TEST(SolidFirstContact, MotionsMustRunTogether) {
    const Solid a = solids::box(0, 1);
    const std::vector<Pose> three{Pose(), Pose::from_translation({1, 0, 0}), Pose()};
    const std::vector<Pose> four{Pose(), Pose::from_translation({1, 0, 0}), Pose(), Pose()};
    EXPECT_THROW(
        (void)first_contact(a, Motion::through(three), solids::box(4, 5), Motion::through(four)),
        trisect::UsageError);
    expect_at(
        first_contact(a, Motion(), solids::box(4, 5),
                      Motion::through(std::vector<Pose>{Pose(), Pose::from_translation({0, -3, -3}),
                                                        Pose::from_translation({-6, -3, -3})})),
        "3/2");
}

// Random solids -----------------------------------------------------------------------------------

Screw random_screw(Random& random, bool turning) {
    Screw screw;
    if (turning) screw.turn = {random.between(3, 9), small(random), small(random), small(random)};
    for (std::size_t i = 0; i < 3; ++i) {
        screw.center[i] = static_cast<double>(random.between(0, 8));
        screw.shift[i] = static_cast<double>(random.between(-4, 4));
    }
    return screw;
}

// From where things coincide: sliding, grazing, flush.
TEST(SolidFirstContact, OfRandomScenesIsThatOfModels) {
    Seen touch;
    Seen overlap;
    for (std::uint64_t seed = 1; seed <= 300 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        const auto few = static_cast<std::uint32_t>(1 + seed % 6);
        const Solid a = solid_of(scene.a, few);
        const Solid b = solid_of(scene.b, few);
        const bool names = !touches_itself(a) && !touches_itself(b);
        const Motion moving = Motion::screw(scene.pose_b, random_screw(random, seed % 3 == 0));
        expect_same(a, Motion(scene.pose_a), b, moving, ContactEvent::Touch, names, touch);
        expect_same(a, Motion(scene.pose_a), b, moving, ContactEvent::Overlap, names, overlap);
    }
    EXPECT_GT(touch.contacts, 100U);
    EXPECT_GT(overlap.later, 10U);
    EXPECT_GT(overlap.none, 10U);
}

// Away from each other, then together.
TEST(SolidFirstContact, OfRandomSolidsThatComeTogetherIsThatOfModels) {
    Seen touch;
    Seen overlap;
    for (std::uint64_t seed = 1; seed <= 240 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(1000 + seed);
        brute::Scene scene = brute::random_scene(random);
        const auto few = static_cast<std::uint32_t>(1 + seed % 6);
        const Solid a = solid_of(scene.a, few);
        const Solid b = solid_of(scene.b, few);
        const bool names = !touches_itself(a) && !touches_itself(b);
        Placement p;
        if (random.chance(1, 2))
            p.quaternion = {random.between(1, 3), small(random), small(random), small(random)};
        p.screw = random_screw(random, seed % 2 == 0);
        const std::size_t axis = random.below(3);
        const double side = random.chance(1, 2) ? 1 : -1;
        for (std::size_t i = 0; i < 3; ++i) p.at[i] = static_cast<double>(random.between(-5, 5));
        p.at[axis] = side * static_cast<double>(random.between(14, 30));
        p.screw.shift[axis] -= side * static_cast<double>(random.between(10, 40));
        const Motion own =
            seed % 5 == 0 ? Motion::screw(Pose(), random_screw(random, true)) : Motion();
        expect_same(a, own, b, p.motion(), ContactEvent::Touch, names, touch);
        if (seed % 3 == 0)
            expect_same(a, own, b, p.motion(), ContactEvent::Overlap, names, overlap);
    }
    EXPECT_GT(touch.later, 40U);
    EXPECT_GT(touch.none, 10U);
    EXPECT_GT(overlap.later, 10U);
}

}  // namespace
