// SPDX-License-Identifier: Apache-2.0
//
// What can meet during an interval of the parameter, meets boxes of the middle pose that are grown
// by the sweep: how far any point is from there at most. With numerators X(s) and weight w(s) and
// the value v in the middle, |X / w - v| = |X - v w| / w, and X - v w is a polynomial whose
// Bernstein coefficients bound it; so the sweep shrinks with the interval, and what numerator and
// weight have in common cancels.

#include <trisect/bsp/interference/motion/swept_walk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/inverse_matrix.h>

namespace trisect::detail {

namespace {

// Pairs of triangles smaller than this many sweeps wait for a shorter interval (measured: screw and
// nut, gears; half or twice as many cost up to a quarter more).
constexpr double long_sweep = 8;
// Boxes smaller than this many sweeps are not divided: the time is.
constexpr double coarse_sweep = 4;

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
    r.reach = least > 0 ? r.reach / least * slightly_more : HUGE_VAL;
    return r;
}

// The norm of a matrix, certified from above up to 2^-40: with G = X^T X, of largest eigenvalue λ,
// λ^(2^k) is at most the Frobenius norm of G^(2^k), and at least a third of it. Each square has an
// error of some roundings of its norm, and its root takes 2^-k of that.
double norm_of(const std::array<std::array<double, 3>, 3>& x) {
    using DoubleRows = std::array<std::array<double, 3>, 3>;
    const auto largest = [](const DoubleRows& m) {
        double v = 0;
        for (const auto& row : m)
            for (const double c : row) v = std::max(v, magnitude_of(c));
        return v;
    };
    const double size = largest(x);
    if (!(size > 0x1p-900 && size < 0x1p900)) return HUGE_VAL;
    const double unit = std::ldexp(1.0, std::ilogb(size));
    DoubleRows g{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) g[i][j] += (x[k][i] / unit) * (x[k][j] / unit);
    constexpr int squares = 45;
    double log = 0;  // of what the entries were divided by, as a part of the power
    for (int n = 0; n <= squares; ++n) {
        const double divisor = largest(g);
        log += std::ldexp(std::log(divisor), -n);
        for (auto& row : g)
            for (double& c : row) c /= divisor;
        if (n == squares) break;
        DoubleRows square{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k) square[i][j] += g[i][k] * g[k][j];
        g = square;
    }
    // Entries are at most 1 now, so the norm is at most 3, the last root of which is 1 + 2^-44.
    return unit * std::exp(log / 2) * surely_more;
}

}  // namespace

SweptMap swept_map(const BallMotion& motion, const std::array<double, 3>& lo,
                   const std::array<double, 3>& hi) {
    std::array<double, 3> center{};
    std::array<double, 3> half{};
    for (std::size_t j = 0; j < 3; ++j) {
        center[j] = (lo[j] + hi[j]) / 2;
        half[j] = std::max(hi[j] - center[j], center[j] - lo[j]) * slightly_more;
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
    r.sweep = std::sqrt(square) * surely_more;
    return r;
}

// With X near the inverse of the matrix V in the middle, V + R = X^-1 (1 - E) + R for E = 1 - X V,
// so the inverse of V + R is (1 - E + X R)^-1 X.
double inverse_stretch(const BallMotion& motion) {
    std::array<std::array<double, 3>, 3> v{};
    double reach = 0;
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Swept entry =
                sweep_of(motion, [&](std::size_t k) { return motion.maps[k].matrix[i][j]; });
            v[i][j] = entry.value;
            reach += entry.reach * entry.reach;
            size += entry.value * entry.value;
        }
    const std::array<std::array<double, 3>, 3> x = inverse_of(v);
    const double rest = square_off_identity(x, v);
    double inverse = 0;
    for (const auto& row : x)
        for (const double c : row) inverse += c * c;
    const double norm = norm_of(x);
    const double loss = std::sqrt(rest) + 0x1p-48 * std::sqrt(inverse * size) +
                        norm * std::sqrt(reach) * surely_more;
    return loss < 0.5 ? norm / (1 - loss) * surely_more : HUGE_VAL;
}

SweptWalk::Pairs SweptWalk::meeting(const ObbPose& pose, const Pairs& front) {
    Pairs r;
    // Pairs that came from one node lie side by side: one test decides up to four of them.
    bool of_a = false;
    unsigned hits = 0;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const Pair& p = front[i];
        const auto is_beside = [&p](const Pair& q, bool lanes_of_a) {
            return lanes_of_a ? q.b.index == p.b.index && q.a.node() == p.a.node()
                              : q.a.index == p.a.index && q.b.node() == p.b.node();
        };
        if (i == 0 || !is_beside(front[i - 1], of_a)) {
            ++box_tests_;
            of_a = i + 1 < front.size() && is_beside(front[i + 1], true);
            hits = of_a ? pose.overlaps(a_.nodes[p.a.node()], b_.box(p.b))
                        : pose.overlaps(a_.box(p.a), b_.nodes[p.b.node()]);
        }
        if ((hits >> (of_a ? p.a : p.b).lane() & 1U) != 0) r.push_back(p);
    }
    return r;
}

void SweptWalk::divide(const ObbPose& pose, double sweep, const Pair& p, Pairs& stack,
                       Pairs& leaves, Pairs& coarse) {
    const bool a_is_leaf = a_.is_leaf(p.a);
    const bool b_is_leaf = b_.is_leaf(p.b);
    if (a_is_leaf && b_is_leaf) {
        leaves.push_back(p);
        return;
    }
    const double a = size_a(p.a);
    const double b = size_b(pose, p.b);
    if (a + b < coarse_sweep * sweep)
        coarse.push_back(p);
    else
        push_children(pose, p, a_is_leaf || (!b_is_leaf && b > a), stack);
}

void SweptWalk::push_children(const ObbPose& pose, const Pair& p, bool of_b, Pairs& stack) {
    ++box_tests_;
    if (of_b) {
        const std::uint32_t node = b_.child(p.b).node();
        const unsigned hits = pose.overlaps(a_.box(p.a), b_.nodes[node]);
        for (std::uint32_t k = 0; k < 4; ++k)
            if ((hits >> k & 1U) != 0) stack.push_back({p.a, ObbId::of(node, k)});
    } else {
        const std::uint32_t node = a_.child(p.a).node();
        const unsigned hits = pose.overlaps(a_.nodes[node], b_.box(p.b));
        for (std::uint32_t k = 0; k < 4; ++k)
            if ((hits >> k & 1U) != 0) stack.push_back({ObbId::of(node, k), p.b});
    }
}

bool SweptWalk::are_long(const ObbPose& pose, double sweep, const Pairs& leaves) const {
    const auto is_long = [&](const Pair& p) {
        return size_a(p.a) + size_b(pose, p.b) < long_sweep * sweep;
    };
    return static_cast<std::size_t>(std::count_if(leaves.begin(), leaves.end(), is_long)) * 2 >
           leaves.size();
}

double SweptWalk::size_a(ObbId id) const {
    const ObbNode& n = a_.nodes[id.node()];
    return a_.unit *
           static_cast<double>(n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()]);
}

double SweptWalk::size_b(const ObbPose& pose, ObbId id) const {
    const ObbNode& n = b_.nodes[id.node()];
    return a_.unit * static_cast<double>(pose.scale()) *
           static_cast<double>(n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()]);
}

}  // namespace trisect::detail
