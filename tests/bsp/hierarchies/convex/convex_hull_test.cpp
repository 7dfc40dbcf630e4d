// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/convex/convex_hull.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <trisect/kernel/predicates.h>

#include "support/convex_oracle.h"

namespace {

using convex_oracle::Engine;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::Side;
using trisect::hierarchies::convex_hull;
using trisect::hierarchies::ConvexPolytope;
using trisect::hierarchies::enclosing_hull;

LatticePoint any(Engine& engine, std::int64_t reach) {
    std::uniform_int_distribution<std::int64_t> d(-reach, reach);
    return {d(engine), d(engine), d(engine)};
}

// Euler, adjacency, planes, and that no point is outside.
void expect_hull(const ConvexPolytope& h, const std::vector<LatticePoint>& points) {
    ASSERT_EQ(h.dimension(), 3);
    EXPECT_EQ(h.vertices().size() + h.face_count(), h.edges().size() + 2);
    EXPECT_TRUE(std::is_sorted(h.vertices().begin(), h.vertices().end()));
    for (std::size_t f = 0; f < h.face_count(); ++f) {
        const std::set<std::uint32_t> corners(h.corners(f).begin(), h.corners(f).end());
        for (std::uint32_t v = 0; v < h.vertices().size(); ++v)
            EXPECT_EQ(side_of(h.vertices()[v], h.plane(f)),
                      corners.contains(v) ? Side::On : Side::Below);
    }
    for (const auto& e : h.edges())
        for (std::size_t i = 0; i < 2; ++i) {
            const auto corners = h.corners(e.face[i]);
            const auto at = [&](std::uint32_t v) {
                return std::find(corners.begin(), corners.end(), v) - corners.begin();
            };
            const auto n = static_cast<std::ptrdiff_t>(corners.size());
            ASSERT_LT(at(e.vertex[0]), n);
            EXPECT_EQ((at(e.vertex[i]) + 1) % n, at(e.vertex[1 - i]));
            ASSERT_LT(at(e.across[i]), n);
            EXPECT_NE(e.across[i], e.vertex[0]);
            EXPECT_NE(e.across[i], e.vertex[1]);
        }
    for (const LatticePoint& p : points) EXPECT_TRUE(h.contains(p));
    for (const LatticePoint& v : h.vertices())
        EXPECT_NE(std::find(points.begin(), points.end(), v), points.end());
}

TEST(ConvexHull, RandomPointsOfGridsOfAllSizes) {
    for (const std::int64_t reach : {std::int64_t{1}, std::int64_t{2}, std::int64_t{5},
                                     std::int64_t{1000}, (std::int64_t{1} << 52) - 1})
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            Engine engine(seed);
            std::vector<LatticePoint> points;
            for (std::uint64_t i = 0; i < 5 + 4 * seed; ++i) points.push_back(any(engine, reach));
            const ConvexPolytope h = convex_hull(points, {});
            if (h.dimension() == 3) expect_hull(h, points);
        }
}

TEST(ConvexHull, AllPointsOfACubeGridAreSixFaces) {
    std::vector<LatticePoint> points;
    for (int x = 0; x < 6; ++x)
        for (int y = 0; y < 6; ++y)
            for (int z = 0; z < 6; ++z) points.push_back({x, y, z});
    Engine engine(1);
    for (int i = 0; i < 20; ++i) {
        std::shuffle(points.begin(), points.end(), engine);
        const ConvexPolytope h = convex_hull(points, {});
        EXPECT_EQ(h.vertices().size(), 8U);
        EXPECT_EQ(h.edges().size(), 12U);
        EXPECT_EQ(h.face_count(), 6U);
        expect_hull(h, points);
    }
}

TEST(ConvexHull, IndependentOfOrderAndRepetition) {
    Engine engine(7);
    std::vector<LatticePoint> points;
    for (int i = 0; i < 60; ++i) points.push_back(any(engine, 3));
    const ConvexPolytope first = convex_hull(points, {});
    for (int i = 0; i < 10; ++i) {
        std::shuffle(points.begin(), points.end(), engine);
        points.push_back(points.front());
        const ConvexPolytope h = convex_hull(points, {});
        ASSERT_TRUE(std::ranges::equal(h.vertices(), first.vertices()));
        ASSERT_EQ(h.face_count(), first.face_count());
        for (std::size_t f = 0; f < h.face_count(); ++f)
            EXPECT_TRUE(std::ranges::equal(h.corners(f), first.corners(f)));
    }
}

TEST(ConvexHull, NothingAPointASegmentAndAPolygon) {
    EXPECT_TRUE(convex_hull({}, {}).is_empty());
    const std::vector<LatticePoint> point{{3, 4, 5}, {3, 4, 5}};
    EXPECT_EQ(convex_hull(point, {}).dimension(), 0);
    const std::vector<LatticePoint> line{{0, 0, 0}, {2, 4, 6}, {1, 2, 3}, {-1, -2, -3}};
    const ConvexPolytope segment = convex_hull(line, {});
    ASSERT_EQ(segment.dimension(), 1);
    EXPECT_EQ(segment.vertices()[0], (LatticePoint{-1, -2, -3}));
    EXPECT_EQ(segment.vertices()[1], (LatticePoint{2, 4, 6}));
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<LatticePoint> flat;
        for (int i = 0; i <= 3; ++i)
            for (int j = 0; j <= 3; ++j)
                flat.push_back(axis == 0   ? LatticePoint{i + j, i, j}
                               : axis == 1 ? LatticePoint{i, -i, j}
                                           : LatticePoint{i, j, 0});
        const ConvexPolytope polygon = convex_hull(flat, {});
        ASSERT_EQ(polygon.dimension(), 2);
        EXPECT_EQ(polygon.vertices().size(), 4U);
        EXPECT_EQ(polygon.edges().size(), 4U);
        ASSERT_EQ(polygon.face_count(), 2U);
        for (const LatticePoint& p : flat) {
            EXPECT_TRUE(polygon.contains(p));
            EXPECT_EQ(side_of(p, polygon.plane(0)), Side::On);
        }
        EXPECT_FALSE(polygon.contains({50, 50, 50}));
    }
}

TEST(ConvexHull, EnclosesPointsThatAreNamedByPlanes) {
    Engine engine(3);
    for (int i = 0; i < 50; ++i) {
        std::vector<Point> points;
        while (points.size() < 12) {
            const auto plane = [&] {
                for (;;) {
                    const LatticePoint a = any(engine, 50);
                    const LatticePoint b = any(engine, 50);
                    const LatticePoint c = any(engine, 50);
                    if (!trisect::are_collinear(a, b, c)) return Plane::through(a, b, c);
                }
            };
            const Plane p = plane();
            const Plane q = plane();
            const Plane r = plane();
            if (meet_in_a_point(p, q, r)) points.emplace_back(p, q, r);
        }
        const ConvexPolytope h = enclosing_hull(points, {});
        ASSERT_EQ(h.dimension(), 3);
        for (const Point& p : points)
            for (std::size_t f = 0; f < h.face_count(); ++f)
                EXPECT_NE(side_of(p, h.plane(f)), Side::Above);
    }
}

}  // namespace
