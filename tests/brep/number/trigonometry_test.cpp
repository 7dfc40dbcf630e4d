// SPDX-License-Identifier: Apache-2.0
//
// Sines, cosines and angles in fixed point against identities and the C library.

#include <trisect/brep/number/trigonometry.h>

#include <gtest/gtest.h>

#include <cmath>

#include "reference/random_solids.h"

namespace {

using trisect::detail::angle_of;
using trisect::detail::fixed_bits;
using trisect::detail::fixed_error_bits;
using trisect::detail::sine_cosine;
using trisect::detail::SineCosine;

const mpz_class one = mpz_class(1) << fixed_bits;
const mpz_class error = mpz_class(1) << (fixed_bits - fixed_error_bits);

double to_double(const mpz_class& v) { return mpq_class(v, one).get_d(); }

mpq_class random_angle(reference::Random& random) {
    const int scale = 1 << random.between(0, 20);
    return mpq_class(mpz_class(random.between(-1000000, 1000000)), 1000003) * scale;
}

TEST(FixedPoint, SineAndCosineAgreeWithTheLibrary) {
    reference::Random random(1);
    for (int i = 0; i < 500; ++i) {
        const mpq_class angle = mpq_class(mpz_class(random.between(-(1 << 20), 1 << 20)), 1 << 14);
        const SineCosine r = sine_cosine(angle);
        EXPECT_NEAR(to_double(r.sine), std::sin(angle.get_d()), 1e-15);
        EXPECT_NEAR(to_double(r.cosine), std::cos(angle.get_d()), 1e-15);
    }
}

TEST(FixedPoint, SquaresAddToOneAndSumsObeyTheirTheorem) {
    reference::Random random(2);
    for (int i = 0; i < 300; ++i) {
        const mpq_class x = random_angle(random);
        const mpq_class y = random_angle(random);
        const SineCosine a = sine_cosine(x / 2);
        const SineCosine b = sine_cosine(y / 2);
        const SineCosine c = sine_cosine((x + y) / 2);
        EXPECT_LT(abs(a.sine * a.sine + a.cosine * a.cosine - one * one), 8 * error * one);
        EXPECT_LT(abs(a.sine * b.cosine + a.cosine * b.sine - c.sine * one), 8 * error * one);
        EXPECT_LT(abs(a.cosine * b.cosine - a.sine * b.sine - c.cosine * one), 8 * error * one);
    }
}

TEST(FixedPoint, AnAngleHasTheDirectionItIsOf) {
    reference::Random random(3);
    for (int i = 0; i < 300; ++i) {
        const mpz_class y = random.between(-1000, 1000);
        const mpz_class x = random.between(1, 1000);
        const SineCosine r = sine_cosine(angle_of(y, x));
        EXPECT_LT(abs(y * r.cosine - x * r.sine), 4000 * error);
        EXPECT_GT(x * r.cosine + y * r.sine, 0);
    }
}

}  // namespace
