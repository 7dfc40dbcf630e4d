// SPDX-License-Identifier: Apache-2.0
//
// The checker gets enclosures from the motions and has corners, polynomials and fractions. A corner
// x is at X(s) / w(s) up to a distance of by_length |x| + constant, so its height n·X / w is off by
// |n| times that at most; both lengths are bounded by sums of magnitudes, which need no roots.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/certified_motion.h>
#include <trisect/bsp/interference/certificate/certified_walk.h>
#include <trisect/bsp/interference/enclosed_certificate.h>

namespace trisect::detail::certified {

namespace {

using Node = EnclosedFreedomNode;
using DoubleWalkRange = WalkRange<double>;

// A motion over a range of time, which is the unit interval of its enclosure.
struct Enclosed {
    Piece piece;
    std::optional<ControlMaps> controls;  // nothing where the motion is not known
    ExactRational by_length;
    ExactRational constant;

    Enclosed(const EnclosedMotion& motion, double from, double to) {
        const MotionEnclosure e = motion.enclose(from, to);
        if (!std::isfinite(e.by_length) || !std::isfinite(e.constant) || e.by_length < 0 ||
            e.constant < 0 || e.motion.piece_count() != 1)
            return;
        piece = piece_of(e.motion, 0);
        if (!is_positive_on_unit(piece.w)) return;
        by_length = ExactRational::from_double(e.by_length);
        constant = ExactRational::from_double(e.constant);
        controls.emplace(piece, 0, 1);
    }
    [[nodiscard]] ExactRational deviation(const ExactPoint& x) const {
        return by_length * sum_of_magnitudes(x) + constant;
    }
};

// Which of the eight parts of space a point is in, one bit for each negative coordinate; there the
// sum of magnitudes is linear.
std::size_t octant_of(const IntegerPoint& p) {
    std::size_t r = 0;
    for (std::size_t k = 0; k < 3; ++k) r |= static_cast<std::size_t>(sgn(p.x[k]) < 0) << k;
    return r;
}
ExactPoint signs_in(std::size_t octant) {
    ExactPoint r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = ExactRational((octant >> k & 1U) != 0 ? -1 : 1);
    return r;
}

class EnclosedChecker {
public:
    EnclosedChecker(const EnclosedCertificate& c, const Brep& a, const EnclosedMotion& motion_a,
                    const Brep& b, const EnclosedMotion& motion_b)
        : c_(c),
          answer_(c.answer),
          motion_a_(motion_a),
          motion_b_(motion_b),
          a_(a),
          b_(b),
          duration_(motion_a.is_still() ? motion_b.duration() : motion_a.duration()) {}

    std::string run() {
        if (a_.brep().is_empty() || b_.brep().is_empty())
            return answer_.outcome == EnclosedContact::Outcome::None
                       ? ""
                       : "an empty solid touches nothing";
        if (!c_.free.empty() || c_.in_both)
            if (!a_.is_filled_by(c_.triangles_a) || !b_.is_filled_by(c_.triangles_b))
                return "the triangles do not fill the faces";
        for (const FreeSpan& s : c_.free)
            if (std::string w = wrong_span(s); !w.empty()) return w;
        if (c_.in_both) {
            if (!answer_.contact_by) return "there is no time of contact";
            if (std::string w = wrong_contact(*answer_.contact_by); !w.empty()) return w;
        }
        return c_.is_complete ? missing() : "";
    }

private:
    // ------------------------------------------------------------ the answer

    // Free spans and the answer's undecided times are all there is, up to the contact or the end.
    std::string missing() const {
        using Outcome = EnclosedContact::Outcome;
        if (answer_.contact_by.has_value() != c_.in_both.has_value())
            return "the contact is not proved";
        const Outcome outcome = answer_.contact_by           ? Outcome::Contact
                                : !answer_.undecided.empty() ? Outcome::Undecided
                                                             : Outcome::None;
        if (answer_.outcome != outcome) return "the outcome is another one";
        const double end = answer_.contact_by.value_or(duration_);
        std::vector<TimeSpan> all = answer_.undecided;
        if (!std::ranges::all_of(all, [](const TimeSpan& s) { return s.from <= s.to; }))
            return "an undecided span is none";
        for (const FreeSpan& s : c_.free) all.push_back(s.span);
        std::ranges::sort(all, {}, &TimeSpan::from);
        double known = 0;
        for (const TimeSpan& s : all) {
            if (s.from > known) return "times are missing";
            known = std::max(known, s.to);
        }
        if (known < end) return "times are missing";
        // Contact at the start needs no free span.
        const double until =
            c_.free.empty() || c_.free.front().span.from > 0 ? 0 : c_.free.front().span.to;
        return answer_.free_until <= until ? "" : "it is not free for so long";
    }

    // ------------------------------------------------------------ contact

    std::string wrong_contact(double time) {
        if (!(0 <= time && time <= duration_)) return "the contact is not within the motion";
        return is_deep(motion_a_, time, a_, c_.triangles_a) &&
                       is_deep(motion_b_, time, b_, c_.triangles_b)
                   ? ""
                   : "a point is not deep inside both";
    }
    [[nodiscard]] bool is_deep(const EnclosedMotion& motion, double time, const Boundary& boundary,
                               const std::vector<CertifiedTriangle>& triangles) const {
        const Enclosed e(motion, time, time);
        if (!e.controls) return false;
        ExactRational farthest;
        for (const IntegerPoint& x : boundary.points())
            farthest = std::max(farthest, sum_of_magnitudes(x.rational()));
        const ExactRational deviation = e.by_length * farthest + e.constant;
        return Boundary(boundary.brep(), motion.enclose(time, time).motion.pose_at(0))
            .is_deep_inside(*c_.in_both, deviation, triangles);
    }

    // ------------------------------------------------------------ freedom

    std::string wrong_span(const FreeSpan& s) {
        const double from = s.span.from;
        if (!(0 <= from && from <= s.span.to && s.span.to <= duration_))
            return "a span is not within the motion";
        if (s.at_start.relation != Relation::Disjoint || !s.at_start.is_complete)
            return "the start of a span is not proved";
        if (const auto refusal =
                check(s.at_start, a_.brep(), motion_a_.enclose(from, from).motion.pose_at(0),
                      b_.brep(), motion_b_.enclose(from, from).motion.pose_at(0)))
            return "at the start of a span: " + refusal->reason;
        if (std::string w = wrong_tree(s.start, {from, from}); !w.empty()) return w;
        return wrong_tree(s.freedom, s.span);
    }
    std::string wrong_tree(const std::vector<Node>& nodes, const TimeSpan& time) {
        return detail::certified::wrong_tree(
            nodes,
            DoubleWalkRange{0, c_.triangles_a.size(), 0, c_.triangles_b.size(), time.from, time.to},
            [this](const Node& node, const DoubleWalkRange& r) {
                if (has_break_within(r)) return "a motion has a kink in a range";
                return are_apart(r, node.plane) ? "" : "a plane does not separate";
            });
    }
    [[nodiscard]] bool has_break_within(const DoubleWalkRange& r) const {
        const auto within = [&r](double x) { return r.from < x && x < r.to; };
        return (!motion_a_.is_still() && std::ranges::any_of(motion_a_.breaks(), within)) ||
               (!motion_b_.is_still() && std::ranges::any_of(motion_b_.breaks(), within));
    }
    const std::pair<Enclosed, Enclosed>& enclosed(const DoubleWalkRange& r) {
        auto at = enclosed_.find({r.from, r.to});
        if (at == enclosed_.end())
            at = enclosed_
                     .emplace(std::pair{r.from, r.to}, std::pair{Enclosed(motion_a_, r.from, r.to),
                                                                 Enclosed(motion_b_, r.from, r.to)})
                     .first;
        return at->second;
    }
    bool are_apart(const DoubleWalkRange& r, const SeparatingPlane& plane) {
        const auto& [of_a, of_b] = enclosed(r);
        SeparatingPlane turned;
        for (std::size_t k = 0; k < 3; ++k) turned.normal[k] = -plane.normal[k];
        turned.offset = -plane.offset;
        return stay_above(turned, of_a, a_, corners_of_a(c_.triangles_a, r)) &&
               stay_above(plane, of_b, b_, corners_of_b(c_.triangles_b, r));
    }
    // By more than they may deviate. Bernstein coefficients first; polynomials of corners for which
    // these say nothing.
    static bool stay_above(const SeparatingPlane& plane, const Enclosed& e,
                           const Boundary& boundary, const std::vector<std::uint32_t>& corners) {
        if (!e.controls) return false;
        const ExactRational length = sum_of_magnitudes(plane.normal);
        const SeparatingPlane shifted{plane.normal, plane.offset - length * e.constant};
        std::array<std::vector<IntegerPlane>, 8> planes;
        return std::ranges::all_of(corners, [&](std::uint32_t v) {
            const IntegerPoint& corner = boundary.points()[v];
            const std::size_t octant = octant_of(corner);
            if (planes[octant].empty()) {
                ExactPoint margin = signs_in(octant);
                for (ExactRational& c : margin) c *= -(length * e.by_length);
                planes[octant] = e.controls->planes(shifted, margin);
            }
            if (std::ranges::all_of(planes[octant], [&corner](const IntegerPlane& p) {
                    return p.side_of(corner) > 0;
                }))
                return true;
            const ExactPoint x = corner.rational();
            const Polynomial height = dot(constant(plane.normal), e.piece.point(x)) +
                                      Polynomial(plane.offset) * e.piece.w;
            return is_positive_on_unit(height - Polynomial(length * e.deviation(x)) * e.piece.w);
        });
    }

    const EnclosedCertificate& c_;
    const EnclosedContact& answer_;
    const EnclosedMotion& motion_a_;
    const EnclosedMotion& motion_b_;
    Boundary a_;
    Boundary b_;
    double duration_;
    std::map<std::pair<double, double>, std::pair<Enclosed, Enclosed>> enclosed_;
};

}  // namespace

}  // namespace trisect::detail::certified

namespace trisect {

std::optional<Refusal> check(const EnclosedCertificate& certificate, const Brep& a,
                             const EnclosedMotion& motion_a, const Brep& b,
                             const EnclosedMotion& motion_b) {
    std::string reason =
        detail::certified::EnclosedChecker(certificate, a, motion_a, b, motion_b).run();
    if (reason.empty()) return std::nullopt;
    return Refusal{std::move(reason)};
}

}  // namespace trisect
