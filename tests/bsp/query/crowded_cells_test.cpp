// SPDX-License-Identifier: Apache-2.0
//
// A spindle of 200 sides and a ball, small and far apart: cells of the index's grid are divided
// again and again, and those at the spindle's tips list more polygons than fit into one word.
// Against brute force.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/plane.h>

#include "support/query_oracle.h"

namespace {

using trisect::BrepIndex;
using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::Location;
using trisect::Solid;
using Vector = std::array<double, 3>;

constexpr std::uint32_t sides = 200;
constexpr std::uint32_t ball_sides = 48;
constexpr std::uint32_t ball_rings = 23;
constexpr std::int64_t radius = 100000;  // rounding leaves the rim convex
constexpr std::int64_t far = std::int64_t{1} << 22;

// A ball around a point of the diagonal, its corners in rings: two cones for a single one.
void add_ball(LatticeMesh& mesh, std::int64_t at, std::uint32_t corners, std::uint32_t rings) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const double pi = std::acos(-1.0);
    for (std::uint32_t r = 0; r < rings; ++r) {
        const double up = pi * (0.5 - (r + 1.0) / (rings + 1.0));
        for (std::uint32_t i = 0; i < corners; ++i) {
            const double around = 2 * pi * i / corners;
            mesh.points.push_back({at + std::llround(radius * std::cos(up) * std::cos(around)),
                                   at + std::llround(radius * std::cos(up) * std::sin(around)),
                                   at + std::llround(radius * std::sin(up))});
        }
    }
    const auto top = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({at, at, at + radius});
    mesh.points.push_back({at, at, at - radius});
    const auto corner = [&](std::uint32_t r, std::uint32_t i) {
        return first + r * corners + i % corners;
    };
    for (std::uint32_t i = 0; i < corners; ++i) {
        mesh.triangles.push_back({corner(0, i), corner(0, i + 1), top});
        mesh.triangles.push_back({corner(rings - 1, i + 1), corner(rings - 1, i), top + 1});
        for (std::uint32_t r = 1; r < rings; ++r) {
            mesh.triangles.push_back({corner(r, i), corner(r, i + 1), corner(r - 1, i)});
            mesh.triangles.push_back({corner(r - 1, i), corner(r, i + 1), corner(r - 1, i + 1)});
        }
    }
}

class SpindleAndBall : public testing::Test {
protected:
    SpindleAndBall() : solid_(Solid::from_lattice_mesh(mesh_)) {}

    static LatticeMesh two() {
        LatticeMesh mesh;
        add_ball(mesh, 0, sides, 1);
        add_ball(mesh, far, ball_sides, ball_rings);
        return mesh;
    }
    // Near one of the four tips, at every distance down to a fraction of a unit; some exactly
    // there, or right above or below it.
    Vector near_a_tip() {
        const double at = random_.chance(1, 2) ? 0.0 : static_cast<double>(far);
        Vector p{at, at, at + static_cast<double>(random_.chance(1, 2) ? radius : -radius)};
        const double reach = std::ldexp(1.0, static_cast<int>(random_.between(-8, 8)));
        const bool upright = random_.chance(1, 5);
        for (std::size_t k = upright ? 2 : 0; k < 3; ++k)
            p[k] += reach * static_cast<double>(random_.between(-16, 16)) / 16;
        return p;
    }
    Vector near() { return random_.chance(2, 3) ? near_a_tip() : make_.any(); }

    const LatticeMesh mesh_ = two();
    const Solid solid_;
    const brute::Boundary boundary_ = brute::Boundary::of_mesh(mesh_, solid_.source_id());
    brute::PointMaker make_{mesh_, 3};
    reference::Random random_{5};
};

TEST_F(SpindleAndBall, PointsAreWhereTheyAre) {
    const BrepIndex index(solid_);
    std::vector<Vector> points;
    for (int i = 0; i < 1200; ++i) points.push_back(near());
    std::vector<Location> many(points.size());
    BrepIndex(solid_).classify(points, many);
    const std::vector<trisect::Place> places = BrepIndex(solid_).locate(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector& p = points[i];
        const brute::Answer answer = boundary_.locate(brute::point(p));
        const trisect::Place place = index.locate(p);
        ASSERT_TRUE(brute::agrees(place, answer, true))
            << p[0] << " " << p[1] << " " << p[2] << ": " << brute::to_string(place)
            << " instead of " << brute::to_string(answer);
        ASSERT_EQ(places[i], place);
        ASSERT_EQ(many[i], place.location);
    }
    EXPECT_GE(index.stats().depth, 3U);
}

TEST_F(SpindleAndBall, RaysMeetWhatTheyMeet) {
    const BrepIndex index(solid_);
    for (int i = 0; i < 300; ++i) {
        const Vector from = near();
        Vector to = near();
        if (i % 3 == 0) to = {from[0], from[1], from[2] + (i % 2 == 0 ? 7 : -7)};
        if (from == to) continue;
        const brute::Point3 o = brute::point(from);
        const brute::Point3 e = brute::point(to);
        const auto expected = boundary_.hits(o, {e[0] - o[0], e[1] - o[1], e[2] - o[2]}, true);
        const auto hits = index.all_hits(trisect::Segment{from, to});
        ASSERT_EQ(hits.size(), expected.size()) << i;
        for (std::size_t k = 0; k < hits.size(); ++k) {
            EXPECT_EQ(brute::rational(hits[k].enter.exact()), expected[k].enter) << i;
            EXPECT_EQ(brute::rational(hits[k].leave.exact()), expected[k].leave) << i;
            EXPECT_TRUE(brute::agrees(hits[k].place, expected[k].answer, true)) << i;
        }
        const auto first = index.first_hit(trisect::Segment{from, to});
        ASSERT_EQ(first.has_value(), !expected.empty());
        if (first) {
            EXPECT_EQ(brute::rational(first->enter.exact()), expected[0].enter) << i;
        }
    }
}

TEST_F(SpindleAndBall, NearestPointsAreAsNearAsThat) {
    const BrepIndex index(solid_);
    for (int i = 0; i < 24; ++i) {
        const Vector p = near();
        const auto expected = boundary_.squared_distance(brute::point(p));
        const auto found = index.nearest(p);
        const auto bounds = index.distance(p);
        ASSERT_TRUE(found && bounds && expected);
        EXPECT_EQ(brute::rational(found->squared_distance), *expected) << i;
        EXPECT_LE(brute::Rational(bounds->lo) * brute::Rational(bounds->lo), *expected) << i;
        EXPECT_GE(brute::Rational(bounds->hi) * brute::Rational(bounds->hi), *expected) << i;
        const auto vertex = index.nearest_vertex(p);
        ASSERT_TRUE(vertex);
        EXPECT_LE(found->squared_distance, vertex->squared_distance);
    }
}

TEST_F(SpindleAndBall, BoxesListWhatReachesIntoThem) {
    const BrepIndex index = BrepIndex(solid_).with_brep();
    // Around a tip, around both spindles, in one of them, and between them.
    const auto tip = index.in_box({-1, -1, 99999}, {1, 1, 100001});
    EXPECT_EQ(tip.faces.size(), sides);
    EXPECT_EQ(tip.edge_ids.size(), sides);
    EXPECT_EQ(tip.vertex_ids.size(), 1U);
    const double end = static_cast<double>(far + radius);
    const auto all = index.in_box({-1e5, -1e5, -1e5}, {end, end, end});
    EXPECT_EQ(all.faces.size(), 2 * sides + 2 * ball_sides * ball_rings);
    EXPECT_EQ(all.vertex_ids.size(), sides + 2 + ball_sides * ball_rings + 2);
    EXPECT_TRUE(index.in_box({-1, -1, -1}, {1, 1, 1}).faces.empty());
    EXPECT_TRUE(index.in_box({5e5, 5e5, 5e5}, {9e5, 9e5, 9e5}).faces.empty());
    // Right below the tip the box is inside of all sides but those that it ends on.
    const auto corner = index.in_box({0, 0, 9e4}, {0, 0, 1e5});
    EXPECT_EQ(corner.vertex_ids.size(), 1U);
    EXPECT_EQ(corner.faces.size(), sides);
    // A cross section of one side: edges that pass through the box without a vertex in it.
    const auto rim = index.in_box({9e4, -5e3, 4e3}, {1e5, 5e3, 5e3});
    EXPECT_TRUE(rim.vertex_ids.empty());
    EXPECT_FALSE(rim.edge_ids.empty());
    EXPECT_LE(rim.edge_ids.size(), rim.face_ids.size() + 1);
}

TEST_F(SpindleAndBall, PlanesBetweenAndThroughThem) {
    const BrepIndex index(solid_);
    using trisect::Plane;
    using trisect::PlaneRelation;
    const auto level = [](std::int64_t z) {
        return Plane::through(LatticePoint{0, 0, z}, LatticePoint{1, 0, z}, LatticePoint{0, 1, z});
    };
    EXPECT_EQ(index.relation_to(level(far + radius + 1), {}), PlaneRelation::Below);
    EXPECT_EQ(index.relation_to(level(far + radius), {}), PlaneRelation::TouchingBelow);
    EXPECT_EQ(index.relation_to(level(far + radius - 1), {}), PlaneRelation::Straddling);
    EXPECT_EQ(index.relation_to(level(far / 2), {}), PlaneRelation::Straddling);
    EXPECT_EQ(index.relation_to(level(-radius), {}), PlaneRelation::TouchingAbove);
    EXPECT_EQ(index.relation_to(level(-radius - 1), {}), PlaneRelation::Above);
    EXPECT_TRUE(index.section(level(far / 2), {}).empty());
    for (const std::int64_t at : {std::int64_t{0}, far}) {
        const auto rim = index.section(level(at), {});
        ASSERT_EQ(rim.size(), 1U);
        EXPECT_EQ(rim[0].outer.points.size(), at == 0 ? sides : ball_sides);
        EXPECT_TRUE(rim[0].holes.empty());
        EXPECT_EQ(index.section(level(at + radius - 1), {}).size(), 1U);
    }
}

}  // namespace
