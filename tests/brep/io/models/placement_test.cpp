// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/placement.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace {

using namespace trisect;
using detail::Placement;

Point3d image(const Placement& placement, const Point3d& p, ModelReport& report) {
    return placement.apply(p, report);
}

TEST(Placement, QuaternionsOfAnyLength) {
    ModelReport report;
    // A quarter turn about z, of length 2.
    const Placement turn = Placement::from_parts({1, 1, 1}, {0, 0, 1.5, 1.5}, {1, 2, 3});
    EXPECT_EQ(image(turn, {1, 0, 0}, report), (Point3d{1, 3, 3}));
    EXPECT_EQ(image(turn, {0, 1, 0}, report), (Point3d{0, 2, 3}));
    EXPECT_EQ(report, ModelReport());
    EXPECT_EQ(turn.orientation(), 1);
    EXPECT_EQ(Placement::from_parts({-1, 2, 3}, {0, 0, 0, 1}, {0, 0, 0}).orientation(), -1);
}

TEST(Placement, ScaleComesBeforeTheTurn) {
    ModelReport report;
    const Placement p = Placement::from_parts({3, 1, 1}, {0, 0, 1, 1}, {0, 0, 0});
    EXPECT_EQ(image(p, {1, 1, 1}, report), (Point3d{-1, 3, 1}));
}

TEST(Placement, RoundsOnce) {
    ModelReport report;
    const Placement third = Placement::from_rows({0.1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    // 0.1 ten times over, exactly, is a little more than 1; in doubles each step would round.
    Placement power;
    Placement back = Placement::from_rows({10, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    power = third.then(back);
    EXPECT_EQ(image(power, {1, 0, 0}, report), (Point3d{1, 0, 0}));
    EXPECT_EQ(report.rounded_vertices, 1U);
    EXPECT_GT(report.largest_move, 5e-17);
    EXPECT_FALSE(power.is_identity());
    EXPECT_TRUE(Placement().then(Placement()).is_identity());
}

/// Row by row in fractions, rounded once.
Point3d image_in_fractions(const std::array<double, 12>& rows, const Point3d& p, double& largest) {
    Point3d out{};
    for (std::size_t i = 0; i < 3; ++i) {
        ExactRational sum = ExactRational::from_double(rows[4 * i + 3]);
        for (std::size_t k = 0; k < 3; ++k)
            sum += ExactRational::from_double(rows[4 * i + k]) * ExactRational::from_double(p[k]);
        out[i] = sum.to_double();
        const double move = (sum - ExactRational::from_double(out[i])).to_double();
        largest = std::max(largest, std::fabs(move));
    }
    return out;
}

TEST(Placement, AgreesWithFractions) {
    std::mt19937_64 random(3);
    const auto number = [&] {
        const double size = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
        const double value = static_cast<double>(static_cast<std::int64_t>(random())) * 0x1p-63;
        // Few digits now and then, so that sums are exact or half way between doubles.
        return random() % 3 == 0 ? std::floor(8 * value) * size : value * size;
    };
    for (int n = 0; n < 20000; ++n) {
        std::array<double, 12> rows{};
        for (double& r : rows) r = random() % 4 == 0 ? 0 : number();
        const Point3d p{number(), number(), number()};
        ModelReport report;
        double largest = 0;
        const Point3d expected = image_in_fractions(rows, p, largest);
        EXPECT_EQ(image(Placement::from_rows(rows), p, report), expected);
        EXPECT_EQ(report.rounded_vertices, largest > 0 ? 1U : 0U);
        EXPECT_NEAR(report.largest_move, largest, 0.01 * largest);
    }
}

}  // namespace
