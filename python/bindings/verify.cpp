// SPDX-License-Identifier: Apache-2.0
//
// Certified comparison of a mesh with the exact result of a boolean.

#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/verify.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "fractions.h"
#include "run.h"

namespace trisect::python {

namespace {

BooleanOperation operation_of(const std::string& word) {
    for (const auto operation :
         {BooleanOperation::Union, BooleanOperation::Intersection, BooleanOperation::Difference,
          BooleanOperation::SymmetricDifference})
        if (word == to_string(operation)) return operation;
    throw UsageError("operation: must be 'union', 'intersection', 'difference' or 'xor', not '" +
                     word + "'");
}

py::tuple blamed_faces(const Witness& w) {
    py::tuple faces(w.faces.size());
    for (std::size_t i = 0; i < w.faces.size(); ++i)
        faces[i] = py::make_tuple(w.faces[i].mesh, w.faces[i].face);
    return faces;
}

void bind_witness(py::module_& m) {
    py::class_<Witness>(m, "VerifyWitness", "A point that one of two sets has and the other lacks.")
        .def_property_readonly(
            "point",
            [](const Witness& w) {
                return to_array(Point3d{w.point[0].to_double(), w.point[1].to_double(),
                                        w.point[2].to_double()});
            },
            "The point, rounded, array of shape (3,).")
        .def(
            "exact_point", [](const Witness& w) { return to_fractions(w.point); },
            "The point as three Fractions.")
        .def_property_readonly(
            "winding", [](const Witness& w) { return w.winding; },
            "Winding numbers of each operand about it, and last of the result.")
        .def_property_readonly(
            "in_exact", [](const Witness& w) { return w.in_exact; },
            "Whether the exact result has the point.")
        .def_property_readonly(
            "in_result", [](const Witness& w) { return w.in_result; },
            "Whether the mesh has the point.")
        .def_property_readonly("faces", &blamed_faces,
                               "(mesh, face) of faces around it; the result follows the operands.");
}

void bind_verify_report(py::module_& m) {
    bind_enum(m, "Verdict", "The answer of `verify`.",
              std::vector<EnumMember>{{"EQUAL", static_cast<int>(Verdict::Equal)},
                                      {"WITHIN", static_cast<int>(Verdict::Within)},
                                      {"DIFFERENT", static_cast<int>(Verdict::Different)},
                                      {"UNDECIDED", static_cast<int>(Verdict::Undecided)},
                                      {"NOT_CLOSED", static_cast<int>(Verdict::NotClosed)}});
    py::class_<VerifyReport>(m, "VerifyReport", "What `verify` proved.")
        .def_property_readonly(
            "verdict", [](const VerifyReport& r) { return enum_member("Verdict", r.verdict); },
            "`Verdict`")
        .def_property_readonly(
            "lower", [](const VerifyReport& r) { return r.lower; },
            "Some point is wrong by at least so much.")
        .def_property_readonly(
            "upper", [](const VerifyReport& r) { return r.upper; }, "No point is wrong by more.")
        .def_property_readonly(
            "witness", [](const VerifyReport& r) { return r.witness; },
            "`VerifyWitness` of a difference, else None.")
        .def_property_readonly(
            "result_inside_out", [](const VerifyReport& r) { return r.result_inside_out; },
            "Whether the result encloses a negative volume.")
        .def_property_readonly(
            "result_defects", [](const VerifyReport& r) { return r.result_defects; },
            "`Report` of a result that is not closed.")
        .def("__repr__", [](const VerifyReport& r) {
            return "<VerifyReport: " + std::string(to_string(r.verdict)) + ">";
        });
}

}  // namespace

void bind_verify(py::module_& m) {
    bind_witness(m);
    bind_verify_report(m);
    m.def(
        "verify",
        [](const std::string& operation, const py::iterable& operands, const py::object& result,
           std::optional<double> within) {
            std::vector<PolygonMesh> meshes;
            for (const py::handle operand : operands)
                meshes.push_back(
                    mesh_of_pair(py::reinterpret_borrow<py::object>(operand), "operands"));
            const PolygonMesh made = mesh_of_pair(result, "result");
            VerifyOptions options;
            options.within = within;
            const BooleanOperation what = operation_of(operation);
            return run_on_threads([&](std::uint32_t threads) {
                options.evaluate.threads = threads;
                return verify(what, meshes, made, options);
            });
        },
        py::arg("operation"), py::arg("operands"), py::arg("result"), py::kw_only(),
        py::arg("within") = py::none(),
        R"(Proves that a mesh is the result of a boolean, or names a point where it is not.

The mesh may come from any program.

Parameters
----------
operation : {'union', 'intersection', 'difference', 'xor'}
operands : iterable of (vertices, faces)
    Or of objects that have both as attributes.
result : (vertices, faces)
within : float, optional
    Whether the sets are equal up to this distance; without it, whether they are equal.

Returns
-------
VerifyReport
)");
}

}  // namespace trisect::python
