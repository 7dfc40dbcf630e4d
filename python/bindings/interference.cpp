// SPDX-License-Identifier: Apache-2.0
//
// The relation, contacts and distance of two placed solids.

#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/interference/solid_interference.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "fractions.h"
#include "names.h"
#include "poses.h"
#include "run.h"

namespace trisect::python {

namespace {

void bind_relation(py::module_& m) {
    bind_enum(m, "Relation", "How a solid A lies to a solid B, as closed sets.",
              std::vector<EnumMember>{{"DISJOINT", static_cast<int>(Relation::Disjoint)},
                                      {"TOUCHING", static_cast<int>(Relation::Touching)},
                                      {"OVERLAPPING", static_cast<int>(Relation::Overlapping)},
                                      {"INSIDE", static_cast<int>(Relation::Inside)},
                                      {"CONTAINS", static_cast<int>(Relation::Contains)},
                                      {"EQUAL", static_cast<int>(Relation::Equal)}});
}

void bind_names(py::module_& m) {
    bind_enum(m, "EntityKind", "Whether an `EntityName` is of a vertex, an edge or a face.",
              std::vector<EnumMember>{{"VERTEX", static_cast<int>(EntityName::Kind::Vertex)},
                                      {"EDGE", static_cast<int>(EntityName::Kind::Edge)},
                                      {"FACE", static_cast<int>(EntityName::Kind::Face)}});
    py::class_<EntityName>(m, "EntityName", "A face, edge or vertex, by faces of operands.")
        .def_property_readonly(
            "kind", [](const EntityName& n) { return enum_member("EntityKind", n.kind); },
            "`EntityKind`")
        .def_property_readonly(
            "faces", [](const EntityName& n) { return faces_of(n); },
            "(operand, face) of the faces that meet there.")
        .def_property_readonly(
            "corner", [](const EntityName& n) { return to_object(n.corner); },
            "(operand, corner) of a corner of an operand, else None.")
        .def("__repr__", [](const EntityName& n) {
            const char* const kind = n.kind == EntityName::Kind::Vertex ? "vertex"
                                     : n.kind == EntityName::Kind::Edge ? "edge"
                                                                        : "face";
            return std::string("<") + kind + " " + std::string(py::repr(faces_of(n))) + ">";
        });
}

void bind_results(py::module_& m) {
    py::class_<NamedContact>(m, "Contact", "Entities of A and B that have points in common.")
        .def_property_readonly(
            "a", [](const NamedContact& c) { return c.a; }, "`EntityName`")
        .def_property_readonly(
            "b", [](const NamedContact& c) { return c.b; }, "`EntityName`")
        .def_property_readonly(
            "dimension", [](const NamedContact& c) { return static_cast<int>(c.dimension); },
            "0 points, 1 segments, 2 area.")
        .def_property_readonly(
            "opposite", [](const NamedContact& c) { return c.opposite; },
            "Of area: whether the outward normals are opposite.")
        .def("__repr__", [](const NamedContact& c) {
            return "<Contact: " + std::string(py::repr(py::cast(c.a))) + " " +
                   std::string(py::repr(py::cast(c.b))) + ">";
        });
    py::class_<SolidInterference>(m, "Interference", "What `interfere` found.")
        .def_property_readonly(
            "relation",
            [](const SolidInterference& i) { return enum_member("Relation", i.relation); },
            "`Relation`")
        .def_property_readonly(
            "contacts", [](const SolidInterference& i) { return i.contacts; },
            "List of `Contact`, if requested.")
        .def("__repr__", [](const SolidInterference& i) {
            return "<Interference: " + std::string(to_string(i.relation)) + ">";
        });
    py::class_<NamedDistance>(m, "Distance", "The distance of two boundaries, as an interval.")
        .def_property_readonly(
            "lower", [](const NamedDistance& d) { return d.lower; },
            "The distance is at least this.")
        .def_property_readonly(
            "upper", [](const NamedDistance& d) { return d.upper; },
            "The distance is at most this.")
        .def_property_readonly(
            "a", [](const NamedDistance& d) { return d.a; }, "`EntityName`")
        .def_property_readonly(
            "b", [](const NamedDistance& d) { return d.b; }, "`EntityName`")
        .def_property_readonly(
            "on_a", [](const NamedDistance& d) { return to_array(d.on_a); },
            "Near to the closest point of A, in the world.")
        .def_property_readonly(
            "on_b", [](const NamedDistance& d) { return to_array(d.on_b); },
            "Near to the closest point of B, in the world.")
        .def("__repr__", [](const NamedDistance& d) {
            return "<Distance: " + std::string(py::repr(py::float_(d.lower))) + " to " +
                   std::string(py::repr(py::float_(d.upper))) + ">";
        });
}

// A call with two placed solids.
template <class F>
auto placed(const py::object& pose_a, const py::object& pose_b, const F& f) {
    const Pose a = pose_of(pose_a, "pose_a");
    const Pose b = pose_of(pose_b, "pose_b");
    return run([&] { return f(a, b); });
}

}  // namespace

void bind_interference(py::module_& m) {
    bind_relation(m);
    bind_names(m);
    bind_results(m);
    m.def(
        "interfere",
        [](const Solid& a, const py::object& pose_a, const Solid& b, const py::object& pose_b,
           bool contacts) {
            return placed(pose_a, pose_b, [&](const Pose& p, const Pose& q) {
                return interfere(a, p, b, q, {.contacts = contacts});
            });
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"), py::kw_only(),
        py::arg("contacts") = false, R"(How solid A under its pose lies to solid B under its pose.

Exact for the poses as they are; nothing is moved or rounded.

Parameters
----------
a, b : Solid
pose_a, pose_b : Pose, array_like of shape (3, 4) or (4, 4), or None
contacts : bool
    Also list all pairs of faces, edges and vertices that meet.

Returns
-------
Interference

Raises
------
LimitError
    When the numbers of the poses are too wide for each other.
UnsupportedError
    For an unbounded solid.
)");
    m.def(
        "distance",
        [](const Solid& a, const py::object& pose_a, const Solid& b, const py::object& pose_b) {
            return placed(pose_a, pose_b, [&](const Pose& p, const Pose& q) {
                return boundary_distance(a, p, b, q);
            });
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
        "The `Distance` of the boundaries of two placed solids; None when one is empty.");
    m.def(
        "exact_squared_distance",
        [](const Solid& a, const py::object& pose_a, const Solid& b,
           const py::object& pose_b) -> py::object {
            const auto squared = placed(pose_a, pose_b, [&](const Pose& p, const Pose& q) {
                return exact_squared_distance(a, p, b, q);
            });
            return squared ? to_fraction(*squared) : py::none();
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
        "The square of the distance of two boundaries as a Fraction; None when one is empty.");
    m.def(
        "are_nearer_than",
        [](const Solid& a, const py::object& pose_a, const Solid& b, const py::object& pose_b,
           double distance) {
            return placed(pose_a, pose_b, [&](const Pose& p, const Pose& q) {
                return are_nearer_than(a, p, b, q, distance);
            });
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"), py::arg("distance"),
        "Whether two boundaries are nearer than a distance, exactly.");
}

}  // namespace trisect::python
