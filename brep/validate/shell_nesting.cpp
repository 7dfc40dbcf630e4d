// SPDX-License-Identifier: Apache-2.0
//
// The winding number is counted along a ray that starts in the interior of a facet of the shell, so
// that other shells may touch its corners and edges: at a corner p of the facet, moved by
// infinitesimals e to the next corner and e² to the last one. The ray runs along an axis along
// which the facet is not seen edge-on; then its start, seen along the axis, is on no line through
// corners, and it passes no corner or edge. A turn that is 0 at p is decided by the next corner or
// the last one, and so is the side of a plane through p. Where all three are in the plane, the
// start may lie on the other facet; then the next facet of the shell is tried.

#include <trisect/brep/validate/shell_nesting.h>

#include <algorithm>
#include <cstddef>

#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

// From the interior of a facet, near its first corner.
struct ShellNesting::Ray {
    const std::array<LatticePoint, 3>& from;
    int axis = 0;
    bool is_upwards = true;
    double length = -1;  // to the end of the mesh; below 0 where there is no ray

    [[nodiscard]] FlatCorner flat(const LatticePoint& p) const {
        return flat_corner(p, (axis + 1) % 3, (axis + 2) % 3);
    }
    // Sign of the turn from a to b to the start of the ray; 0 where a and b are one point, seen
    // along the axis.
    [[nodiscard]] int turn_to_start(const LatticePoint& a, const LatticePoint& b) const {
        for (const LatticePoint& p : from)
            if (const int sign = turn(flat(a), flat(b), flat(p)); sign != 0) return sign;
        return 0;
    }
    // On where the facet lies in the plane.
    [[nodiscard]] Side side_of_start(const Plane& plane) const {
        for (const LatticePoint& p : from)
            if (const Side side = side_of(p, plane); side != Side::On) return side;
        return Side::On;
    }
    // What the ray adds to the winding number at its start: 1 where it leaves through t, -1 where
    // it enters. Nothing where it starts on t.
    [[nodiscard]] std::optional<int> crossing(const std::array<LatticePoint, 3>& t) const {
        const int s = turn_to_start(t[0], t[1]);
        if (s == 0 || turn_to_start(t[1], t[2]) != s || turn_to_start(t[2], t[0]) != s) return 0;
        const Side side = side_of_start(Plane::through(t[0], t[1], t[2]));
        if (side == Side::On) return std::nullopt;
        // Counter-clockwise: the normal points upwards.
        const bool leaves = (s > 0) == is_upwards;
        if (leaves) return side == Side::Below ? 1 : 0;
        return side == Side::Above ? -1 : 0;
    }
};

namespace {

// Facets that others cover are tried in turn, up to so many.
constexpr std::size_t facet_limit = 64;

}  // namespace

std::optional<int> ShellNesting::winding_outside(std::uint32_t shell,
                                                 std::span<const Triangle> own) {
    const auto windings = windings_outside(shell, own);
    if (!windings) return std::nullopt;
    int sum = 0;
    for (const Winding& w : *windings) sum += w.number;
    return sum;
}

std::optional<std::vector<std::uint32_t>> ShellNesting::shells_around(
    std::uint32_t shell, std::span<const Triangle> own) {
    const auto windings = windings_outside(shell, own);
    if (!windings) return std::nullopt;
    std::vector<std::uint32_t> out;
    for (const Winding& w : *windings)
        if (w.number != 0) out.push_back(w.shell);
    return out;
}

std::optional<ShellNesting::Windings> ShellNesting::windings_outside(
    std::uint32_t shell, std::span<const Triangle> own) {
    for (const Triangle& t : own.first(std::min(own.size(), facet_limit))) {
        const std::array<LatticePoint, 3> corners{points_[t[0]], points_[t[1]], points_[t[2]]};
        const Ray ray = shortest_way_out(corners);
        if (ray.length < 0) continue;
        if (auto w = windings_along(ray, shell)) return w;
    }
    return std::nullopt;
}

// Shells in a row see few others across it.
ShellNesting::Ray ShellNesting::shortest_way_out(const std::array<LatticePoint, 3>& own) const {
    Ray best{own};
    for (const int axis : {0, 1, 2}) {
        Ray ray{own, axis};
        if (turn(ray.flat(own[0]), ray.flat(own[1]), ray.flat(own[2])) == 0) continue;
        const double at = own[0][axis].to_double();
        const double below = at - all_.low[axis].to_double();
        const double above = all_.high[axis].to_double() - at;
        ray.is_upwards = above <= below;
        ray.length = std::min(above, below);
        if (best.length < 0 || ray.length < best.length) {
            best.axis = ray.axis;
            best.is_upwards = ray.is_upwards;
            best.length = ray.length;
        }
    }
    return best;
}

std::optional<ShellNesting::Windings> ShellNesting::windings_along(const Ray& ray,
                                                                   std::uint32_t without) {
    LatticeBox way;
    way.add(ray.from[0]);
    const auto end = ray.is_upwards ? all_.high[ray.axis] : all_.low[ray.axis];
    const LatticePoint& p = ray.from[0];
    const auto at = [&](int axis) { return axis == ray.axis ? end : p[axis]; };
    way.add(LatticePoint{at(0), at(1), at(2)});
    Windings crossings;
    bool known = true;
    tree_.for_each_in(way, [&](std::uint32_t t) {
        const std::uint32_t shell = shell_of_triangle_[t];
        if (shell == without || !is_closed_[shell]) return;
        const Triangle& corners = triangles_[t];
        const auto crossing =
            ray.crossing({points_[corners[0]], points_[corners[1]], points_[corners[2]]});
        known = known && crossing.has_value();
        if (crossing.value_or(0) != 0) crossings.push_back({shell, *crossing});
    });
    if (!known) return std::nullopt;
    std::ranges::sort(crossings, {}, &Winding::shell);
    Windings out;
    for (const Winding& c : crossings) {
        if (out.empty() || out.back().shell != c.shell) {
            out.push_back(c);
        } else {
            out.back().number += c.number;
        }
    }
    return out;
}

}  // namespace trisect::detail
