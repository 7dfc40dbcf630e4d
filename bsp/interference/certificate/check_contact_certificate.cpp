// SPDX-License-Identifier: Apache-2.0
//
// The checker shares nothing with what decides. It has the corners of both boundaries, the
// coefficients of the motions, fractions, and Sturm's theorem: between two points that are no
// roots, a polynomial has as many distinct roots as its sequence of remainders loses changes of
// sign. Everything is seen from A, or from B; that neither becomes flat is shown first.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/certified_motion.h>
#include <trisect/bsp/interference/certificate/certified_time.h>
#include <trisect/bsp/interference/certificate/certified_walk.h>
#include <trisect/bsp/interference/contact_certificate.h>

namespace trisect::detail::certified {

namespace {

using ExactWalkRange = WalkRange<ExactRational>;

class ContactChecker {
public:
    ContactChecker(const ContactCertificate& c, const Brep& a, const Motion& motion_a,
                   const Brep& b, const Motion& motion_b)
        : c_(c), motion_a_(motion_a), motion_b_(motion_b), a_(a), b_(b) {}

    std::string run() {
        const Pose pose_a = motion_a_.pose_at(0);
        const Pose pose_b = motion_b_.pose_at(0);
        if (const auto refusal = check(c_.at_start, a_.brep(), pose_a, b_.brep(), pose_b))
            return "at the start: " + refusal->reason;
        const bool starts_apart = c_.at_start.relation == Relation::Disjoint;
        if (!c_.is_complete) return {};
        if (!c_.at_start.is_complete) return "the start is not proved";
        if (!starts_apart) return c_.is_contact ? "" : "the solids meet at the start";
        if (a_.brep().is_empty() || b_.brep().is_empty())
            return c_.is_contact ? "an empty solid touches nothing" : "";
        if (!a_.is_filled_by(c_.triangles_a) || !b_.is_filled_by(c_.triangles_b))
            return "the triangles do not fill the faces";
        const std::size_t pieces = std::max(motion_a_.piece_count(), motion_b_.piece_count());
        if (c_.is_contact ? c_.piece >= pieces || c_.freedom.size() != c_.piece + 1
                          : c_.freedom.size() != pieces)
            return "pieces of the motion are missing";
        for (std::size_t i = 0; i < c_.freedom.size(); ++i)
            if (std::string w = wrong_piece(i); !w.empty()) return w;
        return {};
    }

private:
    std::string wrong_piece(std::size_t i) {
        const Piece a = piece_of(motion_a_, i);
        const Piece b = piece_of(motion_b_, i);
        to_a_ = seen_from(a, b);
        to_b_ = seen_from(b, a);
        controls_.clear();
        is_last_ = c_.is_contact && i == c_.piece;
        ExactRational end(1);
        if (is_last_) {
            time_ = RootTime(c_.polynomial, c_.lower, c_.upper);
            if (std::string w = time_.wrong(); !w.empty()) return w;
            end = c_.upper;
        }
        if (!is_positive(to_a_.w, 0, end) || !is_positive(to_b_.w, 0, end))
            return "a solid becomes flat";
        if (is_last_ && !meet()) return "the triangles do not meet at the time of contact";
        return detail::certified::wrong_tree(
            c_.freedom[i],
            ExactWalkRange{0, c_.triangles_a.size(), 0, c_.triangles_b.size(), 0,
                           is_last_ ? c_.lower : end},
            [this](const FreedomNode& node, const ExactWalkRange& r) {
                return are_apart(r, node.separator) ? "" : "a plane does not separate";
            });
    }

    // ------------------------------------------------------------ the common point

    static bool is_of(const CertifiedTriangle& t, const std::array<VertexId, 2>& edge) {
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexId u = t.vertex[i];
            const VertexId v = t.vertex[(i + 1) % 3];
            if ((edge[0] == u && edge[1] == v) || (edge[0] == v && edge[1] == u)) return true;
        }
        return false;
    }
    static bool contains(const std::vector<CertifiedTriangle>& all, const CertifiedTriangle& t) {
        return std::ranges::any_of(all, [&t](const CertifiedTriangle& u) {
            return u.face == t.face && u.vertex == t.vertex;
        });
    }
    static bool has(const CertifiedTriangle& t, VertexId v) {
        return std::ranges::find(t.vertex, v) != t.vertex.end();
    }
    [[nodiscard]] bool meet() const {
        const CommonPoint& p = c_.common_point;
        if (!contains(c_.triangles_a, p.triangle_a) || !contains(c_.triangles_b, p.triangle_b))
            return false;
        switch (p.kind) {
            case CommonPoint::Kind::VertexOfB:
                return has(p.triangle_b, p.vertex_b) &&
                       is_on(to_a_.point(b_.at(p.vertex_b)), to_a_.w, p.triangle_a, a_);
            case CommonPoint::Kind::VertexOfA:
                return has(p.triangle_a, p.vertex_a) &&
                       is_on(to_b_.point(a_.at(p.vertex_a)), to_b_.w, p.triangle_b, b_);
            default:
                return is_of(p.triangle_a, p.edge_a) && is_of(p.triangle_b, p.edge_b) &&
                       edges_cross(p);
        }
    }
    // Whether x / w is on the triangle.
    [[nodiscard]] bool is_on(const PolynomialVector& x, const Polynomial& w,
                             const CertifiedTriangle& t, const Boundary& boundary) const {
        std::array<ExactPoint, 3> c;
        for (std::size_t i = 0; i < 3; ++i) c[i] = boundary.at(t.vertex[i]);
        const ExactPoint n = cross(minus(c[1], c[0]), minus(c[2], c[0]));
        if (is_zero(n)) return false;
        const auto from = [&](std::size_t i) { return x - w * constant(c[i]); };
        if (!time_.is_root_of(dot(constant(n), from(0)))) return false;
        for (std::size_t i = 0; i < 3; ++i) {
            const ExactPoint inward = cross(n, minus(c[(i + 1) % 3], c[i]));
            const int s = time_.sign_of(dot(constant(inward), from(i)));
            if (s != 0 && s != 1) return false;
        }
        return true;
    }
    [[nodiscard]] bool edges_cross(const CommonPoint& p) const {
        const ExactPoint a0 = a_.at(p.edge_a[0]);
        const ExactPoint a1 = a_.at(p.edge_a[1]);
        const ExactPoint b0 = b_.at(p.edge_b[0]);
        const ExactPoint b1 = b_.at(p.edge_b[1]);
        const PolynomialVector u = constant(minus(a1, a0));
        const PolynomialVector v = to_a_.direction(minus(b1, b0));
        const PolynomialVector n = cross(u, v);
        const PolynomialVector way = to_a_.point(b0) - to_a_.w * constant(a0);
        if (!time_.is_root_of(dot(n, way)) || time_.sign_of(dot(n, n)) != 1) return false;
        // The ends of each are not on one side of the other.
        const auto opposite = [this](const Polynomial& x, const Polynomial& y) {
            const int s = time_.sign_of(x);
            const int t = time_.sign_of(y);
            return s != 2 && t != 2 && s * t <= 0;
        };
        const PolynomialVector across_u = cross(n, u);
        const PolynomialVector across_v = cross(n, v);
        const PolynomialVector way_1 = to_a_.point(b1) - to_a_.w * constant(a0);
        const PolynomialVector back_1 = to_a_.w * constant(a1) - to_a_.point(b0);
        return opposite(dot(across_u, way), dot(across_u, way_1)) &&
               opposite(dot(across_v, PolynomialVector{} - way), dot(across_v, back_1));
    }

    // ------------------------------------------------------------ freedom

    // The last ranges of the last piece go on from the bracket to the contact, itself excluded.
    [[nodiscard]] bool goes_to_the_contact(const ExactWalkRange& r) const {
        return is_last_ && r.to == c_.lower;
    }
    [[nodiscard]] bool is_positive_in(const Polynomial& p, const ExactWalkRange& r) const {
        return goes_to_the_contact(r) ? time_.is_positive_before(p, r.from)
                                      : is_positive(p, r.from, r.to);
    }
    [[nodiscard]] bool are_apart(const ExactWalkRange& r, const MovingSeparator& s) {
        const auto of_a = corners_of_a(c_.triangles_a, r);
        const auto of_b = corners_of_b(c_.triangles_b, r);
        if (s.kind == MovingSeparator::Kind::Edges) return are_apart_by_edges(r, s, of_a, of_b);
        if (s.kind == MovingSeparator::Kind::OfA)
            return is_not_above(a_, of_a, s.plane) && stays_above(to_a_, b_, of_b, r, s.plane);
        SeparatingPlane turned;
        for (std::size_t k = 0; k < 3; ++k) turned.normal[k] = -s.plane.normal[k];
        turned.offset = -s.plane.offset;
        return is_not_above(b_, of_b, turned) && stays_above(to_b_, a_, of_a, r, turned);
    }
    static bool is_not_above(const Boundary& boundary, const std::vector<std::uint32_t>& corners,
                             const SeparatingPlane& plane) {
        const IntegerPlane p(plane);
        return std::ranges::all_of(
            corners, [&](std::uint32_t v) { return p.side_of(boundary.points()[v]) <= 0; });
    }
    // Bernstein coefficients first; polynomials of corners for which these say nothing.
    [[nodiscard]] bool stays_above(const Piece& map, const Boundary& boundary,
                                   const std::vector<std::uint32_t>& corners,
                                   const ExactWalkRange& r, const SeparatingPlane& plane) {
        const std::vector<IntegerPlane> planes = controls(map, r).planes(plane);
        return std::ranges::all_of(corners, [&](std::uint32_t v) {
            if (std::ranges::all_of(planes, [&](const IntegerPlane& p) {
                    return p.side_of(boundary.points()[v]) > 0;
                }))
                return true;
            const Polynomial height =
                dot(constant(plane.normal), map.point(boundary.at(VertexId(v)))) +
                Polynomial(plane.offset) * map.w;
            return is_positive_in(height, r);
        });
    }
    const ControlMaps& controls(const Piece& map, const ExactWalkRange& r) {
        const ExactRational& to = goes_to_the_contact(r) ? c_.upper : r.to;
        const auto key = std::make_tuple(&map == &to_a_, r.from, to);
        auto at = controls_.find(key);
        if (at == controls_.end()) at = controls_.emplace(key, ControlMaps(map, r.from, to)).first;
        return at->second;
    }
    [[nodiscard]] bool are_apart_by_edges(const ExactWalkRange& r, const MovingSeparator& s,
                                          const std::vector<std::uint32_t>& of_a,
                                          const std::vector<std::uint32_t>& of_b) const {
        for (const VertexId v : s.edge_a)
            if (v.index >= a_.points().size()) return false;
        for (const VertexId v : s.edge_b)
            if (v.index >= b_.points().size()) return false;
        const ExactPoint a0 = a_.at(s.edge_a[0]);
        const ExactPoint u = minus(a_.at(s.edge_a[1]), a0);
        const ExactPoint v = minus(b_.at(s.edge_b[1]), b_.at(s.edge_b[0]));
        PolynomialVector n = cross(constant(u), to_a_.direction(v));
        if (s.flipped) n = PolynomialVector{} - n;
        return std::ranges::all_of(of_a,
                                   [&](std::uint32_t x) {
                                       const Polynomial depth =
                                           dot(n, constant(minus(a0, a_.at(VertexId(x)))));
                                       return depth.is_zero() || is_positive_in(depth, r);
                                   }) &&
               std::ranges::all_of(of_b, [&](std::uint32_t x) {
                   return is_positive_in(
                       dot(n, to_a_.point(b_.at(VertexId(x))) - to_a_.w * constant(a0)), r);
               });
    }

    const ContactCertificate& c_;
    const Motion& motion_a_;
    const Motion& motion_b_;
    Boundary a_;
    Boundary b_;
    Piece to_a_;  // A sees B
    Piece to_b_;
    RootTime time_;
    bool is_last_ = false;  // the contact is in this piece
    std::map<std::tuple<bool, ExactRational, ExactRational>, ControlMaps> controls_;
};

}  // namespace

}  // namespace trisect::detail::certified

namespace trisect {

std::optional<Refusal> check(const ContactCertificate& certificate, const Brep& a,
                             const Motion& motion_a, const Brep& b, const Motion& motion_b) {
    std::string reason =
        detail::certified::ContactChecker(certificate, a, motion_a, b, motion_b).run();
    if (reason.empty()) return std::nullopt;
    return Refusal{std::move(reason)};
}

}  // namespace trisect
