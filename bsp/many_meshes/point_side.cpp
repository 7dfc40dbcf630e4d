// SPDX-License-Identifier: Apache-2.0
//
// By a ray along an axis. Seen along it, an edge of a part goes from one side of the ray to the
// other, or it does not; the part is met where an odd number of its edges does so on one side of
// it. Where a vertex or an edge is too near the ray, one along another axis is tried.

#include <trisect/bsp/many_meshes/point_side.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include <trisect/bsp/many_meshes/outlines/boundary_cells.h>
#include <trisect/bsp/many_meshes/outlines/settled_part.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

// A whole facet of an operand.
class WholeOutline {
public:
    WholeOutline(const ManyMeshes& meshes, std::uint32_t number, std::uint32_t slot) {
        facet_ = {number, slot, 0, 3, true};
        const std::uint32_t first = meshes.operands->operands[slot].first;
        const std::array<Vector3, 3> corners = meshes.corners(slot, number - first);
        for (std::uint32_t i = 0; i < 3; ++i) {
            OutlineVertex& v = vertices_[i];
            v.at = {corners[i], 0.0};
            v.facets[0] = number;
            v.which = static_cast<std::int8_t>(i);
            box_.add(v.at);
            edges_[i] = {i, i == 2 ? 0 : i + 1, EdgeOrigin(i)};
        }
    }
    [[nodiscard]] const OutlineBox& box() const { return box_; }
    [[nodiscard]] const OutlinedSolid::Facet& facet() const { return facet_; }
    // Good as long as this is.
    [[nodiscard]] OutlinedSolid view() const {
        OutlinedSolid out;
        out.edges = edges_;
        out.vertices = vertices_;
        return out;
    }

private:
    OutlinedSolid::Facet facet_;
    std::array<OutlinedSolid::Edge, 3> edges_;
    std::array<OutlineVertex, 3> vertices_;
    OutlineBox box_ = OutlineBox::none();
};

// Whether one of the operands has what the ray goes from, by passes(outline), which is nothing
// where that is not certain. \pre each of them is bounded
template <class Ray, class Passes>
std::optional<bool> is_in_one(const Ray& ray, std::span<const std::uint32_t> operands,
                              const ManyMeshes& meshes, const Passes& passes) {
    for (const std::uint32_t slot : operands) {
        if (!ray.may_begin_in(outline_box(meshes.sources[slot]->box()))) continue;
        const std::uint32_t first = meshes.operands->operands[slot].first;
        bool odd = false;
        for (std::uint32_t f = 0; f < meshes.sources[slot]->facet_count(); ++f) {
            const WholeOutline outline(meshes, first + f, slot);
            if (!ray.may_meet(outline.box())) continue;
            const std::optional<bool> met = passes(outline);
            if (!met) return std::nullopt;
            odd = odd != *met;
        }
        if (odd) return true;
    }
    return false;
}

class AxisRay {
public:
    AxisRay(const Approximation& from, std::size_t axis, bool up)
        : from_(from), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3), up_(up) {}

    [[nodiscard]] bool may_begin_in(const OutlineBox& b) const {
        return may_meet(b) && b.lo[axis_] - margin_ <= from_.c[axis_] &&
               from_.c[axis_] <= b.hi[axis_] + margin_;
    }
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
    if (!solid.united.empty())
        return is_in_one(ray, solid.united, planes.meshes(), [&](const WholeOutline& w) {
            return ray.meets(w.view(), w.facet(), planes.plane_of(w.facet()));
        });
    bool odd = false;
    const auto pass = [&](const OutlinedSolid& part, const auto& plane_of) {
        if (!ray.may_meet(part.box)) return true;
        for (std::uint32_t f = 0; f < part.facets.size(); ++f) {
            if (!ray.may_meet(part.boxes[f])) continue;
            const std::optional<bool> met = ray.meets(part, part.facets[f], plane_of(f));
            if (!met) return false;
            odd = odd != *met;
        }
        return true;
    };
    if (!pass(solid, [&](std::uint32_t f) { return planes.plane(number, f); })) return std::nullopt;
    for (const auto& part : solid.settled)
        if (!pass(part->view(), [&](std::uint32_t f) { return planes.plane_of(part->facets[f]); }))
            return std::nullopt;
    return odd;
}

}  // namespace

namespace {

// A ray along the third axis from a corner, by signs alone.
class ExactRay {
public:
    ExactRay(const OutlineVertex& from, const OutlinedSolid& solid, const ShiftedPoints& exact)
        : from_(from), solid_(solid), exact_(exact) {}

    [[nodiscard]] bool may_meet(const OutlineBox& b) const {
        const auto& c = from_.at.c;
        return b.lo[0] <= c[0] && c[0] <= b.hi[0] && b.lo[1] <= c[1] && c[1] <= b.hi[1] &&
               c[2] <= b.hi[2];
    }
    [[nodiscard]] bool may_begin_in(const OutlineBox& b) const {
        return may_meet(b) && b.lo[2] <= from_.at.c[2];
    }
    [[nodiscard]] bool meets(const OutlinedSolid::Facet& facet) const {
        const int slope = exact_.slope(facet.number, 2);
        if (slope == 0) return false;
        bool odd = false;
        for (const OutlinedSolid::Edge& e : solid_.edges_of(facet))
            odd = odd != passes(e, facet.number);
        return odd && exact_.side_of_corner(from_, facet.number) != slope;
    }

private:
    // Whether the edge, seen along the ray, goes by on the far side along the first axis.
    [[nodiscard]] bool passes(const OutlinedSolid::Edge& e, std::uint32_t facet) const {
        const int from = order(e.from, 1);
        if (from == order(e.to, 1)) return false;
        const int near = order_in_doubles(e.from, 0);
        if (near != 0 && near == order_in_doubles(e.to, 0)) return near > 0;
        return exact_.order_at_height(solid_, facet, e, from_, {0, 1}) > 0;
    }
    [[nodiscard]] int order_in_doubles(std::uint32_t vertex, std::size_t axis) const {
        const Approximation& at = solid_.vertices[vertex].at;
        return certain_sign(at.c[axis] - from_.at.c[axis],
                            bound_slack * (at.error + from_.at.error));
    }
    [[nodiscard]] int order(std::uint32_t vertex, std::size_t axis) const {
        const int known = order_in_doubles(vertex, axis);
        return known != 0 ? known : exact_.order_along(solid_.vertices[vertex], from_, axis);
    }

    const OutlineVertex& from_;
    const OutlinedSolid& solid_;
    const ShiftedPoints& exact_;
};

}  // namespace

bool is_open_at_corner(const OutlineVertex& corner, const OutlinedSolid& solid,
                       const ShiftedPoints& exact) {
    if (!solid.united.empty()) {
        const ExactRay ray(corner, solid, exact);
        const auto odd = is_in_one(ray, solid.united, exact.meshes(), [&](const WholeOutline& w) {
            return std::optional(ExactRay(corner, w.view(), exact).meets(w.facet()));
        });
        return solid.open_far_out != *odd;
    }
    bool odd = false;
    const auto pass = [&](const OutlinedSolid& part) {
        const ExactRay ray(corner, part, exact);
        if (!ray.may_meet(part.box)) return;
        for (std::uint32_t f = 0; f < part.facets.size(); ++f)
            if (ray.may_meet(part.boxes[f])) odd = odd != ray.meets(part.facets[f]);
    };
    pass(solid);
    for (const auto& part : solid.settled) pass(part->view());
    return solid.open_far_out != odd;
}

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
