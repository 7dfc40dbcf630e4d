// SPDX-License-Identifier: Apache-2.0
//
// Finding certificates of first contact. What is found need not be right: the checker says.
//
// Most pairs of ranges are kept apart by a plane that rests in A's frame, found and tried in
// doubles with error bounds; where the solids move far in the time looked at, time is halved. Up to
// the contact itself no plane with a margin is left for the triangles that meet there. They get
// planes through features of theirs (contact_planes.cpp).

#include <trisect/bsp/interference/contact_certificate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/number/real_root.h>
#include <trisect/bsp/interference/boxes/triangle_distance.h>
#include <trisect/bsp/interference/certificate/find/contact_planes.h>
#include <trisect/bsp/interference/certificate/find/proof_body.h>
#include <trisect/bsp/interference/certificate/find/proof_tree.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/motion/time_in_piece.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect {

namespace {

using detail::Ball;
using detail::BallMotion;
using detail::BallVector;
using detail::dot;
using detail::IntegerPolynomial;
using detail::minus;
using detail::MotionPiece;
using detail::ProofBody;
using detail::rounded;
using detail::proof::Approximate;

constexpr int most_freedom_levels = 200;

// The tree of one piece of the motions.
class FreedomBuilder {
public:
    using Range = detail::ProofRange<double>;

    FreedomBuilder(const ProofBody& a, const MotionPiece& piece_a, const ProofBody& b,
                   const MotionPiece& piece_b, const std::optional<detail::BracketedTime>& contact,
                   std::size_t limit)
        : a_(a),
          b_(b),
          to_a_(detail::relative_points(piece_a, Lattice{}, piece_b, Lattice{})),
          to_b_(detail::relative_points(piece_b, Lattice{}, piece_a, Lattice{})),
          contact_(contact),
          limit_(limit) {
        if (contact) planes_.emplace(a_, to_a_, b_, to_b_, *contact);
    }
    FreedomBuilder(const FreedomBuilder&) = delete;
    FreedomBuilder& operator=(const FreedomBuilder&) = delete;

    // Nothing where it fails.
    std::optional<std::vector<FreedomNode>> build() {
        if (!BallMotion::fits(to_a_)) return std::nullopt;
        const double end = contact_ ? contact_->upper : 1;
        return detail::ProofTree<FreedomNode, double, FreedomBuilder>(*this,
                                                                      {limit_, most_freedom_levels})
            .build({0, a_.triangles.size(), 0, b_.triangles.size(), 0, end});
    }
    [[nodiscard]] const std::optional<CommonPoint>& common_point() const { return common_; }

    bool separate(const Range& r, FreedomNode& node) {
        auto s = resting_plane(view(r.from, r.to), a_.corners(r.a0, r.a1), b_.corners(r.b0, r.b1),
                               r.is_single());
        if (!s && r.is_single() && is_last(r)) {
            if (!common_) common_ = planes_->common_point(r.a0, r.b0);
            s = planes_->plane(r.a0, r.b0, r.from);
        }
        if (s) node.separator = std::move(*s);
        return s.has_value();
    }
    std::optional<double> time_to_split(const Range& r) {
        const double to = is_last(r) ? contact_->lower : r.to;
        const double middle = r.from + (to - r.from) / 2;
        if (!(r.from < middle && middle < to)) return std::nullopt;
        if (r.is_single() ||
            moves_far(view(r.from, r.to), a_.corners(r.a0, r.a1), b_.corners(r.b0, r.b1)))
            return middle;
        return std::nullopt;
    }
    static void set_time(FreedomNode& node, double time) {
        node.time = ExactRational::from_double(time);
    }

private:
    [[nodiscard]] bool is_last(const Range& r) const { return contact_ && r.to == contact_->upper; }
    const BallMotion& view(double from, double to) {
        auto at = views_.find({from, to});
        if (at == views_.end())
            at = views_
                     .emplace(std::pair{from, to}, BallMotion::of_points(detail::part_of(
                                                       to_a_, mpq_class(from), mpq_class(to))))
                     .first;
        return at->second;
    }

    // Farther than half of what is larger.
    bool moves_far(const BallMotion& motion, std::span<const std::uint32_t> of_a,
                   std::span<const std::uint32_t> of_b) const {
        double square = 0;
        for (const std::uint32_t v : {of_b.front(), of_b.back()}) {
            const Approximate d = minus(motion.guessed_image(motion.degree, b_.near[v]),
                                        motion.guessed_image(0, b_.near[v]));
            square = std::max(square, dot(d, d));
        }
        return 4 * square > std::max(a_.squared_size(of_a), b_.squared_size(of_b));
    }

    // A plane that rests in A's frame, with a margin.
    std::optional<MovingSeparator> resting_plane(const BallMotion& motion,
                                                 std::span<const std::uint32_t> of_a,
                                                 std::span<const std::uint32_t> of_b,
                                                 bool single) const {
        const std::size_t half = motion.degree / 2;
        const Approximate from = a_.middle(of_a);
        const Approximate to = motion.guessed_image(half, b_.middle(of_b));
        std::vector<Approximate> directions = detail::proof_directions(minus(to, from));
        if (single) {
            detail::TriangleCorners p;
            detail::TriangleCorners q;
            for (std::size_t i = 0; i < 3; ++i) {
                p[i] = a_.near[of_a[i]];
                q[i] = motion.guessed_image(half, b_.near[of_b[i]]);
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
            highest = std::max(highest, detail::dot(direction, rounded(a_.near[v])).upper());
        double lowest = HUGE_VAL;
        std::vector<std::vector<Ball>> heights;
        for (const std::uint32_t v : of_b) {
            auto& h = heights.emplace_back();
            const BallVector x = rounded(b_.near[v]);
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
        s.plane = {detail::proof::exact(d), -ExactRational::from_double(at)};
        return s;
    }

    const ProofBody& a_;
    const ProofBody& b_;
    MotionPiece to_a_;
    MotionPiece to_b_;
    std::optional<detail::BracketedTime> contact_;
    std::optional<detail::ContactPlanes> planes_;  // where there is a contact
    std::size_t limit_;
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
    c.at_start = certify_relation(a, motion_a.pose_at(0), b, motion_b.pose_at(0));
    if (c.at_start.relation != Relation::Disjoint || a.is_empty() || b.is_empty()) {
        c.is_complete = c.at_start.is_complete;
        return c;
    }
    ProofBody body_a(detail::data_of(a));
    ProofBody body_b(detail::data_of(b));
    std::size_t pieces = std::max(motion_a.piece_count(), motion_b.piece_count());
    std::optional<detail::BracketedTime> last;
    if (c.is_contact) {
        const detail::TimeInPiece time = detail::time_in_piece(*contact.time);
        auto roots = isolate_roots(integer_polynomial(time.polynomial), mpq_class(time.lower),
                                   mpq_class(time.upper));
        if (roots.size() != 1 || time.lower < 0) return c;
        c.piece = time.piece;
        c.polynomial = time.polynomial;
        c.lower = ExactRational::from_double(time.lower);
        c.upper = ExactRational::from_double(time.upper);
        last = detail::BracketedTime{roots[0], time.lower, time.upper};
        pieces = c.piece + 1;
    }
    const auto piece_of = [](const Motion& m, std::size_t i) -> const MotionPiece& {
        return detail::piece_of(m, std::min(i, m.piece_count() - 1));
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
