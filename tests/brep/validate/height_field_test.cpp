// SPDX-License-Identifier: Apache-2.0
//
// Surfaces over a flat bottom, against validation, which compares all pairs.

#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/contact/embedding_counters.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/brep/validate/manifold_mesh.h>
#include <trisect/brep/validate/validate.h>

#include "support/mesh_builders.h"

namespace height_field_test {
namespace {

using trisect::Coordinate;
using trisect::LatticeMesh;
using trisect::PolygonMesh;

bool is_height_field(const LatticeMesh& mesh) {
    const auto manifold = trisect::detail::ManifoldMesh::of(mesh.points, mesh.triangles);
    return manifold && manifold->is_height_field();
}

bool is_height_field(const PolygonMesh& mesh) {
    return is_height_field(trisect::import_mesh(mesh).mesh);
}

// Cells of two triangles over a grid, walls, and a bottom around its middle.
PolygonMesh field(std::uint32_t n, const std::function<double()>& height) {
    PolygonMesh mesh;
    const auto at = [n](std::uint32_t x, std::uint32_t y) { return y * n + x; };
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) mesh.points.push_back({1.0 * x, 1.0 * y, height()});
    for (std::uint32_t y = 0; y + 1 < n; ++y)
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            mesh.add_triangle(at(x, y), at(x + 1, y), at(x + 1, y + 1));
            mesh.add_triangle(at(x, y), at(x + 1, y + 1), at(x, y + 1));
        }
    std::vector<std::uint32_t> border;
    for (std::uint32_t x = 0; x + 1 < n; ++x) border.push_back(at(x, 0));
    for (std::uint32_t y = 0; y + 1 < n; ++y) border.push_back(at(n - 1, y));
    for (std::uint32_t x = n - 1; x > 0; --x) border.push_back(at(x, n - 1));
    for (std::uint32_t y = n - 1; y > 0; --y) border.push_back(at(0, y));
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const auto sides = static_cast<std::uint32_t>(border.size());
    for (const std::uint32_t p : border)
        mesh.points.push_back({mesh.points[p][0], mesh.points[p][1], 0});
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({(n - 1) / 2.0, (n - 1) / 2.0, 0});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        mesh.add_triangle(first + i, first + j, border[j]);
        mesh.add_triangle(first + i, border[j], border[i]);
        mesh.add_triangle(first + j, first + i, middle);
    }
    return mesh;
}

TEST(HeightField, OfBoxesAndCliffs) {
    EXPECT_TRUE(is_height_field(trisect::make_box({1, 2, 3})));
    EXPECT_FALSE(is_height_field(trisect::make_torus(3, 1)));
    std::mt19937 random(20261129);
    const trisect::Diagnostics<trisect::detail::EmbeddingCounters> diagnostics;
    for (int round = 0; round < 20; ++round) {
        const PolygonMesh mesh = field(7, [&] { return random() % 2 == 0 ? 1.0 : 1000.0; });
        EXPECT_TRUE(trisect::is_embedded(trisect::import_mesh(mesh).mesh));
        EXPECT_TRUE(is_height_field(mesh)) << round;
        EXPECT_TRUE(trisect::validate(trisect::import_mesh(mesh).mesh).is_solid()) << round;
    }
    EXPECT_EQ(diagnostics.counters().height_fields, 20U);
    EXPECT_EQ(diagnostics.counters().compared, 0U);
}

TEST(HeightField, InsideOutUpsideDownAndTwoOfThemAreNone) {
    const PolygonMesh one = field(4, [] { return 1.5; });
    EXPECT_TRUE(is_height_field(one));
    EXPECT_FALSE(is_height_field(trisect::test::flipped(one)));
    PolygonMesh bumpy = field(4, [h = 1.0]() mutable { return h += 0.25; });
    EXPECT_TRUE(is_height_field(bumpy));
    bumpy = trisect::test::flipped(bumpy);
    for (auto& p : bumpy.points) p[2] = -p[2];
    EXPECT_FALSE(is_height_field(bumpy));
    EXPECT_FALSE(
        is_height_field(trisect::test::together(one, trisect::make_box({9, 9, 0}, {10, 10, 1}))));
    EXPECT_FALSE(is_height_field(trisect::test::together(one, one)));
}

// A valley that comes down to the bottom meets it in a point.
TEST(HeightField, AValleyAtTheBottomIsNone) {
    PolygonMesh mesh = field(5, [] { return 2.0; });
    mesh.points[12][2] = 0;
    mesh.points.back() = {1.75, 2.25, 0};
    EXPECT_FALSE(is_height_field(mesh));
    EXPECT_FALSE(trisect::is_embedded(trisect::import_mesh(mesh).mesh));
}

// A rim of two turns: each sheet covers the plane twice.
TEST(HeightField, TwiceAroundIsNone) {
    LatticeMesh mesh;
    const auto add = [&](double x, double y, double z) {
        mesh.points.push_back({Coordinate(x), Coordinate(y), Coordinate(z)});
    };
    const double ring[3][2] = {{10, 0}, {-5, 9}, {-5, -9}};
    for (int i = 0; i < 6; ++i) add(ring[i % 3][0], ring[i % 3][1], 0);
    add(0, 0, 8);
    add(0, 0, 0);
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.triangles.push_back({i, j, 6});
        mesh.triangles.push_back({j, i, 7});
    }
    EXPECT_FALSE(is_height_field(mesh));
}

// Where it says yes, all pairs of triangles say so, whatever was moved where.
TEST(HeightField, OfFieldsWithCornersMoved) {
    std::mt19937 random(20261130);
    int fields = 0;
    int others = 0;
    for (int round = 0; round < 3000; ++round) {
        const double unit = round % 3 == 0 ? 0.1 : 1;
        const auto n = static_cast<std::uint32_t>(2 + random() % 3);
        PolygonMesh mesh = field(n, [&] { return unit * static_cast<double>(1 + random() % 4); });
        for (auto k = random() % 4; k > 0; --k) {
            auto& p = mesh.points[random() % mesh.points.size()];
            p[random() % 3] = unit * static_cast<double>(random() % 5);
            if (random() % 4 == 0) p[2] = 0;
        }
        LatticeMesh moved;
        try {
            moved = trisect::import_mesh(mesh).mesh;
        } catch (const trisect::Error&) {
            continue;
        }
        if (is_height_field(moved)) {
            ++fields;
            const trisect::ValidationReport report = trisect::validate(moved);
            EXPECT_TRUE(report.is_solid()) << round << report.to_string();
            EXPECT_TRUE(trisect::is_embedded(moved)) << round;
        } else {
            ++others;
        }
    }
    EXPECT_GT(fields, 500);
    EXPECT_GT(others, 500);
}

}  // namespace
}  // namespace height_field_test
