// SPDX-License-Identifier: Apache-2.0
//
// The convolution of two tracings (Guibas, Ramshaw and Stolfi 1983): a corner of one outline with
// the sides of the other whose directions are passed while it turns there, backwards where it turns
// to the right. The winding number of all of that about x is the Euler characteristic of what A and
// x - B have in common. Parts that two sets without holes have in common have none, so it is their
// number, and positive within the sum alone.
//
// Where sides are parallel, those of the second outline count as turned to the left by an
// infinitesimal. Directions are compared exactly, so each corner is left as often as it is reached.
#include <trisect/bsp/modelling/pieces/plane_sums.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

/// Ranks of the directions of sides by angle; equal ones have the same.
class DirectionRanks {
public:
    DirectionRanks(const Outline& a, const Outline& b) {
        for (const Outline* outline : {&a, &b})
            for (const Point2d& p : *outline) corners_.push_back({p[0], p[1], 0});
        LatticeReport report;
        const Lattice lattice = choose_lattice(corners_, 1, Fractions::Kept);
        at_ = to_lattice(corners_, lattice, report, 1, Fractions::Kept);
        add_sides(0, a.size());
        add_sides(a.size(), b.size());
        rank();
    }
    /// Of the side that begins at a corner of the first outline, or of the second one behind it.
    [[nodiscard]] std::size_t operator[](std::size_t i) const { return ranks_[i]; }
    [[nodiscard]] std::size_t size() const { return count_; }
    /// Of two sides: 1 where the second one is to the left of the first.
    [[nodiscard]] int cross(std::size_t s, std::size_t t) const {
        const auto d = [&](std::size_t side, int axis) {
            return at_[ends_[side][1]][axis].to_double() - at_[ends_[side][0]][axis].to_double();
        };
        const double left = d(s, 0) * d(t, 1);
        const double right = d(s, 1) * d(t, 0);
        const double bound = 0x1p-50 * (std::fabs(left) + std::fabs(right));
        if (std::fabs(left - right) > bound) return left > right ? 1 : -1;
        return bound == 0 ? 0 : sign_of_cross(plane(s), plane(t), 2);
    }

private:
    void add_sides(std::size_t first, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) ends_.push_back({first + i, first + (i + 1) % n});
    }
    [[nodiscard]] bool is_upper(std::size_t s) const {
        const LatticePoint& p = at_[ends_[s][0]];
        const LatticePoint& q = at_[ends_[s][1]];
        return p.y != q.y ? p.y < q.y : p.x < q.x;
    }
    [[nodiscard]] Plane plane(std::size_t s) const {
        return Plane::along_axis(at_[ends_[s][0]], at_[ends_[s][1]], 2);
    }
    [[nodiscard]] bool is_before(std::size_t s, std::size_t t) const {
        if (is_upper(s) != is_upper(t)) return is_upper(s);
        return cross(s, t) > 0;
    }
    void rank() {
        std::vector<std::size_t> order(ends_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(),
                  [this](std::size_t s, std::size_t t) { return is_before(s, t); });
        ranks_.resize(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i > 0 && is_before(order[i - 1], order[i])) ++count_;
            ranks_[order[i]] = count_;
        }
        ++count_;
    }

    std::vector<Point3d> corners_;
    std::vector<LatticePoint> at_;
    std::vector<std::array<std::size_t, 2>> ends_;
    std::vector<std::size_t> ranks_;
    std::size_t count_ = 0;
};

class Convolution {
public:
    Convolution(SumSides& out, const Outline& a, const Outline& b)
        : out_(out), a_(a), b_(b), ranks_(a, b) {}

    void run() {
        const std::size_t n = a_.size();
        const std::size_t m = b_.size();
        for (std::size_t i = 0; i < n; ++i) {
            check_stop(m);
            const Turn turn = turn_between((i + n - 1) % n, i);
            for (std::size_t j = 0; j < m; ++j)
                if (const std::size_t past = from(turn.begin, ranks_[n + j]); past < turn.width)
                    add({i, j}, {i, (j + 1) % m}, turn.is_left);
        }
        for (std::size_t j = 0; j < m; ++j) {
            check_stop(n);
            const Turn turn = turn_between(n + (j + m - 1) % m, n + j);
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t past = from(turn.begin, ranks_[i]);
                if (past > 0 && past <= turn.width) add({i, j}, {(i + 1) % n, j}, turn.is_left);
            }
        }
    }

private:
    struct Turn {
        std::size_t begin = 0;
        std::size_t width = 0;
        bool is_left = true;
    };
    using Pair = std::array<std::size_t, 2>;

    [[nodiscard]] std::size_t from(std::size_t begin, std::size_t rank) const {
        return rank >= begin ? rank - begin : rank + ranks_.size() - begin;
    }
    // By less than half a turn.
    [[nodiscard]] Turn turn_between(std::size_t s, std::size_t t) const {
        const std::size_t before = ranks_[s];
        const std::size_t after = ranks_[t];
        return ranks_.cross(s, t) >= 0 ? Turn{before, from(before, after), true}
                                       : Turn{after, from(after, before), false};
    }

    void add(const Pair& p, const Pair& q, bool forward) {
        const std::uint32_t from = corner(p);
        const std::uint32_t to = corner(q);
        out_.sides.push_back(forward ? std::array{from, to} : std::array{to, from});
    }
    std::uint32_t corner(const Pair& p) {
        const std::size_t key = p[0] * b_.size() + p[1];
        const auto [at, is_new] =
            numbers_.emplace(key, static_cast<std::uint32_t>(out_.corners.size()));
        if (is_new) out_.corners.push_back({a_[p[0]][0] + b_[p[1]][0], a_[p[0]][1] + b_[p[1]][1]});
        return at->second;
    }

    SumSides& out_;
    const Outline& a_;
    const Outline& b_;
    DirectionRanks ranks_;
    std::unordered_map<std::size_t, std::uint32_t> numbers_;
};

}  // namespace

void add_convolution(SumSides& out, const Outline& a, const Outline& b) {
    Convolution(out, a, b).run();
}

}  // namespace trisect::detail
