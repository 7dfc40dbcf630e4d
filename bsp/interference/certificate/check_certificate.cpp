// SPDX-License-Identifier: Apache-2.0
//
// The checker shares nothing with what decides: it has the vertices, loops and shells of the two
// boundaries, the numbers of the poses, and fractions. Operations on a boundary are in
// certified_boundary.h, partitions of space are in certified_cells.h.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/certified_cells.h>
#include <trisect/bsp/interference/certificate/certified_walk.h>
#include <trisect/bsp/interference/interference_certificate.h>

namespace trisect::detail::certified {

namespace {

class RelationChecker {
public:
    RelationChecker(const InterferenceCertificate& c, const Brep& a, const Pose& pose_a,
                    const Brep& b, const Pose& pose_b)
        : c_(c), a_(a, pose_a), b_(b, pose_b) {}

    std::string run() {
        if (a_.brep().is_empty() || b_.brep().is_empty())
            return c_.relation == Relation::Disjoint ? "" : "an empty solid is disjoint";
        if (std::string wrong = wrong_points(); !wrong.empty()) return wrong;
        if (c_.plane && !separates(*c_.plane)) return "the plane does not separate the solids";
        if (!c_.apart.empty() || !c_.cells.empty())
            if (!a_.is_filled_by(c_.triangles_a) || !b_.is_filled_by(c_.triangles_b))
                return "the triangles do not fill the faces";
        if (!c_.apart.empty())
            if (std::string wrong = wrong_apart(); !wrong.empty()) return wrong;
        if (!c_.cells.empty())
            if (std::string wrong = wrong_cells(c_, a_, b_); !wrong.empty()) return wrong;
        if (std::string wrong = contradiction(); !wrong.empty()) return wrong;
        return c_.is_complete ? missing() : "";
    }

private:
    static bool is(const Boundary& boundary, const std::optional<ExactPoint>& p, Where where) {
        return !p || boundary.locate(*p) == where;
    }
    std::string wrong_points() const {
        if (!is(a_, c_.in_both, Where::Inside) || !is(b_, c_.in_both, Where::Inside))
            return "a point is not inside both";
        if (!is(a_, c_.only_in_a, Where::Inside) || !is(b_, c_.only_in_a, Where::Outside))
            return "a point is not inside A alone";
        if (!is(a_, c_.only_in_b, Where::Outside) || !is(b_, c_.only_in_b, Where::Inside))
            return "a point is not inside B alone";
        if (!is(a_, c_.on_both, Where::Boundary) || !is(b_, c_.on_both, Where::Boundary))
            return "a point is not on both boundaries";
        return {};
    }
    bool separates(const SeparatingPlane& separating) const {
        if (is_zero(separating.normal)) return false;
        const IntegerPlane plane(separating);
        return std::ranges::all_of(a_.points(),
                                   [&](const IntegerPoint& p) { return plane.side_of(p) <= 0; }) &&
               std::ranges::all_of(b_.points(),
                                   [&](const IntegerPoint& p) { return plane.side_of(p) >= 0; });
    }
    std::string wrong_apart() const {
        return detail::certified::wrong_tree(
            c_.apart, WalkRange<NoTime>{0, c_.triangles_a.size(), 0, c_.triangles_b.size(), {}, {}},
            [this](const ApartNode& node, const WalkRange<NoTime>& r) {
                const IntegerPlane plane(node.plane);
                return are_beside(plane, a_, corners_of_a(c_.triangles_a, r), -1) &&
                               are_beside(plane, b_, corners_of_b(c_.triangles_b, r), 1)
                           ? ""
                           : "a plane of the tree does not separate";
            });
    }
    static bool are_beside(const IntegerPlane& plane, const Boundary& boundary,
                           const std::vector<std::uint32_t>& corners, int sign) {
        return std::ranges::all_of(
            corners, [&](std::uint32_t v) { return plane.side_of(boundary.points()[v]) == sign; });
    }

    // What the parts say together, against the relation claimed.
    std::string contradiction() const {
        const Relation r = c_.relation;
        const bool interiors_meet = r != Relation::Disjoint && r != Relation::Touching;
        if (c_.in_both && !interiors_meet) return "interiors meet";
        if (c_.plane && interiors_meet) return "a plane separates the solids";
        if (c_.only_in_a && (r == Relation::Inside || r == Relation::Equal))
            return "a point of A is outside B";
        if (c_.only_in_b && (r == Relation::Contains || r == Relation::Equal))
            return "a point of B is outside A";
        if (c_.on_both && r == Relation::Disjoint) return "the boundaries meet";
        if (!c_.cells.empty() && (r == Relation::Overlapping || r == Relation::Equal))
            return "cells say nothing about such solids";
        return {};
    }

    std::string missing() {
        switch (c_.relation) {
            case Relation::Touching:
                if (!c_.on_both) return "no common point";
                return c_.plane || !c_.cells.empty() ? "" : "no proof that interiors are apart";
            case Relation::Overlapping:
                return c_.in_both && c_.only_in_a && c_.only_in_b ? "" : "points are missing";
            case Relation::Equal:
                return a_.outlines() == b_.outlines() ? "" : "the boundaries are different";
            case Relation::Inside:
                if (c_.cells.empty()) return shells_say();
                return c_.only_in_b ? "" : "no point of B alone";
            case Relation::Contains:
                if (c_.cells.empty()) return shells_say();
                return c_.only_in_a ? "" : "no point of A alone";
            default:
                return shells_say();
        }
    }
    // Boundaries that are apart: each shell is inside or outside as a whole.
    std::string shells_say() {
        if (c_.apart.empty()) return "no proof that the boundaries are apart";
        bool a_in = false;
        bool a_out = false;
        bool b_in = false;
        const auto look = [](const Boundary& these, const Boundary& other, bool& in, bool& out) {
            const Brep& brep = these.brep();
            for (const ShellId s : brep.shells()) {
                const FaceId f = brep.faces(s).front();
                const Where w =
                    other.locate(these.at(brep.origin(brep.halfedges(brep.outer_loop(f))[0])));
                in = in || w == Where::Inside;
                out = out || w == Where::Outside;
                if (w == Where::Boundary || w == Where::Unknown) return false;
            }
            return true;
        };
        bool b_out = false;
        if (!look(a_, b_, a_in, a_out) || !look(b_, a_, b_in, b_out))
            return "a shell that could not be located";
        Relation found = Relation::Overlapping;
        if (!a_in && !b_in)
            found = Relation::Disjoint;
        else if (!a_out && !b_in)
            found = Relation::Inside;
        else if (!b_out && !a_in)
            found = Relation::Contains;
        return found == c_.relation ? "" : "the shells lie otherwise";
    }

    const InterferenceCertificate& c_;
    Boundary a_;
    Boundary b_;
};

}  // namespace

}  // namespace trisect::detail::certified

namespace trisect {

std::optional<Refusal> check(const InterferenceCertificate& certificate, const Brep& a,
                             const Pose& pose_a, const Brep& b, const Pose& pose_b) {
    std::string reason =
        detail::certified::RelationChecker(certificate, a, pose_a, b, pose_b).run();
    if (reason.empty()) return std::nullopt;
    return Refusal{std::move(reason)};
}

}  // namespace trisect
