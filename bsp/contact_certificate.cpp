// SPDX-License-Identifier: Apache-2.0
//
// Finding certificates of first contact. What is found need not be right: the checker says.
//
// Most pairs of ranges are kept apart by a plane that rests in A's frame, found and tried in
// doubles with error bounds; where the solids move far in the time looked at, time is halved. Up to
// the contact itself no plane with a margin is left for the triangles that meet there. They get
// planes through features of theirs: a face, an edge, a corner, or one along two edges, whose
// heights are polynomials with a root at the time of contact, and no root before.

#include <trisect/bsp/contact_certificate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <trisect/brep/detail/gmp_conversion.h>
#include <trisect/brep/detail/real_root.h>
#include <trisect/bsp/detail/ball_motion.h>
#include <trisect/bsp/detail/interference_model_data.h>
#include <trisect/bsp/detail/motion_piece.h>
#include <trisect/bsp/detail/proof_body.h>
#include <trisect/bsp/detail/time_in_piece.h>
#include <trisect/bsp/detail/triangle_distance.h>

namespace trisect {

namespace {

using detail::Ball;
using detail::BallMotion;
using detail::BallVector;
using detail::IntegerPolynomial;
using detail::MotionPiece;
using detail::PolynomialVector;
using detail::ProofBody;
using detail::RealRoot;
using GmpVector = std::array<mpq_class, 3>;
using Approximate = std::array<double, 3>;

constexpr int max_depth = 200;

GmpVector minus(const GmpVector& u, const GmpVector& v) {
    return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
GmpVector cross(const GmpVector& u, const GmpVector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
mpq_class dot(const GmpVector& u, const GmpVector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
GmpVector opposite(const GmpVector& v) { return {-v[0], -v[1], -v[2]}; }
bool is_zero(const GmpVector& v) { return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0; }
Approximate minus(const Approximate& u, const Approximate& v) {
    return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
double dot(const Approximate& u, const Approximate& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
RationalPoint rational(const GmpVector& v) {
    return {detail::from_gmp(v[0]), detail::from_gmp(v[1]), detail::from_gmp(v[2])};
}
GmpVector exact(const Approximate& v) {
    return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])};
}

BallVector ball(const Approximate& x) {
    return {Ball::rounded(x[0]), Ball::rounded(x[1]), Ball::rounded(x[2])};
}

// Integers in place of fractions: a point times a weight.
struct Scaled {
    std::array<mpz_class, 3> x;
    mpz_class weight;

    explicit Scaled(const GmpVector& v) {
        const std::vector<mpz_class> n =
            detail::common_numerators(std::vector<mpq_class>(v.begin(), v.end()), weight);
        x = {n[0], n[1], n[2]};
    }
};

// Where a point goes, times a positive weight; and that weight.
struct MovingPoint {
    PolynomialVector x;
    IntegerPolynomial w;

    MovingPoint(const MotionPiece& map, const GmpVector& p) {
        const Scaled s(p);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) x[i].add_multiple(map.matrix[i][j], s.x[j]);
            x[i].add_multiple(map.shift[i], s.weight);
        }
        w = map.weight * s.weight;
    }
};

// A positive multiple of n·x + c w.
IntegerPolynomial height(const GmpVector& n, const mpq_class& c, const MovingPoint& p) {
    mpz_class denominator;
    const std::vector<mpz_class> k =
        detail::common_numerators(std::vector<mpq_class>{n[0], n[1], n[2], c}, denominator);
    IntegerPolynomial r = p.w * k[3];
    for (std::size_t i = 0; i < 3; ++i) r.add_multiple(p.x[i], k[i]);
    return r;
}

// A positive multiple of x - w q.
PolynomialVector way_from(const GmpVector& q, const MovingPoint& p) {
    const Scaled s(q);
    PolynomialVector r;
    for (std::size_t i = 0; i < 3; ++i) {
        r[i] = p.x[i] * s.weight;
        r[i].add_multiple(p.w, mpz_class(-s.x[i]));
    }
    return r;
}

// Of a vector: a positive multiple of M v.
PolynomialVector moving_direction(const MotionPiece& map, const GmpVector& v) {
    const Scaled s(v);
    PolynomialVector r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r[i].add_multiple(map.matrix[i][j], s.x[j]);
    return r;
}

PolynomialVector constant(const GmpVector& v) {
    const Scaled s(v);
    return {IntegerPolynomial(s.x[0]), IntegerPolynomial(s.x[1]), IntegerPolynomial(s.x[2])};
}

// The tree of one piece of the motions.
class FreedomBuilder {
public:
    struct Contact {
        RealRoot time;
        double lower = 0;
        double upper = 0;
    };

    FreedomBuilder(const ProofBody& a, const MotionPiece& piece_a, const ProofBody& b,
                   const MotionPiece& piece_b, std::optional<Contact> contact, std::size_t limit)
        : a_(a),
          b_(b),
          to_a_(detail::relative_points(piece_a, Lattice{}, piece_b, Lattice{})),
          to_b_(detail::relative_points(piece_b, Lattice{}, piece_a, Lattice{})),
          contact_(std::move(contact)),
          limit_(limit) {}

    // Nothing where it fails.
    std::optional<std::vector<FreedomNode>> build() {
        if (!BallMotion::fits(to_a_)) return std::nullopt;
        const double end = contact_ ? contact_->upper : 1;
        if (!add({0, end, 0, a_.triangles.size(), 0, b_.triangles.size()}, 0)) return std::nullopt;
        return std::move(nodes_);
    }
    [[nodiscard]] const std::optional<CommonPoint>& common_point() const { return common_; }

private:
    struct Range {
        double from;
        double to;
        std::size_t a0, a1, b0, b1;
    };

    const BallMotion& view(double from, double to) {
        auto at = views_.find({from, to});
        if (at == views_.end())
            at = views_
                     .emplace(std::pair{from, to}, BallMotion::of_points(detail::part_of(
                                                       to_a_, mpq_class(from), mpq_class(to))))
                     .first;
        return at->second;
    }

    bool add(const Range& r, int depth) {
        if (nodes_.size() >= limit_ || depth > max_depth) return false;
        const std::size_t at = nodes_.size();
        nodes_.emplace_back();
        const auto of_a = a_.corners(r.a0, r.a1);
        const auto of_b = b_.corners(r.b0, r.b1);
        const BallMotion& motion = view(r.from, r.to);
        const bool single = r.a1 - r.a0 == 1 && r.b1 - r.b0 == 1;
        const bool is_last = contact_ && r.to == contact_->upper;
        if (auto s = resting_plane(motion, of_a, of_b, single)) {
            nodes_[at].separator = std::move(*s);
            return true;
        }
        if (single && is_last) {
            note_common_point(r);
            if (auto s = plane_to_the_contact(r)) {
                nodes_[at].separator = std::move(*s);
                return true;
            }
        }
        const double split =
            is_last ? r.from + (contact_->lower - r.from) / 2 : r.from + (r.to - r.from) / 2;
        const bool can_split_time =
            r.from < split && split < r.to && (!is_last || split < contact_->lower);
        if (single && !can_split_time) return false;
        Range first = r;
        Range second = r;
        if (can_split_time && (single || moves_far(motion, of_a, of_b))) {
            nodes_[at].kind = FreedomNode::Kind::SplitTime;
            nodes_[at].time = ExactRational::from_double(split);
            first.to = second.from = split;
        } else if (r.a1 - r.a0 >= r.b1 - r.b0) {
            nodes_[at].kind = FreedomNode::Kind::SplitA;
            first.a1 = second.a0 = (r.a0 + r.a1) / 2;
        } else {
            nodes_[at].kind = FreedomNode::Kind::SplitB;
            first.b1 = second.b0 = (r.b0 + r.b1) / 2;
        }
        if (!add(first, depth + 1)) return false;
        nodes_[at].other = static_cast<std::uint32_t>(nodes_.size());
        return add(second, depth + 1);
    }

    static Approximate place(const BallMotion& motion, std::size_t k, const Approximate& x) {
        const BallMotion::Maps& m = motion.maps[k];
        Approximate y{};
        for (std::size_t i = 0; i < 3; ++i)
            y[i] = (m.matrix[i][0].value * x[0] + m.matrix[i][1].value * x[1] +
                    m.matrix[i][2].value * x[2] + m.shift[i].value) /
                   m.weight.value;
        return y;
    }
    static Approximate middle(const ProofBody& body, std::span<const std::uint32_t> corners) {
        Approximate sum{};
        for (const std::uint32_t v : corners)
            for (std::size_t k = 0; k < 3; ++k) sum[k] += body.near[v][k];
        for (double& c : sum) c /= static_cast<double>(corners.size());
        return sum;
    }
    static double size_of(const ProofBody& body, std::span<const std::uint32_t> corners) {
        const Approximate m = middle(body, corners);
        double square = 0;
        for (const std::uint32_t v : corners) {
            const Approximate d = minus(body.near[v], m);
            square = std::max(square, dot(d, d));
        }
        return std::sqrt(square);
    }
    // Farther than the smaller of the two is large.
    bool moves_far(const BallMotion& motion, std::span<const std::uint32_t> of_a,
                   std::span<const std::uint32_t> of_b) const {
        double square = 0;
        for (const std::uint32_t v : {of_b.front(), of_b.back()}) {
            const Approximate d =
                minus(place(motion, motion.degree, b_.near[v]), place(motion, 0, b_.near[v]));
            square = std::max(square, dot(d, d));
        }
        return std::sqrt(square) > 0.5 * std::max(size_of(a_, of_a), size_of(b_, of_b));
    }

    // A plane that rests in A's frame, with a margin.
    std::optional<MovingSeparator> resting_plane(const BallMotion& motion,
                                                 std::span<const std::uint32_t> of_a,
                                                 std::span<const std::uint32_t> of_b,
                                                 bool single) const {
        const std::size_t half = motion.degree / 2;
        const Approximate from = middle(a_, of_a);
        const Approximate to = place(motion, half, middle(b_, of_b));
        std::vector<Approximate> directions{minus(to, from), {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                            {-1, 0, 0},      {0, -1, 0}, {0, 0, -1}};
        if (single) {
            detail::TriangleCorners p;
            detail::TriangleCorners q;
            for (std::size_t i = 0; i < 3; ++i) {
                p[i] = a_.near[of_a[i]];
                q[i] = place(motion, half, b_.near[of_b[i]]);
            }
            detail::add_proof_directions(p, q, directions);
        }
        for (const Approximate& d : directions)
            if (auto s = resting_plane_along(d, motion, of_a, of_b)) return s;
        return std::nullopt;
    }
    std::optional<MovingSeparator> resting_plane_along(const Approximate& d,
                                                       const BallMotion& motion,
                                                       std::span<const std::uint32_t> of_a,
                                                       std::span<const std::uint32_t> of_b) const {
        const BallVector direction{Ball(d[0]), Ball(d[1]), Ball(d[2])};
        double highest = -HUGE_VAL;
        for (const std::uint32_t v : of_a)
            highest = std::max(highest, detail::dot(direction, ball(a_.near[v])).upper());
        double lowest = HUGE_VAL;
        std::vector<std::vector<Ball>> heights;
        for (const std::uint32_t v : of_b) {
            auto& h = heights.emplace_back();
            const BallVector x = ball(b_.near[v]);
            for (std::size_t k = 0; k <= motion.degree; ++k) {
                const BallMotion::Maps& m = motion.maps[k];
                h.push_back(detail::dot(direction, m.matrix * x + m.shift));
                lowest = std::min(lowest, h.back().value / m.weight.value);
            }
        }
        const double at = highest + (lowest - highest) / 2;
        if (!(highest <= at) || !std::isfinite(at)) return std::nullopt;
        for (const auto& h : heights)
            for (std::size_t k = 0; k <= motion.degree; ++k)
                if ((h[k] - Ball(at) * motion.maps[k].weight).sign() <= 0) return std::nullopt;
        MovingSeparator s;
        s.plane = {rational(exact(d)), -ExactRational::from_double(at)};
        return s;
    }

    // ------------------------------------------------------------ up to the contact

    // Positive from a time on, with the contact for the first root and nothing else.
    bool is_positive(const IntegerPolynomial& p, double from) {
        if (p.is_zero() || p.sign_at(mpq_class(from)) <= 0) return false;
        auto roots = isolate_roots(p, mpq_class(from), mpq_class(contact_->upper));
        if (roots.empty()) return true;
        return roots.size() == 1 && roots[0].compare(contact_->time) == 0;
    }
    std::array<GmpVector, 3> corners_of(const ProofBody& body, std::size_t t) const {
        std::array<GmpVector, 3> r;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                r[i][k] = detail::to_gmp(body.points[body.triangles[t].vertex[i].index][k]);
        return r;
    }

    std::optional<MovingSeparator> plane_to_the_contact(const Range& r) {
        const auto p = corners_of(a_, r.a0);
        const auto q = corners_of(b_, r.b0);
        for (const auto kind : {MovingSeparator::Kind::OfA, MovingSeparator::Kind::OfB})
            if (auto s = plane_of_one(kind, r, p, q)) return s;
        return plane_along_edges(r, p, q);
    }
    // The plane is carried along with one of the triangles, `resting`, and supports it.
    std::optional<MovingSeparator> plane_of_one(MovingSeparator::Kind kind, const Range& r,
                                                const std::array<GmpVector, 3>& p,
                                                const std::array<GmpVector, 3>& q) {
        const bool is_of_a = kind == MovingSeparator::Kind::OfA;
        const auto& resting = is_of_a ? p : q;
        const auto& moving = is_of_a ? q : p;
        const MotionPiece& map = is_of_a ? to_a_ : to_b_;
        std::vector<MovingPoint> paths;
        for (const GmpVector& x : moving) paths.emplace_back(map, x);
        // Away from the resting triangle, towards the other one.
        for (const GmpVector& n : candidates(resting, paths, r.from)) {
            mpq_class highest = dot(n, resting[0]);
            for (const GmpVector& x : resting) highest = std::max(highest, dot(n, x));
            if (!std::ranges::all_of(paths, [&](const MovingPoint& x) {
                    return is_positive(height(n, -highest, x), r.from);
                }))
                continue;
            MovingSeparator s;
            s.kind = kind;
            const GmpVector m = is_of_a ? n : opposite(n);
            s.plane = {rational(m), detail::from_gmp(is_of_a ? mpq_class(-highest) : highest)};
            return s;
        }
        return std::nullopt;
    }
    // Normals: of the triangle, the way to the other one, and that way turned square to each edge.
    std::vector<GmpVector> candidates(const std::array<GmpVector, 3>& resting,
                                      const std::vector<MovingPoint>& paths, double from) const {
        const GmpVector n = cross(minus(resting[1], resting[0]), minus(resting[2], resting[0]));
        std::vector<GmpVector> r{n, opposite(n)};
        detail::TriangleCorners p;
        detail::TriangleCorners q;
        const mpq_class at(from);
        for (std::size_t i = 0; i < 3; ++i) {
            const mpq_class w = paths[i].w.value_at(at);
            for (std::size_t k = 0; k < 3; ++k) {
                p[i][k] = resting[i][k].get_d();
                q[i][k] = mpq_class(paths[i].x[k].value_at(at) / w).get_d();
            }
        }
        std::vector<Approximate> ways;
        detail::add_proof_directions(p, q, ways);
        // The other one's normals and the way between the middles, too.
        ways.push_back({});
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) ways.back()[k] += q[i][k] - p[i][k];
        const std::size_t count = ways.size();
        for (std::size_t i = 1; i < count; ++i) {  // between two of them
            const double a = std::sqrt(dot(ways[0], ways[0]));
            const double b = std::sqrt(dot(ways[i], ways[i]));
            if (!(a > 0) || !(b > 0)) continue;
            Approximate sum{};
            for (std::size_t k = 0; k < 3; ++k) sum[k] = ways[0][k] / a + ways[i][k] / b;
            ways.push_back(sum);
        }
        for (const Approximate& way : ways) {
            const double length = std::sqrt(dot(way, way));
            if (!(length > 0) || !std::isfinite(length)) continue;
            // Short numbers.
            Approximate d{};
            for (std::size_t k = 0; k < 3; ++k) d[k] = std::round(way[k] / length * 0x1p20);
            const GmpVector e = exact(d);
            if (is_zero(e)) continue;
            r.push_back(e);
            for (std::size_t i = 0; i < 3; ++i) {
                const GmpVector u = minus(resting[(i + 1) % 3], resting[i]);
                const mpq_class uu = dot(u, u);
                const mpq_class eu = dot(e, u);
                GmpVector square;
                for (std::size_t k = 0; k < 3; ++k) square[k] = uu * e[k] - eu * u[k];
                if (!is_zero(square)) r.push_back(square);
            }
        }
        return r;
    }
    std::optional<MovingSeparator> plane_along_edges(const Range& r,
                                                     const std::array<GmpVector, 3>& p,
                                                     const std::array<GmpVector, 3>& q) {
        std::vector<MovingPoint> paths;
        for (const GmpVector& x : q) paths.emplace_back(to_a_, x);
        const CertifiedTriangle& ta = a_.triangles[r.a0];
        const CertifiedTriangle& tb = b_.triangles[r.b0];
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const std::size_t i1 = (i + 1) % 3;
                const std::size_t j1 = (j + 1) % 3;
                PolynomialVector n = detail::cross(constant(minus(p[i1], p[i])),
                                                   moving_direction(to_a_, minus(q[j1], q[j])));
                for (const bool flipped : {false, true}) {
                    if (flipped) n = PolynomialVector{} - n;
                    IntegerPolynomial below =
                        -detail::dot(n, constant(minus(p[(i + 2) % 3], p[i])));
                    if (!below.is_zero() && !is_positive(below, r.from)) continue;
                    if (!std::ranges::all_of(paths, [&](const MovingPoint& x) {
                            return is_positive(detail::dot(n, way_from(p[i], x)), r.from);
                        }))
                        continue;
                    MovingSeparator s;
                    s.kind = MovingSeparator::Kind::Edges;
                    s.edge_a = {ta.vertex[i], ta.vertex[i1]};
                    s.edge_b = {tb.vertex[j], tb.vertex[j1]};
                    s.flipped = flipped;
                    return s;
                }
            }
        return std::nullopt;
    }

    // ------------------------------------------------------------ the contact itself

    void note_common_point(const Range& r) {
        if (common_) return;
        const auto p = corners_of(a_, r.a0);
        const auto q = corners_of(b_, r.b0);
        CommonPoint c;
        c.triangle_a = a_.triangles[r.a0];
        c.triangle_b = b_.triangles[r.b0];
        for (std::size_t i = 0; i < 3; ++i) {
            if (is_on({to_a_, q[i]}, p)) {
                c.kind = CommonPoint::Kind::VertexOfB;
                c.vertex_b = c.triangle_b.vertex[i];
                common_ = c;
                return;
            }
            if (is_on({to_b_, p[i]}, q)) {
                c.kind = CommonPoint::Kind::VertexOfA;
                c.vertex_a = c.triangle_a.vertex[i];
                common_ = c;
                return;
            }
        }
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                if (!cross_each_other(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3])) continue;
                c.kind = CommonPoint::Kind::Edges;
                c.edge_a = {c.triangle_a.vertex[i], c.triangle_a.vertex[(i + 1) % 3]};
                c.edge_b = {c.triangle_b.vertex[j], c.triangle_b.vertex[(j + 1) % 3]};
                common_ = c;
                return;
            }
    }
    int sign_of(const IntegerPolynomial& p) { return p.is_zero() ? 0 : contact_->time.sign_of(p); }
    bool is_on(const MovingPoint& x, const std::array<GmpVector, 3>& t) {
        const GmpVector n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        if (sign_of(height(n, -dot(n, t[0]), x)) != 0) return false;
        for (std::size_t i = 0; i < 3; ++i) {
            const GmpVector inward = cross(n, minus(t[(i + 1) % 3], t[i]));
            if (sign_of(height(inward, -dot(inward, t[i]), x)) < 0) return false;
        }
        return true;
    }
    bool cross_each_other(const GmpVector& a0, const GmpVector& a1, const GmpVector& b0,
                          const GmpVector& b1) {
        const PolynomialVector u = constant(minus(a1, a0));
        const PolynomialVector v = moving_direction(to_a_, minus(b1, b0));
        const PolynomialVector n = detail::cross(u, v);
        const MovingPoint x0(to_a_, b0);
        const MovingPoint x1(to_a_, b1);
        const PolynomialVector way = way_from(a0, x0);
        if (sign_of(detail::dot(n, way)) != 0 || sign_of(detail::dot(n, n)) != 1) return false;
        const PolynomialVector across_u = detail::cross(n, u);
        const PolynomialVector across_v = detail::cross(n, v);
        return sign_of(detail::dot(across_u, way)) *
                       sign_of(detail::dot(across_u, way_from(a0, x1))) <=
                   0 &&
               sign_of(detail::dot(across_v, way)) *
                       sign_of(detail::dot(across_v, way_from(a1, x0))) <=
                   0;
    }

    const ProofBody& a_;
    const ProofBody& b_;
    MotionPiece to_a_;
    MotionPiece to_b_;
    std::optional<Contact> contact_;
    std::size_t limit_;
    std::vector<FreedomNode> nodes_;
    std::map<std::pair<double, double>, BallMotion> views_;
    std::optional<CommonPoint> common_;
};

IntegerPolynomial integer_polynomial(const std::vector<ExactRational>& c) {
    std::vector<mpq_class> values;
    for (const ExactRational& v : c) values.push_back(detail::to_gmp(v));
    mpz_class denominator;
    return IntegerPolynomial(detail::common_numerators(values, denominator));
}

}  // namespace

ContactCertificate certify_first_contact(const InterferenceModel& a, const Motion& motion_a,
                                         const InterferenceModel& b, const Motion& motion_b,
                                         std::size_t max_nodes) {
    ContactCertificate c;
    const FirstContact contact = first_contact(a, motion_a, b, motion_b);
    c.is_contact = contact.exists();
    c.at_start = certify(a, motion_a.pose_at(0), b, motion_b.pose_at(0));
    if (c.at_start.relation != Relation::Disjoint || a.is_empty() || b.is_empty()) {
        c.is_complete = c.at_start.is_complete;
        return c;
    }
    ProofBody body_a(a.data());
    ProofBody body_b(b.data());
    std::size_t pieces = std::max(motion_a.piece_count(), motion_b.piece_count());
    std::optional<FreedomBuilder::Contact> last;
    if (c.is_contact) {
        const detail::TimeInPiece time = detail::time_in_piece(*contact.time);
        auto roots = isolate_roots(integer_polynomial(time.polynomial), mpq_class(time.lower),
                                   mpq_class(time.upper));
        if (roots.size() != 1 || time.lower < 0) return c;
        c.piece = time.piece;
        c.polynomial = time.polynomial;
        c.lower = ExactRational::from_double(time.lower);
        c.upper = ExactRational::from_double(time.upper);
        last = FreedomBuilder::Contact{roots[0], time.lower, time.upper};
        pieces = c.piece + 1;
    }
    const auto piece_of = [](const Motion& m, std::size_t i) -> const MotionPiece& {
        return m.piece(std::min(i, m.piece_count() - 1));
    };
    for (std::size_t i = 0; i < pieces; ++i) {
        const bool is_last = c.is_contact && i + 1 == pieces;
        FreedomBuilder builder(body_a, piece_of(motion_a, i), body_b, piece_of(motion_b, i),
                               is_last ? last : std::nullopt, max_nodes);
        auto tree = builder.build();
        if (!tree || (is_last && !builder.common_point())) {
            c.freedom.clear();
            return c;
        }
        c.freedom.push_back(std::move(*tree));
        if (is_last) c.common_point = *builder.common_point();
    }
    c.triangles_a = std::move(body_a.triangles);
    c.triangles_b = std::move(body_b.triangles);
    c.is_complete = c.at_start.is_complete;
    return c;
}

}  // namespace trisect
