// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/bsp/interference/boxes/obb_walk.h>

#include "reference/random_solids.h"
#include "support/triangle_oracle.h"

namespace obb_walk_test {
namespace {

using brute::Triangle3;
using reference::Random;
using trisect::detail::ApproximateMap;
using trisect::detail::BoxedTriangles;
using trisect::detail::ObbTree;
using trisect::detail::ObbWalk;
using trisect::detail::PairVerdict;
using trisect::detail::Vector3;

struct Soup {
    std::vector<Vector3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    ObbTree tree;
    double largest = 0;

    explicit Soup(const trisect::PolygonMesh& mesh, std::uint32_t leaf = 1) {
        for (const auto& p : mesh.points) {
            positions.push_back(p);
            for (const double c : p) largest = std::max(largest, std::abs(c));
        }
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            const auto corners = mesh.face(f);
            for (std::size_t i = 2; i < corners.size(); ++i)
                triangles.push_back({corners[0], corners[i - 1], corners[i]});
        }
        tree = ObbTree(positions, 0, triangles, {leaf});
    }
    [[nodiscard]] BoxedTriangles boxed() const { return {&tree, &positions, 0, largest}; }
};

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

// Every pair that the walk leaves out is apart, every pair that it calls crossing crosses.
// Returns the number of pairs that meet.
std::size_t expect_right(const Soup& a, const Soup& b, const ApproximateMap& map) {
    Pairs crossing;
    Pairs unknown;
    ObbWalk::Stack stack;
    ObbWalk walk(a.boxed(), b.boxed(), map, stack);
    EXPECT_FALSE(walk.run([&](std::uint32_t i, std::uint32_t j, PairVerdict v) {
        EXPECT_TRUE((v == PairVerdict::Crossing ? crossing : unknown).insert({i, j}).second);
        return false;
    }));
    std::vector<Triangle3> p;
    std::vector<Triangle3> q;
    for (const auto& t : a.triangles)
        p.push_back({brute::exact(a.positions[t[0]]), brute::exact(a.positions[t[1]]),
                     brute::exact(a.positions[t[2]])});
    for (const auto& t : b.triangles) {
        Triangle3 moved;
        for (std::size_t i = 0; i < 3; ++i)
            moved[i] = brute::moved(map.m, map.t, brute::exact(b.positions[t[i]]));
        q.push_back(moved);
    }
    std::size_t meeting = 0;
    for (std::uint32_t i = 0; i < p.size(); ++i)
        for (std::uint32_t j = 0; j < q.size(); ++j) {
            const bool meets = brute::meet(p[i], q[j]);
            meeting += meets ? 1 : 0;
            if (crossing.count({i, j}) != 0) {
                EXPECT_TRUE(brute::cross(p[i], q[j]));
            } else if (unknown.count({i, j}) == 0) {
                EXPECT_FALSE(meets) << i << ' ' << j;
            }
        }
    return meeting;
}

// A rotation rounded to doubles.
ApproximateMap turned(Random& random, const Vector3& by) {
    const auto c = [&random] { return static_cast<double>(random.between(-1000, 1000)); };
    const auto f = trisect::detail::triangle_frame({0, 0, 0}, {c(), c(), c()}, {c(), c(), c()});
    ApproximateMap map;
    map.m = f.axis;
    map.t = by;
    return map;
}

TEST(ObbWalk, ToriInRandomPosesAgainstAllPairsInRationals) {
    const Soup torus(trisect::make_torus(1, 0.25, 12, 8));
    const Soup sphere(trisect::make_icosphere(0.5, 1), 3);
    Random random(21);
    std::size_t meeting = 0;
    for (int i = 0; i < 12; ++i) {
        const double x = 0.01 * static_cast<double>(random.between(0, 200));
        meeting += expect_right(torus, torus, turned(random, {x, 0.1, 0.05}));
        meeting += expect_right(torus, sphere, turned(random, {x, 0, 0}));
        meeting += expect_right(sphere, torus, turned(random, {x, 0, 0}));
    }
    EXPECT_GT(meeting, 1000U);
}

TEST(ObbWalk, BoxesThatShareFacesEdgesAndCorners) {
    const Soup a(trisect::make_box({0, 0, 0}, {2, 2, 2}));
    const Soup b(trisect::make_box({0, 0, 0}, {1, 2, 1}));
    for (int x = -2; x <= 3; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -1; z <= 2; ++z) {
                ApproximateMap map;
                map.t = {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
                (void)expect_right(a, b, map);
                map.m = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};  // a quarter turn
                (void)expect_right(a, b, map);
                map.m = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // a mirror
                (void)expect_right(a, b, map);
            }
}

TEST(ObbWalk, AffineMapsAndSolidsOfVeryDifferentSize) {
    const Soup torus(trisect::make_torus(1, 0.25, 10, 6));
    const Soup speck(trisect::make_icosphere(1, 0));
    Random random(22);
    std::size_t meeting = 0;
    for (int i = 0; i < 10; ++i) {
        ApproximateMap sheared = turned(random, {0.5, 0.25, 0});
        sheared.m[0][1] += 0.5;
        meeting += expect_right(torus, torus, sheared);
        const double scale = std::ldexp(1.0, -static_cast<int>(random.between(0, 40)));
        ApproximateMap small = turned(random, torus.positions[3]);
        for (auto& row : small.m)
            for (double& v : row) v *= scale;
        meeting += expect_right(torus, speck, small);
        ApproximateMap large = turned(random, {0, 0, 0});
        for (auto& row : large.m)
            for (double& v : row) v /= scale;
        (void)expect_right(torus, speck, large);
        ApproximateMap fit = turned(random, {0.5, 0, 0});
        for (auto& row : fit.m)
            for (double& v : row) v *= 0.75;
        meeting += expect_right(torus, speck, fit);
    }
    EXPECT_GT(meeting, 50U);
}

TEST(ObbWalk, LatticeFarFromTheOrigin) {
    Soup a(trisect::make_box({1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 1, 1e6 + 1}));
    ApproximateMap map;
    map.t = {1, 0, 0};
    EXPECT_GT(expect_right(a, a, map), 0U);
    map.t = {1.0000001, 0, 0};
    EXPECT_EQ(expect_right(a, a, map), 0U);
}

TEST(ObbWalk, StopsAtTheFirstCrossingAndCountsWhatItDid) {
    const Soup torus(trisect::make_torus(1, 0.25, 64, 32));
    ApproximateMap map;
    map.t = {0.75, 0.125, 0.03};
    ObbWalk::Stack stack;
    ObbWalk all(torus.boxed(), torus.boxed(), map, stack);
    EXPECT_FALSE(all.run([](auto, auto, PairVerdict) { return false; }));
    ObbWalk first(torus.boxed(), torus.boxed(), map, stack);
    EXPECT_TRUE(first.run([](auto, auto, PairVerdict v) { return v == PairVerdict::Crossing; }));
    EXPECT_EQ(first.counters().crossing, 1U);
    EXPECT_GT(all.counters().crossing, 20U);
    EXPECT_LT(10 * first.counters().node_tests, all.counters().node_tests);
    const auto& c = all.counters();
    EXPECT_EQ(c.triangle_pairs, c.apart + c.crossing + c.unknown);
    // Far fewer than all pairs are looked at.
    EXPECT_LT(c.triangle_pairs, 4096U * 4);
}

}  // namespace
}  // namespace obb_walk_test
