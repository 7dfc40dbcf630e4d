// SPDX-License-Identifier: Apache-2.0
//
// Certificates of relations and distances. All they contain is handed out as fractions, so that a
// program of the user can check them.

#include "certificates.h"

#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/interference/distance_certificate.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "fractions.h"
#include "poses.h"

namespace trisect::python {

namespace {

using HeldRelation = HeldCertificate<InterferenceCertificate, Pose>;
using HeldDistance = HeldCertificate<DistanceCertificate, Pose>;

py::object optional_point(const std::optional<ExactPoint>& point) {
    return point ? py::object(to_fractions(*point)) : py::none();
}

py::tuple plane_tuple(const SeparatingPlane& plane) {
    return py::make_tuple(to_fraction(plane.normal[0]), to_fraction(plane.normal[1]),
                          to_fraction(plane.normal[2]), to_fraction(plane.offset));
}

ExactPoint exact_position(const Point& point, Lattice lattice) {
    const HomogeneousPoint h = point.homogeneous();
    ExactPoint exact;
    for (std::size_t i = 0; i < 3; ++i)
        exact[i] = (ExactRational(h.xyz[i]) / ExactRational(h.w)).scaled(lattice.exponent);
    return exact;
}

// Corners of each triangle, before the pose, in the user's units.
py::list corners_of(const std::vector<CertifiedTriangle>& triangles, const Brep& brep) {
    py::list out;
    for (const CertifiedTriangle& t : triangles) {
        py::tuple corners(3);
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = to_fractions(exact_position(brep.point(t.vertex[i]), brep.lattice()));
        out.append(corners);
    }
    return out;
}

py::list nodes_of(const std::vector<ApartNode>& nodes) {
    using Kind = ApartNode::Kind;
    py::list out;
    for (const ApartNode& n : nodes) {
        if (n.kind == Kind::Separated) {
            out.append(py::make_tuple("plane", plane_tuple(n.plane)));
        } else {
            out.append(py::make_tuple(n.kind == Kind::SplitA ? "split_a" : "split_b", n.other));
        }
    }
    return out;
}

py::list nodes_of(const std::vector<SlabNode>& nodes) {
    using Kind = SlabNode::Kind;
    py::list out;
    for (const SlabNode& n : nodes) {
        if (n.kind == Kind::Separated) {
            out.append(py::make_tuple(
                "slab", py::make_tuple(to_fractions(n.slab.normal), to_fraction(n.slab.below),
                                       to_fraction(n.slab.above))));
        } else {
            out.append(py::make_tuple(n.kind == Kind::SplitA ? "split_a" : "split_b", n.other));
        }
    }
    return out;
}

py::list cells_of(const std::vector<CertifiedCell>& cells) {
    using Kind = CertifiedCell::Kind;
    py::list out;
    for (const CertifiedCell& c : cells) {
        if (c.kind == Kind::Split) {
            out.append(py::make_tuple("split", plane_tuple(c.plane), c.other));
        } else {
            out.append(py::make_tuple(c.kind == Kind::WithoutA ? "without_a" : "without_b",
                                      to_fractions(c.point)));
        }
    }
    return out;
}

template <class Held>
void bind_triangles(py::class_<Held>& c) {
    c.def(
         "triangles_a",
         [](const Held& h) { return corners_of(h.certificate.triangles_a, h.a.brep()); },
         R"(The triangles of A's boundary in the order of the tree's ranges.

Three corners each, three Fractions a corner, before the pose.
)")
        .def(
            "triangles_b",
            [](const Held& h) { return corners_of(h.certificate.triangles_b, h.b.brep()); },
            "The same of B.");
}

void bind_relation_certificate(py::module_& m) {
    auto c = certificate_class<InterferenceCertificate, Pose>(
        m, "RelationCertificate",
        R"(A proof of how two placed solids lie to each other.

What proves a relation:

* disjoint: `apart`, and every shell outside the other solid
* touching: `on_both`; and `plane` between the solids, or `cells`, each outside of one of them
* overlapping: `in_both`, `only_in_a`, `only_in_b`
* inside: `only_in_b`; and `apart`, or `cells`, each outside of A or inside of B
* contains: the same with A and B exchanged
* equal: nothing, since the boundaries are the same

Points and planes are in the world, as Fractions.
)");
    c.def_property_readonly(
         "relation",
         [](const HeldRelation& h) { return enum_member("Relation", h.certificate.relation); },
         "`Relation`")
        .def_property_readonly(
            "in_both", [](const HeldRelation& h) { return optional_point(h.certificate.in_both); },
            "A point strictly inside both solids, or None.")
        .def_property_readonly(
            "only_in_a",
            [](const HeldRelation& h) { return optional_point(h.certificate.only_in_a); },
            "A point strictly inside A and strictly outside B, or None.")
        .def_property_readonly(
            "only_in_b",
            [](const HeldRelation& h) { return optional_point(h.certificate.only_in_b); },
            "A point strictly inside B and strictly outside A, or None.")
        .def_property_readonly(
            "on_both", [](const HeldRelation& h) { return optional_point(h.certificate.on_both); },
            "A point of both boundaries, or None.")
        .def_property_readonly(
            "plane",
            [](const HeldRelation& h) -> py::object {
                const auto& plane = h.certificate.plane;
                return plane ? py::object(plane_tuple(*plane)) : py::none();
            },
            "(a, b, c, d): a x + b y + c z + d is at most 0 in A and at least 0 in B; or None.")
        .def(
            "apart", [](const HeldRelation& h) { return nodes_of(h.certificate.apart); },
            R"(A tree that proves that no triangle of A meets one of B.

A node is ``("plane", (a, b, c, d))``, with all corners of its triangles of A strictly below and those
of B strictly above; or ``("split_a", other)`` or ``("split_b", other)``, which halves its range of A's
or B's triangles, the first half rounded down: children are the next node and ``other``.
)")
        .def(
            "cells", [](const HeldRelation& h) { return cells_of(h.certificate.cells); },
            R"(A partition of space, the whole first.

A cell is ``("split", (a, b, c, d), other)``, with the part below the plane next and the part above at
``other``; or ``("without_a", point)`` or ``("without_b", point)``, without a piece of that boundary
inside it, where the point, strictly inside the cell, says on which side of it the cell is.
)");
    bind_triangles(c);
}

void bind_certify_relation(py::module_& m) {
    m.def(
        "certify_relation",
        [](const Solid& a, const py::object& pose_a, const Solid& b, const py::object& pose_b) {
            return held<InterferenceCertificate>(
                a, pose_of(pose_a, "pose_a"), b, pose_of(pose_b, "pose_b"),
                [](const auto& x, const Pose& p, const auto& y, const Pose& q) {
                    return certify_relation(x, p, y, q);
                });
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
        R"(The relation of two placed solids with a proof that fractions alone can check.

Costs a B-rep of each solid and some milliseconds, or 0.1 ms for each cell.

Parameters
----------
a, b : Solid
pose_a, pose_b : Pose, array_like of shape (3, 4) or (4, 4), or None

Returns
-------
RelationCertificate
    Complete but where large boundaries touch all over.
)");
}

void bind_distance_certificate(py::module_& m) {
    auto c = certificate_class<DistanceCertificate, Pose>(
        m, "DistanceCertificate",
        "A proof of the distance of two boundaries: two points, and slabs between all triangles.");
    c.def_property_readonly(
         "squared", [](const HeldDistance& h) { return to_fraction(h.certificate.squared); },
         "The square of the distance as a Fraction.")
        .def_property_readonly(
            "on_a", [](const HeldDistance& h) { return to_fractions(h.certificate.on_a.point); },
            "A point of A's boundary, in the world, that is so near to `on_b`.")
        .def_property_readonly(
            "on_b", [](const HeldDistance& h) { return to_fractions(h.certificate.on_b.point); },
            "A point of B's boundary.")
        .def(
            "slabs", [](const HeldDistance& h) { return nodes_of(h.certificate.slabs); },
            R"(A tree as `RelationCertificate.apart`, of slabs instead of planes.

A leaf is ``("slab", (normal, below, above))``: normal·x is at most ``below`` for its triangles of A and at
least ``above`` for those of B.
)");
    bind_triangles(c);
    m.def(
        "certify_distance",
        [](const Solid& a, const py::object& pose_a, const Solid& b, const py::object& pose_b,
           std::size_t max_nodes) {
            return held<DistanceCertificate>(
                a, pose_of(pose_a, "pose_a"), b, pose_of(pose_b, "pose_b"),
                [&](const auto& x, const Pose& p, const auto& y, const Pose& q) {
                    return certify_distance(x, p, y, q, max_nodes);
                });
        },
        py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"), py::kw_only(),
        py::arg("max_nodes") = 1000000,
        R"(The exact distance of two boundaries with a proof that fractions alone can check.

Costs two to some hundred times the answer.

Parameters
----------
a, b : Solid
pose_a, pose_b : Pose, array_like of shape (3, 4) or (4, 4), or None
max_nodes : int
    After so many it stays incomplete.

Returns
-------
DistanceCertificate
)");
}

}  // namespace

void bind_static_certificates(py::module_& m) {
    bind_relation_certificate(m);
    bind_certify_relation(m);
    bind_distance_certificate(m);
}

void bind_certificates(py::module_& m) {
    bind_static_certificates(m);
    bind_moving_certificates(m);
}

}  // namespace trisect::python
