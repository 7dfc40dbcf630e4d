// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/prism_crossings.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/kernel/number/int128.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/parallel_sort.h>

namespace trisect::detail {

namespace {

// Two neighbours in one outline: in a common corner, and nowhere else.
bool are_neighbours(const PrismSideFace& s, const PrismSideFace& t, bool in_line) {
    if (s.operand != t.operand || s.lo != t.lo || s.hi != t.hi) return false;
    // `from` is the smaller end, so side faces in one line that share the same end overlap.
    if (s.to == t.from || s.from == t.to) return true;
    return !in_line && (s.from == t.from || s.to == t.to);
}

// The part of the way along a side face at which another one crosses it: of twice the area of the
// quadrangle of which both are the diagonals, what is on one side of the other one. The quadrangle
// has at most the area of a box around both, hence `whole` is below 2^109 in integers and below
// 2^255 in fractions (flat_corner.h), and `part` is no larger.
template <class N>
struct Fraction {
    N part;
    N whole;

    /// From the turns of the other side face to both ends.
    Fraction(const N& from, const N& to) : part(from), whole(from + to) {}
};

using IntegerFraction = Fraction<Int128>;
using WideFraction = Fraction<WideInt<4>>;

bool is_whole(const PrismSideFace& w) {
    return w.from.u.is_whole() && w.from.v.is_whole() && w.to.u.is_whole() && w.to.v.is_whole();
}

/// \pre both have whole coordinates.
IntegerFraction integer_fraction(const PrismSideFace& on, const PrismSideFace& other) {
    return {magnitude(turn_of_integers(other.from, other.to, on.from)),
            magnitude(turn_of_integers(other.from, other.to, on.to))};
}

WideFraction wide_fraction(const PrismSideFace& on, const PrismSideFace& other) {
    return {turn_of_fractions(other.from, other.to, on.from).abs(),
            turn_of_fractions(other.from, other.to, on.to).abs()};
}

// On which sides of a side face the ends of another one lie.
struct EndSides {
    RoundedTurn from;
    int from_sign;
    RoundedTurn to;
    int to_sign;

    EndSides(const PrismSideFace& ends, const PrismSideFace& of)
        : from(rounded_turn(of.from, of.to, ends.from)),
          from_sign(sign_of_turn(from, of.from, of.to, ends.from)),
          to(rounded_turn(of.from, of.to, ends.to)),
          to_sign(sign_of_turn(to, of.from, of.to, ends.to)) {}
    [[nodiscard]] bool are_equal() const { return from_sign * to_sign > 0; }
    [[nodiscard]] bool touch() const { return from_sign == 0 || to_sign == 0; }
};

// PrismCrossing::at. Let p and q be the magnitudes of both turns, off by at most e from P and Q:
// p / (p + q) - P / (P + Q) = (p (Q - q) - q (P - p)) / ((p + q) (P + Q)), so it is off by at most
// e / (P + Q). That is half of place_error here but for terms of second order. Two roundings, of at
// most 2^-52 together, or four in integers, are the least of it.
double place(const PrismSideFace& on, const PrismSideFace& other, const EndSides& sides) {
    const double part = std::fabs(sides.from.value);
    const double all = part + std::fabs(sides.to.value);
    if (std::max(sides.from.error, sides.to.error) <= place_error / 2 * all) return part / all;
    if (is_whole(on) && is_whole(other)) {
        const IntegerFraction f = integer_fraction(on, other);
        return static_cast<double>(f.part) / static_cast<double>(f.whole);
    }
    const WideFraction f = wide_fraction(on, other);
    return f.part.to_double() / f.whole.to_double();
}

// In twice the width of their numbers.
template <int N>
int order_of(const WideInt<N>& part, const WideInt<N>& whole, const WideInt<N>& other_part,
             const WideInt<N>& other_whole) {
    const auto s = multiply<2 * N>(part, other_whole);
    const auto t = multiply<2 * N>(other_part, whole);
    return s < t ? -1 : (t < s ? 1 : 0);
}

int order_of(const IntegerFraction& f, const IntegerFraction& g) {
    return order_of<2>(f.part, f.whole, g.part, g.whole);
}

int order_of(const WideFraction& f, const WideFraction& g) {
    return order_of<4>(f.part, f.whole, g.part, g.whole);
}

}  // namespace

int PrismCrossings::compare(const PrismCrossing& a, const PrismCrossing& b) const {
    if (const double gap = a.at - b.at; std::fabs(gap) > 3 * place_error) return gap < 0 ? -1 : 1;
    const PrismSideFace& on = side_faces_[as_index(a.on)];
    const PrismSideFace& s = side_faces_[as_index(a.side_face)];
    const PrismSideFace& t = side_faces_[as_index(b.side_face)];
    if (is_whole(on) && is_whole(s) && is_whole(t))
        return order_of(integer_fraction(on, s), integer_fraction(on, t));
    return order_of(wide_fraction(on, s), wide_fraction(on, t));
}

bool PrismCrossings::find(const LeafProblem& problem, std::span<const PrismSideFace> side_faces,
                          EvaluateStats& stats, std::uint32_t threads) {
    constexpr std::size_t least_searched = 512;
    side_faces_ = side_faces;
    found_.clear();
    put_in_order(threads);
    const ParallelParts of_order(order_.size(), threads, least_searched);
    std::vector<Part> parts(of_order.count());
    parts[0].found.swap(found_);  // its memory is used again
    of_order.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        search(problem, stats, begin, end, parts[part]);
    });
    found_.swap(parts[0].found);
    std::size_t looked_at = 0;
    for (const Part& part : parts) {
        looked_at += part.looked_at;
        if (part.touches || looked_at > most_per_side_face * order_.size()) return false;
        stats.pairs_boxes += part.pairs_boxes;
        found_.insert(found_.end(), part.found.begin(), part.found.end());
    }
    stats.pairs_touching += found_.size() / 2;
    stats.pairs_cutting += found_.size() / 2;
    std::sort(found_.begin(), found_.end(), [&](const PrismCrossing& a, const PrismCrossing& b) {
        if (a.on != b.on) return a.on < b.on;
        const int order = compare(a, b);
        return order != 0 ? order < 0 : a.side_face < b.side_face;
    });
    first_.assign(side_faces.size() + 1, 0);
    for (const PrismCrossing& c : found_) ++first_[as_index(c.on) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    return true;
}

void PrismCrossings::put_in_order(std::uint32_t threads) {
    order_.clear();
    order_.reserve(side_faces_.size());
    for (std::size_t i = 0; i < side_faces_.size(); ++i)
        order_.emplace_back(side_faces_[i].from.u, static_cast<LeafIndex>(i));
    sort_in_parts(order_, threads);
    low_v_.resize(order_.size());
    high_v_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const PrismSideFace& w = side_faces_[as_index(order_[i].second)];
        low_v_[i] = std::min(w.from.v, w.to.v).to_double();
        high_v_[i] = std::max(w.from.v, w.to.v).to_double();
    }
}

// Of those [begin, end) of the order with those behind them, which are looked at in blocks.
void PrismCrossings::search(const LeafProblem& problem, const EvaluateStats& before,
                            std::size_t begin, std::size_t end, Part& part) const {
    constexpr std::size_t block = 16;
    EvaluateStats stats = before;
    for (std::size_t i = begin; i < end && !part.touches; ++i) {
        check_budget(*problem.options, stats);
        if (part.looked_at > most_per_side_face * order_.size()) return;
        const PrismSideFace& w = side_faces_[as_index(order_[i].second)];
        const double low = low_v_[i];
        const double high = high_v_[i];
        // The first that begins beyond it.
        const auto beyond = static_cast<std::size_t>(
            std::partition_point(order_.begin() + static_cast<std::ptrdiff_t>(i), order_.end(),
                                 [&](const auto& o) { return o.first <= w.to.u; }) -
            order_.begin());
        part.looked_at += beyond - (i + 1);
        const auto is_beside = [&](std::size_t j) {
            return int{high_v_[j] >= low} & int{low_v_[j] <= high};
        };
        for (std::size_t j = i + 1; j < beyond && !part.touches;) {
            const std::size_t next = std::min(j + block, beyond);
            int any = 0;
            for (std::size_t k = j; k < next; ++k) any |= is_beside(k);
            for (; any != 0 && j < next && !part.touches; ++j)
                if (is_beside(j) != 0) compare_at(i, j, part);
            j = next;
        }
        stats.pairs_boxes = before.pairs_boxes + part.pairs_boxes;
    }
}

void PrismCrossings::compare_at(std::size_t i, std::size_t j, Part& part) const {
    const auto [s, t] = std::pair(order_[i].second, order_[j].second);
    const PrismSideFace& a = side_faces_[as_index(s)];
    const PrismSideFace& b = side_faces_[as_index(t)];
    if (b.lo > a.hi || b.hi < a.lo) return;
    ++part.pairs_boxes;
    part.touches = !cross(s, t, part.found);
}

bool PrismCrossings::any_coincide() const {
    return std::ranges::adjacent_find(found_, [&](const PrismCrossing& a, const PrismCrossing& b) {
               return a.on == b.on && compare(a, b) == 0;
           }) != found_.end();
}

// Notes where two side faces cross, if they do; false when they touch otherwise than as neighbours.
bool PrismCrossings::cross(LeafIndex s, LeafIndex t, std::vector<PrismCrossing>& found) const {
    const PrismSideFace& a = side_faces_[as_index(s)];
    const PrismSideFace& b = side_faces_[as_index(t)];
    const EndSides of_b(b, a);
    if (of_b.are_equal()) return true;
    const EndSides of_a(a, b);
    if (of_a.are_equal()) return true;
    if (of_a.touch() || of_b.touch())
        return are_neighbours(a, b, of_b.from_sign == 0 && of_b.to_sign == 0);
    if (a.operand == b.operand) return false;
    found.push_back({s, t, place(a, b, of_a)});
    found.push_back({t, s, place(b, a, of_b)});
    return true;
}

}  // namespace trisect::detail
