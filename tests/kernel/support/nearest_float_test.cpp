// SPDX-License-Identifier: Apache-2.0
#include <trisect/kernel/support/nearest_float.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace trisect::detail {
namespace {

TEST(NearestFloat, NoCoordinateOfALoopIsLeftOut) {
    for (std::size_t n = 1; n < 100; ++n) {
        std::vector<std::array<double, 3>> points(n);
        for (std::size_t i = 0; i < n; ++i) {
            const auto x = static_cast<double>(i);
            points[i] = {std::sqrt(2 + x), std::sqrt(3 + x), -std::sqrt(12 + x)};
        }
        std::vector<std::array<double, 3>> rounded = points;
        for (auto& p : rounded)
            for (double& c : p) c = nearest_float(c);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const volatile auto expected = static_cast<float>(points[i][k]);
                EXPECT_EQ(rounded[i][k], static_cast<double>(expected)) << n << " points, " << i;
            }
    }
}

}  // namespace
}  // namespace trisect::detail
