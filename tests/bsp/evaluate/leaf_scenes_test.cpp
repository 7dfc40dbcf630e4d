// SPDX-License-Identifier: Apache-2.0
//
// Scenes that are hard for a leaf arrangement, with the counters that show how it copes. Volumes
// are exact, counts are asserted, times never.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/stop_scope.h>

#include "engines/evaluate_stats.h"

namespace {

using trisect::Embedding;
using trisect::evaluate;
using trisect::exact_volume;
using trisect::ExactRational;
using trisect::Expression;
using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::Solid;
using trisect::test::EvaluateStats;

void add_box(LatticeMesh& mesh, const LatticePoint& lo, const LatticePoint& hi) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back(
            {(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z});
    constexpr std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads) {
        mesh.triangles.push_back({first + q[0], first + q[1], first + q[2]});
        mesh.triangles.push_back({first + q[0], first + q[2], first + q[3]});
    }
}

// A double cone: two hubs with `needles` facets around each of them. Turned by `angle` about two
// axes and rounded to integers, which leaves it free of self-intersections.
LatticeMesh double_cone(int needles, double angle) {
    constexpr double radius = 1e6;
    LatticeMesh mesh;
    const auto add = [&](double x, double y, double z) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const double v = c * y - s * z;
        const double w = s * y + c * z;
        mesh.points.push_back(
            {std::llround(c * x - s * v), std::llround(s * x + c * v), std::llround(w)});
        return static_cast<std::uint32_t>(mesh.points.size() - 1);
    };
    const std::uint32_t top = add(0, 0, radius / 3);
    const std::uint32_t bottom = add(0, 0, -radius / 3);
    const auto n = static_cast<std::uint32_t>(needles);
    for (int i = 0; i < needles; ++i) {
        const double a = 2 * 3.14159265358979323846 * i / needles;
        (void)add(radius * std::cos(a), radius * std::sin(a), 0);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 + i;
        const std::uint32_t b = 2 + (i + 1) % n;
        mesh.triangles.push_back({top, a, b});
        mesh.triangles.push_back({bottom, b, a});
    }
    return mesh;
}

ExactRational volume_of(const Solid& solid) { return exact_volume(solid.to_brep()); }

// V(A ∪ B) + V(A ∩ B) = V(A) + V(B) and V(A - B) + V(A ∩ B) = V(A).
void expect_volumes_add_up(const Solid& a, const Solid& b, const ExactRational& volume_a,
                           const ExactRational& volume_b) {
    const ExactRational common = volume_of(evaluate(a & b));
    EXPECT_EQ(volume_of(evaluate(a | b)) + common, volume_a + volume_b);
    EXPECT_EQ(volume_of(evaluate(a - b)) + common, volume_a);
}

TEST(NeedleFans, HubOf500NeedlesAgainstATurnedCopy) {
    const LatticeMesh a = double_cone(500, 0);
    const LatticeMesh b = double_cone(500, 0.6);
    expect_volumes_add_up(Solid::from_lattice_mesh(a), Solid::from_lattice_mesh(b), exact_volume(a),
                          exact_volume(b));
}

// Every two needles of a hub have a corner in common: by name, without arithmetic.
TEST(NeedleFans, NeedlesOfOneHubAreToldApartByTheFilter) {
    const Solid a = Solid::from_lattice_mesh(double_cone(500, 0), Embedding::Resolve);
    trisect::EvaluateOptions options;
    options.leaf_polygons = 2000;  // one leaf
    const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
    EvaluateStats stats;
    const Solid resolved = evaluate(a | a, options, &stats);
    EXPECT_EQ(stats.mixed_leaves, 1U);
    EXPECT_GT(stats.pairs_boxes, 10'000U);
    EXPECT_EQ(stats.pairs_touching, 0U);
    EXPECT_EQ(stats.untouched_polygons, 1000U);
    EXPECT_EQ(stats.pieces, 0U);
    EXPECT_LE(stats.traces, 1U);
    const auto counters = diagnostics.counters();
    EXPECT_LT(counters.exact_narrow + counters.exact_wide, 100U);
    EXPECT_EQ(volume_of(resolved), exact_volume(double_cone(500, 0)));
}

// Cuts what evaluation has deferred.
void arrange_leaves(const trisect::detail::CellNode& node) {
    if (node.is_leaf()) {
        EXPECT_TRUE(node.size() == 0 || !node.polygons().empty());
        return;
    }
    for (int i = 0; i < 2; ++i) arrange_leaves(*node.child(i).node);
}

// Two surfaces that cross: nothing is traced piece by piece, and no sign needs wide integers.
TEST(NeedleFans, GenericCutsNeedNoWideIntegers) {
    const Solid a = Solid::from_lattice_mesh(double_cone(60, 0));
    const Solid b = Solid::from_lattice_mesh(double_cone(60, 0.6));
    const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
    EvaluateStats stats;
    const trisect::StopScope by_cells({.max_work = std::uint64_t{1} << 60});  // counted by cells
    const Solid joined = evaluate(a | b, {}, &stats);
    arrange_leaves(*trisect::detail::state_of(joined)->root().node);
    const auto counters = diagnostics.counters();
    EXPECT_GT(stats.pairs_cutting, 20U);
    EXPECT_GE(stats.pairs_boxes, stats.pairs_touching);
    EXPECT_GE(stats.pairs_touching, stats.pairs_cutting);
    EXPECT_LE((counters.exact_narrow + counters.exact_wide) * 100, counters.filtered);
    EXPECT_LT(stats.traces, stats.pairs_cutting + 30);
}

class EngravedPlate : public ::testing::TestWithParam<int> {};

// n² pockets in one mesh, whose tops are coplanar with the plate's: what a leaf compares and what
// it makes grows with their number, not with its square.
TEST_P(EngravedPlate, CoplanarPiecesCostAsManyAsThereAre) {
    const int n = GetParam();
    const std::int64_t side = 10 * n;
    LatticeMesh plate;
    LatticeMesh pockets;
    add_box(plate, {0, 0, 0}, {side, side, 10});
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            add_box(pockets, {10 * i + 2, 10 * j + 2, 5}, {10 * i + 8, 10 * j + 8, 10});
    EvaluateStats stats;
    const Solid engraved =
        evaluate(Solid::from_lattice_mesh(plate) - Solid::from_lattice_mesh(pockets), {}, &stats);
    const auto count = static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(n);
    EXPECT_LT(stats.pairs_boxes, 60 * count);
    EXPECT_LT(stats.pieces, 60 * count);
    EXPECT_LT(stats.traces, 20 * count);
    const trisect::Brep brep = engraved.to_brep();
    EXPECT_EQ(brep.faces().size(), 6 + 5 * count);
    const auto volume =
        static_cast<std::int64_t>(side * side * 10) - static_cast<std::int64_t>(count) * 6 * 6 * 5;
    EXPECT_EQ(exact_volume(brep), ExactRational(volume));
}

INSTANTIATE_TEST_SUITE_P(Pockets, EngravedPlate, ::testing::Values(10, 32, 100));

// Boxes turned about one axis: their caps lie in two planes and overlap all over. No cap may be cut
// by all the others, and both kinds of leaf engine must say the same.
TEST(LeafScenes, BoxesTurnedAboutAnAxisShareTwoPlanes) {
    constexpr int count = 12;
    // A pyramid within the boxes, whose sides are neither across the axis nor along it.
    LatticeMesh sides;
    sides.points = {{-1, -1, 1}, {2, 0, 1}, {0, 2, 1}, {0, 0, 3}};
    sides.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const Solid pyramid = Solid::from_lattice_mesh(sides);
    const auto united = [&](Embedding embedding, bool with_pyramid, EvaluateStats& stats) {
        std::vector<Expression> boxes;
        trisect::SolidOptions options;
        options.embedding = embedding;
        for (int i = 0; i < count; ++i) {
            auto box =
                trisect::transformed(trisect::make_box({-8, -3, 0}, {8, 3, 5}),
                                     trisect::AffineMap::rotation({0, 0, 1}, 180.0 * i / count));
            for (auto& p : box.points) p[2] = std::round(p[2]);  // the map moves one by a digit
            boxes.emplace_back(Solid::from_mesh(box, options));
        }
        if (with_pyramid) boxes.emplace_back(pyramid);
        trisect::EvaluateOptions one_leaf;
        one_leaf.leaf_polygons = 1000;
        // By cells: a limit of work is counted by them.
        const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});
        return evaluate(Expression::any_of(boxes), one_leaf, &stats);
    };
    EvaluateStats stats;
    EvaluateStats long_stats;
    EvaluateStats resolved_stats;
    const auto fan = united(Embedding::Assume, false, stats).to_brep();
    const auto long_way = united(Embedding::Assume, true, long_stats).to_brep();
    const auto resolved = united(Embedding::Resolve, false, resolved_stats).to_brep();
    EXPECT_EQ(stats.prism_leaves, 1U);
    EXPECT_EQ(long_stats.prism_leaves, 0U);
    EXPECT_GT(long_stats.cuts_undone, 0U);
    // Twelve facets a box, each in a few parts for every other box; not in n² parts.
    EXPECT_LT(long_stats.pieces, 24U * count * count);
    EXPECT_LT(4 * long_stats.pieces, resolved_stats.pieces);
    EXPECT_LT(4 * stats.pieces, long_stats.pieces);
    EXPECT_EQ(exact_volume(fan), exact_volume(resolved));
    EXPECT_EQ(exact_volume(fan), exact_volume(long_way));
    EXPECT_EQ(fan.counts().faces, resolved.counts().faces);
    EXPECT_EQ(fan.counts().faces, long_way.counts().faces);
}

Solid cube_at(double x, double y, double z) {
    return Solid::from_mesh(trisect::make_box({x, y, z}, {x + 1, y + 1, z + 1}));
}

// Axis-parallel leaves are arranged on a grid of bits: no pair is compared, no segment traced.
TEST(AxisParallelLeaves, CubesThatTouchBecomeOneBox) {
    std::vector<Expression> cubes;
    for (int i = 0; i < 64; ++i) cubes.emplace_back(cube_at(i % 4, i / 4 % 4, i / 16));
    for (const std::uint32_t leaf : {3U, 25U, 100U, 10000U}) {
        trisect::EvaluateOptions options;
        options.leaf_polygons = leaf;
        EvaluateStats stats;
        const Solid all = evaluate(Expression::any_of(cubes), options, &stats);
        EXPECT_EQ(stats.pairs_boxes, 0U);
        EXPECT_EQ(stats.traces, 0U);
        const auto brep = all.to_brep();
        EXPECT_EQ(exact_volume(brep), ExactRational(64));
        EXPECT_EQ(brep.counts().faces, 6U);
    }
}

// Every second cube: they touch in edges and vertices only.
TEST(AxisParallelLeaves, CubesOfOneColourLeaveTheOthers) {
    std::vector<Expression> even;
    for (int i = 0; i < 27; ++i)
        if ((i % 3 + i / 3 % 3 + i / 9) % 2 == 0)
            even.emplace_back(cube_at(i % 3, i / 3 % 3, i / 9));
    const Solid block = Solid::from_mesh(trisect::make_box({0, 0, 0}, {3, 3, 3}));
    for (const std::uint32_t leaf : {3U, 25U, 100U}) {
        trisect::EvaluateOptions options;
        options.leaf_polygons = leaf;
        const auto rest = evaluate(Expression(block) - Expression::any_of(even), options).to_brep();
        EXPECT_EQ(exact_volume(rest), ExactRational(13));
        EXPECT_EQ(rest.counts().faces, 13U * 6);
    }
}

// Two meshes whose bars cross all others of the other one: the same grid, no search for pairs.
TEST(AxisParallelLeaves, BarsOfTwoMeshesThatCrossAreOneGrid) {
    constexpr std::int64_t bars = 12;
    LatticeMesh along_x;
    LatticeMesh along_y;
    for (std::int64_t i = 0; i < bars; ++i) {
        add_box(along_x, {0, 10 * i + 3, 0}, {10 * bars, 10 * i + 7, 4});
        add_box(along_y, {10 * i + 3, -5, 1}, {10 * i + 7, 10 * bars + 5, 3});
    }
    const Expression x = Solid::from_lattice_mesh(along_x);
    const Expression y = Solid::from_lattice_mesh(along_y);
    EvaluateStats stats;
    const Solid both = evaluate(x & y, {}, &stats);
    EXPECT_EQ(stats.grid_leaves, 1U);
    EXPECT_EQ(stats.pairs_boxes, 0U);
    EXPECT_EQ(exact_volume(both.to_brep()), ExactRational(bars * bars * 4 * 4 * 2));
}

// Small cells lie under the common part of several plates, where all of them are one slab.
TEST(LeafScenes, PlatesThatShareACoverAreOneSlabUnderIt) {
    std::vector<Expression> plates;
    for (int i = 0; i < 6; ++i)
        plates.emplace_back(Solid::from_mesh(
            trisect::make_box({-20.0 - i, -31.0 + i, -4}, {20.0 + i, 31.0 - i, 4})));
    // A slanted one keeps the leaves from being axis-parallel.
    LatticeMesh wedge;
    wedge.points = {{0, -40, -4}, {40, 0, -4}, {-40, 0, -4}, {0, -40, 4}, {40, 0, 4}, {-40, 0, 4}};
    wedge.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                       {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    plates.emplace_back(Solid::from_lattice_mesh(wedge));
    ExactRational expected = exact_volume(evaluate(Expression::any_of(plates)).to_brep());
    for (const std::uint32_t leaf : {3U, 12U, 1000U}) {
        trisect::EvaluateOptions options;
        options.leaf_polygons = leaf;
        const auto brep = evaluate(Expression::any_of(plates), options).to_brep();
        EXPECT_EQ(exact_volume(brep), expected);
        for (const auto& p : plates)
            EXPECT_TRUE(evaluate(p - evaluate(Expression::any_of(plates), options)).is_empty());
    }
}

}  // namespace
