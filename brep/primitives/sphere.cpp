// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/sphere.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/circle.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

class Icosphere {
public:
    Icosphere(double radius, std::uint32_t subdivisions) : radius_(radius) {
        constexpr double g = std::numbers::phi;
        for (const auto& p : std::array<Point3d, 12>{{{-1, g, 0},
                                                      {1, g, 0},
                                                      {-1, -g, 0},
                                                      {1, -g, 0},
                                                      {0, -1, g},
                                                      {0, 1, g},
                                                      {0, -1, -g},
                                                      {0, 1, -g},
                                                      {g, 0, -1},
                                                      {g, 0, 1},
                                                      {-g, 0, -1},
                                                      {-g, 0, 1}}})
            add_point(p);
        triangles_ = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
        for (std::uint32_t i = 0; i < subdivisions; ++i) subdivide();
    }
    PolygonMesh mesh() {
        for (const auto& t : triangles_) mesh_.add_triangle(t[0], t[1], t[2]);
        return std::move(mesh_);
    }

private:
    std::uint32_t add_point(const Point3d& p) {
        const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        Point3d q{};
        for (std::size_t i = 0; i < 3; ++i) q[i] = detail::snap(p[i] / length * radius_, radius_);
        mesh_.points.push_back(q);
        return static_cast<std::uint32_t>(mesh_.points.size() - 1);
    }
    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
        const auto [it, is_new] = middles_.try_emplace(key, 0);
        if (is_new) {
            const Point3d& p = mesh_.points[a];
            const Point3d& q = mesh_.points[b];
            it->second = add_point({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
        }
        return it->second;
    }
    void subdivide() {
        std::vector<std::array<std::uint32_t, 3>> finer;
        finer.reserve(4 * triangles_.size());
        middles_.clear();
        for (const auto& [a, b, c] : triangles_) {
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        triangles_ = std::move(finer);
    }

    double radius_;
    PolygonMesh mesh_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

}  // namespace

PolygonMesh make_icosphere(double radius, std::uint32_t subdivisions) {
    detail::require_positive(radius, "the radius of a sphere");
    detail::require_between(subdivisions, 0, 10, "the subdivisions of a sphere");
    return Icosphere(radius, subdivisions).mesh();
}

PolygonMesh make_uv_sphere(double radius, std::uint32_t slices, std::uint32_t stacks) {
    detail::require_positive(radius, "the radius of a sphere");
    detail::require_between(slices, 3, detail::segment_limit, "the slices of a sphere");
    detail::require_between(stacks, 2, detail::segment_limit, "the stacks of a sphere");
    if (std::uint64_t{slices} * stacks > (1U << 26))
        throw UsageError("a sphere of more than 2^27 triangles");
    PolygonMesh m;
    m.points.push_back({0, 0, -radius});
    for (std::uint32_t k = 1; k < stacks; ++k) {
        const double angle = std::numbers::pi * (static_cast<double>(k) / stacks - 0.5);
        const double z = detail::snap(radius * std::sin(angle), radius);
        for (const Point2d& p : detail::circle(radius * std::cos(angle), slices, radius))
            m.points.push_back({p[0], p[1], z});
    }
    m.points.push_back({0, 0, radius});
    const auto top = static_cast<std::uint32_t>(m.points.size() - 1);
    const auto at = [&](std::uint32_t k, std::uint32_t i) {  // ring k = 1 .. stacks - 1
        return 1 + (k - 1) * slices + i % slices;
    };
    for (std::uint32_t i = 0; i < slices; ++i) {
        m.add_triangle(0, at(1, i + 1), at(1, i));
        for (std::uint32_t k = 1; k + 1 < stacks; ++k) {
            m.add_triangle(at(k, i), at(k, i + 1), at(k + 1, i + 1));
            m.add_triangle(at(k, i), at(k + 1, i + 1), at(k + 1, i));
        }
        m.add_triangle(top, at(stacks - 1, i), at(stacks - 1, i + 1));
    }
    return m;
}

}  // namespace trisect
