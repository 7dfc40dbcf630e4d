// SPDX-License-Identifier: Apache-2.0
//
// Many points at once, and points far from the boundary, in trees of many leaves: the same answers
// as one by one, and as in an index of one leaf.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/query/index/branch_block.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::BrepIndex;
using trisect::Expression;
using trisect::Location;
using trisect::Place;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::detail::IndexBase;

constexpr double grid = 0x1p-8;

using Engine = std::mt19937_64;

Point3d in_box(Engine& engine, double half) {
    std::uniform_real_distribution<double> c(-half, half);
    return {c(engine), c(engine), c(engine)};
}

// On a grid so coarse that many points lie on edges and faces.
PolygonMesh ball(double radius, const Point3d& at, int level) {
    PolygonMesh mesh = trisect::make_icosphere(radius, level);
    for (Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::round((p[k] + at[k]) / grid) * grid;
    return mesh;
}

Solid stock_after_cuts(int cuts, Engine& engine) {
    Solid stock = Solid::from_mesh(ball(1, {}, 4));
    stock.refine();
    for (int i = 0; i < cuts; ++i) {
        Point3d at = in_box(engine, 1);
        const double length = std::hypot(at[0], at[1], at[2]) + 0.01;
        for (double& c : at) c /= length;
        stock = evaluate(Expression(stock) - Expression(Solid::from_mesh(ball(0.25, at, 2))));
    }
    return stock;
}

// Doubles beside the walls of a tree, in user units.
std::vector<Point3d> beside_walls(const Solid& solid, Engine& engine) {
    std::vector<Point3d> out;
    const IndexBase base(solid);
    const double unit = std::ldexp(1.0, solid.lattice().exponent);
    std::vector<const trisect::detail::CellNode*> pending{base.root().node.get()};
    while (!pending.empty()) {
        const auto& n = trisect::detail::refined(*pending.back());
        pending.pop_back();
        if (n.is_leaf()) continue;
        const double wall = trisect::detail::rounded_position(n.splitter()) * unit;
        Point3d p = in_box(engine, 1.1);
        double& c = p[static_cast<std::size_t>(n.axis())];
        c = wall;
        out.push_back(p);
        for (const double away : {-2.0, 2.0}) {
            c = std::nextafter(wall, away);
            out.push_back(p);
        }
        for (int i = 0; i < 2; ++i) pending.push_back(n.child(i).node.get());
    }
    return out;
}

std::vector<Point3d> points_for(const Solid& solid, Engine& engine) {
    std::vector<Point3d> points = beside_walls(solid, engine);
    const PolygonMesh mesh = solid.to_mesh();
    const auto vertex = [&] { return mesh.points[engine() % mesh.points.size()]; };
    for (int i = 0; i < 1500; ++i) {
        Point3d p = vertex();
        points.push_back(p);
        const Point3d q = vertex();
        for (std::size_t k = 0; k < 3; ++k) p[k] = 0.5 * (p[k] + q[k]);
        points.push_back(p);
        points.push_back(in_box(engine, 1.3));
    }
    points.push_back({1e300, 0, 0});
    points.push_back({0, 1e-310, 0});
    return points;
}

// `same`: an index of the same solid; `whole`: one whose tree is a single leaf.
void expect_batches_as_one_by_one(const BrepIndex& index, const BrepIndex& same,
                                  const BrepIndex& whole, const std::vector<Point3d>& points) {
    std::vector<Place> expected;
    for (const Point3d& p : points) expected.push_back(same.locate(p));
    for (const unsigned threads : {1U, 4U, 0U}) {
        std::vector<Location> found(points.size());
        index.classify(points, found, threads);
        const std::vector<Place> places = index.locate(points, threads);
        for (std::size_t i = 0; i < points.size(); ++i) {
            ASSERT_EQ(found[i], expected[i].location) << i;
            ASSERT_EQ(places[i], expected[i]) << i;
            ASSERT_EQ(found[i], whole.locate(points[i]).location) << i;
        }
    }
}

TEST(Batches, InTreesOfManyLeavesAreAsOneByOne) {
    Engine engine(1);
    for (const int cuts : {0, 1, 12}) {
        const Solid stock = stock_after_cuts(cuts, engine);
        const auto points = points_for(stock, engine);
        const BrepIndex whole(Solid::from_brep(stock.to_brep()));
        // Without an index of any leaf, and with all of them.
        for (int again = 0; again < 2; ++again)
            expect_batches_as_one_by_one(BrepIndex(stock), BrepIndex(stock), whole, points);
        ASSERT_NE(IndexBase(stock).root_block(), nullptr);
    }
}

TEST(Batches, OfComplementsReadTheSameFacts) {
    Engine engine(2);
    const Solid stock = stock_after_cuts(8, engine);
    const Solid rest = evaluate(~Expression(stock));
    const auto points = points_for(stock, engine);
    const BrepIndex inside(stock);
    const BrepIndex outside(rest);
    std::vector<Location> in(points.size());
    std::vector<Location> out(points.size());
    for (int again = 0; again < 3; ++again) {
        inside.classify(points, in);
        outside.classify(points, out);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Location turned = in[i] == Location::Inside    ? Location::Outside
                                    : in[i] == Location::Outside ? Location::Inside
                                                                 : in[i];
            ASSERT_EQ(out[i], turned);
            ASSERT_EQ(outside.locate(points[i]).location, turned);
        }
    }
}

TEST(Batches, AFarPointHasTheSameAnswerHoweverOftenItsCellWasSeen) {
    Engine engine(3);
    const Solid stock = stock_after_cuts(6, engine);
    const BrepIndex whole(Solid::from_brep(stock.to_brep()));
    const BrepIndex index(stock);
    for (int i = 0; i < 20000; ++i) {
        const Point3d p = in_box(engine, 1.02);
        const Location expected = whole.locate(p).location;
        for (int again = 0; again < 2; ++again) ASSERT_EQ(index.locate(p).location, expected);
    }
}

// Shells within each other: cells that no polygon meets are on both sides of the boundary.
TEST(Batches, OfNestedShellsAreAsInOneLeaf) {
    Solid nested = Solid::from_mesh(ball(1, {}, 4));
    nested.refine();
    for (const double radius : {0.8, 0.6, 0.4, 0.2})
        nested = evaluate(Expression(nested) ^ Expression(Solid::from_mesh(ball(radius, {}, 3))));
    const BrepIndex whole(Solid::from_brep(nested.to_brep()));
    const BrepIndex index(nested);
    Engine engine(4);
    std::vector<Point3d> points;
    for (int i = 0; i < 60000; ++i) points.push_back(in_box(engine, 1.01));
    std::vector<Location> found(points.size());
    std::vector<Location> expected(points.size());
    whole.classify(points, expected);
    for (int again = 0; again < 3; ++again) {
        index.classify(points, found);
        ASSERT_EQ(found, expected);
    }
}

TEST(Batches, OfSeveralThreadsMayBeginTogether) {
    Engine engine(5);
    for (int round = 0; round < 4; ++round) {
        const Solid stock = stock_after_cuts(3, engine);
        const auto points = points_for(stock, engine);
        std::array<std::vector<Location>, 4> found;
        {
            std::vector<std::jthread> threads;
            for (auto& of_thread : found)
                threads.emplace_back([&] {
                    const BrepIndex index(stock);
                    of_thread.resize(points.size());
                    index.classify(points, of_thread, 1);
                    for (std::size_t i = 0; i < points.size(); i += 3)
                        if (index.locate(points[i]).location != of_thread[i])
                            of_thread[i] = Location::OnVertex;
                });
        }
        const BrepIndex whole(Solid::from_brep(stock.to_brep()));
        for (std::size_t i = 0; i < points.size(); ++i)
            for (const auto& of_thread : found)
                ASSERT_EQ(of_thread[i], whole.locate(points[i]).location);
    }
}

TEST(Batches, OfOneOrNoPoint) {
    Engine engine(6);
    const BrepIndex index(stock_after_cuts(1, engine));
    EXPECT_TRUE(index.locate(std::vector<Point3d>{}, 1).empty());
    EXPECT_EQ(index.locate(std::vector<Point3d>{{0, 0, 0}}, 1).at(0).location, Location::Inside);
    const std::vector<Point3d> bad{{0, std::numeric_limits<double>::quiet_NaN(), 0}};
    EXPECT_THROW((void)index.locate(bad, 1), trisect::UsageError);
}

}  // namespace
