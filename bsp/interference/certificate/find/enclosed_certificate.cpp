// SPDX-License-Identifier: Apache-2.0
//
// Finding certificates of contact under enclosed motions. What is found need not be right: the
// checker says.
//
// Planes rest in the world, so that each enclosure is looked at by itself and its deviation is a
// plain distance. Where solids move far in the time looked at, or come near each other, time is
// halved: shortly before a contact at constant speed half of the time left has half of the gap, so
// there are as many halvings as the answer has bits, and few triangles take part in the last ones.

#include <trisect/bsp/interference/enclosed_certificate.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/find/proof_body.h>
#include <trisect/bsp/interference/certificate/find/proof_tree.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect {

namespace {

using detail::Ball;
using detail::BallMotion;
using detail::BallVector;
using detail::dot;
using detail::minus;
using detail::ProofBody;
using detail::rounded;
using detail::proof::Approximate;
using Node = EnclosedFreedomNode;

constexpr int most_enclosed_levels = 300;

double sum_of_magnitudes(const Approximate& v) {
    return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}
BallVector direction(const Approximate& d) { return {Ball(d[0]), Ball(d[1]), Ball(d[2])}; }

// A solid's enclosure over a range of time.
struct EnclosedView {
    BallMotion motion;
    double by_length;
    double constant;

    explicit EnclosedView(const MotionEnclosure& e)
        : motion(BallMotion::of_points(detail::piece_of(e.motion, 0))),
          by_length(e.by_length),
          constant(e.constant) {}

    [[nodiscard]] double deviation(const Approximate& x) const {
        return (by_length * sum_of_magnitudes(x) + constant) * (1 + 0x1p-30);
    }
};

class FreedomFinder {
public:
    using Range = detail::ProofRange<double>;

    FreedomFinder(const ProofBody& a, const EnclosedMotion& motion_a, const ProofBody& b,
                  const EnclosedMotion& motion_b, std::vector<double> breaks, std::size_t limit)
        : a_(a),
          motion_a_(motion_a),
          b_(b),
          motion_b_(motion_b),
          breaks_(std::move(breaks)),
          limit_(limit) {}

    // Nothing where it fails.
    std::optional<std::vector<Node>> find(double from, double to) {
        return detail::ProofTree<Node, double, FreedomFinder>(*this, {limit_, most_enclosed_levels})
            .build({0, a_.triangles.size(), 0, b_.triangles.size(), from, to});
    }
    bool separate(const Range& r, Node& node) {
        if (kink_within(r)) return false;
        auto plane = plane_between(views(r.from, r.to), a_.corners(r.a0, r.a1),
                                   b_.corners(r.b0, r.b1), r.is_single());
        if (plane) node.plane = std::move(*plane);
        return plane.has_value();
    }
    std::optional<double> time_to_split(const Range& r) {
        if (const auto kink = kink_within(r)) return kink;
        const double middle = r.from + (r.to - r.from) / 2;
        if (!(r.from < middle && middle < r.to)) return std::nullopt;
        if (r.is_single() ||
            moves_far(views(r.from, r.to), a_.corners(r.a0, r.a1), b_.corners(r.b0, r.b1)))
            return middle;
        return std::nullopt;
    }
    static void set_time(Node& node, double time) { node.time = time; }

private:
    struct Views {
        EnclosedView a;
        EnclosedView b;
    };
    using Indices = std::span<const std::uint32_t>;

    const Views& views(double from, double to) {
        auto at = views_.find({from, to});
        if (at == views_.end())
            at = views_
                     .emplace(std::pair{from, to}, Views{EnclosedView(motion_a_.enclose(from, to)),
                                                         EnclosedView(motion_b_.enclose(from, to))})
                     .first;
        return at->second;
    }

    [[nodiscard]] std::optional<double> kink_within(const Range& r) const {
        const auto kink = std::upper_bound(breaks_.begin(), breaks_.end(), r.from);
        if (kink == breaks_.end() || !(*kink < r.to)) return std::nullopt;
        return *kink;
    }
    static double squared_way(const EnclosedView& view, const ProofBody& body, Indices corners) {
        double square = 0;
        for (const std::uint32_t v : {corners.front(), corners.back()}) {
            const Approximate& x = body.near[v];
            const Approximate d = minus(view.motion.guessed_image(view.motion.degree, x),
                                        view.motion.guessed_image(0, x));
            square = std::max(square, dot(d, d));
        }
        return square;
    }
    // Either solid farther than half of what is larger, or by an unknown way.
    bool moves_far(const Views& v, Indices of_a, Indices of_b) const {
        if (!std::isfinite(v.a.by_length + v.a.constant + v.b.by_length + v.b.constant))
            return true;
        const double way = std::max(squared_way(v.a, a_, of_a), squared_way(v.b, b_, of_b));
        return 4 * way > std::max(a_.squared_size(of_a), b_.squared_size(of_b));
    }

    std::optional<SeparatingPlane> plane_between(const Views& v, Indices of_a, Indices of_b,
                                                 bool single) const {
        const std::size_t half_a = v.a.motion.degree / 2;
        const std::size_t half_b = v.b.motion.degree / 2;
        const Approximate from = v.a.motion.guessed_image(half_a, a_.middle(of_a));
        const Approximate to = v.b.motion.guessed_image(half_b, b_.middle(of_b));
        std::vector<Approximate> directions = detail::proof_directions(minus(to, from));
        if (single) {
            detail::TriangleCorners p;
            detail::TriangleCorners q;
            for (std::size_t i = 0; i < 3; ++i) {
                p[i] = v.a.motion.guessed_image(half_a, a_.near[of_a[i]]);
                q[i] = v.b.motion.guessed_image(half_b, b_.near[of_b[i]]);
            }
            detail::add_proof_directions(p, q, directions);
        }
        for (const Approximate& d : directions)
            if (auto plane = plane_along(d, v, of_a, of_b)) return plane;
        return std::nullopt;
    }

    // Heights of a body's corners along a direction: bounds of all coefficients, over the weight,
    // with `sign` times the deviation.
    struct Heights {
        std::vector<std::vector<Ball>> all;  // by corner and coefficient
        std::vector<double> margins;
        double extreme;
    };
    static Heights heights(const Approximate& d, const EnclosedView& view, const ProofBody& body,
                           Indices corners, int sign) {
        Heights r{{}, {}, -HUGE_VAL};
        const BallVector e = direction(d);
        const double length = sum_of_magnitudes(d) * (1 + 0x1p-30);
        for (const std::uint32_t v : corners) {
            const BallVector x = rounded(body.near[v]);
            auto& h = r.all.emplace_back();
            const double margin = length * view.deviation(body.near[v]);
            r.margins.push_back(margin);
            for (std::size_t k = 0; k <= view.motion.degree; ++k) {
                const BallMotion::Maps& m = view.motion.maps[k];
                h.push_back(detail::dot(e, m.matrix * x + m.shift));
                r.extreme = std::max(r.extreme, sign * h.back().value / m.weight.value + margin);
            }
        }
        r.extreme *= sign;
        return r;
    }
    static bool are_beyond(double at, const EnclosedView& view, const Heights& h, int side) {
        for (std::size_t i = 0; i < h.all.size(); ++i)
            for (std::size_t k = 0; k <= view.motion.degree; ++k) {
                const Ball limit =
                    (Ball(at) + Ball(side * h.margins[i])) * view.motion.maps[k].weight;
                if ((h.all[i][k] - limit).sign() != side) return false;
            }
        return true;
    }
    std::optional<SeparatingPlane> plane_along(const Approximate& d, const Views& v, Indices of_a,
                                               Indices of_b) const {
        const Heights a = heights(d, v.a, a_, of_a, 1);
        if (!std::isfinite(a.extreme)) return std::nullopt;
        const Heights b = heights(d, v.b, b_, of_b, -1);
        const double at = a.extreme + (b.extreme - a.extreme) / 2;
        if (!(a.extreme <= at) || !std::isfinite(at)) return std::nullopt;
        if (!are_beyond(at, v.a, a, -1) || !are_beyond(at, v.b, b, 1)) return std::nullopt;
        SeparatingPlane plane;
        for (std::size_t k = 0; k < 3; ++k) plane.normal[k] = ExactRational::from_double(d[k]);
        plane.offset = -ExactRational::from_double(at);
        return plane;
    }

    const ProofBody& a_;
    const EnclosedMotion& motion_a_;
    const ProofBody& b_;
    const EnclosedMotion& motion_b_;
    std::vector<double> breaks_;
    std::size_t limit_;
    std::map<std::pair<double, double>, Views> views_;
};

std::vector<double> all_breaks(const EnclosedMotion& a, const EnclosedMotion& b) {
    std::vector<double> r;
    if (!a.is_still()) r.assign(a.breaks().begin(), a.breaks().end());
    if (!b.is_still()) r.insert(r.end(), b.breaks().begin(), b.breaks().end());
    std::ranges::sort(r);
    return r;
}

// The times that are not undecided, up to a contact or the end.
std::vector<TimeSpan> free_spans(const EnclosedContact& answer, double duration) {
    std::vector<TimeSpan> r;
    double from = 0;
    for (const TimeSpan& u : answer.undecided) {
        if (from < u.from) r.push_back({from, u.from});
        from = u.to;
    }
    const double end = answer.contact_by.value_or(duration);
    if (from < end) r.push_back({from, end});
    return r;
}

// Whether a point is inside a solid, deeper than its enclosure deviates at a moment.
bool is_deep_inside(const ExactPoint& p, const InterferenceModel& m, const MotionEnclosure& e,
                    const std::vector<CertifiedTriangle>& triangles) {
    ExactRational reach;
    const detail::certified::Boundary modelled(m.brep());
    for (const auto& corner : modelled.points())
        reach = std::max(reach, detail::certified::sum_of_magnitudes(corner.rational()));
    return detail::certified::Boundary(m.brep(), e.motion.pose_at(0))
        .is_deep_inside(p,
                        ExactRational::from_double(e.by_length) * reach +
                            ExactRational::from_double(e.constant),
                        triangles);
}

bool prove_contact(EnclosedCertificate& c, double time, const InterferenceModel& a,
                   const EnclosedMotion& motion_a, const InterferenceModel& b,
                   const EnclosedMotion& motion_b) {
    const MotionEnclosure ea = motion_a.enclose(time, time);
    const MotionEnclosure eb = motion_b.enclose(time, time);
    const InterferenceCertificate s =
        certify_relation(a, ea.motion.pose_at(0), b, eb.motion.pose_at(0));
    if (!s.in_both || !is_deep_inside(*s.in_both, a, ea, c.triangles_a) ||
        !is_deep_inside(*s.in_both, b, eb, c.triangles_b))
        return false;
    c.in_both = s.in_both;
    return true;
}

}  // namespace

EnclosedCertificate certify_enclosed_contact(
    const InterferenceModel& a, const EnclosedMotion& motion_a, const InterferenceModel& b,
    const EnclosedMotion& motion_b, const EnclosedContactOptions& options, std::size_t max_nodes) {
    EnclosedCertificate c;
    c.answer = enclosed_first_contact(a, motion_a, b, motion_b, options);
    if (a.is_empty() || b.is_empty()) {
        c.is_complete = true;
        return c;
    }
    ProofBody body_a(detail::data_of(a));
    ProofBody body_b(detail::data_of(b));
    c.triangles_a = body_a.triangles;
    c.triangles_b = body_b.triangles;
    const double duration = motion_a.is_still() ? motion_b.duration() : motion_a.duration();
    FreedomFinder finder(body_a, motion_a, body_b, motion_b, all_breaks(motion_a, motion_b),
                         max_nodes);
    for (const TimeSpan& span : free_spans(c.answer, duration)) {
        FreeSpan s;
        s.span = span;
        auto start = finder.find(span.from, span.from);
        auto freedom = finder.find(span.from, span.to);
        if (!start || !freedom) return c;
        s.start = std::move(*start);
        s.freedom = std::move(*freedom);
        s.at_start = certify_relation(a, motion_a.enclose(span.from, span.from).motion.pose_at(0),
                                      b, motion_b.enclose(span.from, span.from).motion.pose_at(0));
        if (!s.at_start.is_complete || s.at_start.relation != Relation::Disjoint) return c;
        c.free.push_back(std::move(s));
    }
    c.is_complete =
        !c.answer.contact_by || prove_contact(c, *c.answer.contact_by, a, motion_a, b, motion_b);
    return c;
}

}  // namespace trisect
