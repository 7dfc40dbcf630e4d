// SPDX-License-Identifier: Apache-2.0
//
// Pairs of triangles that doubles keep apart, against the corners of their intersection in
// rationals.

#include <trisect/brep/contact/contact_filter.h>

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
}

}  // namespace
}  // namespace contact_filter_test
