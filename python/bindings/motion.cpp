// SPDX-License-Identifier: Apache-2.0
//
// Moving solids and their first contact.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/brep/algebraic_number.h>
#include <trisect/bsp/interference/solid_motion.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "fractions.h"
#include "poses.h"
#include "run.h"

namespace trisect::python {

namespace {

std::vector<ExactRational> coefficients_of(const py::handle& numbers, const char* what) {
    std::vector<ExactRational> out;
    for (const py::handle n : numbers) out.push_back(exact_of(n, what));
    return out;
}

Motion rational_motion(const py::sequence& entries, const py::sequence& denominator) {
    std::array<std::vector<ExactRational>, 12> polynomials;
    if (entries.size() != polynomials.size())
        throw UsageError("entries: must be 12 lists of coefficients, not " +
                         std::to_string(entries.size()));
    for (std::size_t i = 0; i < polynomials.size(); ++i)
        polynomials[i] = coefficients_of(entries[i], "entries");
    return Motion::rational(polynomials, coefficients_of(denominator, "denominator"));
}

void bind_motion_type(py::module_& m) {
    py::class_<Motion>(m, "Motion", R"(An exact rational motion: a pose for every parameter value.

Pieces run one after the other; piece i while the parameter goes from i to i + 1. Nothing is
sampled and nothing is rounded. ``Motion()`` stands still, ``Motion(pose)`` stands at a pose.
)")
        .def(py::init([](const py::object& pose) { return Motion(pose_of(pose, "pose")); }),
             py::arg("pose") = py::none())
        .def_static(
            "translation",
            [](const py::object& start, const py::object& by) {
                return Motion::translation(pose_of(start, "start"), point_of(by, "by"));
            },
            py::arg("start"), py::arg("by"), "From a pose by a vector, with constant velocity.")
        .def_static(
            "blend",
            [](const py::object& first, const py::object& last) {
                return Motion::blend(pose_of(first, "first"), pose_of(last, "last"));
            },
            py::arg("first"), py::arg("last"),
            "Every point on a straight line from its place under one pose to that under another.")
        .def_static(
            "screw",
            [](const py::object& start, const std::array<std::int64_t, 4>& turn,
               const py::object& center, const py::object& shift) {
                return Motion::screw(pose_of(start, "start"),
                                     {turn, point_of(center, "center"), point_of(shift, "shift")});
            },
            py::arg("start"), py::arg("turn"), py::arg("center") = py::make_tuple(0.0, 0.0, 0.0),
            py::arg("shift") = py::make_tuple(0.0, 0.0, 0.0),
            R"(A turn about an axis with a shift along the way.

Parameters
----------
start : Pose, array_like or None
turn : (w, x, y, z)
    The whole rotation as a quaternion of integers with w > 0, so less than half a turn.
center : array_like, shape (3,)
    A point of the axis.
shift : array_like, shape (3,)
    Over the whole motion.
)")
        .def_static(
            "through",
            [](const std::vector<py::object>& poses) {
                std::vector<Pose> list;
                for (const py::object& p : poses) list.push_back(pose_of(p, "poses"));
                return Motion::through(list);
            },
            py::arg("poses"), "Straight pieces from pose to pose.")
        .def_static(
            "joined", [](const std::vector<Motion>& motions) { return Motion::joined(motions); },
            py::arg("motions"), "Motions one after the other, each from the end of the last.")
        .def_static("rational", &rational_motion, py::arg("entries"), py::arg("denominator"),
                    R"(Any rational motion of one piece.

Parameters
----------
entries : sequence of 12 sequences
    Of each number of the 3 x 4 matrix, row by row, the coefficients of a polynomial in the
    parameter, the constant first: int, float or Fraction.
denominator : sequence
    Coefficients of what all of them are divided by.
)")
        .def("then", &Motion::then, py::arg("next"),
             "This motion, then one that begins at its end.")
        .def_property_readonly("piece_count", &Motion::piece_count,
                               "The parameter runs from 0 to this number.")
        .def(
            "pose_at",
            [](const Motion& motion, const py::object& parameter) {
                return motion.pose_at(exact_of(parameter, "parameter"));
            },
            py::arg("parameter"), "The exact `Pose` at an int, float or Fraction.")
        .def("__repr__", [](const Motion& motion) {
            return "<trisect.Motion: " + std::to_string(motion.piece_count()) + " pieces>";
        });
}

py::tuple interval_of(const AlgebraicNumber& time, const py::object& width) {
    const AlgebraicNumber narrow = width.is_none() ? time : time.refined(exact_of(width, "width"));
    return py::make_tuple(to_fraction(narrow.lower()), to_fraction(narrow.upper()));
}

void bind_result(py::module_& m) {
    py::class_<NamedWitness>(m, "Witness", "An entity of A and one of B that meet.")
        .def_property_readonly(
            "a", [](const NamedWitness& w) { return w.a; }, "`EntityName`")
        .def_property_readonly(
            "b", [](const NamedWitness& w) { return w.b; }, "`EntityName`");
    py::class_<NamedFirstContact>(m, "FirstContact", R"(The first contact of two moving solids.

It is true where there is one; no contact is proved.
)")
        .def("__bool__", &NamedFirstContact::exists, "Whether there is a contact.")
        .def_property_readonly(
            "time",
            [](const NamedFirstContact& c) -> py::object {
                return c.time ? py::object(py::float_(c.time->to_double())) : py::none();
            },
            "The parameter, rounded once; None where there is no contact.")
        .def(
            "exact_time",
            [](const NamedFirstContact& c, const py::object& width) -> py::object {
                return c.time ? py::object(interval_of(*c.time, width)) : py::none();
            },
            py::arg("width") = py::none(), R"(Two Fractions between which the exact parameter is.

They are equal where it is known to be rational; ``width`` makes them so close.
)")
        .def_property_readonly(
            "at_start",
            [](const NamedFirstContact& c) { return enum_member("Relation", c.at_start); },
            "The `Relation` at the start.")
        .def_property_readonly(
            "witnesses", [](const NamedFirstContact& c) { return c.witnesses; },
            "List of `Witness`: pairs of entities that arrive at each other.")
        .def("__repr__", [](const NamedFirstContact& c) {
            if (!c.time) return std::string("<FirstContact: none>");
            return "<FirstContact at " + std::string(py::repr(py::float_(c.time->to_double()))) +
                   ">";
        });
}

ContactEvent event_of(const std::string& word) {
    if (word == "touch") return ContactEvent::Touch;
    if (word == "overlap") return ContactEvent::Overlap;
    throw UsageError("event: must be 'touch' or 'overlap', not '" + word + "'");
}

}  // namespace

void bind_motion(py::module_& m) {
    bind_motion_type(m);
    bind_result(m);
    m.def(
        "first_contact",
        [](const Solid& a, const Motion& motion_a, const Solid& b, const Motion& motion_b,
           const std::string& event) {
            FirstContactOptions options;
            options.event = event_of(event);
            return run([&] { return first_contact(a, motion_a, b, motion_b, options); });
        },
        py::arg("a"), py::arg("motion_a"), py::arg("b"), py::arg("motion_b"), py::kw_only(),
        py::arg("event") = "touch", R"(When moving solids first touch or overlap, in exact time.

Parameters
----------
a, b : Solid
motion_a, motion_b : Motion
    Of the same number of pieces, or one of them stands still.
event : {'touch', 'overlap'}
    'overlap': the time from which on the interiors meet; sliding along is no obstacle.

Returns
-------
FirstContact
)");
}

}  // namespace trisect::python
