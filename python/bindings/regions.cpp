// SPDX-License-Identifier: Apache-2.0
//
// Contact regions of two placed solids, and their overlap as a solid.

#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/interference/solid_regions.h>

#include "arrays.h"
#include "bind.h"
#include "fractions.h"
#include "names.h"
#include "poses.h"
#include "run.h"

namespace trisect::python {

namespace {

py::list rounded_loops(const NamedRegion& region) {
    py::list out;
    for (const auto& loop : region.loops) {
        std::vector<Point3d> points;
        points.reserve(loop.size());
        for (const ContactPoint& p : loop) points.push_back(p.nearest);
        out.append(to_array(std::move(points)));
    }
    return out;
}

py::list exact_loops(const NamedRegion& region) {
    py::list out;
    for (const auto& loop : region.loops) {
        py::list points;
        for (const ContactPoint& p : loop) points.append(to_fractions(p.exact));
        out.append(points);
    }
    return out;
}

std::string region_text(const NamedRegion& region) {
    const char* const kind = region.dimension == 2   ? "area"
                             : region.dimension == 1 ? "segment"
                                                     : "point";
    return std::string("<ContactRegion: ") + kind + ", " + std::to_string(region.loops.size()) +
           (region.loops.size() == 1 ? " loop>" : " loops>");
}

void bind_region_type(py::module_& m) {
    py::class_<NamedRegion>(m, "ContactRegion",
                            R"(A part of what two boundaries have in common, as large as it can be.

An area that a face of each share, with holes; a segment that is not part of an area's outline; or a
point that is on neither.
)")
        .def_property_readonly(
            "dimension", [](const NamedRegion& r) { return static_cast<int>(r.dimension); },
            "0 a point, 1 a segment, 2 an area.")
        .def_property_readonly(
            "a", [](const NamedRegion& r) { return r.a; }, "`EntityName`")
        .def_property_readonly(
            "b", [](const NamedRegion& r) { return r.b; }, "`EntityName`")
        .def_property_readonly(
            "opposite", [](const NamedRegion& r) { return r.opposite; },
            "Of an area: whether the outward normals are opposite.")
        .def_property_readonly("loops", &rounded_loops,
                               R"(Arrays of shape (n, 3) in the world, each coordinate rounded once.

An area is to the left of its loops, seen from where A's outward normal points; holes run the other
way round. A segment is one loop of two points, a point one loop of one.
)")
        .def("exact_loops", &exact_loops, "The same as lists of three Fractions a point.")
        .def("__repr__", &region_text);
}

void bind_overlap_type(py::module_& m) {
    py::class_<Overlap>(m, "Overlap", "What two placed solids have in common.")
        .def_property_readonly(
            "solid", [](const Overlap& o) { return o.scaled_solid; },
            R"(The overlap in A's own frame, enlarged by `scale`.

As if A were not placed; ``solid.transform(pose_a)`` is in the world where the scale is 1.
)")
        .def_property_readonly(
            "scale", [](const Overlap& o) { return to_fraction(o.scale); },
            R"(A Fraction, and 1 but for rotations by fractions.

Corners of solids are multiples of powers of two; a rotation by a fraction needs its denominator.
)")
        .def_property_readonly(
            "is_exact", [](const Overlap& o) { return o.is_exact; },
            "Whether no corner was rounded to a lattice before.")
        .def_property_readonly(
            "max_move", [](const Overlap& o) { return o.max_move; },
            "How far rounding moved a coordinate at most.")
        .def_property_readonly(
            "volume", [](const Overlap& o) { return o.volume.to_double(); },
            "Of the overlap in the world, rounded once.")
        .def(
            "exact_volume", [](const Overlap& o) { return to_fraction(o.volume); },
            "The same as a Fraction; exact for what `solid` is.")
        .def("__repr__", [](const Overlap& o) {
            return "<Overlap: volume " + std::string(py::repr(py::float_(o.volume.to_double()))) +
                   (o.is_exact ? ", exact>" : ", corners rounded>");
        });
}

}  // namespace

void bind_regions(py::module_& m) {
    bind_region_type(m);
    bind_overlap_type(m);
    m.def(
        "contact_regions",
        [](const Solid& a, const py::object& pose_a, const Solid& b, const py::object& pose_b) {
            const Pose p = pose_of(pose_a, "pose_a");
            const Pose q = pose_of(pose_b, "pose_b");
            return run([&] { return contact_regions(a, p, b, q); });
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
        R"(Where two placed solids touch and cross: areas, segments and points, exactly.

Parameters
----------
a, b : Solid
pose_a, pose_b : Pose, array_like of shape (3, 4) or (4, 4), or None

Returns
-------
list of ContactRegion
    By falling dimension, then by names.

Raises
------
LimitError, UnsupportedError
    As `interfere`.
)");
    m.def(
        "overlap",
        [](const Solid& a, const py::object& pose_a, const Solid& b, const py::object& pose_b) {
            const Pose p = pose_of(pose_a, "pose_a");
            const Pose q = pose_of(pose_b, "pose_b");
            return run([&] { return overlap(a, p, b, q); });
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
        R"(What two placed solids have in common, as a solid, and its volume.

Parameters
----------
a, b : Solid
pose_a, pose_b : Pose, array_like of shape (3, 4) or (4, 4), or None

Returns
-------
Overlap
    Exact between poses that differ by translations, quarter turns and mirrors; under rotations the
    corners that booleans made are rounded, and `is_exact` says so.

Raises
------
LimitError, UnsupportedError
    As `interfere`.
)");
}

}  // namespace trisect::python
