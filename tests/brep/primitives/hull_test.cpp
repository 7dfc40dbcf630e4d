// SPDX-License-Identifier: Apache-2.0
//
// Hulls of points in doubles: corners keep their doubles, and what is within is left out.
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {
namespace {

TEST(Hull, OfABoxWithPointsInsideIsTheBox) {
    std::vector<Point3d> points = make_box({2, 3, 4}).points;
    points.push_back({1, 1, 1});  // within
    points.push_back({1, 1, 0});  // in a face
    points.push_back({1, 0, 0});  // in an edge
    points.push_back({2, 3, 4});  // again
    const PolygonMesh hull = make_hull(points);
    EXPECT_EQ(hull.points.size(), 8U);
    EXPECT_EQ(hull.face_count(), 12U);
    EXPECT_EQ(exact_volume(import_mesh(hull).mesh), ExactRational(24));
}

TEST(Hull, KeepsDoublesAndIsConvex) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<Point3d> points;
    for (int i = 0; i < 200; ++i)
        points.push_back({number(random), number(random) / 3, 1e-3 * number(random)});
    const std::set<Point3d> given(points.begin(), points.end());
    const PolygonMesh hull = make_hull(points);
    for (const Point3d& p : hull.points) EXPECT_TRUE(given.contains(p));
    const ImportedMesh imported = import_mesh(hull);
    EXPECT_TRUE(imported.report.lattice.lossless);
    EXPECT_TRUE(is_convex(imported.mesh));
    // None of the points is outside.
    points.insert(points.end(), hull.points.begin(), hull.points.end());
    EXPECT_EQ(exact_volume(import_mesh(make_hull(points)).mesh), exact_volume(imported.mesh));
}

// Every point is a corner, and faces are many.
TEST(Hull, OfManyPointsOnASphere) {
    std::mt19937 random(8);
    std::normal_distribution<double> number;
    std::vector<Point3d> points;
    for (int i = 0; i < 3000; ++i) {
        Point3d p{number(random), number(random), number(random)};
        const double size = std::hypot(p[0], p[1], p[2]);
        for (double& c : p) c = std::round(c / size * 0x1p40) * 0x1p-40;
        points.push_back(p);
    }
    const PolygonMesh hull = make_hull(points);
    EXPECT_EQ(hull.points.size(), 3000U);
    EXPECT_EQ(hull.face_count(), 5996U);
    EXPECT_TRUE(is_convex(import_mesh(hull).mesh));
}

// Corners on two circles, points all over both caps: two faces of many corners.
TEST(Hull, OfAPrismWithFullCaps) {
    std::vector<Point3d> points;
    const PolygonMesh prism = make_cylinder(1, 2, 500);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> number(-0.7, 0.7);
    for (int i = 0; i < 5000; ++i)
        points.push_back({number(random), number(random), prism.points[i % 2 == 0 ? 0 : 999][2]});
    points.insert(points.end(), prism.points.begin(), prism.points.end());
    const ImportedMesh hull = import_mesh(make_hull(points));
    EXPECT_EQ(hull.mesh.points.size(), 1000U);
    EXPECT_EQ(exact_volume(hull.mesh), exact_volume(import_mesh(prism).mesh));
}

TEST(Hull, EndsWhereItsWorkIsSpent) {
    const std::vector<Point3d> points = make_uv_sphere(1, 64, 32).points;
    const StopScope scope({.max_work = 1000});
    EXPECT_THROW(static_cast<void>(make_hull(points)), LimitError);
}

TEST(Hull, RefusesWhatHasNone) {
    EXPECT_THROW(static_cast<void>(make_hull({})), UsageError);
    const std::vector<Point3d> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    EXPECT_THROW(static_cast<void>(make_hull(flat)), UsageError);
    std::vector<Point3d> wide{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    wide.push_back({1e30, 1e-30, 0});
    EXPECT_THROW(static_cast<void>(make_hull(wide)), LimitError);
    wide.back() = {std::numeric_limits<double>::infinity(), 0, 0};
    EXPECT_THROW(static_cast<void>(make_hull(wide)), LimitError);
}

}  // namespace
}  // namespace trisect
