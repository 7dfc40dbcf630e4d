// SPDX-License-Identifier: Apache-2.0
//
// Many solids in one place: how much is compared, and that the result is that of a chain.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/stop_scope.h>

#include "engines/evaluate_stats.h"

namespace {

using trisect::evaluate;
using trisect::exact_volume;
using trisect::Expression;
using trisect::FaceSource;
using trisect::Solid;
using trisect::test::EvaluateStats;

// Spheres of 1,280 triangles about one centre, turned by other angles each, with radii from 1 to
// 1 + `growth`.
std::vector<Solid> spheres(int n, double growth) {
    std::vector<Solid> out;
    for (int i = 0; i < n; ++i) {
        const double radius = 1 + growth * (i * 7 % n) / n;
        trisect::PolygonMesh mesh = trisect::make_icosphere(radius, 3);
        for (trisect::Point3d& p : mesh.points)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double angle = 0.37 + 1.13 * i + 0.71 * static_cast<double>(axis);
                double& x = p[axis];
                double& y = p[(axis + 1) % 3];
                const double turned = std::cos(angle) * x - std::sin(angle) * y;
                y = std::sin(angle) * x + std::cos(angle) * y;
                x = turned;
            }
        trisect::SolidOptions options;
        options.embedding = trisect::Embedding::Assume;
        out.push_back(Solid::from_mesh(mesh, options));
    }
    return out;
}

std::vector<FaceSource> sources_of(const trisect::Brep& brep) {
    std::vector<FaceSource> out;
    for (const trisect::FaceId f : brep.faces()) out.push_back(brep.source(f));
    std::ranges::sort(out);
    return out;
}

// The same faces with the same names, and the same volume.
void expect_same(const Solid& result, const Solid& chain) {
    const trisect::Brep a = result.to_brep();
    const trisect::Brep b = chain.to_brep();
    EXPECT_EQ(a.counts(), b.counts());
    EXPECT_EQ(sources_of(a), sources_of(b));
    EXPECT_EQ(exact_volume(a), exact_volume(b));
    EXPECT_EQ(evaluate(result ^ chain).to_brep().counts().faces, 0U);
}

// A limit of work is counted by cells.
Solid by_cells(const Expression& expression, EvaluateStats& stats) {
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});
    return evaluate(expression, {}, &stats);
}

using Combine = Expression (*)(const Expression& a, const Expression& b);

// All solids by one operation: in one pass, and one after the other.
void expect_same_as_chain(const std::vector<Solid>& solids, Combine combine) {
    Expression all = solids[0];
    Solid chain = solids[0];
    for (std::size_t i = 1; i < solids.size(); ++i) {
        all = combine(all, solids[i]);
        chain = evaluate(combine(chain, solids[i]));
    }
    EvaluateStats stats;
    const Solid result = by_cells(all, stats);
    EXPECT_GT(stats.halved_cells, 0U);
    EXPECT_LT(stats.exact_leaves * 20, stats.filtered_leaves);
    expect_same(result, chain);
    const Solid without_tree = evaluate(all, {}, &stats);
    EXPECT_EQ(stats.halved_cells, 0U);
    EXPECT_EQ(stats.exact_leaves, 0U);
    EXPECT_FALSE(trisect::detail::state_of(without_tree)->lazy_tree()->is_cut());
    expect_same(without_tree, chain);
}

TEST(CrowdedScenes, AreWhatAChainMakes) {
    const std::vector<Solid> solids = spheres(16, 0.02);
    using E = const Expression&;
    expect_same_as_chain(solids, [](E a, E b) { return a & b; });
    expect_same_as_chain(solids, [](E a, E b) { return a | b; });
    expect_same_as_chain(solids, [](E a, E b) { return a - b; });
}

TEST(CrowdedScenes, OfNestedFormulas) {
    const std::vector<Solid> solids = spheres(8, 0.02);
    const Expression a = (solids[0] ^ solids[1]) | (solids[2] & solids[3]);
    const Expression b = (solids[4] & solids[5]) - (solids[6] ^ solids[7]);
    EvaluateStats stats;
    const Solid result = evaluate(a - b, {}, &stats);
    EXPECT_GT(stats.halved_cells, 0U);
    expect_same(result, evaluate(evaluate(a) - evaluate(b)));
}

// What is compared grows little faster than the operands.
TEST(CrowdedScenes, PairsAreFew) {
    std::vector<std::uint64_t> pairs;
    for (const int n : {8, 32}) {
        EvaluateStats stats;
        (void)by_cells(Expression::all_of(spheres(n, 0.02)), stats);
        pairs.push_back(stats.pairs_boxes);
        EXPECT_GT(stats.filtered_fragments, 0U);
        EXPECT_LT(stats.exact_leaves * 20, stats.filtered_leaves);
    }
    EXPECT_LT(pairs[1], 8 * pairs[0]);
}

// Pair by pair as well.
TEST(CrowdedScenes, PairsAreFewWithoutATree) {
    for (const bool is_union : {false, true}) {
        std::vector<std::uint64_t> pairs;
        for (const int n : {8, 32}) {
            const std::vector<Solid> solids = spheres(n, 0.02);
            EvaluateStats stats;
            (void)evaluate(is_union ? Expression::any_of(solids) : Expression::all_of(solids), {},
                           &stats);
            pairs.push_back(stats.pairs_boxes);
        }
        EXPECT_LT(pairs[1], 8 * pairs[0]);
    }
}

TEST(CrowdedScenes, AreTheSameWithAnyNumberOfThreads) {
    const std::vector<Solid> solids = spheres(18, 0.02);
    for (const Expression& e : {Expression::all_of(solids), Expression::any_of(solids),
                                solids[0] - Expression::any_of(std::span(solids).subspan(1))}) {
        trisect::EvaluateOptions options;
        options.threads = 1;
        const trisect::PolygonMesh alone = evaluate(e, options).to_mesh();
        for (const std::uint32_t threads : {2U, 5U}) {
            options.threads = threads;
            const trisect::PolygonMesh mesh = evaluate(e, options).to_mesh();
            EXPECT_EQ(mesh.corners, alone.corners);
            EXPECT_TRUE(mesh.points == alone.points);
        }
    }
}

// About an axis along the third one.
Solid frustum(double z, double lower, double upper, std::uint32_t sides = 30, double x = 0) {
    trisect::PolygonMesh mesh;
    for (const auto& [height, radius] : {std::pair(z, lower), std::pair(z + 1, upper)})
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 6.28 * i / sides;
            mesh.points.push_back({x + radius * std::cos(angle), radius * std::sin(angle), height});
        }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        if (i + 2 < sides) {
            mesh.add_triangle(0, i + 2, i + 1);
            mesh.add_triangle(sides, sides + i + 1, sides + i + 2);
        }
        mesh.add_triangle(i, j, sides + j);
        mesh.add_triangle(i, sides + j, sides + i);
    }
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Assume;
    return Solid::from_mesh(mesh, options);
}

// Where cells would be arranged exactly.
TEST(CrowdedScenes, ThatStandOnEachOtherGoPairByPair) {
    std::vector<Solid> solids;
    for (int i = 0; i < 6; ++i)
        solids.push_back(frustum(i, i % 2 == 0 ? 1.0 : 0.75, i % 2 == 0 ? 0.75 : 1.0));
    EvaluateStats stats;
    const Solid all = evaluate(Expression::any_of(solids), {}, &stats);
    EXPECT_EQ(stats.exact_leaves, 0U);
    EXPECT_GT(stats.doubtful_pairs, 0U);
    EXPECT_FALSE(trisect::detail::state_of(all)->lazy_tree()->is_cut());
    Solid chain = solids[0];
    for (std::size_t i = 1; i < solids.size(); ++i) chain = evaluate(chain | solids[i]);
    const trisect::Brep a = all.to_brep();
    const trisect::Brep b = chain.to_brep();
    EXPECT_EQ(exact_volume(a), exact_volume(b));
    EXPECT_EQ(a.counts(), b.counts());
    EXPECT_EQ(evaluate(all ^ chain).to_brep().counts().faces, 0U);
}

// Caps of fans have some 70,000 pairs whose boxes meet.
TEST(CrowdedScenes, FacetsOfOnePlaneAreNoPairs) {
    std::vector<Solid> solids;
    for (int i = 0; i < 4; ++i) solids.push_back(frustum(0, 1, 0.875, 100, 0.25 * i));
    EvaluateStats stats;
    const Solid all = evaluate(Expression::any_of(solids), {}, &stats);
    EXPECT_FALSE(trisect::detail::state_of(all)->lazy_tree()->is_cut());
    EXPECT_GT(stats.doubtful_pairs, 100U);
    EXPECT_LT(stats.doubtful_pairs, 30000U);
    Solid chain = solids[0];
    for (std::size_t i = 1; i < solids.size(); ++i) chain = evaluate(chain | solids[i]);
    EXPECT_EQ(exact_volume(all.to_brep()), exact_volume(chain.to_brep()));
}

}  // namespace
