// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/solid_measure.h>

#include <optional>

#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/measure/boundary_bounds.h>
#include <trisect/bsp/measure/enclosed_area.h>
#include <trisect/bsp/measure/enclosed_volume.h>
#include <trisect/bsp/measure/measure_counters.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

// A boundary that may meet itself is made free of that first. Names of faces do not matter here, so
// nothing need be cut for them.
Solid resolved(const Solid& solid) {
    return detail::state_of(solid)->embedded ? solid : evaluate(Expression(solid));
}

ExactMesh boundary_of(const Solid& solid) {
    return detail::assemble_exact_mesh(*detail::state_of(resolved(solid)));
}

// Half-spaces alone show what they bound only when they have been put together.
bool is_surely_bounded(const Solid& solid) { return detail::state_of(solid)->far_out == 0; }

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

// What all numbers between these round to. One below the range of doubles is none.
std::optional<double> common_double(const ExactRational& least, const ExactRational& most) {
    const double value = least.to_double();
    if (value != most.to_double() || (value == 0 && least != most)) return std::nullopt;
    return value;
}

template <class Measure>
Measure without_mesh(Measure measure) {
    ++detail::counters_of_thread<detail::MeasureCounters>.enclosed;
    return measure;
}
ExactMesh counted_boundary_of(const Solid& set) {
    ++detail::counters_of_thread<detail::MeasureCounters>.exact;
    return boundary_of(set);
}

}  // namespace

ExactRational exact_volume(const Solid& solid) {
    if (!is_surely_bounded(solid)) return exact_volume(bounded_boundary_of(solid));
    const Solid set = resolved(solid);
    const auto enclosed = detail::enclosed_volume(*detail::state_of(set));
    if (enclosed.least == enclosed.most) return without_mesh(enclosed.least);
    return exact_volume(counted_boundary_of(set));
}

double volume(const Solid& solid) {
    if (!is_surely_bounded(solid)) return volume(bounded_boundary_of(solid));
    const Solid set = resolved(solid);
    const auto enclosed = detail::enclosed_volume(*detail::state_of(set));
    if (const auto value = common_double(enclosed.least, enclosed.most))
        return without_mesh(*value);
    return volume(counted_boundary_of(set));
}

Area area(const Solid& solid) {
    if (!is_surely_bounded(solid)) return area(boundary_of(solid));
    const Solid set = resolved(solid);
    if (const auto a = detail::enclosed_area(*detail::state_of(set))) {
        if (a->least == a->most) return without_mesh(Area{a->least.to_double(), a->least});
        if (const auto value = common_double(a->least, a->most))
            return without_mesh(Area{*value, {}});
    }
    return area(counted_boundary_of(set));
}

std::optional<std::array<ExactRational, 3>> exact_centroid(const Solid& solid) {
    return exact_centroid(bounded_boundary_of(solid));
}

std::optional<Point3d> centroid(const Solid& solid) { return centroid(bounded_boundary_of(solid)); }

std::optional<Bounds> bounds(const Solid& solid) {
    if (is_surely_bounded(solid))
        return detail::boundary_bounds(*detail::state_of(resolved(solid)));
    if (solid.is_whole_space()) return std::nullopt;
    return bounds(bounded_boundary_of(solid));
}

SolidCounts counts(const Solid& solid) {
    const PolygonMesh mesh = detail::assemble_mesh(*detail::state_of(resolved(solid)));
    return {mesh.points.size(), mesh.face_count()};
}

}  // namespace trisect
