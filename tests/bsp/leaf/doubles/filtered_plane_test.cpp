// SPDX-License-Identifier: Apache-2.0
//
// Values of a facet's plane in doubles against integers of any length, where differences of corners
// and points are rounded and rounded the worst way.

#include <trisect/bsp/leaf/doubles/filtered_facets.h>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace {

using namespace trisect::detail;

using Triangle = std::array<Vector3, 3>;

// The determinant of the plane, exact.
mpf_class exact_value(const Triangle& t, const Vector3& p) {
    const auto difference = [&](const Vector3& a, std::size_t k) {
        return mpf_class(mpf_class(a[k], 1024) - t[0][k]);
    };
    mpf_class sum(0, 1024);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        sum += difference(p, k) * (difference(t[1], i) * difference(t[2], j) -
                                   difference(t[1], j) * difference(t[2], i));
    }
    return sum;
}

Vector3 extent_of(const std::vector<Vector3>& points) {
    Vector3 extent{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [lo, hi] =
            std::ranges::minmax_element(points, {}, [k](const Vector3& p) { return p[k]; });
        extent[k] = ((*hi)[k] - (*lo)[k]) * slightly_more;
    }
    return extent;
}

std::vector<Vector3> vectors_of(const std::vector<double>& numbers) {
    std::vector<Vector3> out;
    for (const double x : numbers)
        for (const double y : numbers)
            for (const double z : numbers) out.push_back({x, y, z});
    return out;
}

// Numbers of 53 bits, whose differences from small odd ones are 54 bits long.
const std::vector<double> numbers{0x1p53 - 1, -0x1p53 + 1, 0x1p52 + 1, -0x1.8p52 - 3};

TEST(FilteredPlane, ValuesOfDifferencesThatRoundAreWithinTheBound) {
    double largest = 0;
    std::size_t cases = 0;
    std::size_t decided = 0;
    const std::vector<Vector3> corners = vectors_of(numbers);
    const Vector3 origin{0.25, -0.25, 0.75};
    for (const Vector3& a : corners)
        for (const Vector3& b : corners) {
            const Triangle t{origin, a, b};
            std::vector<Vector3> all = corners;
            all.push_back(origin);
            const FilteredPlane plane = FilteredFacets::plane_of(t, extent_of(all));
            for (const Vector3& p : corners) {
                const double value = plane.value(p);
                const mpf_class exact = exact_value(t, p);
                const mpf_class error = abs(mpf_class(exact - value));
                ASSERT_LE(error, plane.bound);
                const int sign = plane.sign({p, 0.0});
                if (sign != 0) {
                    ++decided;
                    ASSERT_EQ(sign, sgn(exact));
                }
                ++cases;
                if (plane.bound > 0)
                    largest = std::max(largest, mpf_class(error / plane.bound).get_d());
            }
        }
    EXPECT_EQ(cases, 64U * 64 * 64);
    EXPECT_GT(decided, cases / 20);
    // Or the inputs prove little. The bound takes every difference for one of the whole extent,
    // which is twice as much.
    EXPECT_GT(largest, 0.1);
    EXPECT_LE(largest, 1);
    testing::Test::RecordProperty("largest_part_of_bound", std::to_string(largest));
}

}  // namespace
