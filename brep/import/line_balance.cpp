// SPDX-License-Identifier: Apache-2.0
//
// What a solid needs is not that every edge is named twice, but that the boundaries of its faces
// add up to zero as 1-chains: on every line, every open interval is run through as often one way as
// the other. A face with a corner in the middle of its neighbour's side (a T-vertex), or the hole
// that a dropped triangle without area leaves, balances in this sense and not in the other.
//
// Lines need names that are equal exactly when the lines are. A line through lattice points has a
// primitive direction d (divided by the gcd, first nonzero component positive) and its lattice
// points are p + t·d for integers t; the one with the smallest non-negative coordinate along the
// axis where |d| is largest names it, and t is the position of every other point. |t·d| < 2^55.
// Points with bits behind the point are counted on the lattice that is finer by all these bits.

#include <trisect/brep/import/line_balance.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using std::abs;

// Integers of 64 bits, or of any size where coordinates have bits behind the point.
template <class Integer>
struct EdgeInterval {
    VectorOf<Integer> direction{};
    VectorOf<Integer> base{};
    Integer begin = 0;
    Integer end = 0;
    std::int64_t count = 0;
    std::size_t edge = 0;

    [[nodiscard]] bool same_line(const EdgeInterval& o) const {
        return direction == o.direction && base == o.base;
    }
};

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
    const std::int64_t q = a / b;
    return a % b != 0 && (a < 0) != (b < 0) ? q - 1 : q;
}
mpz_class floor_divide(const mpz_class& a, const mpz_class& b) {
    mpz_class q;
    mpz_fdiv_q(q.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
    return q;
}

std::int64_t common_divisor(std::int64_t a, std::int64_t b) { return std::gcd(a, b); }
mpz_class common_divisor(const mpz_class& a, const mpz_class& b) { return gcd(a, b); }

template <class Integer>
std::size_t largest_axis(const VectorOf<Integer>& d) {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (abs(Integer(d[i])) > abs(Integer(d[axis]))) axis = i;
    return axis;
}

template <class Integer>
EdgeInterval<Integer> interval_of(const VectorOf<Integer>& a, const VectorOf<Integer>& b,
                                  std::int64_t count, std::size_t edge) {
    VectorOf<Integer> d = minus(b, a);
    Integer g = common_divisor(common_divisor(d[0], d[1]), d[2]);
    if (d < VectorOf<Integer>{}) g = -g;  // lexicographically: the first nonzero component decides
    d = {d[0] / g, d[1] / g, d[2] / g};
    const std::size_t axis = largest_axis(d);
    const Integer t = floor_divide(a[axis], d[axis]);
    EdgeInterval<Integer> i;
    i.direction = d;
    i.base = {a[0] - t * d[0], a[1] - t * d[1], a[2] - t * d[2]};
    i.begin = std::min<Integer>(t, t + g);
    i.end = std::max<Integer>(t, t + g);
    i.count = g > 0 ? count : -count;
    i.edge = edge;
    return i;
}

// Marks the intervals of one line that meet a part where the counts do not add up to zero.
template <class Integer>
void sweep_line(std::span<const EdgeInterval<Integer>> line, std::vector<bool>& open) {
    std::vector<std::pair<Integer, std::int64_t>> events;
    for (const auto& i : line) {
        events.emplace_back(i.begin, i.count);
        events.emplace_back(i.end, -i.count);
    }
    std::sort(events.begin(), events.end());
    // Prefix counts of uncancelled elementary intervals answer "any in [begin, end)?".
    std::vector<Integer> at;
    std::vector<std::size_t> bad_before;
    std::int64_t sum = 0;
    std::size_t bad = 0;
    for (std::size_t i = 0; i < events.size();) {
        const Integer t = events[i].first;
        at.push_back(t);
        bad_before.push_back(bad);
        while (i < events.size() && events[i].first == t) sum += events[i++].second;
        if (sum != 0) ++bad;
    }
    const auto index = [&](const Integer& t) {
        return static_cast<std::size_t>(std::lower_bound(at.begin(), at.end(), t) - at.begin());
    };
    for (const auto& i : line)
        open[i.edge] = bad_before[index(i.end)] != bad_before[index(i.begin)];
}

// `at` gives the coordinates of a point.
template <class Integer, class At>
std::vector<bool> uncancelled(std::span<const NetEdge> edges, const At& at) {
    std::vector<EdgeInterval<Integer>> intervals;
    intervals.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
        intervals.push_back(
            interval_of<Integer>(at(edges[i].from), at(edges[i].to), edges[i].count, i));
    std::sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) {
        if (a.direction != b.direction) return a.direction < b.direction;
        if (a.base != b.base) return a.base < b.base;
        return a.edge < b.edge;
    });
    std::vector<bool> open(edges.size(), false);
    for (std::size_t i = 0; i < intervals.size();) {
        std::size_t end = i + 1;
        while (end < intervals.size() && intervals[end].same_line(intervals[i])) ++end;
        sweep_line<Integer>({intervals.data() + i, end - i}, open);
        i = end;
    }
    return open;
}

}  // namespace

std::vector<bool> find_uncancelled(std::span<const LatticePoint> points,
                                   std::span<const NetEdge> edges) {
    const auto are_whole = [&](const NetEdge& e) {
        return points[e.from].is_whole() && points[e.to].is_whole();
    };
    if (std::ranges::all_of(edges, are_whole))
        return uncancelled<std::int64_t>(edges,
                                         [&](std::uint32_t p) { return to_integers(points[p]); });
    return uncancelled<mpz_class>(edges, [&](std::uint32_t p) {
        VectorOf<mpz_class> x;
        for (std::size_t k = 0; k < 3; ++k) {
            const Dyadic d = dyadic(coordinate(points[p], k).to_double());
            x[k] = mpz_class(static_cast<double>(d.mantissa))
                   << static_cast<unsigned>(d.exponent + fraction_limit);
        }
        return x;
    });
}

}  // namespace trisect::detail
