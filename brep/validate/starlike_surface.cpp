// SPDX-License-Identifier: Apache-2.0
//
// A closed surface whose triangles all turn their front away from a point covers the sphere of
// directions from there without folds, everywhere equally often. Where one direction meets one
// triangle, each does: directions map the surface to the sphere one to one, and no two triangles
// meet beyond the corners and edges that they share.
//
// Boundaries of convex solids whose corners were rounded are such surfaces, though their faces are
// neither flat nor convex any more.

#include <trisect/brep/validate/manifold_mesh.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Of det(a, b, c), whose components carry one rounding each: 1, -1, or 0 for unknown.
int certain_determinant(const Vector3& a, const Vector3& b, const Vector3& c) {
    double sum = 0;
    double magnitude = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double p = b[(i + 1) % 3] * c[(i + 2) % 3];
        const double q = b[(i + 2) % 3] * c[(i + 1) % 3];
        sum += a[i] * (p - q);
        magnitude += std::fabs(a[i]) * (std::fabs(p) + std::fabs(q));
    }
    return certain_sign(sum, determinant_rounding * magnitude);
}

class StarlikeSurface {
public:
    StarlikeSurface(std::span<const LatticePoint> points, std::span<const Triangle> triangles)
        : points_(points), triangles_(triangles), center_(mean()) {}

    [[nodiscard]] bool is_starlike() const {
        for (const Triangle& t : triangles_) {
            const auto [a, b, c] = corners(t);
            if (certain_determinant(a, b, c) != 1) return false;
        }
        return is_met_once(direction());
    }

private:
    // Of the corners of triangles, about: any point of doubles will do.
    [[nodiscard]] Vector3 mean() const {
        Vector3 sum{};
        for (const Triangle& t : triangles_)
            for (const std::uint32_t v : t) sum = plus(sum, points_[v].doubles());
        return scaled(sum, 1 / (3 * static_cast<double>(triangles_.size())));
    }
    // From the center.
    [[nodiscard]] std::array<Vector3, 3> corners(const Triangle& t) const {
        return {minus(points_[t[0]].doubles(), center_), minus(points_[t[1]].doubles(), center_),
                minus(points_[t[2]].doubles(), center_)};
    }
    // To somewhere within the first triangle.
    [[nodiscard]] Vector3 direction() const {
        const auto [a, b, c] = corners(triangles_[0]);
        return plus(plus(scaled(a, 0.53), scaled(b, 0.31)), scaled(c, 0.16));
    }
    [[nodiscard]] bool is_met_once(const Vector3& direction) const {
        int met = 0;
        for (const Triangle& t : triangles_) {
            const auto [a, b, c] = corners(t);
            const std::array<int, 3> side{certain_determinant(a, b, direction),
                                          certain_determinant(b, c, direction),
                                          certain_determinant(c, a, direction)};
            if (side[0] < 0 || side[1] < 0 || side[2] < 0) continue;
            if (side[0] == 0 || side[1] == 0 || side[2] == 0 || ++met > 1) return false;
        }
        return met == 1;
    }

    std::span<const LatticePoint> points_;
    std::span<const Triangle> triangles_;
    Vector3 center_;
};

}  // namespace

bool ManifoldMesh::is_starlike() const {
    check_stop(triangles_.size());
    return StarlikeSurface(points_, triangles_).is_starlike();
}

}  // namespace trisect::detail
