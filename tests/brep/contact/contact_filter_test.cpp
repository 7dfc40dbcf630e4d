// SPDX-License-Identifier: Apache-2.0
//
// Pairs of triangles that doubles keep apart, against the corners of their intersection in
// rationals.

#include <trisect/brep/contact/contact_filter.h>
#include <trisect/brep/contact/embedding_counters.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "reference/rational.h"
#include "reference/triangle_contact.h"
#include "reference/vector.h"

namespace contact_filter_test {
namespace {

using trisect::Coordinate;
using trisect::LatticePoint;
using Triangle = std::array<std::uint32_t, 3>;

reference::Point3 exact(const LatticePoint& p) {
    const auto d = p.doubles();
    return {reference::Rational(d[0]), reference::Rational(d[1]), reference::Rational(d[2])};
}

reference::Triangle3 exact(const std::vector<LatticePoint>& points, const Triangle& t) {
    return {exact(points[t[0]]), exact(points[t[1]]), exact(points[t[2]])};
}

bool has_area(const reference::Triangle3& t) {
    const auto n =
        reference::cross(reference::subtracted(t[1], t[0]), reference::subtracted(t[2], t[0]));
    return n[0] != 0 || n[1] != 0 || n[2] != 0;
}

// Of a second triangle whose first corners are those of the first one.
void compare(const std::vector<LatticePoint>& points, int shared, int& apart, int& meeting) {
    const Triangle a{0, 1, 2};
    Triangle b{3, 4, 5};
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(shared); ++i) b[i] = i;
    const reference::Triangle3 x = exact(points, a);
    const reference::Triangle3 y = exact(points, b);
    if (!has_area(x) || !has_area(y)) return;
    if (!trisect::detail::are_plainly_apart(points, a, b, shared)) {
        ++meeting;
        return;
    }
    ++apart;
    for (const auto& corner : reference::contact(x, y)) {
        const reference::Point3& point = corner.first;
        EXPECT_NE(std::find(x.begin(), x.begin() + shared, point), x.begin() + shared) << shared;
    }
}

TEST(ContactFilter, AgreesWithRationals) {
    const trisect::Diagnostics<trisect::detail::EmbeddingCounters> diagnostics;
    std::mt19937 random(20261129);
    int apart = 0;
    int meeting = 0;
    for (int round = 0; round < 30000; ++round) {
        // Whole numbers, decimals, and decimals that are off by an ulp.
        const double unit = round % 3 == 0 ? 1 : 0.1;
        const auto number = [&] {
            double v = unit * static_cast<double>(random() % 5);
            if (round % 3 == 2 && v != 0) v *= 1 + 0x1p-52 * static_cast<double>(random() % 3);
            return Coordinate(v * 0x1p10);
        };
        std::vector<LatticePoint> points;
        for (int i = 0; i < 6; ++i) points.push_back({number(), number(), number()});
        compare(points, round / 3 % 3, apart, meeting);
    }
    EXPECT_GT(apart, 8000);
    EXPECT_GT(meeting, 5000);
    const auto counts = diagnostics.counters();
    EXPECT_EQ(counts.exact_pairs, static_cast<std::uint64_t>(meeting));
    EXPECT_EQ(counts.edge_lines + counts.own_planes + counts.intervals + counts.other_planes,
              static_cast<std::uint64_t>(apart));
    for (const std::uint64_t n :
         {counts.edge_lines, counts.own_planes, counts.intervals, counts.other_planes})
        EXPECT_GT(n, 100U);
}

// Triangles of a body that was turned and rounded. Of two faces that meet in a line each has an
// edge on it, one after the other; or all is one face, in which both go out from a corner.
TEST(ContactFilter, KeepsApartWhatLaysOnOneLine) {
    std::mt19937 random(20261130);
    int apart = 0;
    int meeting = 0;
    const trisect::Diagnostics<trisect::detail::EmbeddingCounters> diagnostics;
    for (int round = 0; round < 20000; ++round) {
        const int shared = round % 2;
        const std::array<double, 3> along{0.816497, -0.3, -0.57735};
        const std::array<double, 3> across{0.408248, 0.707107, 0.57735};
        const std::array<double, 3> upwards{0.2, -0.5, 0.6};
        std::vector<LatticePoint> points;
        for (int i = 0; i < 6; ++i) {
            const bool is_free = i % 3 == 2;
            const bool is_right = i >= 3;
            const double u = is_free
                                 ? 0.1 * static_cast<double>(random() % 24)
                                 : 0.1 * static_cast<double>(random() % 11 + (is_right ? 13 : 0));
            double v = is_free ? 0.1 * static_cast<double>(1 + random() % 24) : 0;
            if (shared == 1 && is_right) v = -v;
            const auto& aside = shared == 0 && is_right ? upwards : across;
            const double begin = shared == 1 && i == 0 ? 1.2 : u;
            const auto at = [&](std::size_t k) {
                return Coordinate(0x1p10 * (begin * along[k] + v * aside[k]));
            };
            points.push_back({at(0), at(1), at(2)});
        }
        compare(points, shared, apart, meeting);
    }
    EXPECT_GT(apart, 15000);
    EXPECT_GT(diagnostics.counters().other_planes, 2000U);
}

}  // namespace
}  // namespace contact_filter_test
