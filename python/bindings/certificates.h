// SPDX-License-Identifier: Apache-2.0
//
// A certificate, together with what it is about.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>

#include "run.h"

namespace trisect::python {

namespace py = pybind11;

/// A certificate of library type C about two solids that are placed, or move, as `Placement` says.
/// Vertices and faces are those of the models' boundaries.
template <class C, class Placement>
struct HeldCertificate {
    C certificate;
    InterferenceModel a;
    InterferenceModel b;
    Placement placement_a;
    Placement placement_b;
};

/// What `find` returns for the models of two solids.
template <class C, class Placement, class Find>
HeldCertificate<C, Placement> held(const Solid& a, Placement placement_a, const Solid& b,
                                   Placement placement_b, const Find& find) {
    return run([&] {
        HeldCertificate<C, Placement> made{{},
                                           InterferenceModel(a),
                                           InterferenceModel(b),
                                           std::move(placement_a),
                                           std::move(placement_b)};
        made.certificate = find(made.a, made.placement_a, made.b, made.placement_b);
        return made;
    });
}

/// The class of such a certificate, with what all of them have.
template <class C, class Placement>
py::class_<HeldCertificate<C, Placement>> certificate_class(py::module_& m, const char* name,
                                                            const char* doc) {
    using Held = HeldCertificate<C, Placement>;
    py::class_<Held> c(m, name, doc);
    c.def_property_readonly(
         "is_complete", [](const Held& h) { return h.certificate.is_complete; },
         "Whether it proves the whole answer.")
        .def(
            "check",
            [](const Held& h) -> std::optional<std::string> {
                const auto refusal = run([&] {
                    return check(h.certificate, h.a.brep(), h.placement_a, h.b.brep(),
                                 h.placement_b);
                });
                return refusal ? std::optional(refusal->reason) : std::nullopt;
            },
            R"(Why the certificate does not hold; None where it does.

Nothing of what found it is used: only the boundaries and fractions. An incomplete certificate
holds when all it contains does.
)")
        .def("__repr__", [name = std::string(name)](const Held& h) {
            return "<" + name + (h.certificate.is_complete ? ">" : ": incomplete>");
        });
    return c;
}

void bind_static_certificates(py::module_& m);
void bind_moving_certificates(py::module_& m);

}  // namespace trisect::python
