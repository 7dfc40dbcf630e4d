// SPDX-License-Identifier: Apache-2.0
//
// Doubles with certified errors distinguish nearly all points. What is left is mostly equal along
// the axis, by a plane across it; only then coordinates are compared as fractions.

#include <trisect/bsp/cells/point_order.h>

#include <optional>

#include <trisect/kernel/plane.h>

namespace trisect::detail {

namespace {

// Between lattice points, and where a plane perpendicular to the axis names b, the order is that of
// small integers or the side of a plane: models with axis-parallel faces need little else.
std::optional<int> compare_by_plane(const Workbench& bench, PointId a, PointId b, int axis) {
    if (bench.is_lattice(a) && bench.is_lattice(b)) {
        const auto order = bench.lattice(a)[axis] <=> bench.lattice(b)[axis];
        return order < 0 ? -1 : (order > 0 ? 1 : 0);
    }
    if (bench.is_corner(b)) return std::nullopt;
    for (const PlaneId p : bench.planes_of(b)) {
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
