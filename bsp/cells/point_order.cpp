// SPDX-License-Identifier: Apache-2.0
//
// Doubles with certified errors distinguish nearly all points. What is left is mostly equal along
// the axis, by a plane across it; only then coordinates are compared as fractions.

#include <trisect/bsp/cells/point_order.h>

#include <optional>

#include <trisect/kernel/plane.h>

namespace trisect::detail {

namespace {

// Whether two corners through which the plane passes show that it is not perpendicular to the axis.
// Most are not, and planes take longer to make than this, and memory that threads share.
bool is_surely_slanted(const PlaneName& n, int axis) {
    if (n.is_splitter()) return n.facet != static_cast<std::uint32_t>(axis);
    const Source& source = *n.source();
    if (source.is_half_space()) return false;
    const auto at = [&](std::uint32_t i) {
        return source.corner(n.facet, static_cast<int>(i % 3))[axis];
    };
    const std::uint32_t first = n.is_edge() ? n.kind : 0;
    if (at(first) != at(first + 1)) return true;
    return !n.is_edge() && at(first) != at(first + 2);
}

// Between lattice points, and where a plane perpendicular to the axis names b, the order is that of
// small integers or the side of a plane: models with axis-parallel faces need little else.
std::optional<int> compare_by_plane(const Workbench& bench, PointId a, PointId b, int axis) {
    if (bench.is_lattice(a) && bench.is_lattice(b)) {
        const auto order = bench.lattice(a)[axis] <=> bench.lattice(b)[axis];
        return order < 0 ? -1 : (order > 0 ? 1 : 0);
    }
    if (bench.is_corner(b)) return std::nullopt;
    for (const PlaneId p : bench.planes_of(b)) {
        if (is_surely_slanted(bench.name(p), axis)) continue;
        const Plane& plane = bench.plane_at(p);
        if (plane.normal((axis + 1) % 3) != 0 || plane.normal((axis + 2) % 3) != 0) continue;
        return plane.normal(axis) > 0 ? bench.side(a, p) : -bench.side(a, p);
    }
    return std::nullopt;
}

}  // namespace

int compare_closely_along(const Workbench& bench, PointId a, PointId b, int axis) {
    if (a == b) return 0;
    if (const auto order = compare_by_plane(bench, a, b, axis)) return *order;
    if (const auto order = compare_by_plane(bench, b, a, axis)) return -*order;
    const auto order = compare_coordinate(bench.homogeneous(a), bench.homogeneous(b), axis);
    return order < 0 ? -1 : (order > 0 ? 1 : 0);
}

}  // namespace trisect::detail
