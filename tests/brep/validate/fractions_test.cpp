// SPDX-License-Identifier: Apache-2.0
//
// Checks of meshes on coordinates with bits behind the point: the answers of the same doubles on a
// finer lattice.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/face/loop_triangulator.h>
#include <trisect/brep/import/line_balance.h>
#include <trisect/brep/import/volume_sign.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/kernel/error.h>

#include "support/fractions.h"

namespace {

using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::test::with_fractions;

constexpr std::array<int, 4> shifts{8, 24, 56, 70};

std::vector<LatticePoint> random_points(std::mt19937_64& random, std::size_t count,
                                        std::int64_t reach) {
    const auto c = [&] {
        return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * reach + 1)) -
               reach;
    };
    std::vector<LatticePoint> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({c(), c(), c()});
    return points;
}

std::vector<LatticePoint> with_fractions_all(std::vector<LatticePoint> points, int bits) {
    for (LatticePoint& p : points) p = with_fractions(p, bits);
    return points;
}

TEST(Fractions, KeepSignsOfVolumes) {
    std::mt19937_64 random(1);
    for (int round = 0; round < 200; ++round) {
        const auto points = random_points(random, 4, 3);
        const std::vector<std::array<std::uint32_t, 3>> faces{
            {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        const int expected = trisect::detail::volume_sign(points, faces);
        for (const int bits : shifts)
            ASSERT_EQ(trisect::detail::volume_sign(with_fractions_all(points, bits), faces),
                      expected);
    }
}

TEST(Fractions, KeepWhatCancels) {
    std::mt19937_64 random(2);
    for (int round = 0; round < 300; ++round) {
        const auto points = random_points(random, 12, 2);
        std::vector<trisect::detail::NetEdge> edges;
        for (int i = 0; i < 14; ++i) {
            const auto a = static_cast<std::uint32_t>(random() % points.size());
            const auto b = static_cast<std::uint32_t>(random() % points.size());
            if (points[a] == points[b]) continue;
            edges.push_back({a, b, random() % 2 == 0 ? 1 : -1});
        }
        const auto expected = trisect::detail::find_uncancelled(points, edges);
        for (const int bits : shifts)
            ASSERT_EQ(trisect::detail::find_uncancelled(with_fractions_all(points, bits), edges),
                      expected);
    }
}

TEST(Fractions, KeepContactsOfTriangles) {
    std::mt19937_64 random(3);
    int contacts = 0;
    for (int round = 0; round < 400; ++round) {
        const auto points = random_points(random, 6, 2);
        if (are_collinear(points[0], points[1], points[2]) ||
            are_collinear(points[3], points[4], points[5]))
            continue;
        const auto kind = [](const std::vector<LatticePoint>& p) {
            return trisect::detail::find_contact(p, {0, 1, 2}, {3, 4, 5}).kind;
        };
        const auto expected = kind(points);
        contacts += expected == trisect::detail::ContactKind::None ? 0 : 1;
        for (const int bits : shifts) ASSERT_EQ(kind(with_fractions_all(points, bits)), expected);
    }
    EXPECT_GT(contacts, 40);
}

TEST(Fractions, KeepTrianglesOfLoops) {
    std::mt19937_64 random(4);
    for (int round = 0; round < 100; ++round) {
        // A star around the origin, in a slanted plane.
        std::vector<LatticePoint> points;
        std::vector<std::uint32_t> loop;
        for (std::uint32_t i = 0; i < 9; ++i) {
            const double angle = 0.69 * i;
            const double r = 20 + static_cast<double>(random() % 60);
            const auto x = static_cast<std::int64_t>(r * std::cos(angle));
            const auto y = static_cast<std::int64_t>(r * std::sin(angle));
            points.push_back({x, y, x + 2 * y});
            loop.push_back(i);
        }
        const auto triangles = [&loop](const std::vector<LatticePoint>& p) {
            trisect::detail::LoopTriangulator t(p);
            std::vector<std::array<std::uint32_t, 3>> out;
            (void)t.triangulate(loop, out);
            return out;
        };
        const auto expected = triangles(points);
        for (const int bits : shifts)
            ASSERT_EQ(triangles(with_fractions_all(points, bits)), expected);
    }
}

TEST(Fractions, AreAddedExactlyOrNotAtAll) {
    const LatticeMesh mesh = trisect::import_mesh(trisect::make_icosphere(8, 1)).mesh;
    const LatticeMesh fine = with_fractions(mesh, 24);
    const LatticePoint by{3, -5, 7};
    EXPECT_EQ(translated(fine, with_fractions(by, 24)).points,
              with_fractions(translated(mesh, by), 24).points);
    const LatticePoint far{trisect::coordinate_limit / 2, 0, 0};
    EXPECT_THROW((void)translated(with_fractions(mesh, 70), far), trisect::LimitError);
}

}  // namespace
