// SPDX-License-Identifier: Apache-2.0
//
// Large meshes whose edges meet edges, whose corners lie on each other, or which have facets in
// common: they are not divided, and the result is that of the cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/stop_scope.h>

#include "engines.h"
#include "evaluate_stats.h"

namespace special_position_test {
namespace {

using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::test::EvaluateStats;

Solid solid(const PolygonMesh& mesh) {
    trisect::SolidOptions import;
    import.import.lattice = trisect::Lattice{-40};
    import.embedding = trisect::Embedding::Assume;
    return Solid::from_mesh(mesh, import);
}

// By cells: a limit of work is counted by them.
Solid divided(const Expression& expression) {
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});
    return trisect::evaluate(expression);
}

using Triangle = std::array<trisect::Point3d, 3>;

// By their places, whatever the corners are called: those of two meshes may have one place.
std::vector<Triangle> triangles_of(const PolygonMesh& mesh) {
    std::vector<Triangle> out;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        Triangle t;
        for (std::size_t k = 0; k < 3; ++k) t[k] = mesh.points[mesh.corners[i + k]];
        std::ranges::rotate(t, std::ranges::min_element(t));
        out.push_back(t);
    }
    std::ranges::sort(out);
    return out;
}

double volume_of(const PolygonMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles_of(mesh))
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    return sum / 6;
}

std::vector<trisect::Point3d> places_of(const PolygonMesh& mesh) {
    std::vector<trisect::Point3d> out;
    for (const std::uint32_t c : mesh.corners) out.push_back(mesh.points[c]);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

// Where facets of both cover a part of one plane, triangles may be others.
void expect_same_vertices(const PolygonMesh& mesh, const PolygonMesh& expected) {
    EXPECT_EQ(places_of(mesh), places_of(expected));
    EXPECT_NEAR(volume_of(mesh), volume_of(expected), 0x1p-40 * std::fabs(volume_of(expected)));
}

enum class Formulas { All, NoDifferences };
enum class Triangles { Same, MayDiffer };

// All operations on two meshes. Returns how many pairs took integers.
std::uint64_t expect_as_divided(const Solid& a, const Solid& b, Formulas which = Formulas::All,
                                Triangles triangles = Triangles::Same) {
    std::uint64_t doubtful = 0;
    const Expression p = a;
    const Expression q = b;
    std::vector<Expression> formulas{p | q, p & q, q | p};
    if (which == Formulas::All) formulas.insert(formulas.end(), {p - q, q - p});
    for (const Expression& e : formulas) {
        const Solid cells = divided(e);
        const PolygonMesh expected = engines::boundary_mesh(cells);
        PolygonMesh first;
        for (const std::uint32_t threads : {1U, 4U}) {
            trisect::EvaluateOptions options;
            options.threads = threads;
            EvaluateStats stats;
            const Solid result = evaluate(e, options, &stats);
            const auto tree = trisect::detail::state_of(result)->lazy_tree();
            EXPECT_NE(tree, nullptr);
            if (tree == nullptr) return 0;
            const PolygonMesh mesh = engines::boundary_mesh(result);
            EXPECT_FALSE(tree->is_cut());
            EXPECT_EQ(engines::open_edge(mesh), "");
            if (threads == 1) first = mesh;
            EXPECT_EQ(mesh.corners, first.corners);
            EXPECT_TRUE(mesh.points == first.points);
            if (triangles == Triangles::Same) {
                EXPECT_EQ(triangles_of(mesh), triangles_of(expected));
            }
            expect_same_vertices(mesh, expected);
            EXPECT_EQ(result.to_brep().counts(), cells.to_brep().counts());
            doubtful += stats.doubtful_pairs;
        }
    }
    return doubtful;
}

// What either has outside the other one, side by side.
bool is_undivided(const Expression& exclusive_or) {
    const Solid cells = divided(exclusive_or);
    EvaluateStats stats;
    const Solid result = trisect::test::evaluate(exclusive_or, {}, &stats);
    const auto tree = trisect::detail::state_of(result)->lazy_tree();
    const PolygonMesh mesh = engines::boundary_mesh(result);
    EXPECT_EQ(engines::open_edge(mesh), "");
    EXPECT_EQ(triangles_of(mesh), triangles_of(engines::boundary_mesh(cells)));
    EXPECT_EQ(result.to_brep().counts(), cells.to_brep().counts());
    return tree != nullptr && !tree->is_cut();
}

PolygonMesh sphere() { return trisect::make_icosphere(1, 4); }

PolygonMesh moved(PolygonMesh mesh, const std::array<double, 3>& by) {
    for (auto& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += by[k];
    return mesh;
}

TEST(SpecialPosition, AMeshMovedAlongAnAxis) {
    for (std::size_t k = 0; k < 3; ++k) {
        SCOPED_TRACE("axis " + std::to_string(k));
        std::array<double, 3> by{};
        by[k] = 0.5;
        EXPECT_GT(expect_as_divided(solid(sphere()), solid(moved(sphere(), by))), 100U);
    }
}

TEST(SpecialPosition, AMeshTurnedAboutItsOwnAxis) {
    PolygonMesh turned = sphere();
    for (auto& p : turned.points) p = {-p[1], p[0], p[2]};
    PolygonMesh egg = sphere();
    for (auto& p : egg.points) {
        p[2] *= 0.5;
        p[0] += 0.25 * p[1] + 0.25;
    }
    PolygonMesh turned_egg = egg;
    for (auto& p : turned_egg.points) p = {-p[0], -p[1], p[2]};
    (void)expect_as_divided(solid(egg), solid(turned_egg));
    EXPECT_GT(expect_as_divided(solid(sphere()), solid(turned), Formulas::NoDifferences), 0U);
}

// A lattice point up. Differences have no thickness in planes along the step on either side of the
// mesh, which no shift makes good: they are for the tree.
TEST(SpecialPosition, AMeshMovedByTheSmallestStep) {
    const double step = std::ldexp(1.0, -40);
    std::uint64_t doubtful = 0;
    for (const std::array<double, 3> by : {std::array{step, 0.0, 0.0}, {step, step, -step}})
        doubtful +=
            expect_as_divided(solid(sphere()), solid(moved(sphere(), by)), Formulas::NoDifferences);
    EXPECT_GT(doubtful, 1000U);
}

PolygonMesh mirrored(PolygonMesh mesh) {
    for (auto& p : mesh.points) p[0] = -p[0];
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
        std::swap(mesh.corners[i], mesh.corners[i + 1]);
    return mesh;
}

// Facets to be covered lie in the planes of facets to be uncovered: no one move of the mesh serves
// both, and no growth.
TEST(SpecialPosition, AMeshWithItsMirrorImage) {
    const PolygonMesh torus = trisect::make_torus(0.7, 0.3, 30, 15);
    // Nothing needs to be cut.
    EXPECT_EQ(expect_as_divided(solid(torus), solid(mirrored(torus)), Formulas::All,
                                Triangles::MayDiffer),
              0U);
    // Unless they cross somewhere.
    PolygonMesh bent = torus;
    bent.points[7] = {bent.points[7][0] * 0.75, bent.points[7][1] * 0.75, 0.125};
    EXPECT_GT(
        expect_as_divided(solid(bent), solid(mirrored(torus)), Formulas::All, Triangles::MayDiffer),
        1000U);
}

// With teeth that stand in each other's gaps.
TEST(SpecialPosition, Combs) {
    trisect::Outline outline{{0, 0}, {32, 0}};
    for (double x = 32; x > 0; x -= 2) {
        if (x < 32) outline.push_back({x, 2});
        outline.push_back({x, 8});
        outline.push_back({x - 1, 8});
        outline.push_back({x - 1, 2});
    }
    outline.push_back({0, 2});
    const PolygonMesh comb = trisect::make_prism(outline, 3);
    const auto whole = [](const PolygonMesh& mesh) { return Solid::from_mesh(mesh); };
    for (const std::array<double, 3> by : {std::array{1.0, 0.0, 0.0}, {1.0, 3.0, 0.0}}) {
        const Expression p = whole(comb);
        const Expression q = whole(moved(comb, by));
        for (const Expression& e : {p | q, p & q, p - q, q - p, ~p | q})
            EXPECT_EQ(engines::undivided_difference(e, {}), "");
    }
}

// Not the same arrays, which would be one solid.
TEST(SpecialPosition, AMeshWithItself) {
    PolygonMesh again = sphere();
    std::ranges::rotate(again.corners, again.corners.begin() + 300);
    EXPECT_EQ(expect_as_divided(solid(sphere()), solid(again)), 0U);
}

// All facets but a few around one corner are the same.
TEST(SpecialPosition, AMeshWithADent) {
    PolygonMesh dented = sphere();
    for (double& x : dented.points[100]) x *= 0.75;
    EXPECT_EQ(expect_as_divided(solid(sphere()), solid(dented), Formulas::NoDifferences), 0U);
    PolygonMesh bulged = sphere();
    for (double& x : bulged.points[100]) x *= 1.25;
    EXPECT_EQ(expect_as_divided(solid(dented), solid(bulged)), 0U);
    EXPECT_EQ(expect_as_divided(solid(sphere()), solid(bulged)), 0U);
}

// The halves of a sphere, as a fan on both sides or on one side otherwise.
PolygonMesh half_ball(bool upper, std::uint32_t middle) {
    constexpr std::uint32_t n = 40;
    constexpr std::uint32_t rings = 20;
    PolygonMesh mesh;
    for (std::uint32_t r = 0; r < rings; ++r)
        for (std::uint32_t i = 0; i < n; ++i) {
            const double up = 1.5 * r / rings;
            const double around = 6.283185307179586 * i / n;
            mesh.points.push_back({std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                                   upper ? std::sin(up) : -std::sin(up)});
        }
    const std::uint32_t top = n * rings;
    mesh.points.push_back({0, 0, upper ? 1.0 : -1.0});
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (upper) {
            mesh.add_triangle(a, b, c);
        } else {
            mesh.add_triangle(a, c, b);
        }
    };
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        for (std::uint32_t r = 0; r + 1 < rings; ++r) {
            add(n * r + i, n * r + j, n * (r + 1) + j);
            add(n * r + i, n * (r + 1) + j, n * (r + 1) + i);
        }
        add(n * (rings - 1) + i, n * (rings - 1) + j, top);
        // The cut: a fan about one of its corners.
        if (i != middle && j != middle) add(middle, j, i);
    }
    return mesh;
}

// A lower half and an upper one that lie across each other: in the middle a face looks up and
// another one down, and no move of their common corner takes both outwards. With a ball above them:
// what is all across the axes would be a grid.
Solid crossed_halves(double x, double y) {
    const Expression lower = solid(trisect::make_box({x - 2, y - 2, -2}, {x, y + 2, 0}));
    const Expression upper = solid(trisect::make_box({x - 2, y - 2, 0}, {x + 2, y, 2}));
    const Expression ball = solid(moved(trisect::make_icosphere(0.125, 0), {x, y, 5}));
    return solid(evaluate(lower | upper | ball).to_mesh());
}

TEST(SpecialPosition, MeshesThatNoMoveServes) {
    const Solid a = crossed_halves(0, 0);
    const Solid b = crossed_halves(0.5, 0.5);
    EXPECT_GT(expect_as_divided(a, b, Formulas::All, Triangles::MayDiffer), 0);
    const auto may_have_sheets = [](const Expression& e) {
        return std::get<trisect::detail::UndividedMeshes>(
                   trisect::detail::state_of(trisect::evaluate(e))->form)
            .may_have_sheets;
    };
    EXPECT_TRUE(may_have_sheets(Expression(a) - b));
    EXPECT_TRUE(may_have_sheets(Expression(b) - a));
    EXPECT_FALSE(may_have_sheets(Expression(a) | b));
}

TEST(SpecialPosition, ExclusiveOrs) {
    const Expression a = solid(sphere());
    PolygonMesh turned = sphere();
    for (auto& p : turned.points) p = {-p[1], p[0], p[2]};
    PolygonMesh dented = sphere();
    for (double& x : dented.points[100]) x *= 0.75;
    // In general position, apart, along an axis, across each other all over, and all but the same.
    EXPECT_TRUE(is_undivided(a ^ solid(moved(sphere(), {0.31, 0.17, 0.23}))));
    EXPECT_TRUE(is_undivided(a ^ solid(moved(sphere(), {3, 0, 0}))));
    EXPECT_TRUE(is_undivided(a ^ solid(moved(sphere(), {0.5, 0, 0}))));
    EXPECT_TRUE(is_undivided(a ^ solid(turned)));
    EXPECT_TRUE(is_undivided(a ^ solid(dented)));
    EXPECT_TRUE(is_undivided(~a ^ solid(moved(sphere(), {0.31, 0.17, 0.23}))));
    EXPECT_TRUE(is_undivided(~(a ^ solid(moved(sphere(), {0.5, 0, 0})))));
    // Facets of opposite sides are none of the result's.
    const Expression half = solid(half_ball(true, 0));
    for (const std::uint32_t middle : {0U, 7U}) {
        const Expression both = half ^ solid(half_ball(false, middle));
        EXPECT_TRUE(is_undivided(both));
        EXPECT_EQ(engines::undivided_difference(both, {}), "");
    }
}

TEST(SpecialPosition, HalvesOfACutReunited) {
    (void)expect_as_divided(solid(half_ball(true, 0)), solid(half_ball(false, 0)));
    (void)expect_as_divided(solid(half_ball(true, 0)), solid(half_ball(false, 7)));
}

}  // namespace
}  // namespace special_position_test
