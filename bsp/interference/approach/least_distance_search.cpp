// SPDX-License-Identifier: Apache-2.0
//
// Branch and bound over time. With U the least upper bound so far, of the distance at some time, a
// range of time is done when the boundaries are proved to be farther than U - w all over it, w the
// width requested. U only falls, so the last U - w bounds the distance from below everywhere.
//
// A good U at once leaves out most of the time in long ranges: each part between breaks is asked at
// some places, and around the nearest one the distance is followed down.
//
// A range that is not done is halved with the pairs of boxes that are left: what is farther during
// a range is so during its halves.

#include <trisect/bsp/interference/approach/least_distance_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/motion/swept_separation.h>
#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Ranges of time shorter than this part of the duration are not halved any more.
constexpr double smallest_range = 0x1p-40;
// Each part between breaks is asked at so many places, and the nearest one followed in so many.
constexpr int samples = 16;
constexpr int steps_down = 12;
// So few pairs of triangles are compared at once, however far they sweep.
constexpr std::size_t pairs_tested_at_once = 64;

}  // namespace

LeastDistanceSearch::LeastDistanceSearch(const Boundary& a, const EnclosedMotion& motion_a,
                                         const Boundary& b, const EnclosedMotion& motion_b,
                                         const LeastDistanceOptions& options)
    : a_(a),
      motion_a_(motion_a),
      b_(b),
      motion_b_(motion_b),
      options_(options),
      views_(a, motion_a, b, motion_b),
      walk_(a.boxes, b.boxes) {
    if (!(options.relative >= 0x1p-30 && options.relative <= 1))
        throw UsageError("the relative width of a least distance must be between 2^-30 and 1");
    if (!(options.absolute >= 0) || !std::isfinite(options.absolute))
        throw UsageError("the width of a least distance must be finite and not negative");
}

void LeastDistanceSearch::run() {
    floor_ = views_.breaks().back() * smallest_range;
    upper_ = lower_ = infinite;
    sample();
    // What is certainly farther needs no finer answer than doubles have for what is there.
    options_.absolute = std::max(options_.absolute, 0x1p-40 * (reach_of(a_) + reach_of(b_)));
    for (std::size_t i = 1; i < views_.breaks().size() && goal() > 0; ++i)
        visit(views_.breaks()[i - 1], views_.breaks()[i], {SweptWalk::Pair{}});
    if (goal() <= 0) lower_ = 0;
    is_narrow_ =
        is_narrow_ && upper_ - lower_ <= std::max(options_.relative * upper_, options_.absolute);
}

// The distance at a time, if it is below the limit; notes the least.
double LeastDistanceSearch::ask(double time, double limit) {
    check_stop();
    ++questions_;
    const Pose pose_a = pose_of(motion_a_, time);
    const Pose pose_b = pose_of(motion_b_, time);
    DistanceSearch search(a_, pose_a, b_, pose_b);
    search.run_for_bounds(limit);
    if (!(search.upper() < infinite)) return infinite;
    const double upper = (search.upper() + views_.deviation_at(time)) * slightly_more;
    if (upper < upper_) {
        upper_ = search.candidates().front().crossing && views_.deviation_at(time) == 0 ? 0 : upper;
        time_ = time;
        nearest_ = search.candidates().front();
    }
    return search.upper();
}

void LeastDistanceSearch::sample() {
    const std::vector<double>& breaks = views_.breaks();
    ask(breaks.front(), infinite);
    for (std::size_t i = 1; i < breaks.size(); ++i) {
        const double part = (breaks[i] - breaks[i - 1]) / samples;
        double least = infinite;
        double at = breaks[i];
        for (int k = 1; k <= samples; ++k) {
            const double time = k == samples ? breaks[i] : breaks[i - 1] + part * k;
            const double d = ask(time, upper_);
            if (!(d < least)) continue;
            least = d;
            at = time;
        }
        if (least < infinite && upper_ > 0)
            descend(std::max(breaks[i - 1], at - part), std::min(breaks[i], at + part));
    }
}

// By golden sections, as if there were one valley.
void LeastDistanceSearch::descend(double from, double to) {
    constexpr double golden = 0.6180339887498949;
    double left = to - golden * (to - from);
    double right = from + golden * (to - from);
    double at_left = ask(left, infinite);
    double at_right = ask(right, infinite);
    for (int i = 0; i < steps_down && upper_ > 0; ++i) {
        if (at_left < at_right) {
            to = right;
            right = left;
            at_right = at_left;
            left = to - golden * (to - from);
            at_left = ask(left, infinite);
        } else {
            from = left;
            left = right;
            at_left = at_right;
            right = from + golden * (to - from);
            at_right = ask(right, infinite);
        }
    }
}

// What is to be proved of every time. The factor pays for the rounding of the difference.
double LeastDistanceSearch::goal() const {
    return upper_ - (1 - 0x1p-16) * std::max(options_.relative * upper_, options_.absolute);
}

bool LeastDistanceSearch::is_beyond(double from, double to, double distance, const Pairs& front,
                                    Pairs& rest) {
    ++ranges_;
    const SweptView view = views_.view(from, to, distance);
    if (view.margin == HUGE_VAL) {
        rest = front;
        return false;
    }
    // Boxes are divided while they are large beside the sweep alone.
    const double sweep = view.swept.sweep;
    const ObbPose pose(a_.boxes, b_.boxes, view.swept.map, sweep + view.margin);
    if (pose.is_apart()) return true;
    Pairs leaves;
    walk_.refine(pose, sweep, front, leaves, rest);
    if (leaves.size() > pairs_tested_at_once && walk_.are_long(pose, sweep, leaves))
        rest.insert(rest.end(), leaves.begin(), leaves.end());
    else
        keep_what_may_be_near(view, leaves, rest);
    return rest.empty();
}

void LeastDistanceSearch::keep_what_may_be_near(const SweptView& view, Pairs& leaves, Pairs& rest) {
    const ObbTree& ta = a_.boxes;
    const ObbTree& tb = b_.boxes;
    std::sort(leaves.begin(), leaves.end(), [](const auto& p, const auto& q) {
        return p.b.index != q.b.index ? p.b.index < q.b.index : p.a.index < q.a.index;
    });
    SweptSeparation separation(a_, b_, view.motion, view.swept, view.margin);
    const auto are_far = [&](ObbChild la, ObbChild lb) {
        for (std::uint32_t j = 0; j < lb.count(); ++j)
            for (std::uint32_t i = 0; i < la.count(); ++i)
                if (!separation.are_apart(ta.order[la.first() + i], tb.order[lb.first() + j]))
                    return false;
        return true;
    };
    for (const SweptWalk::Pair& p : leaves)
        if (!are_far(ta.child(p.a), tb.child(p.b))) rest.push_back(p);
}

void LeastDistanceSearch::visit(double from, double to, const Pairs& front) {
    check_stop();
    const double distance = goal();
    if (!(distance > 0)) return;
    Pairs rest;
    if (is_beyond(from, to, distance, front, rest)) {
        lower_ = std::min(lower_, distance);
        return;
    }
    const double middle = from + (to - from) / 2;
    if (to - from <= floor_ || !(from < middle && middle < to)) {
        lower_ = 0;
        is_narrow_ = false;
        return;
    }
    ask(middle, upper_);
    visit(from, middle, rest);
    visit(middle, to, rest);
}

}  // namespace trisect::detail
