// SPDX-License-Identifier: Apache-2.0
//
// Meshes between parallel half-spaces, without a tree and with one: the same set, the same mesh
// corner by corner, and what the counters say.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/stop_scope.h>

namespace {

using trisect::Diagnostics;
using trisect::evaluate;
using trisect::EvaluateCounters;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;

Solid below(double a, double b, double c, double d) { return Solid::half_space({a, b, c, d}); }

// A limit of work is counted by cells.
Solid evaluate_by_cells(const Expression& e) {
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});
    return evaluate(e);
}

// Evaluates without a tree, and expects what cells give.
void expect_one_cut(const Expression& e) {
    const Diagnostics<EvaluateCounters> diagnostics;
    const Solid solid = evaluate(e);
    EXPECT_EQ(diagnostics.counters().half_space_cuts, 1U);
    EXPECT_EQ(diagnostics.counters().cells, 0U);
    const PolygonMesh mesh = solid.to_mesh();
    const auto lazy = trisect::detail::state_of(solid)->lazy_tree();
    ASSERT_NE(lazy, nullptr);
    EXPECT_FALSE(lazy->is_cut());
    const Solid cells = evaluate_by_cells(e);
    EXPECT_EQ(trisect::detail::state_of(cells)->lazy_tree(), nullptr);
    const PolygonMesh expected = cells.to_mesh();
    EXPECT_EQ(mesh.corners, expected.corners);
    EXPECT_TRUE(mesh.points == expected.points);
    EXPECT_EQ(exact_volume(solid), exact_volume(cells));
    EXPECT_EQ(area(solid).value, area(cells).value);
    EXPECT_EQ(bounds(solid), bounds(cells));
    for (const bool maximal : {true, false}) {
        const auto brep = solid.to_brep({maximal});
        const auto wanted = cells.to_brep({maximal});
        EXPECT_EQ(brep.counts().faces, wanted.counts().faces);
        EXPECT_EQ(brep.counts().vertices, wanted.counts().vertices);
        EXPECT_EQ(exact_volume(brep), exact_volume(wanted));
    }
}

std::uint64_t cuts_of(const Expression& e) {
    const Diagnostics<EvaluateCounters> diagnostics;
    static_cast<void>(evaluate(e));
    return diagnostics.counters().half_space_cuts;
}

Solid sphere() { return Solid::from_mesh(trisect::make_icosphere(1, 3)); }

TEST(BetweenHalfSpaces, OnePlane) {
    const Solid s = sphere();
    const Solid h = below(1, 2, 3, -0.4);
    for (const Expression& e : {s & h, s - h, h & s, s & ~h, ~(~Expression(s) | h)})
        expect_one_cut(e);
    const Solid low = below(0, 0, 1, 0.3);
    for (const Expression& e : {s & low, s - low}) expect_one_cut(e);
}

TEST(BetweenHalfSpaces, Slabs) {
    const Solid s = sphere();
    for (int i = -4; i < 4; ++i) {
        const Solid upper = below(1, 2, 3, -0.77 * (i + 1));
        const Solid lower = below(-2, -4, -6, 2 * 0.77 * i);
        expect_one_cut(s & upper & lower);
        expect_one_cut((s & upper) - below(1, 2, 3, -0.77 * i));
    }
}

TEST(BetweenHalfSpaces, PlanesThatAreLooserThanOthers) {
    const Solid s = sphere();
    expect_one_cut(s & below(1, 2, 3, -0.4) & below(2, 4, 6, -1.1));
    expect_one_cut(s & below(1, 2, 3, -0.4) & below(1, 2, 3, 1.1));
    expect_one_cut(below(1, 2, 3, -100) & s & below(1, 2, 3, -0.4) & below(-1, -2, -3, -100));
}

// Two parts, one of which is beside the plane, and a cavity.
TEST(BetweenHalfSpaces, SeveralShells) {
    PolygonMesh mesh = trisect::make_icosphere(1, 2);
    PolygonMesh cavity = trisect::make_icosphere(0.5, 1);
    for (std::size_t f = 0; f < cavity.face_count(); ++f)
        std::swap(cavity.corners[3 * f], cavity.corners[3 * f + 1]);
    append(mesh, cavity);
    PolygonMesh other = trisect::make_icosphere(0.25, 1);
    for (auto& p : other.points) p[0] += 3;
    append(mesh, other);
    const Solid s = Solid::from_mesh(mesh);
    expect_one_cut(s & below(1, 2, 3, -0.1));
    expect_one_cut(s - below(1, 2, 3, -0.1));
    expect_one_cut(s & below(1, 0.125, 0, -3.03));
}

TEST(BetweenHalfSpaces, CoordinatesWithFractions) {
    PolygonMesh mesh = trisect::make_icosphere(1, 3);
    for (auto& p : mesh.points) p[0] += 1e-19 * p[1];
    mesh.points[0][1] += 1e-17;
    const Solid s = Solid::from_mesh(mesh);
    expect_one_cut(s & below(0.1, 0.2, 0.3, -0.04));
    expect_one_cut(s - below(0.1, 0.2, 0.3, 1e-18));
}

// Facets along an axis, which the grid of cells would take.
TEST(BetweenHalfSpaces, Boxes) {
    const Solid s = Solid::from_mesh(trisect::make_box({0, 0, 0}, {4, 4, 4}));
    expect_one_cut(s & below(0, 0, 1, -1));
    expect_one_cut(s & below(0, 0, 3, -4) & below(0, 0, -7, 2));
    expect_one_cut(s - below(1, 2, 3, -7.5));
}

TEST(BetweenHalfSpaces, LeftToTheTree) {
    const Solid s = sphere();
    const Solid h = below(1, 2, 3, -0.4);
    const Solid other = below(1, 2, -3, -0.4);
    const Solid cube = Solid::from_mesh(trisect::make_box({0, 0, 0}, {4, 4, 4}));
    EXPECT_EQ(cuts_of(s & h), 1U);
    EXPECT_EQ(cuts_of(s & h & other), 0U);                   // not parallel
    EXPECT_EQ(cuts_of(s & h & below(2, 4, 6, -0.8)), 0U);    // the same plane
    EXPECT_EQ(cuts_of(s & h & below(-1, -2, -3, 0.8)), 0U);  // nothing between
    EXPECT_EQ(cuts_of(s | h), 0U);                           // unbounded
    EXPECT_EQ(cuts_of(h - s), 0U);
    EXPECT_EQ(cuts_of(s ^ h), 0U);
    EXPECT_EQ(cuts_of(s & below(1, 2, 3, -40)), 0U);                // beside it
    EXPECT_EQ(cuts_of(cube & below(1, 1, 1, -4)), 0U);              // through corners
    EXPECT_EQ(cuts_of(cube & below(1, -1, 0, 0)), 0U);              // through edges
    EXPECT_EQ(cuts_of(evaluate(s & h) & below(1, 2, 3, 0.4)), 0U);  // a result
    EXPECT_EQ(cuts_of(s & cube & h), 0U);
    EXPECT_EQ(cuts_of(h & other), 0U);
}

TEST(BetweenHalfSpaces, AnyNumberOfThreads) {
    const Solid s = Solid::from_mesh(trisect::make_icosphere(1, 6));
    const Expression e = s & below(1, 2, 3, -0.4) & below(-1, -2, -3, 0.1);
    EvaluateOptions options;
    options.threads = 1;
    const PolygonMesh one = evaluate(e, options).to_mesh(1);
    options.threads = 3;
    const PolygonMesh three = evaluate(e, options).to_mesh(3);
    EXPECT_EQ(one.corners, three.corners);
    EXPECT_TRUE(one.points == three.points);
}

// Later steps and questions get a tree.
TEST(BetweenHalfSpaces, StepsAfterwards) {
    const Solid s = sphere();
    const Solid h = below(1, 2, 3, -0.4);
    const Solid other = below(3, -1, 0.5, 0.2);
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(0.7, 2));
    const Solid part = evaluate(s & h);
    EXPECT_EQ(exact_volume(evaluate(part & other)), exact_volume(evaluate_by_cells(s & h & other)));
    EXPECT_EQ(exact_volume(evaluate(part - ball)), exact_volume(evaluate_by_cells((s & h) - ball)));
    EXPECT_EQ(exact_volume(evaluate(part | (s - h))), exact_volume(s));
}

}  // namespace
