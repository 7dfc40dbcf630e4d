// SPDX-License-Identifier: Apache-2.0

#include <optional>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>

#include "arrays.h"
#include "bind.h"
#include "fractions.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

py::object bounds_array(const Solid& s) {
    const std::optional<Bounds> box = run([&] { return bounds(s); });
    if (!box) return py::none();
    return to_array(std::vector<Point3d>{box->lo, box->hi});
}

py::object centroid_array(const Solid& s) {
    const std::optional<Point3d> c = run([&] { return centroid(s); });
    return c ? py::object(to_array(*c)) : py::none();
}

void bind_doubles(py::class_<Solid>& c) {
    c.def_property_readonly(
        "volume", [](const Solid& s) { return run([&] { return volume(s); }); },
        "The exact volume, rounded once (float).");
    c.def_property_readonly(
        "area", [](const Solid& s) { return run([&] { return area(s); }).value; },
        "The area of the boundary (float).");
    c.def_property_readonly("centroid", &centroid_array,
                            "The centre of mass, array of shape (3,); None of the empty set.");
    c.def_property_readonly("bounds", &bounds_array,
                            "The extremes, array of shape (2, 3), rows lowest and highest; None of "
                            "the empty set.");
    c.def_property_readonly(
        "triangle_count", [](const Solid& s) { return run([&] { return counts(s); }).triangles; },
        "How many triangles `mesh` has.");
    c.def_property_readonly(
        "vertex_count", [](const Solid& s) { return run([&] { return counts(s); }).vertices; },
        "How many vertices `mesh` has.");
}

void bind_fractions(py::class_<Solid>& c) {
    c.def(
        "exact_volume",
        [](const Solid& s) { return to_fraction(run([&] { return exact_volume(s); })); },
        R"(The volume as a fractions.Fraction.

That of a solid with n corners that booleans made has about n times their digits.
)");
    c.def(
        "exact_area",
        [](const Solid& s) -> py::object {
            const Area a = run([&] { return area(s); });
            return a.exact ? to_fraction(*a.exact) : py::none();
        },
        "The area as a Fraction where every face has a rational one, else None.");
    c.def(
        "exact_centroid",
        [](const Solid& s) -> py::object {
            const std::optional<ExactPoint> p = run([&] { return exact_centroid(s); });
            return p ? py::object(to_fractions(*p)) : py::none();
        },
        "The centre of mass as three Fractions; None of the empty set.");
}

}  // namespace

void bind_measures(py::module_& m) {
    py::class_<Solid> c = solid_class(m);
    bind_doubles(c);
    bind_fractions(c);
    c.def(
        "components", [](const Solid& s) { return run([&] { return components(s); }); },
        R"(The connected parts, each with its cavities.

Parts that touch in points or edges only are apart.

Returns
-------
list of Solid
)");
    c.def(
        "equals",
        [](const Solid& a, const Solid& b) {
            return run([&] { return evaluate(a ^ b).is_empty(); });
        },
        py::arg("other"), "Whether both are the same set, exactly.");
}

}  // namespace trisect::python
