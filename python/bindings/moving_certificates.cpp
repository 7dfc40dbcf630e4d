// SPDX-License-Identifier: Apache-2.0
//
// Certificates of first contacts and first overlaps of moving solids.

#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/interference/contact_certificate.h>
#include <trisect/bsp/interference/enclosed_certificate.h>
#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/overlap_certificate.h>

#include "bind.h"
#include "certificates.h"
#include "fractions.h"

namespace trisect::python {

namespace {

using HeldContact = HeldCertificate<ContactCertificate, Motion>;
using HeldOverlap = HeldCertificate<OverlapCertificate, Motion>;
using HeldEnclosed = HeldCertificate<EnclosedCertificate, EnclosedMotion>;

// The exact time of an event: an interval of the parameter and a polynomial whose only root there
// it is; times within a piece begin at 0.
template <class C>
py::object bracket_of(const C& certificate, bool is_event) {
    if (!is_event) return py::none();
    const ExactRational start(static_cast<std::int64_t>(certificate.piece));
    return py::make_tuple(to_fraction(start + certificate.lower),
                          to_fraction(start + certificate.upper));
}

py::list polynomial_of(const std::vector<ExactRational>& coefficients) {
    py::list out;
    for (const ExactRational& c : coefficients) out.append(to_fraction(c));
    return out;
}

template <class Nodes>
std::size_t node_count(const std::vector<Nodes>& trees) {
    std::size_t n = 0;
    for (const Nodes& tree : trees) n += tree.size();
    return n;
}

void bind_contact_certificate(py::module_& m) {
    auto c = certificate_class<ContactCertificate, Motion>(
        m, "ContactCertificate",
        R"(A proof of the first contact of two moving solids, or that there is none.

A bracket of a root, features that meet there, and a tree over time and both boundaries whose leaves
are moving planes that separate triangles up to the contact.
)");
    c.def_property_readonly(
         "is_contact", [](const HeldContact& h) { return h.certificate.is_contact; },
         "Whether there is a contact.")
        .def_property_readonly(
            "time",
            [](const HeldContact& h) {
                return bracket_of(h.certificate, h.certificate.is_contact);
            },
            "Two Fractions between which the parameter of the contact is; None without one.")
        .def_property_readonly(
            "polynomial",
            [](const HeldContact& h) { return polynomial_of(h.certificate.polynomial); },
            R"(Fractions, the constant first: the polynomial whose only root in `time` is the contact.

In the parameter within its piece, which begins at 0.
)")
        .def_property_readonly(
            "node_count", [](const HeldContact& h) { return node_count(h.certificate.freedom); },
            "Of the trees.");
    m.def(
        "certify_first_contact",
        [](const Solid& a, const Motion& motion_a, const Solid& b, const Motion& motion_b,
           std::size_t max_nodes) {
            return held<ContactCertificate>(
                a, motion_a, b, motion_b,
                [&](const auto& x, const Motion& p, const auto& y, const Motion& q) {
                    return certify_first_contact(x, p, y, q, max_nodes);
                });
        },
        py::arg("a"), py::arg("motion_a"), py::arg("b"), py::arg("motion_b"), py::kw_only(),
        py::arg("max_nodes") = 200000,
        R"(The first touch of moving solids with a proof that fractions alone can check.

Costs a hundred times the answer. It may stay incomplete where solids come together in a way for
which no plane of a few kinds separates their triangles up to the end.

Parameters
----------
a, b : Solid
motion_a, motion_b : Motion
max_nodes : int
    After so many it stays incomplete.

Returns
-------
ContactCertificate
)");
}

void bind_overlap_certificate(py::module_& m) {
    auto c = certificate_class<OverlapCertificate, Motion>(
        m, "OverlapCertificate",
        R"(A proof of the time from which on interiors meet, or that they never do.

Contacts on the way are no obstacle: solids may slide along each other.
)");
    c.def_property_readonly(
         "is_overlap", [](const HeldOverlap& h) { return h.certificate.is_overlap; },
         "Whether interiors meet at any time.")
        .def_property_readonly(
            "missing", [](const HeldOverlap& h) { return h.certificate.missing; },
            "Why it is not complete, or an empty string.")
        .def_property_readonly(
            "time",
            [](const HeldOverlap& h) {
                return bracket_of(h.certificate, h.certificate.is_overlap);
            },
            "Two Fractions between which the parameter of the event is; None without one.")
        .def_property_readonly(
            "polynomial",
            [](const HeldOverlap& h) { return polynomial_of(h.certificate.polynomial); },
            "As that of `ContactCertificate`; empty for an event at the beginning of a piece.")
        .def_property_readonly(
            "node_count", [](const HeldOverlap& h) { return node_count(h.certificate.clearance); },
            "Of the trees.");
    m.def(
        "certify_first_overlap",
        [](const Solid& a, const Motion& motion_a, const Solid& b, const Motion& motion_b,
           std::size_t max_nodes) {
            return held<OverlapCertificate>(
                a, motion_a, b, motion_b,
                [&](const auto& x, const Motion& p, const auto& y, const Motion& q) {
                    return certify_first_overlap(x, p, y, q, max_nodes);
                });
        },
        py::arg("a"), py::arg("motion_a"), py::arg("b"), py::arg("motion_b"), py::kw_only(),
        py::arg("max_nodes") = 20000,
        R"(The first overlap of moving solids with a proof that fractions alone can check.

Parameters
----------
a, b : Solid
motion_a, motion_b : Motion
max_nodes : int
    Of each piece; after so many it stays incomplete.

Returns
-------
OverlapCertificate
)");
}

void bind_enclosed_contact_certificate(py::module_& m) {
    auto c = certificate_class<EnclosedCertificate, EnclosedMotion>(
        m, "EnclosedContactCertificate",
        R"(A proof of the first contact of enclosed motions.

No contact in spans of time, by planes at rest in the world; and a point inside both solids at the
time of contact, deeper than the enclosures deviate.
)");
    c.def_property_readonly(
         "free",
         [](const HeldEnclosed& h) {
             py::list spans;
             for (const FreeSpan& s : h.certificate.free)
                 spans.append(py::make_tuple(s.span.from, s.span.to));
             return spans;
         },
         "Spans of time (from, to) in which the solids have no point in common.")
        .def_property_readonly(
            "free_until", [](const HeldEnclosed& h) { return h.certificate.answer.free_until; },
            "As that of `EnclosedContact`.")
        .def_property_readonly(
            "contact_by", [](const HeldEnclosed& h) { return h.certificate.answer.contact_by; },
            "As that of `EnclosedContact`.")
        .def_property_readonly(
            "in_both",
            [](const HeldEnclosed& h) -> py::object {
                const auto& point = h.certificate.in_both;
                return point ? py::object(to_fractions(*point)) : py::none();
            },
            "A point inside both solids at `contact_by`, as three Fractions, or None.");
    m.def(
        "certify_enclosed_contact",
        [](const Solid& a, const EnclosedMotion& motion_a, const Solid& b,
           const EnclosedMotion& motion_b, double width, std::size_t max_nodes) {
            EnclosedContactOptions options;
            options.width = width;
            return held<EnclosedCertificate>(a, motion_a, b, motion_b,
                                             [&](const auto& x, const EnclosedMotion& p,
                                                 const auto& y, const EnclosedMotion& q) {
                                                 return certify_enclosed_contact(
                                                     x, p, y, q, options, max_nodes);
                                             });
        },
        py::arg("a"), py::arg("motion_a"), py::arg("b"), py::arg("motion_b"), py::kw_only(),
        py::arg("width") = 1e-9, py::arg("max_nodes") = 200000,
        R"(The first contact of enclosed motions with a proof.

It trusts the motions' enclosures. Costs some hundred times the answer.

Parameters
----------
a, b : Solid
motion_a, motion_b : EnclosedMotion
width : float
max_nodes : int
    Of each span of time; after so many it stays incomplete.

Returns
-------
EnclosedContactCertificate
)");
}

}  // namespace

void bind_moving_certificates(py::module_& m) {
    bind_contact_certificate(m);
    bind_overlap_certificate(m);
    bind_enclosed_contact_certificate(m);
}

}  // namespace trisect::python
