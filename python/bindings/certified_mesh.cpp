// SPDX-License-Identifier: Apache-2.0
//
// Meshes that provably bound a solid after their coordinates were rounded.

#include <string>
#include <utility>

#include <pybind11/stl.h>

#include <trisect/brep/certificate.h>
#include <trisect/bsp/certified_rounding.h>
#include <trisect/bsp/solid.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

using RoundingOutcome = CertifiedRounding::Outcome;

void bind_certificate_type(py::module_& m) {
    py::class_<Certificate>(m, "MeshCertificate",
                            "What is proved of a mesh, decided exactly for its coordinates.")
        .def_readonly("closed", &Certificate::closed, "Whether the faces' boundaries cancel.")
        .def_readonly("oriented", &Certificate::oriented,
                      "And the volume that they enclose is not negative.")
        .def_readonly("self_intersecting_pairs", &Certificate::self_intersecting_pairs,
                      R"(How many pairs of faces meet beyond corners and edges that they share.

None where that was not decided: coordinates span too many bits, or there are too many pairs.
)")
        .def_readonly("max_move", &Certificate::max_move,
                      "How far rounding moved a coordinate at most; 0 for a mesh as it is.")
        .def("__bool__", &Certificate::holds, "Whether it is proved that the mesh bounds a solid.")
        .def("__repr__", [](const Certificate& c) {
            return std::string("<MeshCertificate: ") +
                   (c.holds() ? "bounds a solid>" : "not proved to bound a solid>");
        });
}

py::tuple rounded_arrays(const CertifiedRounding& rounding) {
    PolygonMesh mesh = rounding.mesh;
    auto [vertices, faces] = triangle_arrays(std::move(mesh));
    return py::make_tuple(vertices, faces);
}

const char* outcome_text(RoundingOutcome outcome) {
    switch (outcome) {
        case RoundingOutcome::Plain:
            return "plain";
        case RoundingOutcome::Gridded:
            return "gridded";
        case RoundingOutcome::Repaired:
            return "repaired";
        case RoundingOutcome::Failed:
            break;
    }
    return "failed";
}

void bind_rounding_type(py::module_& m) {
    bind_enum(m, "RoundingOutcome", "How `Solid.certified_mesh` came to its mesh.",
              std::vector<EnumMember>{{"PLAIN", static_cast<int>(RoundingOutcome::Plain)},
                                      {"GRIDDED", static_cast<int>(RoundingOutcome::Gridded)},
                                      {"REPAIRED", static_cast<int>(RoundingOutcome::Repaired)},
                                      {"FAILED", static_cast<int>(RoundingOutcome::Failed)}});
    py::class_<CertifiedRounding>(m, "CertifiedMesh", "A rounded mesh and what is proved of it.")
        .def("mesh", &rounded_arrays, "Vertices and triangles, as `Solid.mesh`.")
        .def_property_readonly(
            "outcome",
            [](const CertifiedRounding& r) { return enum_member("RoundingOutcome", r.outcome); },
            R"(`RoundingOutcome`

PLAIN: correctly rounded coordinates are certified. GRIDDED: multiples of one unit are. REPAIRED: faces
that met were divided or resolved. FAILED: nothing is proved but `radius`.
)")
        .def_readonly("certificate", &CertifiedRounding::certificate, "`MeshCertificate`")
        .def_readonly("radius", &CertifiedRounding::radius,
                      "Every point farther than this from the exact boundary is on its exact side.")
        .def("__repr__", [](const CertifiedRounding& r) {
            return std::string("<CertifiedMesh: ") + outcome_text(r.outcome) + ">";
        });
}

Precision precision_of(const std::string& word) {
    if (word == "double") return Precision::Double;
    if (word == "float") return Precision::Float;
    throw UsageError("precision: must be 'double' or 'float', not '" + word + "'");
}

}  // namespace

void bind_certified_mesh(py::module_& m) {
    bind_certificate_type(m);
    bind_rounding_type(m);
    m.def(
        "certify",
        [](const py::object& vertices, const py::object& faces) {
            const PolygonMesh mesh =
                faces.is_none() ? mesh_of_pair(vertices, "certify") : mesh_of(vertices, faces);
            return run([&] { return certify(mesh); });
        },
        py::arg("vertices"), py::arg("faces") = py::none(),
        R"(Whether a mesh bounds a solid, exactly and quickly; `check` says where it does not.

Parameters
----------
vertices : array_like, shape (n, 3)
    Or a pair (vertices, faces), or an object that has both as attributes.
faces : array_like or sequence of sequences

Returns
-------
MeshCertificate
)");
    solid_class(m).def(
        "certified_mesh",
        [](const Solid& solid, const std::string& precision) {
            RoundingOptions options;
            options.precision = precision_of(precision);
            return run_on_threads([&](std::uint32_t threads) {
                options.evaluate.threads = threads;
                return certified_rounding(solid.to_brep(), options);
            });
        },
        py::kw_only(), py::arg("precision") = "double",
        R"(The boundary as triangles that provably bound a solid.

`mesh` rounds each coordinate once, and faces that lie closer than that may meet then. Here that is
decided exactly, and repaired where it happens.

Parameters
----------
precision : {'double', 'float'}
    'float' is for binary STL and what else has floats.

Returns
-------
CertifiedMesh
)");
}

}  // namespace trisect::python
