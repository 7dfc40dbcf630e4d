// SPDX-License-Identifier: Apache-2.0
//
// Extrusions and revolutions of outlines.

#include <array>
#include <cstdint>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <trisect/brep/primitives/extrusion.h>
#include <trisect/bsp/modelling/extrusion.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/modelling/revolution.h>

#include "arrays.h"
#include "bind.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

std::vector<Outline> outlines_of(const py::iterable& outlines, const char* what) {
    std::vector<Outline> out;
    for (const py::handle outline : outlines)
        out.push_back(outline_of(py::reinterpret_borrow<py::object>(outline), what));
    return out;
}

/// The outline without its holes.
PlaneRegion region_of(const py::object& outline, const py::iterable& holes) {
    const std::vector<FlatOutline> outer{outline_of(outline, "outline")};
    const std::vector<FlatOutline> inner = outlines_of(holes, "holes");
    return run([&] {
        const Solid whole = flat_prism(outer, OutlineRule::Odd, 0, 1);
        if (inner.empty()) return region_of_prism(whole);
        std::vector<Expression> cut;
        for (const FlatOutline& hole : inner)
            cut.emplace_back(flat_prism(std::array{hole}, OutlineRule::Odd, 0, 1));
        return region_of_prism(evaluate(whole - Expression::any_of(cut)));
    });
}

std::array<double, 2> scale_of(const py::object& scale) {
    if (py::isinstance<py::array>(scale) || PySequence_Check(scale.ptr()) != 0) {
        const std::vector<double> factors = numbers_of(scale, 2, "scale");
        return {factors[0], factors[1]};
    }
    const double factor = py::float_(scale).cast<double>();
    return {factor, factor};
}

void bind_extrude(py::class_<Solid>& c) {
    c.def_static(
        "extrude",
        [](const py::object& outline, double low, double high, const py::iterable& holes,
           double twist, const py::object& scale, std::uint32_t divisions) {
            ExtrusionOptions options;
            options.twist = twist;
            options.scale = scale_of(scale);
            options.divisions = divisions;
            if (twist == 0 && options.scale == ExtrusionOptions().scale)
                return import_solid(make_extrusion(outline_of(outline, "outline"),
                                                   outlines_of(holes, "holes"), low, high),
                                    {});
            const PlaneRegion region = region_of(outline, holes);
            return run([&] { return extrusion(region, low, high, options); });
        },
        py::arg("outline"), py::arg("low"), py::arg("high"), py::kw_only(),
        py::arg("holes") = py::tuple(), py::arg("twist") = 0.0, py::arg("scale") = 1.0,
        py::arg("divisions") = 0,
        R"(What is over the inside of an outline, between two heights.

Parameters
----------
outline : array_like, shape (n, 2)
    A simple polygon of either orientation.
low, high : float
    Heights along z.
holes : iterable of array_like, shape (n, 2)
    Inside the outline and apart from each other.
twist : float
    Degrees by which the upper end is turned about the z axis, counter-clockwise seen from above.
scale : float or array_like, shape (2,)
    Of the upper end, not negative; 0 makes a point of it.
divisions : int
    Layers; 0: as few as turn by 10 degrees at most.
)");
}

void bind_revolve(py::class_<Solid>& c) {
    c.def_static(
        "revolve",
        [](const py::object& outline, double angle, std::uint32_t segments,
           const py::iterable& holes, double start) {
            RevolutionOptions options;
            options.angle = angle;
            options.segments = segments;
            options.start = start;
            const PlaneRegion region = region_of(outline, holes);
            return run([&] { return revolution(region, options); });
        },
        py::arg("outline"), py::arg("angle") = 360.0, py::arg("segments") = 64, py::kw_only(),
        py::arg("holes") = py::tuple(), py::arg("start") = 0.0,
        R"(The inside of an outline turned about the z axis.

Corners lie on circles and are rounded once.

Parameters
----------
outline : array_like, shape (n, 2)
    Distances from the axis, all of one sign, and heights.
angle : float
    Degrees, counter-clockwise seen from above.
segments : int
    Of a whole circle.
holes : iterable of array_like, shape (n, 2)
start : float
    Degrees from the x axis at which it begins.
)");
}

}  // namespace

void bind_sweeps(py::module_& m) {
    py::class_<Solid> c = solid_class(m);
    bind_extrude(c);
    bind_revolve(c);
}

}  // namespace trisect::python
