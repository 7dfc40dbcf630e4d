// SPDX-License-Identifier: Apache-2.0
//
// What can meet during an interval of the parameter, meets boxes of the middle pose that are grown
// by the sweep: how far any point is from there at most. With numerators X(s) and weight w(s) and
// the value v in the middle, |X / w - v| = |X - v w| / w, and X - v w is a polynomial whose
// Bernstein coefficients bound it; so the sweep shrinks with the interval, and what numerator and
// weight have in common cancels.
//
// Space and time are halved in turns. A pair of boxes much smaller than the sweep would be kept
// whatever it is like, so boxes are divided only while they are larger; then time is. The pairs
// left over, the front, are what both halves begin with, the earlier one first. Where it finds an
// event the later one is never looked at: the first contact costs what lies before it.

#include <trisect/bsp/detail/contact_search.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

namespace {

// Intervals stay multiples of 2^-36, and their halves in PairEvents exact doubles.
constexpr int max_depth = 36;
// Pairs of triangles smaller than this many sweeps wait for a shorter interval (measured: screw and
// nut, gears; half or twice as many cost up to a quarter more).
constexpr double long_sweep = 8;
// Boxes smaller than this many sweeps are not divided: the time is.
constexpr double coarse_sweep = 4;
// So few pairs of triangles are solved at once, however long the interval is.
constexpr std::size_t few_pairs = 6;

double magnitude_of(double v) { return std::abs(v); }

// The value of num / weight in the middle and how far it moves from there.
struct Swept {
    double value = 0;
    double reach = 0;
};

template <class Numerator>
Swept sweep_of(const BallMotion& motion, const Numerator& numerator) {
    const auto middle_of = [&motion](const auto& coefficient) {
        std::array<double, BallPolynomial::max_degree + 1> row{};
        for (std::size_t k = 0; k <= motion.degree; ++k) row[k] = coefficient(k);
        for (std::size_t n = motion.degree; n > 0; --n)
            for (std::size_t k = 0; k < n; ++k) row[k] = (row[k] + row[k + 1]) / 2;
        return row[0];
    };
    Swept r;
    r.value = middle_of([&](std::size_t k) { return numerator(k).value; }) /
              middle_of([&](std::size_t k) { return motion.maps[k].weight.value; });
    double least = motion.maps[0].weight.lower();
    for (std::size_t k = 0; k <= motion.degree; ++k) {
        const Ball rest = numerator(k) - Ball(r.value) * motion.maps[k].weight;
        r.reach = std::max(r.reach, magnitude_of(rest.value) + rest.error);
        least = std::min(least, motion.maps[k].weight.lower());
    }
    // Without a positive bound on the weight nothing is known.
    r.reach = least > 0 ? r.reach / least * (1 + 0x1p-50) : HUGE_VAL;
    return r;
}

}  // namespace

SweptMap swept_map(const BallMotion& motion, const std::array<double, 3>& lo,
                   const std::array<double, 3>& hi) {
    std::array<double, 3> center{};
    std::array<double, 3> half{};
    for (std::size_t j = 0; j < 3; ++j) {
        center[j] = (lo[j] + hi[j]) / 2;
        half[j] = std::max(hi[j] - center[j], center[j] - lo[j]) * (1 + 0x1p-50);
    }
    SweptMap r;
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Swept q = sweep_of(motion, [&](std::size_t k) {
            const BallMotion::Maps& m = motion.maps[k];
            return m.matrix[i][0] * Ball(center[0]) + m.matrix[i][1] * Ball(center[1]) +
                   m.matrix[i][2] * Ball(center[2]) + m.shift[i];
        });
        double reach = q.reach;
        double shift = q.value;
        double rounding = magnitude_of(q.value);
        for (std::size_t j = 0; j < 3; ++j) {
            const Swept entry =
                sweep_of(motion, [&](std::size_t k) { return motion.maps[k].matrix[i][j]; });
            r.map.m[i][j] = entry.value;
            reach += entry.reach * half[j];
            shift -= entry.value * center[j];
            rounding += magnitude_of(entry.value * center[j]);
        }
        r.map.t[i] = shift;
        reach += 0x1p-50 * rounding;
        square += reach * reach;
    }
    r.sweep = std::sqrt(square) * (1 + 0x1p-40);
    return r;
}

void ContactSearch::run(const BallMotion& over, EarliestEvents& events) {
    search(over, {Pair{}}, 0, events);
}

void ContactSearch::search(const BallMotion& over, const Pairs& front, int depth,
                           EarliestEvents& events) {
    if (over.from > events.latest() || over.to < events.earliest()) return;
    ++counters_.intervals;
    const SweptMap swept = swept_map(over, b_.data().lo, b_.data().hi);
    const ObbPose pose(a_.data().boxes, b_.data().boxes, swept.map, swept.sweep);
    if (pose.is_apart()) return;
    Pairs leaves;
    Pairs coarse;
    refine(pose, swept, front, leaves, coarse);
    if (leaves.empty() && coarse.empty()) return;

    // Triangles that sweep farther than they are large had better wait for a shorter interval.
    const auto is_long = [&](const Pair& p) {
        return size_a(p.a) + size_b(pose, p.b) < long_sweep * swept.sweep;
    };
    const bool worth_halving =
        !coarse.empty() ||
        (leaves.size() > few_pairs &&
         static_cast<std::size_t>(std::count_if(leaves.begin(), leaves.end(), is_long)) * 2 >
             leaves.size());
    if (!worth_halving || depth == max_depth) {
        solve(over, leaves, events);
        if (coarse.empty()) return;
    }
    if (depth == max_depth) {
        // Boxes smaller than the sweep of an interval this short: too small to be told apart.
        leaves.clear();
        refine(pose, SweptMap{}, coarse, leaves, coarse);
        solve(over, leaves, events);
        return;
    }
    coarse.insert(coarse.end(), leaves.begin(), leaves.end());
    leaves = {};
    search(over.left_half(), coarse, depth + 1, events);
    search(over.right_half(), coarse, depth + 1, events);
}

void ContactSearch::refine(const ObbPose& pose, const SweptMap& swept, const Pairs& front,
                           Pairs& leaves, Pairs& coarse) {
    const ObbTree& ta = a_.data().boxes;
    const ObbTree& tb = b_.data().boxes;
    Pairs stack;
    for (const Pair& p : front) {
        ++counters_.box_tests;
        const unsigned hits = pose.overlaps(ta.box(p.a), tb.nodes[p.b.node()]);
        if ((hits >> p.b.lane() & 1U) != 0) stack.push_back(p);
    }
    coarse.clear();
    while (!stack.empty()) {
        const Pair p = stack.back();
        stack.pop_back();
        const bool a_is_leaf = ta.child(p.a).is_leaf();
        const bool b_is_leaf = tb.child(p.b).is_leaf();
        if (a_is_leaf && b_is_leaf) {
            leaves.push_back(p);
            continue;
        }
        const double a = size_a(p.a);
        const double b = size_b(pose, p.b);
        if (a + b < coarse_sweep * swept.sweep) {
            coarse.push_back(p);
            continue;
        }
        push_children(pose, p, a_is_leaf || (!b_is_leaf && b > a), stack);
    }
}

void ContactSearch::push_children(const ObbPose& pose, const Pair& p, bool of_b, Pairs& stack) {
    ++counters_.box_tests;
    const ObbTree& ta = a_.data().boxes;
    const ObbTree& tb = b_.data().boxes;
    if (of_b) {
        const std::uint32_t node = tb.child(p.b).node();
        const unsigned hits = pose.overlaps(ta.box(p.a), tb.nodes[node]);
        for (std::uint32_t k = 0; k < 4; ++k)
            if ((hits >> k & 1U) != 0) stack.push_back({p.a, ObbId::of(node, k)});
    } else {
        const std::uint32_t node = ta.child(p.a).node();
        const unsigned hits = pose.overlaps(ta.nodes[node], tb.box(p.b));
        for (std::uint32_t k = 0; k < 4; ++k)
            if ((hits >> k & 1U) != 0) stack.push_back({ObbId::of(node, k), p.b});
    }
}

void ContactSearch::solve(const BallMotion& over, Pairs& leaves, EarliestEvents& events) {
    const ObbTree& ta = a_.data().boxes;
    const ObbTree& tb = b_.data().boxes;
    // What a triangle of B does on its way is worked out once for all its partners.
    std::sort(leaves.begin(), leaves.end(), [](const Pair& p, const Pair& q) {
        return p.b.index != q.b.index ? p.b.index < q.b.index : p.a.index < q.a.index;
    });
    for (const Pair& p : leaves) {
        const ObbChild la = ta.child(p.a);
        const ObbChild lb = tb.child(p.b);
        for (std::uint32_t j = 0; j < lb.count(); ++j)
            for (std::uint32_t i = 0; i < la.count(); ++i) {
                ++counters_.triangle_pairs;
                pairs_.find(ta.order[la.first() + i], tb.order[lb.first() + j], over, events);
            }
    }
}

double ContactSearch::size_a(ObbId id) const {
    const ObbTree& t = a_.data().boxes;
    const ObbNode& n = t.nodes[id.node()];
    return t.unit *
           static_cast<double>(n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()]);
}

double ContactSearch::size_b(const ObbPose& pose, ObbId id) const {
    const ObbNode& n = b_.data().boxes.nodes[id.node()];
    return a_.data().boxes.unit * static_cast<double>(pose.scale()) *
           static_cast<double>(n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()]);
}

}  // namespace trisect::detail
