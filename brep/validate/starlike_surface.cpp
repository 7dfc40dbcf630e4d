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
#include <cstddef>
#include <span>

#include <trisect/kernel/number/ball_determinant.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

class StarlikeSurface {
public:
    StarlikeSurface(std::span<const LatticePoint> points, std::span<const Triangle> triangles)
        : points_(points), triangles_(triangles), center_(mean()) {}

    [[nodiscard]] bool is_starlike() const {
        for (const Triangle& t : triangles_) {
            const auto [a, b, c] = corners(t);
            if (determinant(a, b, c).sign() != 1) return false;
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
            const std::array<int, 3> side{determinant(a, b, direction).sign(),
                                          determinant(b, c, direction).sign(),
                                          determinant(c, a, direction).sign()};
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
