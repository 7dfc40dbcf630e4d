// SPDX-License-Identifier: Apache-2.0
//
// A closed connected surface that is convex around each of its points bounds a convex solid, and
// does not meet itself (van Heijenoort 1952). Around an edge that means that neither triangle comes
// above the plane of the other one, or back in it. Around a corner the same holds for all triangles
// of the fan; then the fan lies on the boundary of a convex cone, and goes around that once where
// what lies in one plane comes in one row.

#include <trisect/brep/validate/manifold_mesh.h>

#include <array>
#include <cstdint>
#include <span>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

class ConvexSurface {
public:
    ConvexSurface(std::span<const LatticePoint> points, std::span<const Triangle> triangles,
                  const Twins& twins)
        : points_(points), triangles_(triangles), twins_(twins) {}

    [[nodiscard]] bool is_convex() const {
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            check_stop();
            if (!has_area(t)) return false;
            const Plane plane = plane_of(t);
            for (std::uint32_t i = 0; i < 3; ++i)
                if (!bends_down(3 * t + i, plane) || !is_one_row(3 * t + i, plane)) return false;
        }
        return twins_.shells().count == 1;
    }

private:
    static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
    [[nodiscard]] std::uint32_t from(std::uint32_t h) const { return triangles_[h / 3][h % 3]; }
    // Rounding may leave corners in a row.
    [[nodiscard]] bool has_area(std::uint32_t t) const {
        const auto& [a, b, c] = triangles_[t];
        return !are_collinear(points_[a], points_[b], points_[c]);
    }
    [[nodiscard]] Plane plane_of(std::uint32_t t) const {
        const auto& [a, b, c] = triangles_[t];
        return Plane::through(points_[a], points_[b], points_[c]);
    }

    // Over a half-edge of the plane's triangle.
    [[nodiscard]] bool bends_down(std::uint32_t h, const Plane& plane) const {
        const std::uint32_t twin = twins_[h];
        const Side side = side_of(points_[from(previous(twin))], plane);
        if (side != Side::On) return side == Side::Below;
        return has_area(twin / 3) && same_orientation(plane, plane_of(twin / 3));
    }

    // Around the corner where a half-edge of the plane's triangle begins.
    [[nodiscard]] bool is_one_row(std::uint32_t h, const Plane& plane) const {
        bool was_on = true;
        int rows = 0;  // that ended
        for (std::uint32_t at = twins_[previous(h)]; at != h; at = twins_[previous(at)]) {
            const Side side = side_of(points_[from(previous(at))], plane);
            if (side == Side::Above) return false;
            const bool is_on = side == Side::On;
            if (was_on && !is_on) ++rows;
            was_on = is_on;
        }
        // The walk ends at the triangle itself.
        return rows == 1 && was_on;
    }

    std::span<const LatticePoint> points_;
    std::span<const Triangle> triangles_;
    const Twins& twins_;
};

}  // namespace

bool ManifoldMesh::is_convex() const {
    return ConvexSurface(points_, triangles_, twins_).is_convex();
}

}  // namespace trisect::detail
