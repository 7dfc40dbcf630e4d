// SPDX-License-Identifier: Apache-2.0
//
// How much of a result assembly works on, and that its output is a function of the set and the
// operands' facets, not of the tree.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>

#include "engines/evaluate_stats.h"
#include "support/solids.h"

namespace {

using solids::box;
using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::make_box;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::detail::AssemblyStats;
using trisect::test::EvaluateStats;

AssemblyStats stats_of(const Solid& solid) {
    AssemblyStats stats;
    (void)trisect::detail::assemble_mesh(*trisect::detail::state_of(solid), &stats);
    return stats;
}

TEST(AssemblyWork, AnImportedMeshPassesThrough) {
    const PolygonMesh sphere = trisect::make_icosphere(1, 3);
    const AssemblyStats stats = stats_of(Solid::from_mesh(sphere));
    EXPECT_EQ(stats.whole_facets, sphere.face_count());
    EXPECT_EQ(stats.worked_facets, 0U);
    EXPECT_EQ(stats.parts, 0U);
}

TEST(AssemblyWork, DisjointSolidsPassThrough) {
    const AssemblyStats stats = stats_of(evaluate(box(0, 1) | box(3, 4)));
    EXPECT_EQ(stats.whole_facets, 24U);
    EXPECT_EQ(stats.worked_facets, 0U);
}

TEST(AssemblyWork, ACornerCutsThreeSidesOfEachBox) {
    // Each box has 6 facets in the 3 sides that the other one cuts. What is left whole lies in the
    // other sides.
    const AssemblyStats stats = stats_of(evaluate(box(0, 2) | box(1, 3)));
    EXPECT_EQ(stats.whole_facets + stats.worked_facets, 24U);
    EXPECT_GE(stats.whole_facets, 8U);
    EXPECT_GE(stats.parts, stats.worked_facets);
    EXPECT_GE(stats.edges, 3 * stats.worked_facets);
}

TEST(AssemblyWork, ASmallCutLeavesNearlyAllOfASphereAlone) {
    const Solid sphere = Solid::from_mesh(trisect::make_icosphere(1, 5));
    const Solid tool = Solid::from_mesh(trisect::transformed(
        trisect::make_icosphere(0.1, 2), trisect::AffineMap::translation({0.6, 0.48, 0.64})));
    const AssemblyStats stats = stats_of(evaluate(sphere - tool));
    EXPECT_GT(stats.whole_facets, 20000U);
    EXPECT_LT(stats.worked_facets, 600U);
}

TEST(AssemblyWork, EdgesOfEqualToolsCrossInTheirPlaneOfSymmetry) {
    PolygonMesh tool = trisect::make_icosphere(1, 2);
    for (auto& p : tool.points)
        for (double& c : p) c = std::nearbyint(0x1p20 * c) * 0x1p-20;
    const auto at = [&](double x) {
        return Solid::from_mesh(
            trisect::transformed(tool, trisect::AffineMap::translation({x, 0, 4})));
    };
    const Solid block = Solid::from_mesh(make_box({-4, -4, -4}, {4, 4, 4}));
    const AssemblyStats stats = stats_of(evaluate(evaluate(block - at(-0.25)) - at(0.25)));
    EXPECT_GT(stats.named_by_edges, 30U);
}

// The planes of a box that is cut are those of its neighbours, which pass through.
TEST(AssemblyWork, FewLeavesAreReadWherePlanesHaveFacetsThatPassThrough) {
    std::vector<Expression> boxes;
    for (int i = 0; i < 64; ++i) {
        const std::array<double, 3> low{2.0 * (i / 16), 2.0 * (i / 4 % 4), 2.0 * (i % 4)};
        boxes.emplace_back(Solid::from_mesh(make_box(low, {low[0] + 1, low[1] + 1, low[2] + 1})));
    }
    EvaluateOptions options;
    options.leaf_polygons = 6;
    const Solid grid = evaluate(Expression::any_of(boxes), options);
    trisect::SolidOptions whole;
    whole.import.lattice = trisect::Lattice{-40};
    const Solid tool =
        Solid::from_mesh(trisect::transformed(trisect::make_icosphere(0.25, 1),
                                              trisect::AffineMap::translation({7.03, 7.01, 7.02})),
                         whole);
    const AssemblyStats stats = stats_of(evaluate(grid - tool, options));
    EXPECT_EQ(stats.axis_facets, 0U);
    EXPECT_GT(stats.axis_leaves, 0U);
    EXPECT_LT(2 * stats.axis_leaves, stats.leaves);
}

TEST(AssemblyWork, OnlyCoplanarNeighboursAreJoined) {
    AssemblyStats stats;
    // Two facets for each side of a box.
    EXPECT_EQ(trisect::detail::assemble_brep(*trisect::detail::state_of(box(0, 1)), {}, &stats)
                  .counts()
                  .faces,
              6U);
    EXPECT_EQ(stats.joined_facets, 12U);
    const Solid sphere = Solid::from_mesh(trisect::make_icosphere(1, 3));
    (void)trisect::detail::assemble_brep(*trisect::detail::state_of(sphere), {}, &stats);
    EXPECT_EQ(stats.joined_facets, 0U);
}

// Every edge runs once each way, and no vertex lies inside an edge. Coordinates are small integers.
void expect_matching_edges(const PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t i = 0; i < 3; ++i) ++runs[{mesh.face(f)[i], mesh.face(f)[(i + 1) % 3]}];
    for (const auto& [edge, count] : runs) {
        const auto back = runs.find({edge.second, edge.first});
        ASSERT_TRUE(back != runs.end() && back->second == count);
        const auto& a = mesh.points[edge.first];
        const auto& b = mesh.points[edge.second];
        for (std::size_t p = 0; p < mesh.points.size(); ++p) {
            double along = 0;
            double length = 0;
            bool on_line = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t j = (k + 1) % 3;
                const auto& c = mesh.points[p];
                on_line = on_line && (c[k] - a[k]) * (b[j] - a[j]) == (c[j] - a[j]) * (b[k] - a[k]);
                along += (c[k] - a[k]) * (b[k] - a[k]);
                length += (b[k] - a[k]) * (b[k] - a[k]);
            }
            EXPECT_FALSE(on_line && along > 0 && along < length);
        }
    }
}

TEST(CoplanarFacetsOfAMesh, TwoCrossingBarsOfOneHeightHaveTwoSidesOfTwelveCorners) {
    const PolygonMesh mesh =
        evaluate(box({0, 1, 0}, {3, 2, 1}) | box({1, 0, 0}, {2, 3, 1})).to_mesh();
    EXPECT_EQ(mesh.face_count(), 2U * 10 + 12 * 2);
    EXPECT_EQ(mesh.points.size(), 24U);
    expect_matching_edges(mesh);
}

// Which facets the tree has looked at must not show.
TEST(CoplanarFacetsOfAMesh, FacetsThatNothingChangesStay) {
    const PolygonMesh mesh =
        evaluate(box({0, 0, 0}, {1, 2, 2}) | box({1, 0, 0}, {3, 2, 2})).to_mesh();
    EXPECT_EQ(mesh.face_count(), 20U);
    expect_matching_edges(mesh);
}

TEST(CoplanarFacetsOfAMesh, ASideWithASquareHoleHasEightTriangles) {
    const Solid drilled = evaluate(box({0, 0, 0}, {3, 3, 3}) - box({1, 1, -1}, {2, 2, 4}));
    const PolygonMesh mesh = drilled.to_mesh();
    EXPECT_EQ(mesh.face_count(), 2U * 8 + 4 * 2 + 4 * 2);
    EXPECT_EQ(mesh.points.size(), 16U);
    expect_matching_edges(mesh);
}

// A plate whose top has n by n squares; the other sides have the vertices that this needs.
Solid plate(int n) {
    PolygonMesh mesh;
    const auto at = [&](int i, int j, int k) {
        return static_cast<std::uint32_t>((k * (n + 1) + j) * (n + 1) + i);
    };
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) mesh.points.push_back({4.0 * i, 4.0 * j, 4.0 * k});
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.add_triangle(a, b, c);
        mesh.add_triangle(a, c, d);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            quad(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
            quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
        }
        quad(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1));
        quad(at(i + 1, n, 0), at(i, n, 0), at(i, n, 1), at(i + 1, n, 1));
        quad(at(0, i + 1, 0), at(0, i, 0), at(0, i, 1), at(0, i + 1, 1));
        quad(at(n, i, 0), at(n, i + 1, 0), at(n, i + 1, 1), at(n, i, 1));
    }
    return Solid::from_mesh(mesh);
}

TEST(CoplanarFacetsOfAMesh, WhatIsFarFromAPocketKeepsItsVertices) {
    const Solid pocket = evaluate(plate(12) - box({18, 18, 2}, {31, 31, 6}));
    const AssemblyStats stats = stats_of(pocket);
    EXPECT_GT(stats.whole_facets, 400U);
    EXPECT_GT(stats.joined_facets, 20U);
    const PolygonMesh mesh = pocket.to_mesh();
    expect_matching_edges(mesh);
    EXPECT_EQ(evaluate(box({0, 0, 0}, {48, 48, 4}) | pocket).to_mesh().points.size(), 8U);
}

// Planes that are outlined as a whole against facets that are put together one by one.
void expect_general_way_agrees(const Solid& solid) {
    PolygonMesh quick = trisect::detail::assemble_mesh(*trisect::detail::state_of(solid));
    PolygonMesh general =
        trisect::detail::assemble_mesh(*trisect::detail::state_of(solid), nullptr, false);
    EXPECT_EQ(quick.face_count(), general.face_count());
    expect_matching_edges(general);
    std::ranges::sort(quick.points);
    std::ranges::sort(general.points);
    EXPECT_EQ(quick.points, general.points);
}

TEST(PlanesAcrossAxes, AreOutlinedAsAWholeWhereAllTheirFacetsHaveChanged) {
    std::vector<Expression> bars;
    for (double i = 0; i < 4; ++i) {
        bars.emplace_back(box({0, 2 * i + 1, 1}, {9, 2 * i + 2, 2}));
        bars.emplace_back(box({2 * i + 1, 0, 1}, {2 * i + 2, 9, 2}));
    }
    const Solid grid = evaluate(Expression::any_of(bars));
    // The squares at the ends of bars stay as they are, two facets each.
    const AssemblyStats stats = stats_of(grid);
    EXPECT_EQ(stats.whole_facets, 16U * 2);
    EXPECT_EQ(stats.axis_facets, 8U * 8);
    EXPECT_EQ(stats.worked_facets, 8U * 8);
    const PolygonMesh mesh = grid.to_mesh();
    expect_matching_edges(mesh);
    // On each side 9 holes, 16 ends, 12 gaps between neighbouring ends and 4 inner corners.
    EXPECT_EQ(mesh.points.size(), 2U * (9 * 4 + 16 * 2 + 12 * 2 + 4));
    expect_general_way_agrees(grid);
}

TEST(PlanesAcrossAxes, FacetsThatMayBeUnchangedAreLeftOut) {
    const Solid stairs = evaluate(box({0, 0, 0}, {2, 2, 2}) | box({2, 0, 0}, {4, 2, 1}));
    EXPECT_EQ(stats_of(stairs).axis_facets, 2U);
    expect_general_way_agrees(stairs);
}

// Three layers of bars: every bar cuts through those of the two other directions.
Expression lattice_of_bars() {
    std::vector<Expression> along_x;
    std::vector<Expression> others;
    for (double i = 0; i < 3; ++i) {
        along_x.emplace_back(box({0, 10 * i + 2, 12}, {44, 10 * i + 9, 19}));
        others.emplace_back(box({10 * i + 3, 0, 14}, {10 * i + 8, 45, 17}));
    }
    others.emplace_back(box({1, 1, 15}, {43, 41, 16}));
    return Expression::any_of(along_x) - Expression::any_of(others);
}

TEST(PlanesAcrossAxes, NothingIsCutBeforeSomebodyAsks) {
    const Expression formula = lattice_of_bars();
    std::vector<PolygonMesh> meshes;
    for (const std::uint32_t leaf : {4U, 20U, 100000U}) {
        EvaluateOptions options;
        options.leaf_polygons = leaf;
        EvaluateStats counts;
        const Solid solid = evaluate(formula, options, &counts);
        EXPECT_TRUE(leaf != 100000U || counts.pieces == 0);
        const PolygonMesh& mesh = meshes.emplace_back(solid.to_mesh());
        expect_matching_edges(mesh);
        EXPECT_EQ(mesh, meshes[0]) << leaf;
        const Solid complement = evaluate(~Expression(solid));
        const PolygonMesh inside_out =
            trisect::detail::assemble_mesh(*trisect::detail::state_of(complement));
        expect_general_way_agrees(complement);
        // The first use of the facets cuts them.
        const Solid halved = evaluate(solid - box({5, 5, 5}, {30, 30, 15}));
        EXPECT_EQ(halved.to_mesh(), evaluate(formula - box({5, 5, 5}, {30, 30, 15})).to_mesh());
        expect_general_way_agrees(solid);
        EXPECT_EQ(solid.to_mesh(), mesh);
        EXPECT_EQ(trisect::detail::assemble_mesh(*trisect::detail::state_of(complement)),
                  inside_out);
    }
}

// Faces, edges and corners coincide all the time; or no two operands have a plane in common.
void random_boxes(int rounds, bool coincident) {
    std::mt19937 random(5);
    const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
    std::uint64_t outlined = 0;
    for (int round = 0; round < rounds; ++round) {
        std::vector<Expression> terms;
        for (int i = 0; i < 6; ++i) {
            trisect::Point3d low{below(5), below(5), below(5)};
            trisect::Point3d high{low[0] + 1 + below(4), low[1] + 1 + below(4),
                                  low[2] + 1 + below(4)};
            for (std::size_t k = 0; !coincident && k < 3; ++k) {
                low[k] = 6 * low[k] + i;
                high[k] = 6 * high[k] + i;
            }
            terms.emplace_back(box(low, high));
        }
        const Expression formula =
            (terms[0] | terms[1] | terms[2]) - (terms[3] & terms[4]) - terms[5];
        const Solid solid = evaluate(formula);
        const PolygonMesh first = solid.to_mesh();
        expect_matching_edges(first);
        expect_general_way_agrees(solid);
        outlined += stats_of(solid).axis_facets;
        for (const std::uint32_t leaf : {4U, 20U, 100000U}) {
            EvaluateOptions options;
            options.leaf_polygons = leaf;
            const trisect::detail::SplittingOffset offset(leaf == 4 ? 1 : 61);
            const Solid divided = evaluate(formula, options);
            const PolygonMesh other = divided.to_mesh();
            expect_matching_edges(other);
            expect_general_way_agrees(divided);
            EXPECT_TRUE(coincident || other == first) << round << ' ' << leaf;
        }
    }
    EXPECT_GT(outlined, 300U);
}

// Bars side by side along one axis, apart from each other, as one mesh.
Solid random_bars(std::mt19937& random) {
    const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
    const std::size_t along = random() % 3;
    PolygonMesh all;
    for (double at = below(3); at < 12; at += 2 + below(3)) {
        trisect::Point3d low;
        trisect::Point3d high;
        low[along] = -1 - below(2);
        high[along] = 12 + below(2);
        low[(along + 1) % 3] = at;
        high[(along + 1) % 3] = at + 1;
        low[(along + 2) % 3] = below(6);
        high[(along + 2) % 3] = 6 + below(6);
        append(all, make_box(low, high));
    }
    return Solid::from_mesh(all);
}

// Most facets are cut, and planes are outlined from pictures of leaves, parts of facets, or both.
TEST(PlanesAcrossAxes, RandomBarsMatch) {
    std::mt19937 random(9);
    std::uint64_t outlined = 0;
    for (int round = 0; round < 30; ++round) {
        const Expression a(random_bars(random));
        const Expression b(random_bars(random));
        const Expression c(random_bars(random));
        for (const Expression& formula : {a | b, (a & b) - c, a ^ b, (a | b | c) - (a & b & c)}) {
            for (const std::uint32_t leaf : {4U, 30U, 100000U}) {
                EvaluateOptions options;
                options.leaf_polygons = leaf;
                const Solid solid = evaluate(formula, options);
                const PolygonMesh mesh = solid.to_mesh();
                expect_matching_edges(mesh);
                outlined += stats_of(solid).axis_facets;
                expect_general_way_agrees(solid);
                EXPECT_EQ(solid.to_mesh(), mesh) << round << ' ' << leaf;
                expect_general_way_agrees(evaluate(~Expression(solid)));
            }
        }
    }
    EXPECT_GT(outlined, 10000U);
}

TEST(CoplanarFacetsOfAMesh, RandomBoxesOfAGridMatch) { random_boxes(40, true); }
TEST(CoplanarFacetsOfAMesh, RandomBoxesInGeneralPositionDoNotShowTheTree) {
    random_boxes(40, false);
}

TEST(AssemblyOrder, TrianglesDoNotDependOnTheTree) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 3));
    const Solid b = Solid::from_mesh(trisect::transformed(
        trisect::make_icosphere(1, 3), trisect::AffineMap::translation({0.5, 0.25, 0.125})));
    const Solid c = Solid::from_mesh(make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 2}));
    const Expression formula = (a | b) - c;
    const PolygonMesh first = evaluate(formula).to_mesh();
    for (const std::uint32_t leaf : {20U, 200U, 100000U}) {
        for (const std::uint32_t offset : {61U, 1U, 127U}) {
            EvaluateOptions options;
            options.leaf_polygons = leaf;
            const trisect::detail::SplittingOffset at(offset);
            EXPECT_EQ(evaluate(formula, options).to_mesh(), first) << leaf << ' ' << offset;
        }
    }
}

}  // namespace
