// SPDX-License-Identifier: Apache-2.0
//
// The checker shares nothing with what decides. It has the corners of both boundaries, the
// coefficients of the motions, fractions, and Sturm's theorem: between two points that are no
// roots, a polynomial has as many distinct roots as its sequence of remainders loses changes of
// sign.
//
// Everything is seen from A: B's point b is at X(s) / w(s) with
//     X = adj(M_A) (w_A (M_B b + t_B) - w_B t_A),  w = det(M_A) w_B,
// or from B, with the names exchanged. Determinants and weights are shown to have no roots first.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/contact_certificate.h>
#include <trisect/bsp/detail/certified_polynomial.h>
#include <trisect/bsp/detail/certified_triangles.h>

namespace trisect {

namespace {

using Vector = RationalPoint;

using detail::certified::common_divisor;
using detail::certified::constant;
using detail::certified::Piece;
using detail::certified::piece_of;
using detail::certified::Polynomial;
using detail::certified::PolynomialVector;
using detail::certified::roots_between;
using detail::certified::Rows;

Vector minus(const Vector& u, const Vector& v) { return {u[0] - v[0], u[1] - v[1], u[2] - v[2]}; }
ExactRational dot(const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
bool is_zero(const Vector& v) { return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0; }

// What one solid sees of the other: points are at (m x + t) / w.
struct Relative {
    Rows m;
    PolynomialVector t;
    Polynomial w;

    Relative(const Piece& viewer, const Piece& other) {
        // Rows of the adjugate are products of columns.
        const auto column = [&viewer](std::size_t j) {
            return PolynomialVector{viewer.m[0][j], viewer.m[1][j], viewer.m[2][j]};
        };
        const Rows adjugate{cross(column(1), column(2)), cross(column(2), column(0)),
                            cross(column(0), column(1))};
        Rows product;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                product[i][j] =
                    viewer.w * (adjugate[i][0] * other.m[0][j] + adjugate[i][1] * other.m[1][j] +
                                adjugate[i][2] * other.m[2][j]);
        m = product;
        t = adjugate * (viewer.w * other.t - other.w * viewer.t);
        w = dot(adjugate[0], column(0)) * other.w;
        if (w.is_zero() || w.sign_at(0) > 0) return;
        for (PolynomialVector& row : m) row = PolynomialVector{} - row;
        t = PolynomialVector{} - t;
        w = -w;
    }
    [[nodiscard]] PolynomialVector point(const Vector& x) const { return m * constant(x) + t; }
    [[nodiscard]] PolynomialVector direction(const Vector& v) const { return m * constant(v); }
};

// ---------------------------------------------------------------- the checker

class Checker {
public:
    Checker(const ContactCertificate& c, const Brep& a, const Motion& motion_a, const Brep& b,
            const Motion& motion_b)
        : c_(c),
          brep_a_(a),
          brep_b_(b),
          motion_a_(motion_a),
          motion_b_(motion_b),
          a_(detail::corners_in_world(a, Pose())),
          b_(detail::corners_in_world(b, Pose())) {}

    std::string run() {
        const Pose pose_a = motion_a_.pose_at(0);
        const Pose pose_b = motion_b_.pose_at(0);
        if (std::string w = check_certificate(c_.at_start, brep_a_, pose_a, brep_b_, pose_b);
            !w.empty())
            return "at the start: " + w;
        const bool starts_apart = c_.at_start.relation == Relation::Disjoint;
        if (!c_.is_complete) return {};
        if (!c_.at_start.is_complete) return "the start is not proved";
        if (!starts_apart) return c_.is_contact ? "" : "the solids meet at the start";
        if (brep_a_.is_empty() || brep_b_.is_empty())
            return c_.is_contact ? "an empty solid touches nothing" : "";
        if (!detail::triangles_fill_faces(c_.triangles_a, brep_a_) ||
            !detail::triangles_fill_faces(c_.triangles_b, brep_b_))
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
        to_a_.emplace(a, b);
        to_b_.emplace(b, a);
        is_last_ = c_.is_contact && i == c_.piece;
        end_ = ExactRational(1);
        if (is_last_) {
            if (std::string w = wrong_bracket(); !w.empty()) return w;
            end_ = c_.upper;
        }
        for (const Relative* r : {&*to_a_, &*to_b_})
            if (r->w.is_zero() || r->w.sign_at(0) == 0 || r->w.sign_at(end_) == 0 ||
                roots_between(r->w, 0, end_) != 0)
                return "a solid becomes flat";
        if (is_last_ && !meet()) return "the triangles do not meet at the time of contact";
        return wrong_freedom(c_.freedom[i]);
    }
    std::string wrong_bracket() {
        time_ = Polynomial(c_.polynomial);
        if (!(c_.lower < c_.upper) || time_.is_zero()) return "there is no bracket";
        if (c_.lower.sign() < 0 || ExactRational(1) < c_.lower) return "the bracket is elsewhere";
        if (roots_between(time_, c_.lower, c_.upper) != 1)
            return "the bracket holds no single root";
        // Not after the end of the piece.
        if (ExactRational(1) < c_.upper && time_.sign_at(1) != 0 &&
            roots_between(time_, c_.lower, 1) != 1)
            return "the contact is after the end";
        return {};
    }
    // Whether p is 0 at the time of contact.
    [[nodiscard]] bool vanishes(const Polynomial& p) const {
        if (p.is_zero()) return true;
        const Polynomial common = common_divisor(time_, p);
        return common.degree() > 0 && roots_between(common, c_.lower, c_.upper) == 1;
    }
    // The sign of p at the time of contact.
    [[nodiscard]] int sign_of(const Polynomial& p) const {
        if (vanishes(p)) return 0;
        ExactRational low = c_.lower;
        ExactRational high = c_.upper;
        const int above_low = time_.sign_at(low);
        for (int i = 0; i < 2000; ++i) {
            if (const auto n = roots_between(p, low, high); n && *n == 0) return p.sign_at(low);
            const ExactRational middle = (low + high) / ExactRational(2);
            const int s = time_.sign_at(middle);
            if (s == 0) return p.sign_at(middle);
            (s == above_low ? low : high) = middle;
        }
        return 2;  // no sign at all
    }

    // Whether p is positive from `from` to `to`, or up to the contact, itself excluded, when that
    // is the end of the time.
    [[nodiscard]] bool is_positive(const Polynomial& p, const ExactRational& from,
                                   const ExactRational& to) const {
        if (p.is_zero() || p.sign_at(from) <= 0) return false;
        if (p.degree() == 0) return true;
        const bool to_contact = is_last_ && to == end_;
        if (p.sign_at(to) == 0) {
            if (!to_contact) return false;
            // A root right at the end of the bracket is none before the contact.
            return roots_between(p, from, c_.lower) == 0 && p.sign_at(c_.lower) > 0 && vanishes(p);
        }
        const std::optional<int> n = roots_between(p, from, to);
        if (n == 0) return true;
        return to_contact && n == 1 && vanishes(p);
    }
    [[nodiscard]] bool is_not_negative(const Polynomial& p, const ExactRational& from,
                                       const ExactRational& to) const {
        return p.is_zero() || is_positive(p, from, to);
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
                       is_on(to_a_->point(b_[p.vertex_b.index]), to_a_->w, p.triangle_a, a_);
            case CommonPoint::Kind::VertexOfA:
                return has(p.triangle_a, p.vertex_a) &&
                       is_on(to_b_->point(a_[p.vertex_a.index]), to_b_->w, p.triangle_b, b_);
            default:
                return is_of(p.triangle_a, p.edge_a) && is_of(p.triangle_b, p.edge_b) &&
                       edges_cross(p);
        }
    }
    // Whether x / w is on the triangle.
    [[nodiscard]] bool is_on(const PolynomialVector& x, const Polynomial& w,
                             const CertifiedTriangle& t, const std::vector<Vector>& corners) const {
        std::array<Vector, 3> c;
        for (std::size_t i = 0; i < 3; ++i) c[i] = corners[t.vertex[i].index];
        const Vector n = cross(minus(c[1], c[0]), minus(c[2], c[0]));
        if (is_zero(n)) return false;
        const auto from = [&](std::size_t i) { return x - w * constant(c[i]); };
        if (!vanishes(dot(constant(n), from(0)))) return false;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector inward = cross(n, minus(c[(i + 1) % 3], c[i]));
            const int s = sign_of(dot(constant(inward), from(i)));
            if (s != 0 && s != 1) return false;
        }
        return true;
    }
    [[nodiscard]] bool edges_cross(const CommonPoint& p) const {
        const Vector& a0 = a_[p.edge_a[0].index];
        const Vector& a1 = a_[p.edge_a[1].index];
        const Vector& b0 = b_[p.edge_b[0].index];
        const Vector& b1 = b_[p.edge_b[1].index];
        const PolynomialVector u = constant(minus(a1, a0));
        const PolynomialVector v = to_a_->direction(minus(b1, b0));
        const PolynomialVector n = cross(u, v);
        const PolynomialVector way = to_a_->point(b0) - to_a_->w * constant(a0);
        if (!vanishes(dot(n, way)) || sign_of(dot(n, n)) != 1) return false;
        // The ends of each are not on one side of the other.
        const auto opposite = [this](const Polynomial& x, const Polynomial& y) {
            const int s = sign_of(x);
            const int t = sign_of(y);
            return s != 2 && t != 2 && s * t <= 0;
        };
        const PolynomialVector across_u = cross(n, u);
        const PolynomialVector across_v = cross(n, v);
        const PolynomialVector way_1 = to_a_->point(b1) - to_a_->w * constant(a0);
        const PolynomialVector back_1 = to_a_->w * constant(a1) - to_a_->point(b0);
        return opposite(dot(across_u, way), dot(across_u, way_1)) &&
               opposite(dot(across_v, PolynomialVector{} - way), dot(across_v, back_1));
    }

    // ------------------------------------------------------------ freedom

    struct Range {
        std::size_t node = 0;
        ExactRational from;
        ExactRational to;
        std::size_t a0 = 0;
        std::size_t a1 = 0;
        std::size_t b0 = 0;
        std::size_t b1 = 0;
    };
    std::string wrong_freedom(const std::vector<FreedomNode>& nodes) const {
        std::vector<bool> seen(nodes.size(), false);
        std::vector<Range> open{
            {0, ExactRational(0), end_, 0, c_.triangles_a.size(), 0, c_.triangles_b.size()}};
        while (!open.empty()) {
            const Range r = open.back();
            open.pop_back();
            if (r.node >= nodes.size() || seen[r.node]) return "the tree is no tree";
            seen[r.node] = true;
            const FreedomNode& n = nodes[r.node];
            Range first = r;
            Range second = r;
            first.node = r.node + 1;
            second.node = n.other;
            switch (n.kind) {
                case FreedomNode::Kind::Separated:
                    if (!are_apart(r, n.separator)) return "a plane does not separate";
                    continue;
                case FreedomNode::Kind::SplitTime:
                    if (!(r.from < n.time) || !(n.time < r.to) ||
                        (is_last_ && r.to == end_ && c_.lower < n.time))
                        return "a time is not in its range";
                    first.to = second.from = n.time;
                    break;
                case FreedomNode::Kind::SplitA:
                    if (r.a1 - r.a0 < 2) return "the tree splits a single triangle";
                    first.a1 = second.a0 = (r.a0 + r.a1) / 2;
                    break;
                case FreedomNode::Kind::SplitB:
                    if (r.b1 - r.b0 < 2) return "the tree splits a single triangle";
                    first.b1 = second.b0 = (r.b0 + r.b1) / 2;
                    break;
            }
            open.push_back(std::move(first));
            open.push_back(std::move(second));
        }
        return {};
    }
    [[nodiscard]] bool are_apart(const Range& r, const MovingSeparator& s) const {
        const auto of_a = detail::corners_of_range(c_.triangles_a, r.a0, r.a1);
        const auto of_b = detail::corners_of_range(c_.triangles_b, r.b0, r.b1);
        if (s.kind == MovingSeparator::Kind::Edges) return are_apart_by_edges(r, s, of_a, of_b);
        const bool is_of_a = s.kind == MovingSeparator::Kind::OfA;
        const auto& resting = is_of_a ? a_ : b_;
        const auto& moving = is_of_a ? b_ : a_;
        const Relative& map = is_of_a ? *to_a_ : *to_b_;
        // A is below, B above.
        const ExactRational side(is_of_a ? 1 : -1);
        for (const std::uint32_t v : is_of_a ? of_a : of_b)
            if ((side * (dot(s.plane.normal, resting[v]) + s.plane.offset)).sign() > 0)
                return false;
        for (const std::uint32_t v : is_of_a ? of_b : of_a) {
            const Polynomial height = dot(constant(s.plane.normal), map.point(moving[v])) +
                                      Polynomial(s.plane.offset) * map.w;
            if (!is_positive(Polynomial(side) * height, r.from, r.to)) return false;
        }
        return true;
    }
    [[nodiscard]] bool are_apart_by_edges(const Range& r, const MovingSeparator& s,
                                          const std::vector<std::uint32_t>& of_a,
                                          const std::vector<std::uint32_t>& of_b) const {
        for (const VertexId v : s.edge_a)
            if (v.index >= a_.size()) return false;
        for (const VertexId v : s.edge_b)
            if (v.index >= b_.size()) return false;
        const Vector& a0 = a_[s.edge_a[0].index];
        const Vector u = minus(a_[s.edge_a[1].index], a0);
        const Vector v = minus(b_[s.edge_b[1].index], b_[s.edge_b[0].index]);
        PolynomialVector n = cross(constant(u), to_a_->direction(v));
        if (s.flipped) n = PolynomialVector{} - n;
        for (const std::uint32_t x : of_a)
            if (!is_not_negative(-dot(n, constant(minus(a_[x], a0))), r.from, r.to)) return false;
        for (const std::uint32_t x : of_b)
            if (!is_positive(dot(n, to_a_->point(b_[x]) - to_a_->w * constant(a0)), r.from, r.to))
                return false;
        return true;
    }

    const ContactCertificate& c_;
    const Brep& brep_a_;
    const Brep& brep_b_;
    const Motion& motion_a_;
    const Motion& motion_b_;
    std::vector<Vector> a_;
    std::vector<Vector> b_;
    std::optional<Relative> to_a_;
    std::optional<Relative> to_b_;
    Polynomial time_;
    ExactRational end_;
    bool is_last_ = false;  // the contact is in this piece
};

}  // namespace

std::string check_contact_certificate(const ContactCertificate& certificate, const Brep& a,
                                      const Motion& motion_a, const Brep& b,
                                      const Motion& motion_b) {
    return Checker(certificate, a, motion_a, b, motion_b).run();
}

}  // namespace trisect
