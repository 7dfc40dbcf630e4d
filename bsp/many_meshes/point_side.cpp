// SPDX-License-Identifier: Apache-2.0
//
// By a ray along an axis. Seen along it, an edge of a part goes from one side of the ray to the
// other, or it does not; the part is met where an odd number of its edges does so on one side of
// it. Where a vertex or an edge is too near the ray, one along another axis is tried.

#include <trisect/bsp/many_meshes/point_side.h>

#include <array>
#include <cmath>
#include <cstdint>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

class AxisRay {
public:
    AxisRay(const Approximation& from, std::size_t axis, bool up)
        : from_(from), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3), up_(up) {}

    // Whether the ray may meet the box.
    [[nodiscard]] bool may_meet(const OutlineBox& b) const {
        const double e = margin_;
        const auto& c = from_.c;
        return b.lo[u_] - e <= c[u_] && c[u_] <= b.hi[u_] + e && b.lo[v_] - e <= c[v_] &&
               c[v_] <= b.hi[v_] + e &&
               (up_ ? c[axis_] - e <= b.hi[axis_] : b.lo[axis_] <= c[axis_] + e);
    }
    // Nothing when it is not certain.
    [[nodiscard]] std::optional<bool> meets(const OutlinedSolid& solid,
                                            const OutlinedSolid::Facet& facet,
                                            const FilteredPlane& plane) const {
        bool odd = false;
        for (const OutlinedSolid::Edge& e : solid.edges_of(facet)) {
            const Approximation& a = solid.vertices[e.from].at;
            const Approximation& b = solid.vertices[e.to].at;
            const int at_a = compare(a);
            const int at_b = compare(b);
            if (at_a == 0 || at_b == 0) return std::nullopt;
            if (at_a == at_b) continue;
            const int turn = turn_of(a, b);
            if (turn == 0) return std::nullopt;
            if ((turn > 0) == (at_b > 0)) odd = !odd;
        }
        if (!odd) return false;
        const double n = plane.normal[axis_];
        const int side = plane.sign(from_);
        // The slope is the sum of the magnitudes of all minors.
        if (side == 0 || !(std::fabs(n) > minor_rounding * plane.slope)) return std::nullopt;
        return ((n > 0) == up_) == (side < 0);
    }

private:
    // Where a point lies along v.
    [[nodiscard]] int compare(const Approximation& p) const {
        return certain_sign(p.c[v_] - from_.c[v_], bound_slack * (p.error + from_.error));
    }
    // Of a, b and the ray, seen along it.
    [[nodiscard]] int turn_of(const Approximation& a, const Approximation& b) const {
        const double du = b.c[u_] - a.c[u_];
        const double dv = b.c[v_] - a.c[v_];
        const double x = from_.c[u_] - a.c[u_];
        const double y = from_.c[v_] - a.c[v_];
        const double e = std::max({a.error, b.error, from_.error});
        const double error =
            minor_rounding * (std::fabs(du * y) + std::fabs(dv * x)) +
            2.001 * e * (std::fabs(du) + std::fabs(dv) + std::fabs(x) + std::fabs(y) + 4 * e);
        return certain_sign(du * y - dv * x, bound_slack * error);
    }

    const Approximation& from_;
    std::size_t axis_;
    std::size_t u_;
    std::size_t v_;
    bool up_;
    double margin_ = 2 * from_.error;
};

// Whether a ray goes through the boundary an odd number of times.
std::optional<bool> passes_odd(const AxisRay& ray, const OutlinedSolid& solid,
                               CommonSegments& planes, std::size_t number) {
    bool odd = false;
    if (!ray.may_meet(solid.box)) return odd;
    for (std::uint32_t f = 0; f < solid.facets.size(); ++f) {
        if (!ray.may_meet(solid.boxes[f])) continue;
        const std::optional<bool> met = ray.meets(solid, solid.facets[f], planes.plane(number, f));
        if (!met) return std::nullopt;
        odd = odd != *met;
    }
    return odd;
}

}  // namespace

std::optional<bool> is_open_at(const Approximation& point, const OutlinedSolid& solid,
                               CommonSegments& planes, std::size_t number) {
    for (std::size_t i = 0; i < 6; ++i) {
        const AxisRay ray(point, i / 2, i % 2 == 0);
        const std::optional<bool> odd = passes_odd(ray, solid, planes, number);
        if (odd) return solid.open_far_out != *odd;
    }
    return std::nullopt;
}

}  // namespace trisect::detail
