// SPDX-License-Identifier: Apache-2.0
//
// Random loops on small grids, where nearly everything touches, against all pairs of sides.

#include <trisect/bsp/flat/loop_sweep.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace trisect::detail {
namespace {

using Point = LoopSweep::Point;
using Loop = std::vector<Point>;
constexpr LoopSweep::Index none = LoopSweep::none;

// Of small whole numbers.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool is_within(const Point& a, const Point& b, const Point& p) {
    return turn(a, b, p) == 0 && std::min(a, b) <= p && p <= std::max(a, b) &&
           std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}

bool meet(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto apart = [](double s, double t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
    if (apart(turn(a, b, c), turn(a, b, d)) && apart(turn(c, d, a), turn(c, d, b))) return true;
    return is_within(a, b, c) || is_within(a, b, d) || is_within(c, d, a) || is_within(c, d, b);
}

struct Side {
    Point from;
    Point to;
    std::size_t loop = 0;
    std::size_t place = 0;
};

std::vector<Side> sides_of(const std::vector<Loop>& loops) {
    std::vector<Side> out;
    for (std::size_t l = 0; l < loops.size(); ++l)
        for (std::size_t i = 0; i < loops[l].size(); ++i)
            out.push_back({loops[l][i], loops[l][(i + 1) % loops[l].size()], l, i});
    return out;
}

// Sides that follow each other have one point in common.
bool are_apart(const Side& s, const Side& t, std::size_t count) {
    if (s.loop != t.loop) return !meet(s.from, s.to, t.from, t.to);
    const bool follows = (s.place + 1) % count == t.place;
    const bool leads = (t.place + 1) % count == s.place;
    if (follows) return !is_within(s.from, s.to, t.to) && !is_within(t.from, t.to, s.from);
    if (leads) return are_apart(t, s, count);
    return !meet(s.from, s.to, t.from, t.to);
}

bool are_simple(const std::vector<Loop>& loops) {
    const std::vector<Side> sides = sides_of(loops);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (sides[i].from == sides[i].to) return false;
        for (std::size_t k = i + 1; k < sides.size(); ++k)
            if (!are_apart(sides[i], sides[k], loops[sides[i].loop].size())) return false;
    }
    return true;
}

bool run(LoopSweep& sweep, const std::vector<Loop>& loops) {
    std::vector<Point> points;
    std::vector<LoopSweep::Index> begin{0};
    for (const Loop& loop : loops) {
        points.insert(points.end(), loop.begin(), loop.end());
        begin.push_back(static_cast<LoopSweep::Index>(points.size()));
    }
    return sweep.run(points, begin);
}

double twice_area(const Loop& loop) {
    double out = 0;
    for (std::size_t i = 2; i < loop.size(); ++i) out += turn(loop[0], loop[i - 1], loop[i]);
    return out;
}

/// The highest side below a point, seen a little to the right of it, of all but one loop.
struct Below {
    LoopSweep::Index loop = none;
    bool is_on_left = false;
};
Below highest_below(const std::vector<Loop>& loops, std::size_t except, const Point& p) {
    Below out;
    double height = 0;
    double slope = 0;
    for (const Side& s : sides_of(loops)) {
        if (s.loop == except) continue;
        const auto [a, b] = std::minmax(s.from, s.to);
        if (!(a[0] <= p[0] && p[0] < b[0])) continue;
        const double rise = (b[1] - a[1]) / (b[0] - a[0]);
        const double y = a[1] + rise * (p[0] - a[0]);
        if (y > p[1]) continue;
        if (out.loop != none && std::pair(y, rise) < std::pair(height, slope)) continue;
        height = y;
        slope = rise;
        out = {static_cast<LoopSweep::Index>(s.loop), s.from < s.to};
    }
    return out;
}

void expect_places(const LoopSweep& sweep, const std::vector<Loop>& loops) {
    ASSERT_EQ(sweep.order().size(), loops.size());
    std::vector<Point> least;
    for (const LoopSweep::Index l : sweep.order())
        least.push_back(*std::min_element(loops[l].begin(), loops[l].end()));
    EXPECT_TRUE(std::is_sorted(least.begin(), least.end()));
    for (std::size_t i = 0; i < loops.size(); ++i) {
        const LoopSweep::Index l = sweep.order()[i];
        const LoopSweep::Place& place = sweep.place(l);
        EXPECT_EQ(place.is_outline, twice_area(loops[l]) > 0);
        const Below below = highest_below(loops, l, least[i]);
        EXPECT_EQ(place.below, below.loop);
        EXPECT_EQ(place.is_on_left, below.is_on_left);
    }
}

class RandomLoops {
public:
    explicit RandomLoops(std::uint32_t seed) : random_(seed) {}
    std::uint32_t number(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
    Loop any(std::uint32_t corners, std::uint32_t grid, const Point& at) {
        Loop out;
        for (std::uint32_t i = 0; i < corners; ++i) out.push_back(point(grid, at));
        return out;
    }
    /// Corners around a centre: often simple.
    Loop star(std::uint32_t corners, std::uint32_t grid, const Point& at) {
        Loop out = any(corners, grid, at);
        const double half = grid / 2.0;
        const Point middle{at[0] + half - 0.25, at[1] + half - 0.25};
        const auto angle = [&](const Point& p) {
            return std::atan2(p[1] - middle[1], p[0] - middle[0]);
        };
        std::sort(out.begin(), out.end(),
                  [&](const Point& p, const Point& q) { return angle(p) < angle(q); });
        if (number(2) == 0) std::reverse(out.begin(), out.end());
        return out;
    }

private:
    Point point(std::uint32_t grid, const Point& at) {
        return {at[0] + number(grid), at[1] + number(grid)};
    }
    std::mt19937 random_;
};

TEST(LoopSweep, FindsWhetherRandomLoopsAreSimple) {
    RandomLoops random(1);
    LoopSweep sweep;
    int simple = 0;
    for (int round = 0; round < 60000; ++round) {
        std::vector<Loop> loops;
        const std::uint32_t count = 1 + random.number(3);
        for (std::uint32_t l = 0; l < count; ++l) {
            const Point at{static_cast<double>(random.number(9)),
                           static_cast<double>(random.number(9))};
            const std::uint32_t corners = 3 + random.number(round % 2 == 0 ? 3 : 8);
            loops.push_back(round % 3 == 0 ? random.any(corners, 4, at)
                                           : random.star(corners, 8, at));
        }
        const bool is_simple = are_simple(loops);
        ASSERT_EQ(run(sweep, loops), is_simple) << round;
        if (!is_simple) continue;
        ++simple;
        expect_places(sweep, loops);
    }
    EXPECT_GT(simple, 5000);
}

// Many at once: stars in cells of a grid, and within each other.
TEST(LoopSweep, FindsPlacesOfManyLoops) {
    RandomLoops random(2);
    LoopSweep sweep;
    int simple = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<Loop> loops{{{-2, -2}, {200, -2}, {200, 200}, {-2, 200}}};
        for (std::uint32_t i = 0; i < 12; ++i) {
            const double grid = 4 + random.number(12);
            const Point at{static_cast<double>(random.number(10)) * 17,
                           static_cast<double>(random.number(10)) * 17};
            const Loop star =
                random.star(3 + random.number(5), static_cast<std::uint32_t>(grid), at);
            loops.push_back(star);
            if (!are_simple(loops)) loops.pop_back();
        }
        ASSERT_TRUE(run(sweep, loops)) << round;
        simple += loops.size() > 4 ? 1 : 0;
        expect_places(sweep, loops);
        // One more that touches the frame.
        loops.push_back({{-2, 50}, {-1, 49}, {-1, 51}});
        EXPECT_EQ(run(sweep, loops), false);
    }
    EXPECT_GT(simple, 300);
}

// By the last digit: a corner on a side, beside it, and beyond it.
TEST(LoopSweep, IsExact) {
    LoopSweep sweep;
    const double third = 1.0 / 3;
    const Loop triangle{{0, 0}, {3, 1}, {0, 1}};
    for (const double y : {std::nextafter(third, 0), third, std::nextafter(third, 1)}) {
        // 3 y is rounded up for the third double and down for the first: y is no third.
        const Loop below{{0, -1}, {1, -1}, {1, y}};
        const bool is_below = y <= third;  // the double next to a third is below it
        EXPECT_EQ(run(sweep, {triangle, below}), is_below) << y;
    }
    EXPECT_EQ(run(sweep, {triangle, {{0, -1}, {6, -1}, {1.5, 0.5}}}), false);
    EXPECT_EQ(run(sweep, {triangle, {{0, -1}, {1, -1}, {1.5, std::nextafter(0.5, 0)}}}), true);
}

TEST(LoopSweep, SaysNoWhereNumbersAreTooFarApart) {
    LoopSweep sweep;
    EXPECT_TRUE(run(sweep, {{{0, 0}, {0x1p60, 0}, {0x1p60, 0x1p10}}}));
    EXPECT_FALSE(run(sweep, {{{0, 0}, {0x1p60, 0}, {0x1p60, 0x1.0000000000001p-40}}}));
    EXPECT_FALSE(run(sweep, {{{0, 0}, {0x1p500, 0}, {0x1p500, 0x1p500}}}));
}

}  // namespace
}  // namespace trisect::detail
