// SPDX-License-Identifier: Apache-2.0
//
// Queries along chains of operations. What was prepared for one version is kept for the next ones:
// answers must not depend on that, and what is prepared anew must be little.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::BrepIndex;
using trisect::Expression;
using trisect::Location;
using trisect::Place;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;

// On a grid so coarse that many things coincide.
PolygonMesh on_grid(PolygonMesh mesh, double step, const Point3d& by) {
    for (Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::round((p[k] + by[k]) / step) * step;
    return mesh;
}

Solid imported(const PolygonMesh& mesh) {
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Assume;
    return Solid::from_mesh(mesh, options);
}

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform(double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(engine_);
    }
    std::size_t below(std::size_t n) { return engine_() % n; }
    Point3d in_box(double half) {
        return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
    }
    Point3d on_sphere(double radius) {
        Point3d p{};
        double length = 0;
        do {
            p = in_box(1);
            length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        } while (length > 1 || length < 0.1);
        for (double& c : p) c *= radius / length;
        return p;
    }

private:
    std::mt19937_64 engine_;
};

constexpr double coarse = 0x1p-6;

struct Tool {
    Solid solid;
    std::size_t operation = 0;
};

Tool tool(Random& random) {
    const Point3d at = random.on_sphere(random.uniform(0.6, 1.1));
    const double size = random.uniform(0.1, 0.35);
    const PolygonMesh mesh =
        random.below(2) == 0
            ? on_grid(trisect::make_icosphere(size, 2), coarse, at)
            : on_grid(trisect::make_box({-size, -size, -size}, {size, size, size}), coarse, at);
    trisect::SolidOptions options;  // rounding may have folded it
    return {Solid::from_mesh(mesh, options), random.below(8)};
}

Solid applied(const Solid& stock, const Tool& t) {
    const Expression a(stock);
    const Expression b(t.solid);
    if (t.operation < 5) return evaluate(a - b);
    if (t.operation < 7) return evaluate(a | b);
    return evaluate(a ^ b);
}

std::vector<Point3d> points_of(const Solid& solid, Random& random, std::size_t count) {
    const PolygonMesh mesh = solid.to_mesh();
    std::vector<Point3d> out;
    for (std::size_t i = 0; i < count; ++i) {
        Point3d p = random.in_box(1.3);
        if (i % 3 != 0) p = mesh.points[random.below(mesh.points.size())];
        if (i % 3 == 2) {
            const Point3d& q = mesh.points[random.below(mesh.points.size())];
            for (std::size_t k = 0; k < 3; ++k) p[k] = 0.5 * (p[k] + q[k]);
        }
        out.push_back(p);
    }
    return out;
}

trisect::Ray ray_through(const Point3d& a, const Point3d& b) {
    return {a, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}};
}

// The same answers, names included where these are comparable.
void expect_same(const BrepIndex& a, const BrepIndex& b, const std::vector<Point3d>& points,
                 bool named) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Place p = a.locate(points[i]);
        const Place q = b.locate(points[i]);
        ASSERT_EQ(p.location, q.location);
        if (named) {
            ASSERT_EQ(p, q);
        }
        if (i % 4 == 0 && i + 1 < points.size() && points[i] != points[i + 1]) {
            const trisect::Ray ray = ray_through(points[i], points[i + 1]);
            const auto hits = a.all_hits(ray);
            const auto expected = b.all_hits(ray);
            ASSERT_EQ(hits.size(), expected.size());
            for (std::size_t h = 0; h < hits.size(); ++h) {
                ASSERT_EQ(hits[h].enter.exact(), expected[h].enter.exact());
                ASSERT_EQ(hits[h].leave.exact(), expected[h].leave.exact());
                ASSERT_EQ(hits[h].place.location, expected[h].place.location);
                if (named) {
                    ASSERT_EQ(hits[h].place, expected[h].place);
                }
            }
            const auto first = a.first_hit(ray);
            ASSERT_EQ(first.has_value(), !expected.empty());
            if (first) {
                ASSERT_EQ(first->enter.exact(), expected[0].enter.exact());
            }
        }
        if (i % 8 == 0) {
            const auto near = a.nearest(points[i]);
            const auto expected = b.nearest(points[i]);
            ASSERT_EQ(near.has_value(), expected.has_value());
            if (!near) continue;
            ASSERT_EQ(near->squared_distance, expected->squared_distance);
            ASSERT_EQ(near->point, expected->point);
            ASSERT_EQ(near->place.location, expected->place.location);
            if (named) {
                ASSERT_EQ(near->place, expected->place);
            }
            const auto bounds = a.distance(points[i]);
            ASSERT_LE(bounds->lo, near->distance * (1 + 1e-12));
            ASSERT_GE(bounds->hi, near->distance * (1 - 1e-12));
            // Mostly 1e-13; more where the nearest vertex is that of nearly parallel planes.
            ASSERT_LE(bounds->hi - bounds->lo, 1e-9);
        }
    }
}

TEST(QueriesOfChains, AnswersDoNotDependOnEarlierQueries) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Solid stock = imported(on_grid(trisect::make_icosphere(1, 4), 0x1p-10, {}));
        if (seed % 2 == 0) stock.refine();
        Solid warm = stock;  // has an index after every step
        Solid cold = stock;  // has one at the end only
        for (int step = 0; step < 10; ++step) {
            const Tool t = tool(random);
            warm = applied(warm, t);
            cold = applied(cold, t);
            if (warm.to_mesh().points.empty()) break;
            const BrepIndex index(warm);
            const auto points = points_of(warm, random, 60);
            for (const Point3d& p : points) (void)index.locate(p);
            (void)index.first_facet(ray_through(points[0], points[1]));
            (void)index.distance(points[2]);
        }
        const auto points = points_of(warm, random, 240);
        expect_same(BrepIndex(warm), BrepIndex(cold), points, true);
        if (HasFatalFailure()) return;
        // The same set as one leaf, from its boundary.
        const Solid whole = Solid::from_brep(warm.to_brep());
        expect_same(BrepIndex(warm), BrepIndex(whole), points, false);
        if (HasFatalFailure()) return;
        const BrepIndex complement(evaluate(~Expression(warm)));
        const BrepIndex index(warm);
        for (const Point3d& p : points) {
            const Location a = index.locate(p).location;
            const Location b = complement.locate(p).location;
            const bool off = a == Location::Inside || a == Location::Outside;
            ASSERT_EQ(off, b == Location::Inside || b == Location::Outside);
            if (off) {
                ASSERT_NE(a, b);
            }
            if (!off) {
                ASSERT_EQ(a, b);
            }
        }
    }
}

// Leaves that queries prepare after one small cut into a stock that was known before.
std::uint64_t leaves_after_cut(std::uint32_t level) {
    const Solid stock = imported(on_grid(trisect::make_icosphere(1, level), 0x1p-30, {}));
    stock.refine();
    BrepIndex(stock).refine();
    const double radius = std::sqrt(300.0 / (5 * std::pow(4.0, level)));
    const Point3d at{0.6, 0, 0.8};
    const Solid ball = imported(on_grid(trisect::make_icosphere(radius, 2), 0x1p-30, at));
    const BrepIndex index(evaluate(Expression(stock) - Expression(ball)));
    auto& counters = trisect::detail::index_counters();
    const std::uint64_t before = counters.leaves;
    EXPECT_EQ(index.locate(Point3d{-0.6, 0, -0.79}).location, Location::Inside);
    EXPECT_EQ(counters.leaves, before) << "far from the cut nothing is new";
    index.refine();
    return counters.leaves - before;
}

TEST(QueriesOfChains, ACutMakesFewLeavesNewInPartsOfAnySize) {
    const std::uint64_t of_20k = leaves_after_cut(5);
    const std::uint64_t of_330k = leaves_after_cut(7);
    EXPECT_GT(of_20k, 0U);
    EXPECT_LE(of_20k, 40U);
    EXPECT_LE(of_330k, 40U);
}

// An index that was made before its solid was refined, and one with handles that was made after.
TEST(QueriesOfChains, RefiningBetweenTwoIndicesMakesNoDifference) {
    for (const bool used_before : {false, true}) {
        const PolygonMesh mesh = on_grid(trisect::make_icosphere(1, 5), 0x1p-10, {});
        const Solid stock = imported(mesh);
        const BrepIndex before(stock);
        if (used_before) (void)before.locate(mesh.points[0]);
        stock.refine();
        const BrepIndex after = BrepIndex(stock).with_brep();
        for (std::size_t i = 0; i < mesh.points.size(); i += 100) {
            const Place plain = before.locate(mesh.points[i]);
            const Place named = after.locate(mesh.points[i]);
            ASSERT_EQ(plain.location, Location::OnVertex);
            ASSERT_EQ(named.location, Location::OnVertex);
            ASSERT_TRUE(named.vertex.is_valid());
            ASSERT_EQ(plain.faces, named.faces);
            ASSERT_EQ(plain.corner, named.corner);
        }
    }
}

TEST(QueriesOfChains, ThreadsMayUseAVersionThatWasJustMade) {
    Random random(5);
    Solid stock = imported(on_grid(trisect::make_icosphere(1, 5), 0x1p-10, {}));
    for (int step = 0; step < 6; ++step) {
        stock = applied(stock, {tool(random).solid, 0});
        const auto points = points_of(stock, random, 400);
        std::array<std::vector<Place>, 4> found;
        {
            std::vector<std::jthread> threads;
            for (auto& places : found)
                threads.emplace_back([&] {
                    const BrepIndex index(stock);
                    for (const Point3d& p : points) places.push_back(index.locate(p));
                });
        }
        for (const auto& places : found) ASSERT_EQ(places, found[0]);
        const BrepIndex whole(Solid::from_brep(stock.to_brep()));
        for (std::size_t i = 0; i < points.size(); ++i)
            ASSERT_EQ(found[0][i].location, whole.locate(points[i]).location);
    }
}

}  // namespace
