// SPDX-License-Identifier: Apache-2.0

#include "degenerate_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "shapes.h"

namespace bench {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr int ball_level = 6;  // of spheres: 81,920 triangles

// A sphere squeezed along two axes, turned so that no axis is special and moved along x so that its
// images under turns and mirrors about the origin's axes meet it.
PolygonMesh egg() {
    const Matrix squeezed{{{1, 0, 0}, {0, 0.75, 0}, {0, 0, 0.5}}};
    PolygonMesh mesh = shapes::moved(shapes::icosphere(ball_level), squeezed, {});
    return shapes::moved(mesh, shapes::rotation({1, 2, 3}, 37), {0.25, 0.125, 0.0625});
}

// The image under a map that takes axes to axes: exact.
PolygonMesh image(PolygonMesh mesh, const Matrix& m, bool mirror) {
    mesh = shapes::moved(std::move(mesh), m, {});
    if (mirror)
        for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3)
            std::swap(mesh.corners[i + 1], mesh.corners[i + 2]);
    return mesh;
}

// A closed surface around the z axis: rings of n points each, one after the other, with fans to the
// middles of the first and of the last one.
PolygonMesh lathe(std::size_t n, const std::vector<std::array<double, 2>>& rings, double turn = 0) {
    PolygonMesh mesh;
    for (const auto& [radius, z] : rings)
        for (std::size_t i = 0; i < n; ++i) {
            const double angle =
                2 * std::numbers::pi * (static_cast<double>(i) + turn) / static_cast<double>(n);
            mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
        }
    const auto low = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({0, 0, rings.front()[1]});
    mesh.points.push_back({0, 0, rings.back()[1]});
    const auto at = [n](std::size_t ring, std::size_t i) {
        return static_cast<std::uint32_t>(ring * n + i % n);
    };
    for (std::size_t i = 0; i < n; ++i) {
        mesh.add_triangle(low, at(0, i + 1), at(0, i));
        mesh.add_triangle(low + 1, at(rings.size() - 1, i), at(rings.size() - 1, i + 1));
        for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
            mesh.add_triangle(at(r, i), at(r, i + 1), at(r + 1, i + 1));
            mesh.add_triangle(at(r, i), at(r + 1, i + 1), at(r + 1, i));
        }
    }
    return mesh;
}

// Half a ball under or over the plane z = 0.
PolygonMesh half_ball(bool upper) {
    constexpr std::size_t n = 400;
    constexpr std::size_t rings = 100;
    std::vector<std::array<double, 2>> profile;
    for (std::size_t r = 0; r < rings; ++r) {
        const double angle = 0.5 * std::numbers::pi * static_cast<double>(r) / rings;
        profile.push_back({std::cos(angle), upper ? std::sin(angle) : -std::sin(angle)});
    }
    if (!upper) std::reverse(profile.begin(), profile.end());
    return lathe(n, profile);
}

// A can of straight sides with rings of facets, from z = low to high.
PolygonMesh can(double radius, double low, double high, std::size_t n, std::size_t rings,
                double turn = 0) {
    std::vector<std::array<double, 2>> profile;
    for (std::size_t r = 0; r <= rings; ++r)
        profile.push_back(
            {radius, low + (high - low) * static_cast<double>(r) / static_cast<double>(rings)});
    return lathe(n, profile, turn);
}

// A piece of hilly ground over the squares [column, column + 1] × [0, 1], down to z = -1.
PolygonMesh tile(int column) {
    constexpr int n = 198;
    PolygonMesh mesh;
    const auto height = [](double x, double y) {
        return 0.1 * std::sin(9 * x) * std::cos(7 * y) + 0.03 * std::sin(31 * x + 23 * y);
    };
    const auto point = [n](int i, int j, int layer) {
        return static_cast<std::uint32_t>((layer * (n + 1) + i) * (n + 1) + j);
    };
    for (int layer = 0; layer < 2; ++layer)
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j) {
                const double x = column + static_cast<double>(i) / n;
                const double y = static_cast<double>(j) / n;
                mesh.points.push_back({x, y, layer == 0 ? -1.0 : height(x, y)});
            }
    const auto square = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.add_triangle(a, b, c);
        mesh.add_triangle(a, c, d);
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            square(point(i, j, 1), point(i + 1, j, 1), point(i + 1, j + 1, 1), point(i, j + 1, 1));
            // A coarse bottom would have to be closed with the sides; a fine one is as the top.
            square(point(i, j, 0), point(i, j + 1, 0), point(i + 1, j + 1, 0), point(i + 1, j, 0));
        }
    for (int i = 0; i < n; ++i) {
        square(point(i, 0, 0), point(i + 1, 0, 0), point(i + 1, 0, 1), point(i, 0, 1));
        square(point(i + 1, n, 0), point(i, n, 0), point(i, n, 1), point(i + 1, n, 1));
        square(point(0, i + 1, 0), point(0, i, 0), point(0, i, 1), point(0, i + 1, 1));
        square(point(n, i, 0), point(n, i + 1, 0), point(n, i + 1, 1), point(n, i, 1));
    }
    return mesh;
}

PolygonMesh next_doubles(PolygonMesh mesh) {
    for (Point3d& p : mesh.points)
        for (double& x : p) x = std::nextafter(x, std::numeric_limits<double>::infinity());
    return mesh;
}

}  // namespace

std::optional<std::pair<PolygonMesh, PolygonMesh>> degenerate_pair(const std::string& name) {
    const PolygonMesh ball = shapes::icosphere(ball_level);
    if (name == "general") return std::pair(ball, shapes::moved(ball, shapes::along_1_2_3(0.5)));
    if (name == "x") return std::pair(ball, shapes::moved(ball, {0.5, 0, 0}));
    if (name == "y") return std::pair(ball, shapes::moved(ball, {0, 0.5, 0}));
    if (name == "z") return std::pair(ball, shapes::moved(ball, {0, 0, 0.5}));
    if (name == "mirror")
        return std::pair(egg(), image(egg(), {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, true));
    if (name == "turn90")
        return std::pair(egg(), image(egg(), {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, false));
    if (name == "turn180")
        return std::pair(egg(), image(egg(), {{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}, false));
    if (name == "ballturn90")
        return std::pair(ball, image(ball, {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, false));
    if (name == "self") return std::pair(ball, ball);
    if (name == "ulp") return std::pair(ball, next_doubles(ball));
    if (name == "halves") return std::pair(half_ball(true), half_ball(false));
    if (name == "tiles") return std::pair(tile(0), tile(1));
    if (name == "stack") return std::pair(can(1, 0, 1, 400, 99), can(1, 1, 2, 400, 99));
    if (name == "boss")
        return std::pair(tile(0), shapes::moved(can(0.25, -2, -1, 400, 99, 0.5), {0.5, 0.5, 0}));
    if (name == "slab")
        return std::pair(shapes::block({0, 0, 0}, {1, 1, 0.25}, 82),
                         shapes::moved(can(0.25, 0.25, 1, 400, 99, 0.5), {0.5, 0.5, 0}));
    return std::nullopt;
}

}  // namespace bench
