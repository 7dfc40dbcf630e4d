// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/number/exact_affine.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace {

using namespace trisect;
using detail::ExactAffine;

TEST(ExactAffine, QuaternionsOfAnyLength) {
    // A quarter turn about z, of length 2.
    const ExactAffine turn = ExactAffine::from_parts({1, 1, 1}, {0, 0, 1.5, 1.5}, {1, 2, 3});
    EXPECT_EQ(turn.apply({1, 0, 0}).point, (Point3d{1, 3, 3}));
    EXPECT_EQ(turn.apply({0, 1, 0}).point, (Point3d{0, 2, 3}));
    EXPECT_EQ(turn.apply({1, 0, 0}).move, 0);
    EXPECT_EQ(turn.orientation(), 1);
    EXPECT_EQ(ExactAffine::from_parts({-1, 2, 3}, {0, 0, 0, 1}, {0, 0, 0}).orientation(), -1);
}

TEST(ExactAffine, ScaleComesBeforeTheTurn) {
    const ExactAffine p = ExactAffine::from_parts({3, 1, 1}, {0, 0, 1, 1}, {0, 0, 0});
    EXPECT_EQ(p.apply({1, 1, 1}).point, (Point3d{-1, 3, 1}));
}

TEST(ExactAffine, RoundsOnce) {
    const ExactAffine third = ExactAffine::from_rows({0.1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    // 0.1 ten times over, exactly, is a little more than 1; in doubles each step would round.
    ExactAffine power;
    ExactAffine back = ExactAffine::from_rows({10, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    power = third.then(back);
    EXPECT_EQ(power.apply({1, 0, 0}).point, (Point3d{1, 0, 0}));
    EXPECT_GT(power.apply({1, 0, 0}).move, 5e-17);
    EXPECT_FALSE(power.is_identity());
    EXPECT_TRUE(ExactAffine().then(ExactAffine()).is_identity());
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

TEST(ExactAffine, AgreesWithFractions) {
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
        double largest = 0;
        const Point3d expected = image_in_fractions(rows, p, largest);
        const ExactAffine::Image image = ExactAffine::from_rows(rows).apply(p);
        EXPECT_EQ(image.point, expected);
        EXPECT_EQ(image.move > 0, largest > 0);
        EXPECT_NEAR(image.move, largest, 0.01 * largest);
    }
}

}  // namespace
