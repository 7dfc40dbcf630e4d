// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/prism_crossings.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/kernel/number/int128.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// Two neighbours in one outline: in a common corner, and nowhere else.
bool are_neighbours(const PrismSideFace& s, const PrismSideFace& t, bool in_line) {
    if (s.operand != t.operand || s.lo != t.lo || s.hi != t.hi) return false;
    // `from` is the smaller end, so side faces in one line that share the same end overlap.
    if (s.to == t.from || s.from == t.to) return true;
    return !in_line && (s.from == t.from || s.to == t.to);
}

// The part of the way along a side face at which another one crosses it.
struct Fraction {
    Int128 part;
    Int128 whole;

    /// From the sides of the other side face on which its ends lie.
    Fraction(Int128 from, Int128 to)
        : part(magnitude(from)), whole(magnitude(from) + magnitude(to)) {}
    Fraction(const PrismSideFace& on, const PrismSideFace& other)
        : Fraction(flat_turn(other.from, other.to, on.from),
                   flat_turn(other.from, other.to, on.to)) {}
    [[nodiscard]] double rounded() const {
        return static_cast<double>(part) / static_cast<double>(whole);
    }
};

}  // namespace

int PrismCrossings::compare(const PrismCrossing& a, const PrismCrossing& b) const {
    if (const double gap = a.at - b.at; std::fabs(gap) > 0x1p-50) return gap < 0 ? -1 : 1;
    const auto place = [&](const PrismCrossing& c) {
        return Fraction(side_faces_[as_index(c.on)], side_faces_[as_index(c.side_face)]);
    };
    const Fraction f = place(a);
    const Fraction g = place(b);
    const WideInt<4> s = multiply<4>(WideInt<2>(f.part), WideInt<2>(g.whole));
    const WideInt<4> t = multiply<4>(WideInt<2>(g.part), WideInt<2>(f.whole));
    return s < t ? -1 : (t < s ? 1 : 0);
}

bool PrismCrossings::find(const LeafProblem& problem, std::span<const PrismSideFace> side_faces,
                          EvaluateStats& stats) {
    side_faces_ = side_faces;
    found_.clear();
    order_.resize(side_faces.size());
    std::iota(order_.begin(), order_.end(), 0);
    const auto side_face = [&](LeafIndex i) -> const PrismSideFace& {
        return side_faces[as_index(i)];
    };
    std::sort(order_.begin(), order_.end(), [&](LeafIndex a, LeafIndex b) {
        return side_face(a).from[0] != side_face(b).from[0]
                   ? side_face(a).from[0] < side_face(b).from[0]
                   : a < b;
    });
    std::size_t looked_at = 0;
    for (std::size_t i = 0; i < order_.size(); ++i) {
        check_budget(*problem.options, stats);
        if (looked_at > most_per_side_face * order_.size()) return false;
        const PrismSideFace& s = side_face(order_[i]);
        const auto [low, high] = std::minmax(s.from[1], s.to[1]);
        for (std::size_t j = i + 1; j < order_.size(); ++j) {
            const PrismSideFace& t = side_face(order_[j]);
            if (t.from[0] > s.to[0]) break;
            ++looked_at;
            if (std::max(t.from[1], t.to[1]) < low || std::min(t.from[1], t.to[1]) > high ||
                t.lo > s.hi || t.hi < s.lo)
                continue;
            ++stats.pairs_boxes;
            if (!cross(order_[i], order_[j])) return false;
        }
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

bool PrismCrossings::any_coincide() const {
    return std::ranges::adjacent_find(found_, [&](const PrismCrossing& a, const PrismCrossing& b) {
               return a.on == b.on && compare(a, b) == 0;
           }) != found_.end();
}

// Notes where two side faces cross, if they do; false when they touch otherwise than as neighbours.
bool PrismCrossings::cross(LeafIndex s, LeafIndex t) {
    const PrismSideFace& a = side_faces_[as_index(s)];
    const PrismSideFace& b = side_faces_[as_index(t)];
    const Int128 b_from = flat_turn(a.from, a.to, b.from);
    const Int128 b_to = flat_turn(a.from, a.to, b.to);
    if (sign(b_from) * sign(b_to) > 0) return true;
    const Int128 a_from = flat_turn(b.from, b.to, a.from);
    const Int128 a_to = flat_turn(b.from, b.to, a.to);
    if (sign(a_from) * sign(a_to) > 0) return true;
    if (b_from == 0 || b_to == 0 || a_from == 0 || a_to == 0)
        return are_neighbours(a, b, b_from == 0 && b_to == 0);
    if (a.operand == b.operand) return false;
    found_.push_back({s, t, Fraction(a_from, a_to).rounded()});
    found_.push_back({t, s, Fraction(b_from, b_to).rounded()});
    return true;
}

}  // namespace trisect::detail
