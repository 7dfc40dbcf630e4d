// SPDX-License-Identifier: Apache-2.0
//
// Chains of cuts with questions after each of them: one query that goes on with what is left, fresh
// questions to the solids, and models that are made anew.

#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/solid_interference.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/tree/boxes_counters.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/kernel/diagnostics.h>

#include "reference/random_solids.h"
#include "support/solids.h"

namespace {

using reference::Random;
using trisect::Diagnostics;
using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::InterferenceModel;
using trisect::InterferenceQuery;
using trisect::Point3d;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

double uniform(Random& random) { return static_cast<double>(random.below(1U << 20U)) * 0x1p-20; }

Point3d on_sphere(Random& random, double radius) {
    Point3d p{};
    double square = 0;
    do {
        square = 0;
        for (double& c : p) {
            c = 2 * uniform(random) - 1;
            square += c * c;
        }
    } while (square > 1 || square < 0.01);
    for (double& c : p) c *= radius / std::sqrt(square);
    return p;
}

void expect_same(const Solid& stock, const Solid& tool, const Pose& pose, InterferenceQuery& query,
                 std::map<Relation, int>& seen) {
    const InterferenceModel a(stock);
    const InterferenceModel b(tool);
    const Relation expected = interfere(a, Pose(), b, pose).relation;
    EXPECT_EQ(interfere(stock, Pose(), tool, pose).relation, expected);
    EXPECT_EQ(query.relation(Pose(), pose), expected);
    const auto distance = boundary_distance(stock, Pose(), tool, pose);
    ASSERT_EQ(distance.has_value(), !stock.is_empty());
    if (distance) {
        EXPECT_EQ(exact_squared_distance(stock, Pose(), tool, pose),
                  exact_squared_distance(a, Pose(), b, pose));
        const double middle = 0.5 * (distance->lower + distance->upper);
        for (const double d : {0.99 * middle, 1.01 * middle, 0.1})
            EXPECT_EQ(are_nearer_than(stock, Pose(), tool, pose, d),
                      are_nearer_than(a, Pose(), b, pose, d));
    }
    ++seen[expected];
}

TEST(ReplacedSolids, AStockThatIsCutAllAround) {
    Random random(1);
    Solid stock = solids::ball(1, 4, {0, 0, 0});
    stock.refine();
    const Solid holder = solids::ball(0.25, 3, {0, 0, 0});
    InterferenceQuery query(stock, holder);
    std::map<Relation, int> seen;
    for (int cut = 0; cut < 40; ++cut) {
        const Point3d at = on_sphere(random, 1);
        stock = evaluate(Expression(stock) - Expression(solids::ball(0.15, 2, at)));
        query.replace_a(stock);
        for (int i = 0; i < 4; ++i) {
            Point3d by = i < 3 ? at : on_sphere(random, 1);
            const double out = std::array{1.28, 1.2, 1.1, 0.5}[static_cast<std::size_t>(i)];
            for (double& c : by) c *= out;
            expect_same(stock, holder, Pose::from_translation(by), query, seen);
        }
    }
    EXPECT_GT(seen[Relation::Disjoint], 10);
    EXPECT_GT(seen[Relation::Overlapping], 10);
    EXPECT_GT(seen[Relation::Contains], 10);
}

// Walls of a box of cells, one cut out after the other; blocks that fit into what is left.
TEST(ReplacedSolids, BlocksInAPartOfThinWallsTouchExactly) {
    Random random(7);
    EvaluateOptions options;
    options.leaf_polygons = 6;
    Solid part = solids::box(0, 16);
    const Solid block = solids::box(0, 2);
    InterferenceQuery query(part, block);
    std::map<Relation, int> seen;
    for (int cut = 0; cut < 60; ++cut) {
        std::array<double, 3> low{};
        for (double& c : low) c = static_cast<double>(random.below(15));
        const Solid tool = solids::box(low[0], low[1], low[2], low[0] + 2, low[1] + 2, low[2] + 2);
        part = evaluate(Expression(part) - Expression(tool), options);
        query.replace_a(part);
        for (int i = 0; i < 4; ++i) {
            Point3d by = low;
            for (double& c : by) c += static_cast<double>(random.below(3)) - (i == 0 ? 1 : 0);
            if (i == 0) by = low;
            expect_same(part, block, Pose::from_translation(by), query, seen);
        }
    }
    EXPECT_GT(seen[Relation::Touching], 20);
    EXPECT_GT(seen[Relation::Overlapping], 20);
}

// Islands that a cut leaves, shells within cavities.
TEST(ReplacedSolids, CavitiesAndIslandsCutLoose) {
    std::map<Relation, int> seen;
    EvaluateOptions options;
    options.leaf_polygons = 4;
    Solid part = solids::box(0, 32);
    const Solid probe = solids::box(0, 4);
    InterferenceQuery query(part, probe);
    const auto ask = [&](double x, double y, double z) {
        expect_same(part, probe, Pose::from_translation({x, y, z}), query, seen);
    };
    const auto cut = [&](const Solid& tool) {
        part = evaluate(Expression(part) - Expression(tool), options);
        query.replace_a(part);
        ask(14, 14, 14);
        ask(8, 8, 8);
        ask(9, 9, 9);
        ask(40, 0, 0);
        ask(30, 14, 14);
    };
    // A cavity, an island in it, a cavity in the island.
    cut(solids::box(6, 26));
    part = evaluate(Expression(part) | Expression(solids::box(10, 22)), options);
    query.replace_a(part);
    ask(14, 14, 14);
    cut(solids::box(13, 19));
    // The shell goes off in halves.
    cut(solids::box(-1, -1, 15, 33, 33, 17));
    cut(solids::box(-1, -1, -1, 33, 33, 15));
    EXPECT_GT(seen[Relation::Disjoint], 3);
    EXPECT_GT(seen[Relation::Contains] + seen[Relation::Overlapping], 3);
    cut(solids::box(-1, 33));
    EXPECT_TRUE(part.is_empty());
}

// A fresh mesh has its corners in doubles; what a cut leaves of it has not.
TEST(ReplacedSolids, ErrorsOfPositionsHoldAfterTheFirstCut) {
    const Solid mesh = solids::ball(1, 4);
    trisect::detail::SolidBoundary boundary(mesh);
    EXPECT_EQ(boundary.position_error, 0);
    const Solid cut =
        evaluate(Expression(mesh) - Expression(solids::ball(0.3, 3, {0.6, 0.6, 0.3})));
    ASSERT_TRUE(boundary.replace(cut).has_value());
    const std::uint32_t triangles = boundary.open_all();
    double most = 0;
    for (std::uint32_t t = 0; t < triangles; ++t)
        most = std::max(most, boundary.origin(t).leaf->error());
    EXPECT_GT(most, 0);
    EXPECT_LE(most, boundary.position_error);
}

TEST(ReplacedSolids, LookAtWhatIsNewOnly) {
    const auto made = [](int level) {
        Random random(3);
        Solid stock = solids::ball(1, level, {0, 0, 0});
        stock.refine();
        const double size = 0.6 / (1 << (level - 3));
        const Solid holder = solids::ball(size, 3, {0, 0, 0});
        InterferenceQuery query(stock, holder);
        std::uint64_t leaves = 0;
        std::uint64_t triangles = 0;
        for (int cut = 0; cut < 20; ++cut) {
            const Point3d at = on_sphere(random, 1);
            stock = evaluate(Expression(stock) - Expression(solids::ball(size / 2, 2, at)));
            const Diagnostics<trisect::detail::BoxesCounters> diagnostics;
            query.replace_a(stock);
            Point3d by = at;
            for (double& c : by) c *= 1 + 1.1 * size;
            (void)query.relation(Pose(), Pose::from_translation(by));
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
