// SPDX-License-Identifier: Apache-2.0
//
// Hulls of points in doubles: corners keep their doubles, and what is within is left out.
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/kernel/error.h>

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
