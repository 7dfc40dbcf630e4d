// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/contact/graph_corners.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/manifold_mesh.h>

#include "support/mesh_builders.h"

namespace {

using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::detail::find_graph_corners;
using Corners = std::array<std::uint32_t, 3>;

std::size_t count(const std::vector<std::uint8_t>& flags) {
    std::size_t n = 0;
    for (const std::uint8_t f : flags) n += f;
    return n;
}

TEST(GraphCorners, ThoseOfSpheresAndBoxesAreGraphs) {
    const LatticeMesh sphere = trisect::import_mesh(trisect::make_icosphere(1, 3)).mesh;
    EXPECT_EQ(count(find_graph_corners(sphere.points, sphere.triangles, sphere.triangles)),
              sphere.points.size());
    const LatticeMesh box = trisect::import_mesh(trisect::test::cuboid()).mesh;
    EXPECT_EQ(count(find_graph_corners(box.points, box.triangles, box.triangles)), 8U);
}

// Corners are put anywhere near, on a coarse grid. Each pair around a graph's corner is compared.
TEST(GraphCorners, TrianglesAroundThemMeetInNothingElse) {
    std::mt19937 random(20261129);
    std::size_t graphs = 0;
    std::size_t others = 0;
    for (int round = 0; round < 60; ++round) {
        trisect::PolygonMesh dented = trisect::make_icosphere(16, 1);
        for (int n = 0; n < 12; ++n)
            for (double& c : dented.points[random() % dented.points.size()])
                c += (static_cast<double>(random() % 5) - 2) * (round % 2 == 0 ? 4 : 0.7);
        const LatticeMesh mesh = trisect::import_mesh(dented).mesh;
        if (!trisect::detail::ManifoldMesh::of(mesh.points, mesh.triangles)) continue;
        const auto is_graph = find_graph_corners(mesh.points, mesh.triangles, mesh.triangles);
        std::vector<std::vector<Corners>> around(mesh.points.size());
        for (const Corners& t : mesh.triangles)
            for (const std::uint32_t c : t) around[c].push_back(t);
        for (std::size_t v = 0; v < around.size(); ++v) {
            (is_graph[v] != 0 ? graphs : others) += 1;
            if (is_graph[v] == 0) continue;
            for (const Corners& a : around[v])
                for (const Corners& b : around[v])
                    EXPECT_EQ(trisect::detail::find_contact(mesh.points, a, b).kind,
                              trisect::detail::ContactKind::None);
        }
    }
    EXPECT_GT(graphs, 1000U);
    EXPECT_GT(others, 100U);
}

// Twice around the apex: all triangles are seen from above.
TEST(GraphCorners, AStarOfFivePointsGoesAroundTwice) {
    const std::vector<LatticePoint> points{{0, 10, 0},  {6, -8, 0}, {-10, 3, 0}, {10, 3, 0},
                                           {-6, -8, 0}, {0, 0, 9},  {0, 0, -9}};
    std::vector<Corners> triangles;
    // Each next one is two fifths of a turn further, counter-clockwise.
    const std::array<std::uint32_t, 5> around{0, 4, 3, 2, 1};
    for (std::size_t i = 0; i < 5; ++i) {
        triangles.push_back({around[i], around[(i + 1) % 5], 5});
        triangles.push_back({around[(i + 1) % 5], around[i], 6});
    }
    const auto is_graph = find_graph_corners(points, triangles, triangles);
    EXPECT_EQ(is_graph[5], 0);
    EXPECT_EQ(is_graph[6], 0);
    EXPECT_EQ(count(is_graph), 5U) << "around its points the star is an edge";
}

TEST(GraphCorners, AFoldedFanIsNone) {
    const std::vector<LatticePoint> points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 3, 8}};
    const std::vector<Corners> triangles{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    EXPECT_EQ(find_graph_corners(points, triangles, triangles)[4], 1);
    const std::vector<LatticePoint> folded{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {5, 1, 0}, {1, 3, 8}};
    EXPECT_EQ(find_graph_corners(folded, triangles, triangles)[4], 0);
}

}  // namespace
