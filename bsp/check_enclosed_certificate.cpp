// SPDX-License-Identifier: Apache-2.0
//
// The checker asks the motions for enclosures and has corners, polynomials and fractions. A corner
// x is at X(s) / w(s) up to a distance of by_length |x| + constant, so its height n·X / w is off by
// |n| times that at most; both lengths are bounded by sums of magnitudes, which need no roots.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/detail/certified_polynomial.h>
#include <trisect/bsp/detail/certified_triangles.h>
#include <trisect/bsp/enclosed_certificate.h>

namespace trisect {

namespace {

using detail::certified::constant;
using detail::certified::is_positive_on_unit;
using detail::certified::Piece;
using detail::certified::piece_of;
using detail::certified::Polynomial;
using Node = EnclosedFreedomNode;

ExactRational sum_of_magnitudes(const RationalPoint& v) {
    ExactRational r;
    for (const ExactRational& c : v) r += c.sign() < 0 ? -c : c;
    return r;
}

// A motion over a range of time.
struct Enclosed {
    Piece piece;
    ExactRational by_length;
    ExactRational constant;
    bool is_known = false;

    Enclosed(const EnclosedMotion& motion, double from, double to) {
        const MotionEnclosure e = motion.enclose(from, to);
        if (!std::isfinite(e.by_length) || !std::isfinite(e.constant) || e.by_length < 0 ||
            e.constant < 0 || e.motion.piece_count() != 1)
            return;
        piece = piece_of(e.motion, 0);
        by_length = ExactRational::from_double(e.by_length);
        constant = ExactRational::from_double(e.constant);
        is_known = is_positive_on_unit(piece.w);
    }
    [[nodiscard]] ExactRational deviation(const RationalPoint& x) const {
        return by_length * sum_of_magnitudes(x) + constant;
    }
};

class Checker {
public:
    Checker(const EnclosedCertificate& c, const Brep& a, const EnclosedMotion& motion_a,
            const Brep& b, const EnclosedMotion& motion_b)
        : c_(c),
          answer_(c.answer),
          brep_a_(a),
          motion_a_(motion_a),
          brep_b_(b),
          motion_b_(motion_b),
          a_(detail::corners_in_world(a, Pose())),
          b_(detail::corners_in_world(b, Pose())),
          duration_(motion_a.is_still() ? motion_b.duration() : motion_a.duration()) {}

    std::string run() {
        if (brep_a_.is_empty() || brep_b_.is_empty())
            return answer_.outcome == EnclosedContact::Outcome::None
                       ? ""
                       : "an empty solid touches nothing";
        if (!c_.free.empty() || c_.in_both)
            if (!detail::triangles_fill_faces(c_.triangles_a, brep_a_) ||
                !detail::triangles_fill_faces(c_.triangles_b, brep_b_))
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
        return is_deep(motion_a_, time, brep_a_, a_, c_.triangles_a) &&
                       is_deep(motion_b_, time, brep_b_, b_, c_.triangles_b)
                   ? ""
                   : "a point is not deep inside both";
    }
    [[nodiscard]] bool is_deep(const EnclosedMotion& motion, double time, const Brep& brep,
                               const std::vector<RationalPoint>& corners,
                               const std::vector<CertifiedTriangle>& triangles) const {
        const Enclosed e(motion, time, time);
        if (!e.is_known) return false;
        ExactRational deviation;
        for (const RationalPoint& x : corners) deviation = std::max(deviation, e.deviation(x));
        return detail::is_deep_inside(*c_.in_both, deviation, triangles, brep,
                                      motion.enclose(time, time).motion.pose_at(0));
    }

    // ------------------------------------------------------------ freedom

    std::string wrong_span(const FreeSpan& s) {
        const double from = s.span.from;
        if (!(0 <= from && from <= s.span.to && s.span.to <= duration_))
            return "a span is not within the motion";
        if (s.at_start.relation != Relation::Disjoint || !s.at_start.is_complete)
            return "the start of a span is not proved";
        if (std::string w = check_certificate(
                s.at_start, brep_a_, motion_a_.enclose(from, from).motion.pose_at(0), brep_b_,
                motion_b_.enclose(from, from).motion.pose_at(0));
            !w.empty())
            return "at the start of a span: " + w;
        if (std::string w = wrong_tree(s.start, {from, from}); !w.empty()) return w;
        return wrong_tree(s.freedom, s.span);
    }

    struct Range {
        std::size_t node = 0;
        TimeSpan time;
        std::size_t a0 = 0;
        std::size_t a1 = 0;
        std::size_t b0 = 0;
        std::size_t b1 = 0;
    };
    std::string wrong_tree(const std::vector<Node>& nodes, const TimeSpan& time) {
        std::vector<bool> seen(nodes.size(), false);
        std::vector<Range> open{{0, time, 0, c_.triangles_a.size(), 0, c_.triangles_b.size()}};
        while (!open.empty()) {
            const Range r = open.back();
            open.pop_back();
            if (r.node >= nodes.size() || seen[r.node]) return "the tree is no tree";
            seen[r.node] = true;
            const Node& n = nodes[r.node];
            Range first = r;
            Range second = r;
            first.node = r.node + 1;
            second.node = n.other;
            switch (n.kind) {
                case Node::Kind::Separated:
                    if (has_break_within(r.time)) return "a motion has a kink in a range";
                    if (!are_apart(r, n.plane)) return "a plane does not separate";
                    continue;
                case Node::Kind::SplitTime:
                    if (!(r.time.from < n.time && n.time < r.time.to))
                        return "a time is not in its range";
                    first.time.to = second.time.from = n.time;
                    break;
                case Node::Kind::SplitA:
                    if (r.a1 - r.a0 < 2) return "the tree splits a single triangle";
                    first.a1 = second.a0 = (r.a0 + r.a1) / 2;
                    break;
                case Node::Kind::SplitB:
                    if (r.b1 - r.b0 < 2) return "the tree splits a single triangle";
                    first.b1 = second.b0 = (r.b0 + r.b1) / 2;
                    break;
            }
            open.push_back(first);
            open.push_back(second);
        }
        return {};
    }
    [[nodiscard]] bool has_break_within(const TimeSpan& t) const {
        const auto within = [&t](double x) { return t.from < x && x < t.to; };
        return (!motion_a_.is_still() && std::ranges::any_of(motion_a_.breaks(), within)) ||
               (!motion_b_.is_still() && std::ranges::any_of(motion_b_.breaks(), within));
    }
    const std::pair<Enclosed, Enclosed>& enclosed(const TimeSpan& t) {
        auto at = enclosed_.find({t.from, t.to});
        if (at == enclosed_.end())
            at = enclosed_
                     .emplace(std::pair{t.from, t.to}, std::pair{Enclosed(motion_a_, t.from, t.to),
                                                                 Enclosed(motion_b_, t.from, t.to)})
                     .first;
        return at->second;
    }
    bool are_apart(const Range& r, const SeparatingPlane& plane) {
        const auto& [of_a, of_b] = enclosed(r.time);
        return are_beyond(plane, of_a, a_, c_.triangles_a, r.a0, r.a1, -1) &&
               are_beyond(plane, of_b, b_, c_.triangles_b, r.b0, r.b1, 1);
    }
    static bool are_beyond(const SeparatingPlane& plane, const Enclosed& e,
                           const std::vector<RationalPoint>& corners,
                           const std::vector<CertifiedTriangle>& triangles, std::size_t from,
                           std::size_t to, int side) {
        if (!e.is_known) return false;
        const ExactRational length = sum_of_magnitudes(plane.normal);
        const ExactRational sign(side);
        return std::ranges::all_of(
            detail::corners_of_range(triangles, from, to), [&](std::uint32_t v) {
                const Polynomial height = dot(constant(plane.normal), e.piece.point(corners[v])) +
                                          Polynomial(plane.offset) * e.piece.w;
                const Polynomial margin = Polynomial(length * e.deviation(corners[v])) * e.piece.w;
                return is_positive_on_unit(Polynomial(sign) * height - margin);
            });
    }

    const EnclosedCertificate& c_;
    const EnclosedContact& answer_;
    const Brep& brep_a_;
    const EnclosedMotion& motion_a_;
    const Brep& brep_b_;
    const EnclosedMotion& motion_b_;
    std::vector<RationalPoint> a_;
    std::vector<RationalPoint> b_;
    double duration_;
    std::map<std::pair<double, double>, std::pair<Enclosed, Enclosed>> enclosed_;
};

}  // namespace

std::string check_enclosed_certificate(const EnclosedCertificate& certificate, const Brep& a,
                                       const EnclosedMotion& motion_a, const Brep& b,
                                       const EnclosedMotion& motion_b) {
    return Checker(certificate, a, motion_a, b, motion_b).run();
}

}  // namespace trisect
