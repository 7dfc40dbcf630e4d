// SPDX-License-Identifier: Apache-2.0
//
// The winding number at a corner is counted along a ray in direction +x that starts there, moved by
// an infinitesimal (0, e, e²), so that it passes no corner or edge. A corner that lies on another
// shell says nothing about that shell; then the next corner is tried.

#include <trisect/brep/validate/shell_nesting.h>

#include <algorithm>

#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

// Corners on other shells are tried in turn, up to so many.
constexpr std::size_t corner_limit = 64;

// Sign of the turn a, b, p + (e, e²) in the (y, z) plane; never 0 for different a and b.
int perturbed_turn(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p) {
    const int exact = turn(flat_corner(a, 1, 2), flat_corner(b, 1, 2), flat_corner(p, 1, 2));
    if (exact != 0) return exact;
    if (b.z != a.z) return b.z > a.z ? -1 : 1;
    return b.y > a.y ? 1 : -1;
}

// What the ray from p adds to the winding number at p: 1 where it leaves through t, -1 where it
// enters. \pre p is not on t.
int crossing(const LatticePoint& p, const std::array<LatticePoint, 3>& t) {
    // An edge parallel to the ray is a point in the projection: the triangle is seen edge-on.
    for (std::size_t i = 0; i < 3; ++i)
        if (t[i].y == t[(i + 1) % 3].y && t[i].z == t[(i + 1) % 3].z) return 0;
    const int s = perturbed_turn(t[0], t[1], p);
    if (perturbed_turn(t[1], t[2], p) != s || perturbed_turn(t[2], t[0], p) != s) return 0;
    // Counter-clockwise in (y, z): the normal has positive x, and the ray leaves through it if p
    // is below. On the plane, p is beside the triangle, and the perturbed ray cannot meet it.
    const Side side = side_of(p, Plane::through(t[0], t[1], t[2]));
    if (s > 0) return side == Side::Below ? 1 : 0;
    return side == Side::Above ? -1 : 0;
}

// Whether p lies on the closed triangle.
bool lies_on(const LatticePoint& p, const std::array<LatticePoint, 3>& t) {
    for (int i = 0; i < 3; ++i)
        if (p[i] < std::min({t[0][i], t[1][i], t[2][i]}) ||
            p[i] > std::max({t[0][i], t[1][i], t[2][i]}))
            return false;
    const Plane plane = Plane::through(t[0], t[1], t[2]);
    if (side_of(p, plane) != Side::On) return false;
    const int u = (plane.dominant_axis() + 1) % 3;
    const int v = (plane.dominant_axis() + 2) % 3;
    bool left = false;
    bool right = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const int side =
            turn(flat_corner(t[i], u, v), flat_corner(t[(i + 1) % 3], u, v), flat_corner(p, u, v));
        left = left || side > 0;
        right = right || side < 0;
    }
    return !(left && right);
}

}  // namespace

std::optional<int> ShellNesting::winding_outside(std::uint32_t shell,
                                                 std::span<const Triangle> own) {
    std::size_t tried = 0;
    for (const Triangle& t : own)
        for (const std::uint32_t c : t) {
            if (++tried > corner_limit) return std::nullopt;
            if (const auto w = winding_at(points_[c], shell)) return w;
        }
    return std::nullopt;
}

std::optional<int> ShellNesting::winding_at(const LatticePoint& p, std::uint32_t without) {
    LatticeBox ray;
    ray.add(p);
    ray.high.x = coordinate_limit;
    int winding = 0;
    bool known = true;
    tree_.for_each_in(ray, [&](std::uint32_t t) {
        const std::uint32_t shell = shell_of_triangle_[t];
        if (shell == without || !is_closed_[shell]) return;
        const Triangle& corners = triangles_[t];
        const std::array<LatticePoint, 3> q{points_[corners[0]], points_[corners[1]],
                                            points_[corners[2]]};
        if (lies_on(p, q)) {
            known = false;
        } else {
            winding += crossing(p, q);
        }
    });
    return known ? std::optional(winding) : std::nullopt;
}

}  // namespace trisect::detail
