// SPDX-License-Identifier: Apache-2.0
//
// Validation with typed findings.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/brep/validate/validate.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "run.h"

namespace trisect::python {

namespace {

void bind_kinds(py::module_& m) {
    bind_enum(m, "Severity", "How bad a `Finding` is: a mesh with an ERROR bounds no solid.",
              std::vector<EnumMember>{{"WARNING", static_cast<int>(Severity::Warning)},
                                      {"ERROR", static_cast<int>(Severity::Error)}});
    std::vector<EnumMember> kinds;
    for (std::size_t i = 0; i < defect_kind_count; ++i) {
        const auto kind = static_cast<DefectKind>(i);
        std::string name(name_of(kind));
        for (char& c : name)
            if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        kinds.emplace_back(std::move(name), static_cast<int>(kind));
    }
    bind_enum(m, "DefectKind", R"(What a `Finding` is about.

Names are those of the command in capitals: ``DefectKind.OPEN_EDGE`` is ``open_edge`` there.
)",
              kinds);
}

std::size_t count_of(const ValidationReport& report, const py::object& kind) {
    const py::module_ m = py::module_::import("trisect._trisect");
    if (py::isinstance(kind, m.attr("Severity")))
        return report.count(static_cast<Severity>(kind.cast<int>()));
    if (py::isinstance(kind, m.attr("DefectKind")))
        return report.count(static_cast<DefectKind>(kind.cast<int>()));
    throw py::type_error("kind: must be a DefectKind or a Severity");
}

py::tuple finding_state(const Defect& d) {
    return py::make_tuple(static_cast<int>(d.kind), d.vertices, d.faces, d.place, d.sentence);
}

Defect finding_of(const py::tuple& state) {
    return {static_cast<DefectKind>(state[0].cast<int>()),
            state[1].cast<std::vector<std::uint32_t>>(),
            state[2].cast<std::vector<std::uint32_t>>(), state[3].cast<Point3d>(),
            state[4].cast<std::string>()};
}

py::tuple report_state(const ValidationReport& report) {
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < defect_kind_count; ++i)
        counts.push_back(report.count(static_cast<DefectKind>(i)));
    return py::make_tuple(counts, py::cast(report.defects()), py::cast(report.lattice()));
}

// Where more were counted than listed, the list of that kind has reached the limit.
ValidationReport report_of(const py::tuple& state) {
    auto counts = state[0].cast<std::vector<std::size_t>>();
    const auto listed = state[1].cast<std::vector<Defect>>();
    std::array<std::size_t, defect_kind_count> of_kind{};
    for (const Defect& d : listed) ++of_kind[static_cast<std::size_t>(d.kind)];
    ValidationReport report(*std::max_element(of_kind.begin(), of_kind.end()));
    for (const Defect& d : listed) {
        report.add(d.kind, [&] { return d; });
        --counts[static_cast<std::size_t>(d.kind)];
    }
    for (std::size_t i = 0; i < defect_kind_count; ++i)
        for (; counts[i] != 0; --counts[i])
            report.add(static_cast<DefectKind>(i), [] { return Defect(); });
    report.set_lattice(state[2].cast<LatticeReport>());
    return report;
}

void bind_findings(py::module_& m) {
    py::class_<Defect>(m, "Finding", "A defect of a mesh with its place.")
        .def_property_readonly(
            "kind", [](const Defect& d) { return enum_member("DefectKind", d.kind); },
            "`DefectKind`")
        .def_property_readonly(
            "severity", [](const Defect& d) { return enum_member("Severity", d.severity()); },
            "`Severity`")
        .def_property_readonly(
            "vertices", [](const Defect& d) { return d.vertices; },
            "Numbers of vertices (list of int).")
        .def_property_readonly(
            "faces", [](const Defect& d) { return d.faces; }, "Numbers of faces (list of int).")
        .def_property_readonly(
            "place", [](const Defect& d) { return to_array(d.place); },
            "A point where it is, array of shape (3,).")
        .def_property_readonly(
            "sentence", [](const Defect& d) { return d.sentence; }, "The finding in words.")
        .def(py::pickle(&finding_state, &finding_of))
        .def("__repr__", [](const Defect& d) {
            return "<Finding " + std::string(name_of(d.kind)) + ": " + d.sentence + ">";
        });
    py::class_<ValidationReport>(m, "Report", R"(What `check` found.

Counts are of all findings; of each kind at most a hundred are listed.
)")
        .def_property_readonly("findings", &ValidationReport::defects, "List of `Finding`.")
        .def_property_readonly("is_solid", &ValidationReport::is_solid,
                               "Whether there is no finding of severity ERROR.")
        .def_property_readonly(
            "rounding", [](const ValidationReport& r) { return r.lattice(); },
            "The `Rounding` of coordinates that span too many bits; findings are of what is left.")
        .def("count", &count_of, py::arg("kind"),
             "How many findings of a `DefectKind` or a `Severity` there are.")
        .def(
            "__bool__", [](const ValidationReport& r) { return !r.empty(); },
            "Whether anything was found.")
        .def(py::pickle(&report_state, &report_of))
        .def("__str__", [](const ValidationReport& r) { return r.to_string(); })
        .def("__repr__", [](const ValidationReport& r) {
            return "<Report: " + std::to_string(r.count(Severity::Error)) + " errors, " +
                   std::to_string(r.count(Severity::Warning)) + " warnings>";
        });
}

}  // namespace

void bind_check(py::module_& m) {
    bind_kinds(m);
    bind_findings(m);
    m.def(
        "check",
        [](const py::object& vertices, const py::object& faces, bool self_intersection,
           std::size_t list_limit) {
            const PolygonMesh mesh =
                faces.is_none() ? mesh_of_pair(vertices, "check") : mesh_of(vertices, faces);
            ValidateOptions options;
            options.self_intersection = self_intersection;
            options.list_limit = list_limit;
            return run([&] { return validate(mesh, options); });
        },
        py::arg("vertices"), py::arg("faces") = py::none(), py::kw_only(),
        py::arg("self_intersection") = true, py::arg("list_limit") = 100,
        R"(Finds what keeps a mesh from bounding a solid.

Everything is decided exactly: open edges, flipped, degenerate and duplicate faces, vertices
and edges that are not manifold, self-intersection, nesting of shells.

Parameters
----------
vertices : array_like, shape (n, 3)
    Or a pair (vertices, faces), or an object that has both as attributes.
faces : array_like, shape (m, 3) or (m, k), or sequence of sequences
    Indices of vertices, counter-clockwise seen from outside.
self_intersection : bool
    Whether to look for faces that cross or overlap, which takes longest.
list_limit : int
    How many findings of each kind are listed. All are counted.

Returns
-------
Report
)");
}

}  // namespace trisect::python
