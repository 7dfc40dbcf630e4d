// SPDX-License-Identifier: Apache-2.0
//
// A surface over a flat bottom, which a point far below the bottom sees from behind all over.
//
// Project from that point to the plane of the bottom. Triangles of the bottom have one sense of
// rotation there and all others the other one, so each of both sheets covers the plane as often as
// its border turns around a place. Both have one border, the rim of the bottom; where it goes once
// around a point and nowhere back, that is once within and never beside it. So two triangles of
// one sheet share at most a border of both in the projection, and meet nowhere but in the corners
// and edges that they share. The sheets meet in the plane of the bottom alone, where the upper one
// has the rim and nothing else: that is looked at.

#include <trisect/brep/validate/manifold_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/number/ball_determinant.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

class HeightField {
public:
    using Triangle = ManifoldMesh::Triangle;

    HeightField(std::span<const LatticePoint> points, std::span<const Triangle> triangles)
        : points_(points), triangles_(triangles), bottom_(points[triangles[0][0]].z) {
        for (const Triangle& t : triangles_)
            for (const std::uint32_t v : t) bottom_ = std::min(bottom_, points_[v].z);
    }

    [[nodiscard]] bool is_height_field() {
        for (const Triangle& t : triangles_) list_rim(t);
        return !rim_.empty() && upper_has_rim_alone() && choose_eye() &&
               are_seen_as_they_should() && is_rim_around_eye();
    }

private:
    struct Edge {
        std::uint32_t from;
        std::uint32_t to;
    };

    [[nodiscard]] bool is_at_bottom(std::uint32_t v) const { return points_[v].z == bottom_; }
    [[nodiscard]] bool is_of_bottom(const Triangle& t) const {
        return is_at_bottom(t[0]) && is_at_bottom(t[1]) && is_at_bottom(t[2]);
    }

    // An edge between two triangles of the upper sheet comes in both directions, and one of them
    // goes back around the eye.
    void list_rim(const Triangle& t) {
        if (is_of_bottom(t)) return;
        for (std::size_t i = 0; i < 3; ++i)
            if (is_at_bottom(t[i]) && is_at_bottom(t[(i + 1) % 3]))
                rim_.push_back({t[i], t[(i + 1) % 3]});
    }
    [[nodiscard]] bool upper_has_rim_alone() const {
        std::vector<char> is_of_rim(points_.size(), 0);
        for (const Edge& e : rim_) is_of_rim[e.from] = 1;
        return std::ranges::all_of(triangles_, [&](const Triangle& t) {
            return is_of_bottom(t) || std::ranges::all_of(t, [&](std::uint32_t v) {
                       return !is_at_bottom(v) || is_of_rim[v] != 0;
                   });
        });
    }

    // Below the middle of the rim, and twice as deep as the planes of all triangles. Any point of
    // doubles below the bottom will do. None where a triangle plainly looks down.
    [[nodiscard]] bool choose_eye() {
        Vector3 sum{};
        for (const Edge& e : rim_) sum = plus(sum, points_[e.from].doubles());
        eye_ = scaled(sum, 1 / static_cast<double>(rim_.size()));
        eye_[2] = bottom_.to_double();
        double depth = 1;
        for (const Triangle& t : triangles_) {
            if (is_of_bottom(t)) continue;
            const auto [a, b, c] = corners(t);
            const Vector3 normal = cross(minus(b, a), minus(c, a));
            if (normal[2] < 0) return false;
            const double height = dot(normal, a);
            if (normal[2] > 0) depth = std::max(depth, -height / normal[2]);
        }
        eye_[2] -= 2 * depth;
        return std::isfinite(eye_[2]) && eye_[2] < bottom_.to_double();
    }

    [[nodiscard]] bool are_seen_as_they_should() const {
        return std::ranges::all_of(triangles_, [&](const Triangle& t) {
            const auto [a, b, c] = corners(t);
            return determinant(a, b, c).sign() == (is_of_bottom(t) ? -1 : 1);
        });
    }

    // Each edge turns to the left around the vertical through the eye, and one direction meets one.
    [[nodiscard]] bool is_rim_around_eye() const {
        constexpr Vector3 up{0, 0, 1};
        const auto [first, second] = ends(rim_[0]);
        const Vector3 direction = plus(scaled(first, 0.53), scaled(second, 0.47));
        int met = 0;
        for (const Edge& e : rim_) {
            const auto [a, b] = ends(e);
            if (determinant(a, b, up).sign() != 1) return false;
            const int before = determinant(a, direction, up).sign();
            const int after = determinant(direction, b, up).sign();
            if (before < 0 || after < 0) continue;
            if (before == 0 || after == 0 || ++met > 1) return false;
        }
        return met == 1;
    }

    [[nodiscard]] Vector3 seen(std::uint32_t v) const { return minus(points_[v].doubles(), eye_); }
    [[nodiscard]] std::array<Vector3, 2> ends(const Edge& e) const {
        return {seen(e.from), seen(e.to)};
    }
    [[nodiscard]] std::array<Vector3, 3> corners(const Triangle& t) const {
        return {seen(t[0]), seen(t[1]), seen(t[2])};
    }

    std::span<const LatticePoint> points_;
    std::span<const Triangle> triangles_;
    Coordinate bottom_;
    std::vector<Edge> rim_;
    Vector3 eye_{};
};

}  // namespace

bool ManifoldMesh::is_height_field() const {
    check_stop(triangles_.size());
    return HeightField(points_, triangles_).is_height_field();
}

}  // namespace trisect::detail
