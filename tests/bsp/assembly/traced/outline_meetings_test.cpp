// SPDX-License-Identifier: Apache-2.0
//
// Segments in which random triangles cross a facet: where they meet each other, against exact
// predicates of all pairs. On a small grid many of them touch or run through one point, which must
// be uncertain; on a large one none do.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/assembly/traced/outline_meetings.h>

#include "reference/random_solids.h"

namespace {

using trisect::Approximation;
using trisect::HomogeneousPoint;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Side;
using trisect::detail::OutlineMeetings;
using trisect::detail::OutlinePlane;
using trisect::detail::OutlineSegment;

using Corners = std::array<LatticePoint, 3>;

// Points of three planes, and what the exact predicates say of them.
class Figure {
public:
    Figure(reference::Random& random, std::int64_t size, std::int64_t tilt, std::size_t count)
        : facet_(large_facet(size, tilt)), plane_(through(facet_)) {
        while (triangles_.size() < count) {
            Corners t;
            for (auto& p : t)
                p = {random.between(-size, size), random.between(-size, size),
                     random.between(-2 * size, 2 * size)};
            if (!trisect::are_collinear(t[0], t[1], t[2])) add(t, random.chance(1, 2));
        }
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            OutlineSegment s;
            s.cutter = static_cast<std::uint32_t>(i % 5);
            s.open_below = open_below_[i];
            for (std::size_t k = 0; k < 2; ++k) s.at[k] = &at_[i][k];
            segments_.push_back(s);
        }
    }

    // The pairs that cross; false where some pair has an end on the other one's plane.
    bool cross(std::set<std::pair<std::size_t, std::size_t>>& pairs) const {
        bool sure = true;
        for (std::size_t a = 0; a < segments_.size(); ++a)
            for (std::size_t b = a + 1; b < segments_.size(); ++b) {
                if (segments_[a].cutter == segments_[b].cutter) continue;
                const int x = side(a, 0, b) * side(a, 1, b);
                const int y = side(b, 0, a) * side(b, 1, a);
                if (x < 0 && y < 0) pairs.emplace(a, b);
                if (x <= 0 && y <= 0 && (x == 0 || y == 0)) sure = false;
            }
        return sure;
    }
    [[nodiscard]] int side(std::size_t segment, std::size_t end, std::size_t cutter) const {
        return trisect::sign_of(trisect::side_of(ends_[segment][end], planes_[cutter]));
    }
    // Whether a segment comes to one cutter before it comes to another.
    [[nodiscard]] bool is_before(std::size_t segment, std::size_t a, std::size_t b) const {
        for (int axis = 0; axis < 3; ++axis) {
            const auto way =
                trisect::compare_coordinate(ends_[segment][0], ends_[segment][1], axis);
            if (way == 0) continue;
            const auto order =
                trisect::compare_coordinate(*meet(segment, a), *meet(segment, b), axis);
            return way < 0 ? order < 0 : order > 0;
        }
        return false;
    }
    [[nodiscard]] const std::vector<OutlineSegment>& segments() const { return segments_; }
    [[nodiscard]] OutlinePlane facet() const {
        return OutlinePlane({&facet_[0], &facet_[1], &facet_[2]});
    }

private:
    static Corners large_facet(std::int64_t size, std::int64_t tilt) {
        return {{{-8 * size, -8 * size, -tilt}, {9 * size, -7 * size, tilt}, {0, 9 * size, 0}}};
    }
    static Plane through(const Corners& c) { return Plane::through(c[0], c[1], c[2]); }

    [[nodiscard]] std::optional<HomogeneousPoint> meet(std::size_t a, std::size_t b) const {
        return trisect::intersect(plane_, planes_[a], planes_[b]);
    }

    // Where the triangle crosses the facet's plane, with what is open on the left.
    void add(const Corners& t, bool open_below) {
        const Plane plane = through(t);
        std::vector<HomogeneousPoint> ends;
        for (std::size_t k = 0; k < 3; ++k) {
            const Side from = trisect::side_of(t[k], plane_);
            const Side to = trisect::side_of(t[(k + 1) % 3], plane_);
            if (from == Side::On || to == Side::On) return;
            if (from == to) continue;
            for (int axis = 0; axis < 3; ++axis) {
                const auto i = static_cast<std::size_t>(axis);
                const auto& p = t[k];
                const auto& q = t[(k + 1) % 3];
                if (p[static_cast<int>((i + 1) % 3)] == q[static_cast<int>((i + 1) % 3)] &&
                    p[static_cast<int>((i + 2) % 3)] == q[static_cast<int>((i + 2) % 3)])
                    continue;
                const auto end = trisect::intersect(plane_, plane, Plane::along_axis(p, q, axis));
                if (!end) continue;
                ends.push_back(*end);
                break;
            }
        }
        if (ends.size() != 2) return;
        // What is below the triangle is to the left of the product of the normals.
        for (int axis = 0; axis < 3; ++axis) {
            const int product = trisect::sign_of_cross(plane_, plane, axis);
            if (product == 0) continue;
            const bool along =
                (trisect::compare_coordinate(ends[0], ends[1], axis) < 0) == (product > 0);
            if (along != open_below) std::swap(ends[0], ends[1]);
            break;
        }
        triangles_.push_back(t);
        planes_.push_back(plane);
        open_below_.push_back(open_below);
        ends_.push_back({ends[0], ends[1]});
        at_.push_back({trisect::approximate(ends[0]), trisect::approximate(ends[1])});
    }

    Corners facet_;
    Plane plane_;
    std::vector<Corners> triangles_;
    std::vector<Plane> planes_;
    std::vector<bool> open_below_;
    std::vector<std::array<HomogeneousPoint, 2>> ends_;
    std::vector<std::array<Approximation, 2>> at_;
    std::vector<OutlineSegment> segments_;
};

struct Count {
    std::size_t found = 0;
    std::size_t refused = 0;
    std::size_t pairs = 0;
    std::size_t compared = 0;
};

void expect_order(const Figure& figure, OutlineMeetings& meetings) {
    for (std::uint32_t s = 0; s < figure.segments().size(); ++s) {
        const auto run = meetings.of(s);
        for (std::size_t i = 0; i < run.size(); ++i) {
            if (i > 0) {
                EXPECT_TRUE(figure.is_before(s, run[i - 1].other, run[i].other));
            }
            const bool below = figure.side(s, 1, run[i].other) < 0;
            EXPECT_EQ(run[i].opens, below == figure.segments()[run[i].other].open_below);
        }
    }
}

void compare(const Figure& figure, OutlineMeetings& meetings, Count& count) {
    std::set<std::pair<std::size_t, std::size_t>> expected;
    const bool sure = figure.cross(expected);
    const bool found = meetings.find(figure.facet(), figure.segments(), 5);
    const std::size_t n = figure.segments().size();
    count.pairs += n * (n - 1) / 2;
    count.compared += meetings.compared();
    ++(found ? count.found : count.refused);
    if (!sure) {
        EXPECT_FALSE(found);
    }
    if (!found) return;
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const OutlineMeetings::Point& p : meetings.points())
        pairs.emplace(p.segments[0], p.segments[1]);
    EXPECT_EQ(pairs, expected);
    EXPECT_EQ(pairs.size(), meetings.points().size());
    expect_order(figure, meetings);
}

Count compare_many(std::int64_t size, std::int64_t tilt, std::uint64_t first_seed) {
    OutlineMeetings meetings;
    Count count;
    for (std::uint64_t seed = first_seed; seed < first_seed + 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed);
        compare(Figure(random, size, tilt, 2 + seed % 23), meetings, count);
    }
    return count;
}

TEST(OutlineMeetings, TrianglesOnALargeGrid) {
    const Count count = compare_many(std::int64_t{1} << 40, std::int64_t{1} << 38, 910000);
    EXPECT_EQ(count.refused, 0U);
    EXPECT_LT(2 * count.compared, count.pairs);
}

TEST(OutlineMeetings, TrianglesOnASmallGrid) {
    const Count count = compare_many(6, 0, 920000);
    EXPECT_GT(count.found, 20U);
    EXPECT_GT(count.refused, 20U);
}

}  // namespace
