// SPDX-License-Identifier: Apache-2.0

#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/lattice_arithmetic.h"

namespace trisect::test {

namespace {

// Six times the volume of the tetrahedron o, a, b, c. For small coordinates.
std::int64_t det(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) +
           a.z * (b.x * c.y - b.y * c.x);
}

std::int64_t uniform(std::mt19937& random, int size) {
    return std::uniform_int_distribution<int>(0, size)(random);
}

LatticePoint random_point(std::mt19937& random, int size) {
    const std::int64_t x = uniform(random, size);
    const std::int64_t y = uniform(random, size);
    return {x, y, uniform(random, size)};
}

}  // namespace

LatticeMesh box(LatticePoint lo, LatticePoint hi) {
    LatticeMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back(
            {(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

LatticeMesh tetrahedron(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                        const LatticePoint& d) {
    LatticeMesh mesh;
    mesh.points = {a, b, c, d};
    if (det(b - a, c - a, d - a) < 0) std::swap(mesh.points[0], mesh.points[1]);
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return mesh;
}

LatticeMesh sphere(LatticePoint centre, double radius, int segments, int rings) {
    LatticeMesh mesh;
    const auto index = [](int i) { return static_cast<std::uint32_t>(i); };
    const auto add = [&](double x, double y, double z) {
        mesh.points.push_back(centre + LatticePoint{std::llround(radius * x),
                                                    std::llround(radius * y),
                                                    std::llround(radius * z)});
    };
    add(0, 0, -1);
    for (int r = 1; r <= rings; ++r)
        for (int s = 0; s < segments; ++s) {
            const double theta = std::numbers::pi * r / (rings + 1);
            const double phi = 2 * std::numbers::pi * s / segments;
            add(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta));
        }
    add(0, 0, 1);
    const int top = segments * rings + 1;
    const auto at = [&](int r, int s) { return index(1 + (r - 1) * segments + s % segments); };
    for (int s = 0; s < segments; ++s) {
        mesh.triangles.push_back({0, at(1, s + 1), at(1, s)});
        for (int r = 1; r < rings; ++r) {
            mesh.triangles.push_back({at(r, s), at(r, s + 1), at(r + 1, s + 1)});
            mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r + 1, s)});
        }
        mesh.triangles.push_back({at(rings, s), at(rings, s + 1), index(top)});
    }
    return mesh;
}

LatticeMesh joined(const LatticeMesh& a, const LatticeMesh& b) {
    LatticeMesh mesh = a;
    const auto shift = static_cast<std::uint32_t>(a.points.size());
    mesh.points.insert(mesh.points.end(), b.points.begin(), b.points.end());
    for (const auto& t : b.triangles)
        mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return mesh;
}

LatticeMesh turned_inside_out(LatticeMesh mesh) {
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    return mesh;
}

LatticeMesh random_tetrahedron(std::mt19937& random, int size) {
    while (true) {
        const LatticePoint a = random_point(random, size);
        const LatticePoint b = random_point(random, size);
        const LatticePoint c = random_point(random, size);
        const LatticePoint d = random_point(random, size);
        if (det(b - a, c - a, d - a) != 0) return tetrahedron(a, b, c, d);
    }
}

LatticeMesh random_box(std::mt19937& random, int size) {
    while (true) {
        const LatticePoint a = random_point(random, size);
        const LatticePoint b = random_point(random, size);
        if (a.x == b.x || a.y == b.y || a.z == b.z) continue;
        return box({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                   {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
    }
}

ExactRational volume(const LatticeMesh& mesh) {
    ExactRational six_volumes;
    for (const auto& t : mesh.triangles)
        six_volumes += ExactRational(det(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    return six_volumes / ExactRational(6);
}

}  // namespace trisect::test
