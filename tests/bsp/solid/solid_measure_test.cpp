// SPDX-License-Identifier: Apache-2.0
//
// Measures of solids against those of their B-reps, and what an unbounded set answers.

#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/measure/measure_counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

namespace solid_measure_test {
namespace {

using trisect::Bounds;
using trisect::evaluate;
using trisect::ExactRational;
using trisect::Solid;

Solid box(const trisect::Point3d& low, const trisect::Point3d& high) {
    return Solid::from_mesh(trisect::make_box(low, high));
}

Solid cut_ball() {
    const auto turn = trisect::AffineMap::rotation({1, 2, 3}, 17);
    const auto block = trisect::transformed(trisect::make_box({-1, -1, -1}, {0.5, 1, 1}), turn);
    return evaluate(Solid::from_mesh(trisect::make_icosphere(1, 3)) - Solid::from_mesh(block));
}

void expect_measures_of_the_brep(const Solid& s) {
    const trisect::Brep brep = s.to_brep();
    EXPECT_EQ(trisect::exact_volume(s), trisect::exact_volume(brep));
    EXPECT_EQ(trisect::volume(s), trisect::volume(brep));
    EXPECT_EQ(trisect::area(s).value, trisect::area(brep).value);
    EXPECT_EQ(trisect::exact_centroid(s), trisect::exact_centroid(brep));
    EXPECT_EQ(trisect::centroid(s), trisect::centroid(brep));
    EXPECT_EQ(trisect::bounds(s), trisect::bounds(brep));
}

TEST(SolidMeasure, OfAnImport) {
    const Solid s = box({0, 0, 0}, {1, 2, 3});
    EXPECT_EQ(trisect::exact_volume(s), ExactRational(6));
    EXPECT_EQ(trisect::volume(s), 6);
    EXPECT_EQ(trisect::area(s).exact, ExactRational(22));
    EXPECT_EQ(trisect::bounds(s), (Bounds{{0, 0, 0}, {1, 2, 3}}));
    EXPECT_EQ(trisect::centroid(s), (trisect::Point3d{0.5, 1, 1.5}));
    EXPECT_EQ(trisect::counts(s), (trisect::SolidCounts{8, 12}));
}

TEST(SolidMeasure, OfResultsOnAndOffTheLattice) {
    const Solid corner = evaluate(box({0, 0, 0}, {2, 2, 2}) - box({1, 1, 1}, {3, 3, 3}));
    EXPECT_EQ(trisect::volume(corner), 7);
    expect_measures_of_the_brep(corner);
    expect_measures_of_the_brep(cut_ball());
    const Solid bored =
        evaluate(box({-1, -1, 0}, {1, 1, 1}) - Solid::from_mesh(trisect::make_cylinder(0.5, 1, 7)));
    expect_measures_of_the_brep(bored);
}

// Sums over facets decide; the exact fraction of a volume and an area that may be rational take the
// exact mesh.
TEST(SolidMeasure, MostlyMakesNoExactMesh) {
    const Solid ball = cut_ball();
    const trisect::Diagnostics<trisect::detail::MeasureCounters> diagnostics;
    (void)trisect::volume(ball);
    (void)trisect::area(ball);
    EXPECT_EQ(diagnostics.counters().enclosed, 2U);
    EXPECT_EQ(diagnostics.counters().exact, 0U);
    (void)trisect::exact_volume(ball);
    EXPECT_EQ(diagnostics.counters().exact, 1U);
    (void)trisect::exact_volume(box({0, 0, 0}, {1, 2, 3}));
    (void)trisect::area(box({0, 0, 0}, {1, 2, 3}));
    EXPECT_EQ(diagnostics.counters().enclosed, 4U);
    EXPECT_EQ(diagnostics.counters().exact, 1U);
}

TEST(SolidMeasure, ABoundaryThatMeetsItselfIsResolved) {
    trisect::PolygonMesh both = trisect::make_box({0, 0, 0}, {2, 2, 2});
    const trisect::PolygonMesh other = trisect::make_box({1, 1, 1}, {3, 3, 3});
    append(both, other);
    const Solid s = Solid::from_mesh(both, {.import = {}, .embedding = trisect::Embedding::Check});
    EXPECT_EQ(trisect::volume(s), 15);
    EXPECT_EQ(trisect::bounds(s), (Bounds{{0, 0, 0}, {3, 3, 3}}));
}

TEST(SolidMeasure, OfSpecialSets) {
    EXPECT_EQ(trisect::volume(Solid()), 0);
    EXPECT_EQ(trisect::area(Solid()).value, 0);
    EXPECT_FALSE(trisect::bounds(Solid()).has_value());
    EXPECT_FALSE(trisect::centroid(Solid()).has_value());
    EXPECT_FALSE(trisect::bounds(Solid::whole_space()).has_value());
    EXPECT_THROW((void)trisect::volume(Solid::whole_space()), trisect::UnsupportedError);
    const Solid rest = evaluate(~box({0, 0, 0}, {1, 1, 1}));
    EXPECT_THROW((void)trisect::volume(rest), trisect::UnsupportedError);
    EXPECT_THROW((void)trisect::exact_volume(rest), trisect::UnsupportedError);
    EXPECT_EQ(trisect::area(rest).exact, ExactRational(6));
    const Solid half = Solid::half_space({0, 0, 1, 0});
    EXPECT_THROW((void)trisect::volume(half), trisect::UnsupportedError);
    EXPECT_THROW((void)trisect::bounds(half), trisect::UnsupportedError);
}

TEST(SolidMeasure, OfHalfSpacesAlone) {
    trisect::Expression cube = Solid::whole_space();
    for (int axis = 0; axis < 3; ++axis) {
        std::array<double, 4> plane{0, 0, 0, -0.1};
        plane[static_cast<std::size_t>(axis)] = 1;
        cube = cube & Solid::half_space(plane);
        plane[3] = 0;
        cube = cube - Solid::half_space(plane);
    }
    EXPECT_EQ(trisect::bounds(evaluate(cube)), (Bounds{{0, 0, 0}, {0.1, 0.1, 0.1}}));
    const ExactRational edge = ExactRational::from_double(0.1);
    EXPECT_EQ(trisect::exact_volume(evaluate(cube)), edge * edge * edge);
    EXPECT_THROW((void)trisect::volume(evaluate(~cube)), trisect::UnsupportedError);
}

TEST(SolidMesh, NamesTheFaceOfEachTriangle) {
    const Solid a = box({0, 0, 0}, {2, 2, 2});
    const Solid b = Solid::from_mesh(trisect::make_icosphere(1, 2));
    const Solid cut = evaluate(a - b);
    trisect::MeshMap map;
    const trisect::PolygonMesh mesh = cut.to_mesh(map);
    EXPECT_EQ(mesh, cut.to_mesh());
    ASSERT_EQ(map.source.size(), mesh.face_count());
    EXPECT_TRUE(map.face.empty());
    trisect::MeshMap of_brep;
    (void)trisect::to_polygon_mesh(cut.to_brep(), {}, &of_brep);
    const auto sorted = [](auto names) {
        std::ranges::sort(names);
        const auto rest = std::ranges::unique(names);
        names.erase(rest.begin(), rest.end());
        return names;
    };
    EXPECT_EQ(sorted(map.source), sorted(of_brep.source));
    // Every triangle lies in the plane of the face that it names: here, of a box.
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (map.source[f].operand != a.source_id()) continue;
        bool in_a_side = false;
        for (std::size_t k = 0; k < 3; ++k)
            for (const double side : {0.0, 2.0})
                in_a_side = in_a_side || std::ranges::all_of(mesh.face(f), [&](std::uint32_t v) {
                                return mesh.points[v][k] == side;
                            });
        EXPECT_TRUE(in_a_side);
    }
}

TEST(SolidMesh, IsTheExactOneRounded) {
    const Solid s = cut_ball();
    const trisect::ExactMesh exact = s.to_exact_mesh();
    const trisect::PolygonMesh mesh = s.to_mesh();
    ASSERT_EQ(exact.points.size(), mesh.points.size());
    ASSERT_EQ(exact.triangles.size(), mesh.face_count());
    ASSERT_EQ(exact.source.size(), mesh.face_count());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        const auto at = exact.points[v].nearest();
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(mesh.points[v][k], exact.lattice.to_double(at[k]));
    }
}

}  // namespace
}  // namespace solid_measure_test
