// SPDX-License-Identifier: Apache-2.0
//
// The deviations of both enclosures are a margin (swept_view.cpp). Where the boundaries are farther
// apart than the margin during a range of time they do not meet in it, and whether one solid is
// within the other is the same all over it, for the true motion as for the enclosure: on the way
// from one pose to the other no boundary reaches the other one.
//
// The same margin, as an error of all corners, makes a crossing of two triangles in doubles one of
// the true ones. And a point of B that the enclosure takes into A, deeper than the margin, is in A
// in truth.
//
// The search goes down the earlier half first. See visit for when it stops.

#include <trisect/bsp/interference/approach/enclosed_query.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/motion/swept_separation.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

// Ranges of time shorter than this part of the duration are not halved any more,
constexpr double smallest_part = 0x1p-40;
// and this one where an earlier time is undecided anyway.
constexpr double smallest_later_part = 0x1p-10;
// So few pairs of triangles are compared at once, however far they sweep.
constexpr std::size_t pairs_compared_at_once = 6;

// Up to rounding: a proposal.
std::array<double, 3> pulled_back(const std::array<double, 3>& p, const ApproximateMap& map) {
    const auto& m = map.m;
    const std::array<double, 3> v{p[0] - map.t[0], p[1] - map.t[1], p[2] - map.t[2]};
    const auto column = [&m](std::size_t j) {
        return std::array<double, 3>{m[0][j], m[1][j], m[2][j]};
    };
    const auto det = [](const std::array<double, 3>& x, const std::array<double, 3>& y,
                        const std::array<double, 3>& z) {
        return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
               x[2] * (y[0] * z[1] - y[1] * z[0]);
    };
    const double whole = det(column(0), column(1), column(2));
    return {det(v, column(1), column(2)) / whole, det(column(0), v, column(2)) / whole,
            det(column(0), column(1), v) / whole};
}

}  // namespace

EnclosedQuery::EnclosedQuery(const Boundary& a, const EnclosedMotion& motion_a, const Boundary& b,
                             const EnclosedMotion& motion_b, const EnclosedContactOptions& options)
    : a_(a),
      motion_a_(motion_a),
      b_(b),
      motion_b_(motion_b),
      width_(options.width),
      views_(a, motion_a, b, motion_b),
      walk_(a.boxes, b.boxes) {
    if (!(width_ > 0) || !std::isfinite(width_))
        throw UsageError("the width of a contact's interval must be positive");
}

EnclosedContact EnclosedQuery::run() {
    const std::vector<double>& breaks = views_.breaks();
    const double duration = breaks.back();
    floor_ = duration * smallest_part;
    later_floor_ = std::max(width_, duration * smallest_later_part);
    result_.free_until = duration;
    if (a_.boxes.is_empty() || b_.boxes.is_empty()) return std::move(result_);
    if (is_contact(0)) found(0, 0);
    for (std::size_t i = 1; i < breaks.size() && !result_.contact_by; ++i)
        visit(breaks[i - 1], breaks[i], {SweptWalk::Pair{}});
    finish();
    return std::move(result_);
}

// Whether the boundaries are certainly apart during a range; if not, what is left of `front`.
bool EnclosedQuery::is_free(const SweptView& view, const Pairs& front, bool is_last, Pairs& rest) {
    ++counters_.intervals;
    if (view.margin == HUGE_VAL) {
        rest = front;
        return false;
    }
    const double sweep = view.swept.sweep + view.margin;
    const ObbPose pose(a_.boxes, b_.boxes, view.swept.map, sweep);
    if (pose.is_apart()) return true;
    Pairs leaves;
    walk_.refine(pose, sweep, front, leaves, rest);
    if (!is_last && leaves.size() > pairs_compared_at_once && walk_.are_long(pose, sweep, leaves))
        rest.insert(rest.end(), leaves.begin(), leaves.end());
    else
        keep_what_may_meet(view, leaves, rest);
    return rest.empty();
}

void EnclosedQuery::keep_what_may_meet(const SweptView& view, Pairs& leaves, Pairs& rest) {
    const ObbTree& ta = a_.boxes;
    const ObbTree& tb = b_.boxes;
    std::sort(leaves.begin(), leaves.end(), [](const auto& p, const auto& q) {
        return p.b.index != q.b.index ? p.b.index < q.b.index : p.a.index < q.a.index;
    });
    SweptSeparation separation(a_, b_, view.motion, view.swept, view.margin);
    const auto are_apart = [&](ObbChild la, ObbChild lb) {
        for (std::uint32_t j = 0; j < lb.count(); ++j)
            for (std::uint32_t i = 0; i < la.count(); ++i) {
                ++counters_.triangle_pairs;
                if (!separation.are_apart(ta.order[la.first() + i], tb.order[lb.first() + j]))
                    return false;
            }
        return true;
    };
    for (const SweptWalk::Pair& p : leaves)
        if (!are_apart(ta.child(p.a), tb.child(p.b))) rest.push_back(p);
}

// Ends at the first contact that is proved. Until a range is given up as undecided, ranges are
// halved down to the floor and the end of a short one is tested for a contact at once. The
// ranges after an undecided one, each twice as long as the one before it, end there.
void EnclosedQuery::visit(double from, double to, const Pairs& front) {
    const double middle = from + (to - from) / 2;
    const bool is_last = to - from <= floor_ || !(from < middle && middle < to);
    Pairs rest;
    if (is_free(view(from, to), front, is_last, rest)) {
        if (!is_inside_known_) settle_inside(from);
        return;
    }
    if (is_last || to - from <= width_) {
        if (is_contact(to)) {
            found(from, narrowed(from, to));
            return;
        }
    }
    if (is_last) {
        give_up(from, to);
        return;
    }
    visit(from, middle, rest);
    if (!result_.contact_by) visit(middle, to, rest);
}

void EnclosedQuery::give_up(double from, double to) {
    Undecided& u = result_.undecided;
    if (!u.empty() && u.back().to == from)
        u.back().to = to;
    else
        u.push_back({from, to});
    floor_ = later_floor_;
    is_inside_known_ = false;
}

// The boundaries are apart from this time on: is one solid within the other?
void EnclosedQuery::settle_inside(double time) {
    const SweptView now = view(time, time);
    Pairs rest;
    if (!is_free(now, {SweptWalk::Pair{}}, true, rest)) {
        give_up(time, time);
        return;
    }
    is_inside_known_ = true;
    const Pose pose_a = motion_a_.enclose(time, time).motion.pose_at(0);
    const Pose pose_b = motion_b_.enclose(time, time).motion.pose_at(0);
    if (relation_at(pose_a, pose_b) != Relation::Disjoint) found(time, time);
}

// Whether the solids certainly meet at a time. Notes the faces that do.
bool EnclosedQuery::is_contact(double time) {
    const SweptView now = view(time, time);
    if (now.margin == HUGE_VAL) return false;
    ApproximateMap map = now.swept.map;
    map.t_error = (now.swept.sweep + now.margin) * surely_more;
    ObbWalk walk(a_.boxed(), b_.boxed(), map, stack_);
    bool any = false;
    crossing_.reset();
    const bool crossing = walk.run([&](std::uint32_t i, std::uint32_t j, PairVerdict verdict) {
        any = true;
        if (verdict != PairVerdict::Crossing) return false;
        crossing_ = {i, j};
        return true;
    });
    return crossing || (any && is_deep(map));
}

// Whether a point of B certainly lies in A. Tried are points of the middle of what the boxes
// have in common: solids that are aligned have no crossing faces, but a point well inside both.
bool EnclosedQuery::is_deep(const ApproximateMap& map) {
    const Boundary& a = a_;
    const Boundary& b = b_;
    // The box of B, moved, and then what it has in common with that of A.
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};
    std::array<double, 3> center{};
    for (std::size_t k = 0; k < 3; ++k) center[k] = (b.lo[k] + b.hi[k]) / 2;
    const std::array<double, 3> moved = map(center);
    for (std::size_t k = 0; k < 3; ++k) {
        double half = 0;
        for (std::size_t j = 0; j < 3; ++j) half += std::abs(map.m[k][j]) * (b.hi[j] - b.lo[j]) / 2;
        lo[k] = std::max(a.lo[k], moved[k] - half);
        hi[k] = std::min(a.hi[k], moved[k] + half);
        if (!(lo[k] < hi[k])) return false;
    }
    for (unsigned i = 0; i <= 8; ++i) {
        std::array<double, 3> p{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double part = i == 8 ? 0.5 : ((i >> k & 1U) != 0 ? 0.8125 : 0.21875);
            p[k] = lo[k] + part * (hi[k] - lo[k]);
        }
        if (is_deep_at(p, map)) return true;
    }
    return false;
}

bool EnclosedQuery::is_deep_at(const std::array<double, 3>& p, const ApproximateMap& map) {
    const std::array<double, 3> in_b = pulled_back(p, map);
    const auto in_user_units = [](const std::array<double, 3>& v, int exponent) {
        return std::array<double, 3>{std::ldexp(v[0], exponent), std::ldexp(v[1], exponent),
                                     std::ldexp(v[2], exponent)};
    };
    for (const double v : in_b)
        if (!(std::abs(v) < 0x1p60)) return false;
    if (index_b().locate(in_user_units(in_b, b_.lattice.exponent)).location == Location::Outside)
        return false;
    const std::array<double, 3> image = in_user_units(map(in_b), a_.lattice.exponent);
    const BrepIndex& index = index_a();
    if (index.locate(image).location != Location::Inside) return false;
    const double largest = std::max({std::abs(in_b[0]), std::abs(in_b[1]), std::abs(in_b[2])});
    const double error = std::ldexp(2 * map.error_below(largest, 0), a_.lattice.exponent);
    const auto nearest = index.nearest(image);
    return nearest && std::isfinite(error) &&
           nearest->squared_distance >
               ExactRational::from_double(error) * ExactRational::from_double(error);
}

// \pre is_contact(to), called last
double EnclosedQuery::narrowed(double from, double to) {
    double proved = to;
    std::optional<Crossing> crossing = crossing_;
    const double goal = width_ / 4;
    while (proved - from > goal) {
        const double middle = from + (proved - from) / 2;
        if (!(from < middle && middle < proved)) break;
        if (is_contact(middle)) {
            proved = middle;
            crossing = crossing_;
        } else {
            from = middle;
        }
    }
    crossing_ = crossing;
    return proved;
}

// A contact at `by`; nothing is known from `from` on.
void EnclosedQuery::found(double from, double by) {
    result_.contact_by = by;
    if (from < by) {
        Undecided& u = result_.undecided;
        if (!u.empty() && u.back().to == from)
            u.back().to = by;
        else
            u.push_back({from, by});
    }
}

void EnclosedQuery::finish() {
    using Outcome = EnclosedContact::Outcome;
    if (!result_.contact_by) crossing_.reset();
    result_.outcome = result_.contact_by           ? Outcome::Contact
                      : !result_.undecided.empty() ? Outcome::Undecided
                                                   : Outcome::None;
    if (result_.contact_by) result_.free_until = *result_.contact_by;
    if (!result_.undecided.empty()) result_.free_until = result_.undecided.front().from;
    result_.is_narrow = result_.contact_by && *result_.contact_by - result_.free_until <= width_;
    counters_.box_tests = walk_.box_tests();
}

}  // namespace trisect::detail
