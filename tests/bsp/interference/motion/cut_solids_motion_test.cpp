// SPDX-License-Identifier: Apache-2.0
//
// First contact with solids that were just cut: the same as of models that are made anew, for what
// is near the way.

#include <trisect/bsp/interference/solid_motion.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/tree/boxes_counters.h>
#include <trisect/kernel/diagnostics.h>

#include "reference/random_solids.h"
#include "support/solids.h"

namespace {

using reference::Random;
using trisect::ContactEvent;
using trisect::Diagnostics;
using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::first_contact;
using trisect::FirstContact;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::NamedFirstContact;
using trisect::Point3d;
using trisect::Pose;
using trisect::Screw;
using trisect::Solid;

Solid sphere(double radius, const Point3d& at, int level) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(radius, static_cast<std::uint32_t>(level));
    for (Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::round((p[k] + at[k]) * 0x1p20) * 0x1p-20;
    return Solid::from_mesh(mesh);
}

Point3d on_sphere(Random& random, double radius) {
    Point3d p{};
    double square = 0;
    do {
        square = 0;
        for (double& c : p) {
            c = static_cast<double>(random.between(-1024, 1024)) / 1024;
            square += c * c;
        }
    } while (square > 1 || square < 0.01);
    for (double& c : p) c *= radius / std::sqrt(square);
    return p;
}

// From outside to the middle.
Motion dive(const Point3d& at, double from, double by) {
    return Motion::translation(Pose::from_translation({from * at[0], from * at[1], from * at[2]}),
                               {-by * at[0], -by * at[1], -by * at[2]});
}

void expect_same(const Solid& stock, const Solid& tool, const Motion& motion, ContactEvent event,
                 int& contacts) {
    const FirstContact expected =
        first_contact(InterferenceModel(stock), Motion(), InterferenceModel(tool), motion, {event});
    const NamedFirstContact found = first_contact(stock, Motion(), tool, motion, {event});
    EXPECT_EQ(found.at_start, expected.at_start);
    EXPECT_EQ(found.time, expected.time);
    if (found.exists()) ++contacts;
}

TEST(CutSolidsInMotion, AStockThatIsCutAllAround) {
    Random random(1);
    Solid stock = sphere(1, {0, 0, 0}, 4);
    stock.refine();
    const Solid holder = sphere(0.25, {0, 0, 0}, 3);
    int contacts = 0;
    for (int cut = 0; cut < 12; ++cut) {
        const Point3d at = on_sphere(random, 1);
        stock = evaluate(Expression(stock) - Expression(sphere(0.15, at, 2)));
        expect_same(stock, holder, dive(at, 1.5, 0.5), ContactEvent::Touch, contacts);
        expect_same(stock, holder, dive(at, 1.6, 0.2), ContactEvent::Touch, contacts);
        Screw screw;
        screw.turn = {9, 0, 0, 1};
        screw.shift = {-at[0], -at[1], -at[2]};
        expect_same(stock, holder,
                    Motion::screw(Pose::from_translation({2 * at[0], 2 * at[1], 2 * at[2]}), screw),
                    ContactEvent::Overlap, contacts);
    }
    EXPECT_GT(contacts, 20);
}

// Walls of a box of cells, one cut out after the other; a block that slides through what is left.
TEST(CutSolidsInMotion, ABlockSlidesThroughAPartOfThinWalls) {
    Random random(7);
    EvaluateOptions options;
    options.leaf_polygons = 6;
    Solid part = solids::box(0, 16);
    const Solid block = solids::box(0, 2);
    int contacts = 0;
    for (int cut = 0; cut < 30; ++cut) {
        Point3d low{};
        for (double& c : low) c = static_cast<double>(random.below(15));
        part = evaluate(
            Expression(part) -
                Expression(solids::box(low[0], low[1], low[2], low[0] + 2, low[1] + 2, low[2] + 2)),
            options);
        for (int i = 0; i < 3; ++i) {
            Point3d by{};
            by[random.below(3)] = random.chance(1, 2) ? 4 : -4;
            if (i == 2) by[random.below(3)] = 3;
            expect_same(part, block, Motion::translation(Pose::from_translation(low), by),
                        ContactEvent::Overlap, contacts);
        }
    }
    EXPECT_GT(contacts, 20);
}

TEST(CutSolidsInMotion, OnlyWhatIsNearTheWayGetsBoxes) {
    const auto made = [](int level) {
        Random random(3);
        Solid stock = sphere(1, {0, 0, 0}, level);
        stock.refine();
        const double size = 0.6 / (1 << (level - 3));
        const Solid holder = sphere(size, {0, 0, 0}, 3);
        std::uint64_t leaves = 0;
        std::uint64_t triangles = 0;
        for (int cut = 0; cut < 10; ++cut) {
            const Point3d at = on_sphere(random, 1);
            stock = evaluate(Expression(stock) - Expression(sphere(size / 2, at, 2)));
            const Diagnostics<trisect::detail::BoxesCounters> diagnostics;
            const NamedFirstContact c =
                first_contact(stock, Motion(), holder, dive(at, 1 + 2 * size, 2 * size));
            EXPECT_TRUE(c.exists());
            EXPECT_FALSE(c.witnesses.empty());
            leaves += diagnostics.counters().leaves;
            triangles += diagnostics.counters().triangles;
        }
        return std::pair(leaves, triangles);
    };
    const auto [leaves, triangles] = made(4);
    const auto [more_leaves, more_triangles] = made(6);
    EXPECT_GT(leaves, 0U);
    EXPECT_LT(more_leaves, 2 * leaves + 40);
    EXPECT_LT(more_triangles, 2 * triangles + 4000);
}

}  // namespace
