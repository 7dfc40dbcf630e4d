// SPDX-License-Identifier: Apache-2.0
//
// Volume, area and bounds from facets as assembly gathers them, against those of the exact mesh.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/measure/boundary_bounds.h>
#include <trisect/bsp/measure/enclosed_area.h>
#include <trisect/bsp/measure/enclosed_volume.h>

#include "support/random_result.h"
#include "support/solids.h"

namespace enclosures_test {
namespace {

using trisect::AffineMap;
using trisect::evaluate;
using trisect::ExactRational;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;
using namespace trisect::detail;

struct Found {
    bool volume = false;
    bool area = false;
};

Found expect_measures_of_the_mesh(const Solid& solid, const std::string& what) {
    SCOPED_TRACE(what);
    const SolidState& state = *state_of(solid);
    const trisect::ExactMesh mesh = assemble_exact_mesh(state);
    EXPECT_EQ(boundary_bounds(state), trisect::bounds(mesh));
    Found found;
    const EnclosedVolume volume = enclosed_volume(state);
    const ExactRational exact = trisect::exact_volume(mesh);
    EXPECT_LE(volume.least, exact);
    EXPECT_GE(volume.most, exact);
    found.volume =
        (volume.most - volume.least).to_double() <= 0x1p-60 * std::fabs(exact.to_double());
    if (const auto enclosed = enclosed_area(state)) {
        const trisect::Area area = trisect::area(mesh);
        EXPECT_EQ(area.exact.has_value(), enclosed->least == enclosed->most);
        EXPECT_EQ(area.exact.value_or(enclosed->least), enclosed->least);
        EXPECT_EQ(enclosed->least.to_double(), area.value);
        EXPECT_EQ(enclosed->most.to_double(), area.value);
        found.area = true;
    }
    return found;
}

void expect_found(const Solid& solid, const std::string& what) {
    const Found found = expect_measures_of_the_mesh(solid, what);
    EXPECT_TRUE(found.volume) << what;
    EXPECT_TRUE(found.area) << what;
}

PolygonMesh turned(const PolygonMesh& mesh, double degrees) {
    return trisect::transformed(mesh, AffineMap::rotation({1, 2, 3}, degrees));
}

PolygonMesh moved(const PolygonMesh& mesh, const trisect::Point3d& by) {
    return trisect::transformed(mesh, AffineMap::translation(by));
}

Solid of(const PolygonMesh& mesh) { return Solid::from_mesh(mesh); }

TEST(Enclosures, OfPairs) {
    const PolygonMesh ball = trisect::make_icosphere(1, 3);
    const PolygonMesh torus = trisect::make_torus(1, 0.4, 24, 12);
    const PolygonMesh block = turned(trisect::make_box({-1, -1, -1}, {0.5, 1, 1}), 17);
    const auto all = [](const PolygonMesh& a, const PolygonMesh& b, const std::string& what) {
        const Expression p = of(a);
        const Expression q = of(b);
        expect_found(evaluate(p | q), what + " union");
        expect_found(evaluate(p & q), what + " intersection");
        expect_found(evaluate(p - q), what + " difference");
        expect_found(evaluate(p ^ q), what + " xor");
    };
    all(ball, block, "ball and block");
    all(ball, moved(ball, {0.5, 0, 0}), "balls along an axis");
    all(ball, turned(moved(ball, {0.3, 0.2, 0.1}), 5), "balls");
    all(torus, turned(torus, 90), "tori");
    all(torus, moved(torus, {0.1, 0.2, 0}), "tori in a plane");
    all(moved(ball, {1e6, -2e6, 3e6}), moved(block, {1e6, -2e6, 3e6}), "far from the origin");
}

TEST(Enclosures, OfTinyAndHugeSolids) {
    for (const double scale : {1e-30, 1e-3, 1.0, 1e9, 1e30}) {
        const auto scaled = [&](const PolygonMesh& mesh) {
            return of(trisect::transformed(mesh, AffineMap::scaling({scale, scale, scale})));
        };
        const Expression ball = scaled(trisect::make_icosphere(1, 2));
        const Expression block = scaled(turned(trisect::make_box({0, 0, 0}, {2, 2, 2}), 30));
        expect_found(evaluate(ball - block), "scaled by " + std::to_string(scale));
    }
}

TEST(Enclosures, OfFlushAndTouchingSolids) {
    const Expression plate = of(trisect::make_box({-2, -2, 0}, {2, 2, 1}));
    const Expression bore = of(trisect::make_cylinder(0.5, 1, 31));
    const Expression boss = of(moved(trisect::make_cylinder(0.5, 1, 31), {0, 0, 1}));
    const Expression beside = of(trisect::make_box({2, -2, 0}, {4, 2, 1}));
    expect_found(evaluate(plate - bore), "bore");
    expect_found(evaluate(plate | boss), "boss");
    expect_found(evaluate((plate - bore) | boss | beside), "all");
    const Solid boxes = evaluate(plate | beside);
    const Found found = expect_measures_of_the_mesh(boxes, "boxes");
    EXPECT_TRUE(found.volume);
    EXPECT_TRUE(found.area) << "all facets are across axes";
    // Slopes of 3 to 4.
    const PolygonMesh slab = trisect::make_box({0, 0, 0}, {5, 5, 5});
    PolygonMesh sheared = slab;
    for (trisect::Point3d& p : sheared.points) p[0] = 4 * p[0] / 5 + 3 * p[2] / 4;
    EXPECT_FALSE(expect_measures_of_the_mesh(of(sheared), "sheared").area) << "it is rational";
    // An intersection that is a face, an edge or a vertex is none.
    EXPECT_FALSE(boundary_bounds(*state_of(evaluate(plate & beside))).has_value());
}

TEST(Enclosures, OfHalfSpaces) {
    const Expression ball = of(trisect::make_icosphere(1, 3));
    for (const std::array<double, 4>& plane :
         {std::array<double, 4>{0, 0, 1, 0.1}, {0, -1, 0, 0.3}, {1, 2, 3, 0.4}}) {
        const Solid part = evaluate(ball & Solid::half_space(plane));
        const Found found = expect_measures_of_the_mesh(part, "part");
        EXPECT_TRUE(found.volume);
        EXPECT_TRUE(found.area);
    }
}

TEST(Enclosures, OfManySolids) {
    std::vector<Expression> balls;
    for (int i = 0; i < 12; ++i)
        balls.emplace_back(
            of(turned(moved(trisect::make_icosphere(1, 2), {0.1 * i, 0.03 * i * i, 0}), 9.0 * i)));
    expect_found(evaluate(Expression::any_of(balls)), "union");
    expect_found(evaluate(Expression::all_of({balls[0], balls[1], balls[2]})), "intersection");
    expect_found(evaluate(balls[0] - Expression::any_of({balls[1], balls[3], balls[5]})), "less");
}

TEST(Enclosures, OfChainsAndCavities) {
    Solid block = of(trisect::make_box({-2, -2, -2}, {2, 2, 2}));
    block = evaluate(block - of(trisect::make_icosphere(1, 2)));
    expect_found(block, "a cavity");
    for (int i = 0; i < 8; ++i) {
        const PolygonMesh tool = moved(trisect::make_icosphere(0.4, 1), {0.5 * i - 2, 0.1, 2});
        block = evaluate(block - of(tool));
        expect_found(block, "step " + std::to_string(i));
    }
}

// What facets in special position leave may have no width. Not with others is there an irrational
// area: a result that is a box has an exact one.
TEST(Enclosures, OfAResultWhoseSlantedFacetsLeaveNothing) {
    const Solid box = brute::random_result(7977, 2 + 7977 % 5, false).solid;
    (void)expect_measures_of_the_mesh(box, "a box");
    EXPECT_EQ(trisect::area(assemble_exact_mesh(*state_of(box))).exact, ExactRational(446));
}

// Small integers, where everything coincides. Odd operands may meet themselves.
TEST(Enclosures, OfRandomFormulasOnASmallGrid) {
    int volumes = 0;
    int areas = 0;
    int results = 0;
    for (std::uint64_t seed = 0; seed < 160; ++seed) {
        const Solid solid = brute::random_result(seed, 4, false).solid;
        if (solid.is_empty() || !state_of(solid)->embedded) continue;
        const Found found = expect_measures_of_the_mesh(solid, std::to_string(seed));
        volumes += found.volume ? 1 : 0;
        areas += found.area ? 1 : 0;
        ++results;
    }
    EXPECT_GT(results, 80);
    EXPECT_EQ(volumes, results);
    EXPECT_GT(areas, results / 2);
}

}  // namespace
}  // namespace enclosures_test
