// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/solid_measure.h>

#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

// A boundary that may meet itself is made free of that first. Names of faces do not matter here, so
// nothing need be cut for them.
ExactMesh boundary_of(const Solid& solid) {
    const bool embedded = detail::state_of(solid)->embedded;
    const Solid resolved = embedded ? solid : evaluate(Expression(solid));
    return detail::assemble_exact_mesh(*detail::state_of(resolved));
}

ExactMesh bounded_boundary_of(const Solid& solid) {
    const int far_out = detail::state_of(solid)->far_out;
    const auto refuse = [] { throw UnsupportedError("an unbounded set has no volume"); };
    if (far_out == 1) refuse();
    ExactMesh boundary = boundary_of(solid);
    // Half-spaces alone decide it only when they have been put together.
    if (far_out < 0 &&
        (boundary.triangles.empty() ? solid.is_whole_space() : exact_volume(boundary).sign() < 0))
        refuse();
    return boundary;
}

}  // namespace

ExactRational exact_volume(const Solid& solid) { return exact_volume(bounded_boundary_of(solid)); }

double volume(const Solid& solid) { return volume(bounded_boundary_of(solid)); }

Area area(const Solid& solid) { return area(boundary_of(solid)); }

std::optional<std::array<ExactRational, 3>> exact_centroid(const Solid& solid) {
    return exact_centroid(bounded_boundary_of(solid));
}

std::optional<Point3d> centroid(const Solid& solid) { return centroid(bounded_boundary_of(solid)); }

std::optional<Bounds> bounds(const Solid& solid) {
    if (solid.is_whole_space()) return std::nullopt;
    return bounds(bounded_boundary_of(solid));
}

SolidCounts counts(const Solid& solid) {
    const ExactMesh mesh = boundary_of(solid);
    return {mesh.points.size(), mesh.triangles.size()};
}

}  // namespace trisect
