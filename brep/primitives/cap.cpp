// SPDX-License-Identifier: Apache-2.0
//
// Holes are joined to the outline by bridges, pairs of opposite edges, until one loop is left that
// touches itself; that one is clipped ear by ear. Holes are taken from right to left: from the
// rightmost corner of the rightmost remaining hole some corner of the loop to the right of it is
// visible, so a bridge always exists. The nearest visible corner is taken [the idea is Eberly's
// "Triangulation by Ear Clipping", 2002, sec. 3, with visibility decided by exact signs instead of
// a ray]. A corner that bridges made multiple is entered through the occurrence whose inside faces
// the hole.

#include <trisect/brep/primitives/cap.h>

#include <algorithm>
#include <string>

#include <trisect/brep/face/loop_triangulator.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Loop = std::vector<std::uint32_t>;

class BridgeBuilder {
public:
    BridgeBuilder(std::span<const LatticePoint> points, std::span<const Loop> loops)
        : points_(points), loops_(loops), merged_(loops[0]) {}

    Loop run() {
        std::vector<std::size_t> holes;
        for (std::size_t h = 1; h < loops_.size(); ++h) holes.push_back(h);
        std::sort(holes.begin(), holes.end(), [this](std::size_t a, std::size_t b) {
            const LatticePoint& p = points_[loops_[a][rightmost(loops_[a])]];
            const LatticePoint& q = points_[loops_[b][rightmost(loops_[b])]];
            return p != q ? p > q : a < b;
        });
        for (const std::size_t h : holes) join(loops_[h]);
        return std::move(merged_);
    }

private:
    [[nodiscard]] std::size_t rightmost(const Loop& loop) const {
        std::size_t best = 0;
        for (std::size_t i = 1; i < loop.size(); ++i)
            if (points_[loop[i]] > points_[loop[best]]) best = i;
        return best;
    }
    [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const auto flat = [this](std::uint32_t p) { return flat_corner(points_[p], 0, 1); };
        return detail::turn(flat(a), flat(b), flat(c));
    }
    // In units of 2^(-2 fraction_limit): differences are below 2^127.
    [[nodiscard]] WideInt<4> squared_distance(std::uint32_t a, std::uint32_t b) const {
        WideInt<4> sum;
        for (int k = 0; k < 2; ++k) {
            const WideInt<2> d(scaled_integer(points_[b][k], fraction_limit) -
                               scaled_integer(points_[a][k], fraction_limit));
            sum += multiply<4>(d, d);
        }
        return sum;
    }
    // Is corner c between a and b (which are collinear with it), ends included?
    [[nodiscard]] bool is_between(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const auto [low, high] = std::minmax(points_[a], points_[b]);
        return low <= points_[c] && points_[c] <= high;
    }

    // Does the open segment a, b meet the closed side p, q anywhere?
    [[nodiscard]] bool is_blocked_by(std::uint32_t a, std::uint32_t b, std::uint32_t p,
                                     std::uint32_t q) const {
        const bool shares = p == a || p == b || q == a || q == b;
        const int tp = turn(a, b, p);
        const int tq = turn(a, b, q);
        for (const auto& [c, t] : {std::pair{p, tp}, std::pair{q, tq}})
            if (c != a && c != b && t == 0 && is_between(a, b, c)) return true;
        if (shares) return false;
        return tp * tq < 0 && turn(p, q, a) * turn(p, q, b) < 0;
    }
    [[nodiscard]] bool is_blocked(std::uint32_t a, std::uint32_t b) const {
        for (const Loop& loop : loops_)
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (is_blocked_by(a, b, loop[i], loop[(i + 1) % loop.size()])) return true;
        return false;
    }
    // Does the direction to c start into the inside at position i of the merged loop?
    [[nodiscard]] bool is_in_cone(std::size_t i, std::uint32_t c) const {
        const std::size_t n = merged_.size();
        const std::uint32_t before = merged_[(i + n - 1) % n];
        const std::uint32_t at = merged_[i];
        const std::uint32_t after = merged_[(i + 1) % n];
        const bool left_of_in = turn(before, at, c) > 0;
        const bool left_of_out = turn(at, after, c) > 0;
        return turn(before, at, after) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
    }

    void join(const Loop& hole) {
        const std::size_t start = rightmost(hole);
        const std::uint32_t from = hole[start];
        std::vector<std::size_t> order(merged_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return squared_distance(from, merged_[a]) < squared_distance(from, merged_[b]);
        });
        const auto it = std::find_if(order.begin(), order.end(), [&](std::size_t i) {
            return points_[merged_[i]] != points_[from] && is_in_cone(i, from) &&
                   !crosses_bridge(from, merged_[i]) && !is_blocked(from, merged_[i]);
        });
        if (it == order.end())
            throw UsageError("a hole crosses or touches another outline, or lies outside");
        Loop detour;  // at, around the hole, back to at
        for (std::size_t k = 0; k <= hole.size(); ++k)
            detour.push_back(hole[(start + k) % hole.size()]);
        detour.push_back(merged_[*it]);
        bridges_.push_back({from, merged_[*it]});
        merged_.insert(merged_.begin() + static_cast<std::ptrdiff_t>(*it) + 1, detour.begin(),
                       detour.end());
    }
    [[nodiscard]] bool crosses_bridge(std::uint32_t a, std::uint32_t b) const {
        return std::any_of(bridges_.begin(), bridges_.end(), [&](const auto& bridge) {
            return is_blocked_by(a, b, bridge[0], bridge[1]);
        });
    }

    std::span<const LatticePoint> points_;
    std::span<const Loop> loops_;
    Loop merged_;
    std::vector<std::array<std::uint32_t, 2>> bridges_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_cap(
    std::span<const LatticePoint> points, std::span<const std::vector<std::uint32_t>> loops) {
    const Loop merged = BridgeBuilder(points, loops).run();
    std::vector<std::array<std::uint32_t, 3>> triangles;
    LoopTriangulator triangulator(points);
    if (!triangulator.triangulate(merged, triangles).simple)
        throw UsageError("the outlines cross themselves or each other");
    return triangles;
}

}  // namespace trisect::detail
