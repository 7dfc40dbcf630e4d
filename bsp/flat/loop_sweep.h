// SPDX-License-Identifier: Apache-2.0
//
// LoopSweep: a proof that loops of the plane are simple.
// It finds how they lie in each other as well.
//
// Loops are cut at their corners to the left and to the right of all near them into chains, which
// run from left to right. Chains that a vertical line meets have an order. It changes only where
// chains begin or end, and two of them that follow each other stay apart if each corner of one is
// on the same side of the other, for both are straight between their corners. So every corner is
// compared with the chain above it and with the one below it, and with no other.
//
// A line that leans by an infinitesimal is meant: of two points of one vertical line the lower one
// is to the left.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

/// For one thread. Keeps its memory from run to run.
class LoopSweep {
public:
    using Index = std::uint32_t;
    using Point = std::array<double, 2>;
    static constexpr Index none = static_cast<Index>(-1);

    /// How a loop lies.
    struct Place {
        Index below = none;       ///< the loop of the side straight below its smallest corner
        bool is_on_left = false;  ///< of that side; then the corner is, else on its right
        bool is_outline = false;  ///< runs counter-clockwise
    };

    /// Whether all loops are surely simple and none touches another. Loop l has the points from
    /// begin[l] to begin[l + 1], at least three. Exact, but for a false "no" where coordinates are
    /// too many bits apart, or more than `most_chains` chains have a vertical line in common.
    /// O(n + m log m + m k) for n points, m chains, and k of them beside each other; m k is moves
    /// of memory.
    [[nodiscard]] bool run(std::span<const Point> points, std::span<const Index> begin);

    /// \pre run() returned true. Of loops by their numbers.
    [[nodiscard]] const Place& place(Index loop) const { return places_[loop]; }
    /// Loops in the order of their smallest corners.
    [[nodiscard]] std::span<const Index> order() const { return order_; }
    /// 1 where three of the points given turn left, 0 where they are on one line. Exact.
    [[nodiscard]] int turn(const Point& a, const Point& b, const Point& c) const {
        const double left = (b[0] - a[0]) * (c[1] - a[1]);
        const double right = (b[1] - a[1]) * (c[0] - a[0]);
        const double size = (left < 0 ? -left : left) + (right < 0 ? -right : right);
        const int sign = certain_sign(left - right, minor_rounding * size);
        return sign != 0 || size == 0 ? sign : exact_turn_of(a, b, c);
    }

private:
    static constexpr std::size_t most_chains = 4096;

    struct Chain {
        Index last = 0;
        int step = 1;  // 1: as the loop runs; then the inside is above
        Index loop = 0;
        // The next corner to compare with the chain below, with that above, and to look up.
        Index low = 0;
        Index high = 0;
        Index seen = 0;
    };
    struct Event {
        Point at{};
        Index corner = 0;
        std::array<Index, 2> chains{};  // the one that runs as its loop first
        bool begins = false;
    };

    [[nodiscard]] static bool is_before(const Point& p, const Point& q) {
        return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
    }
    [[nodiscard]] static Index moved(Index i, int step) { return i + static_cast<Index>(step); }

    [[nodiscard]] int exact_turn_of(const Point& a, const Point& b, const Point& c) const;
    [[nodiscard]] bool find_unit(std::span<const Point> points);
    [[nodiscard]] bool add_loop(std::span<const Point> loop, Index number);
    Index add_chain(Index first, Index last, int step, Index loop);
    [[nodiscard]] bool begin_chains(const Event& e);
    [[nodiscard]] bool end_chains(const Event& e);
    [[nodiscard]] int side_of_chain(Chain& c, const Point& p) const;
    [[nodiscard]] bool stay_apart(Chain& low, Chain& high, const Point& until) const;
    void skip(Index& next, const Chain& c, const Point& until) const;
    void note_place(const Event& e, Index below, bool is_outline);

    double unit_ = 1;             // times a coordinate: one of a lattice
    std::vector<Point> corners_;  // of all loops, each from its smallest corner to the same again
    std::vector<Chain> chains_;
    std::vector<Event> events_;
    std::vector<Index> active_;  // chains from below
    std::vector<Place> places_;
    std::vector<bool> is_placed_;
    std::vector<Index> order_;
};

}  // namespace trisect::detail
