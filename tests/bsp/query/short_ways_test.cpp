// SPDX-License-Identifier: Apache-2.0
//
// The short ways of an index: taken, and with the same answers.

#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/query/index/index_counters.h>

#include "support/lattice_arithmetic.h"
#include "support/query_oracle.h"

namespace {

using trisect::BrepIndex;
using trisect::LatticeMesh;
using trisect::Location;
using trisect::Solid;
using trisect::detail::index_counters;
using trisect::detail::IndexCounters;

// A torus of n x 2n quadrangles on a lattice: convex, concave and saddle-shaped parts.
LatticeMesh torus(std::uint32_t n) {
    LatticeMesh mesh;
    const std::uint32_t m = 2 * n;
    const double pi = std::acos(-1.0);
    for (std::uint32_t i = 0; i < m; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const double a = 2 * pi * i / m;
            const double b = 2 * pi * j / n;
            const double r = 5000 + 2000 * std::cos(b);
            mesh.points.push_back({std::llround(r * std::cos(a)), std::llround(r * std::sin(a)),
                                   std::llround(2000 * std::sin(b))});
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % m * n + j % n; };
    for (std::uint32_t i = 0; i < m; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

// Points a little off the facets, and some exactly on corners.
std::vector<std::array<double, 3>> points_near(const LatticeMesh& mesh, std::uint64_t seed,
                                               std::size_t count) {
    brute::PointMaker make(mesh, seed);
    std::vector<std::array<double, 3>> out;
    for (std::size_t i = 0; i < count; ++i) {
        auto p = i % 10 == 0 ? make.corner() : make.on_face();
        if (i % 10 != 0)
            for (double& x : p) x += static_cast<double>(make.random().below(2001)) / 10.0 - 100;
        out.push_back(p);
    }
    return out;
}

Location brute_location(const brute::Boundary& boundary, const std::array<double, 3>& p) {
    return boundary.locate(brute::point(p)).location;
}

class Torus : public testing::Test {
protected:
    LatticeMesh mesh_ = torus(24);
    Solid solid_ = Solid::from_lattice_mesh(mesh_);
    brute::Boundary boundary_ = brute::Boundary::of_mesh(mesh_, solid_.source_id());
};

TEST_F(Torus, EveryWayIsTakenAndRight) {
    const BrepIndex index(solid_);
    const auto points = points_near(mesh_, 1, 4000);
    index_counters() = {};
    for (const auto& p : points) {
        ASSERT_EQ(index.locate(p).location, brute_location(boundary_, p))
            << p[0] << " " << p[1] << " " << p[2];
    }
    const IndexCounters c = index_counters();
    const std::uint64_t all = c.empty + c.side + c.region + c.corner + c.traced + c.exact + c.on;
    EXPECT_EQ(all, points.size());
    EXPECT_GT(c.empty, 0U);
    EXPECT_GT(c.side, all / 4);
    EXPECT_GT(c.corner, 0U);
    EXPECT_GT(c.traced, all / 5);
    EXPECT_GT(c.exact, 0U);
    EXPECT_LT(c.exact, all / 20);
    EXPECT_GE(c.on, all / 10);
}

TEST_F(Torus, ManyAtOnceAreWhereEachOneIs) {
    const auto points = points_near(mesh_, 2, 3000);
    const BrepIndex one(solid_);
    for (const unsigned threads : {1U, 4U}) {
        const BrepIndex index(solid_);  // divided by these threads
        std::vector<Location> found(points.size());
        index.classify(points, found, threads);
        const auto places = index.locate(points, threads);
        for (std::size_t i = 0; i < points.size(); ++i) {
            ASSERT_EQ(found[i], one.locate(points[i]).location);
            ASSERT_EQ(places[i], one.locate(points[i]));
        }
    }
}

TEST_F(Torus, CellsAreDividedByThoseWhoComeFirst) {
    const BrepIndex index(solid_);
    EXPECT_GT(index.stats().pending_cells, 0U);
    const auto points = points_near(mesh_, 3, 2000);
    std::vector<std::thread> threads;
    std::array<std::vector<Location>, 4> found;
    for (auto& f : found)
        threads.emplace_back([&] {
            for (const auto& p : points) f.push_back(index.locate(p).location);
        });
    for (std::thread& t : threads) t.join();
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const auto& f : found) ASSERT_EQ(f[i], brute_location(boundary_, points[i]));
    index.refine();
    EXPECT_EQ(index.stats().pending_cells, 0U);
    EXPECT_LT(index.stats().bytes_per_polygon, 200);
}

TEST_F(Torus, LightAnswersAreBoundsOfExactOnes) {
    const BrepIndex index(solid_);
    const auto points = points_near(mesh_, 4, 300);
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
        const auto bounds = index.distance(points[i]);
        const auto exact = boundary_.squared_distance(brute::point(points[i]));
        ASSERT_TRUE(bounds && exact);
        const brute::Rational lo(bounds->lo);
        const brute::Rational hi(bounds->hi);
        EXPECT_LE(lo * lo, *exact);
        EXPECT_GE(hi * hi, *exact);
        EXPECT_LE(bounds->hi - bounds->lo, 1e-6);
        const trisect::Segment segment{points[i], points[i + 1]};
        const auto hit = index.first_hit(segment);
        const auto facet = index.first_facet(segment);
        ASSERT_EQ(hit.has_value(), facet.has_value());
        if (!hit) continue;
        EXPECT_EQ(facet->face, hit->place.faces[0]);
        const brute::Rational t = brute::rational(hit->enter.exact());
        EXPECT_LE(brute::Rational(facet->lo), t);
        EXPECT_GE(brute::Rational(facet->hi), t);
    }
}

LatticeMesh moved(LatticeMesh mesh, std::int64_t by) {
    for (auto& p : mesh.points) {
        p.x = p.x + by;
        p.y = p.y + by / 3;
        p.z = p.z + by / 7;
    }
    return mesh;
}

// Results have splitters of their own tree, whose leaves list facets that go on behind them.
TEST_F(Torus, UnionOfTwoIsWhereOneOfThemIs) {
    const LatticeMesh other_mesh = moved(mesh_, 1777);
    const Solid other = Solid::from_lattice_mesh(other_mesh);
    solid_.refine();
    other.refine();
    const BrepIndex a(solid_);
    const BrepIndex b(other);
    const BrepIndex both(evaluate(trisect::Expression(solid_) | trisect::Expression(other)));
    const BrepIndex rest(evaluate(trisect::Expression(solid_) - trisect::Expression(other)));
    EXPECT_GT(both.stats().polygons, 3000U);
    auto points = points_near(mesh_, 5, 3000);
    const auto more = points_near(other_mesh, 6, 3000);
    points.insert(points.end(), more.begin(), more.end());
    std::vector<Location> many(points.size());
    both.classify(points, many);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Location in_a = a.locate(points[i]).location;
        const Location in_b = b.locate(points[i]).location;
        const Location in_both = both.locate(points[i]).location;
        ASSERT_EQ(many[i], in_both);
        if (in_a == Location::Inside || in_b == Location::Inside) {
            ASSERT_EQ(in_both, Location::Inside) << i;
        } else if (in_a == Location::Outside) {
            ASSERT_EQ(in_both, in_b) << i;
        } else if (in_b == Location::Outside) {
            ASSERT_EQ(in_both, in_a) << i;
        }
        const Location in_rest = rest.locate(points[i]).location;
        if (in_a == Location::Outside || in_b == Location::Inside) {
            ASSERT_EQ(in_rest, Location::Outside) << i;
        } else if (in_b == Location::Outside) {
            ASSERT_EQ(in_rest, in_a) << i;
        }
    }
}

TEST_F(Torus, FirstHitOfAUnionIsTheNearerOne) {
    const LatticeMesh other_mesh = moved(mesh_, 1777);
    const Solid other = Solid::from_lattice_mesh(other_mesh);
    const BrepIndex a(solid_);
    const BrepIndex b(other);
    const BrepIndex both(evaluate(trisect::Expression(solid_) | trisect::Expression(other)));
    const auto targets = points_near(mesh_, 7, 1500);
    for (std::size_t i = 0; i + 1 < targets.size(); ++i) {
        const auto& t = targets[i];
        const auto& d = targets[i + 1];
        const trisect::Ray ray{{t[0] - 20 * d[0], t[1] - 20 * d[1], t[2] - 20000}, {}};
        trisect::Ray to = ray;
        for (std::size_t k = 0; k < 3; ++k) to.direction[k] = t[k] - ray.origin[k];
        const auto in_a = a.first_hit(to);
        const auto in_b = b.first_hit(to);
        const auto in_both = both.first_hit(to);
        ASSERT_EQ(in_both.has_value(), in_a || in_b);
        if (!in_both) continue;
        const bool a_first = in_a && (!in_b || in_a->enter <= in_b->enter);
        EXPECT_EQ(in_both->enter, a_first ? in_a->enter : in_b->enter);
    }
}

}  // namespace
