// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/exact_rational.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <utility>

#include <trisect/kernel/error.h>

#include "support/numbers.h"

namespace {

using numbers::q;
using trisect::ExactRational;

TEST(ExactRational, IsKeptInLowestTerms) {
    EXPECT_EQ(q("6/4").to_string(), "3/2");
    EXPECT_EQ(q("-6/3").to_string(), "-2");
    EXPECT_EQ(q("0/5").to_string(), "0");
    EXPECT_EQ(ExactRational().to_string(), "0");
    EXPECT_EQ(ExactRational(), ExactRational(0));
    EXPECT_TRUE(q("6/3").is_integer());
}

TEST(ExactRational, Arithmetic) {
    EXPECT_EQ(q("1/2") + q("1/3"), q("5/6"));
    EXPECT_EQ(q("1/2") - q("1/3"), q("1/6"));
    EXPECT_EQ(q("2/3") * q("3/4"), q("1/2"));
    EXPECT_EQ(q("2/3") / q("-4/3"), q("-1/2"));
    EXPECT_EQ(-q("2/3"), q("-2/3"));
    EXPECT_EQ(q("3/2").scaled(4), ExactRational(24));
    EXPECT_EQ(q("3/2").scaled(-4), q("3/32"));
    EXPECT_LT(q("1/3"), q("34/100"));
    EXPECT_EQ(q("-1/3").sign(), -1);
}

TEST(ExactRational, CopiesAreIndependentAndMovedFromIsZero) {
    ExactRational a = q("1/7");
    ExactRational b = a;
    b += ExactRational(1);
    EXPECT_EQ(a, q("1/7"));
    const ExactRational c = std::move(b);
    EXPECT_EQ(c, q("8/7"));
    a = c;
    EXPECT_EQ(a, c);
}

TEST(ExactRational, FromWideIntegers) {
    using trisect::Int128;
    using trisect::WideInt;
    EXPECT_EQ(ExactRational(WideInt<4>(-12)), ExactRational(-12));
    EXPECT_EQ(ExactRational(WideInt<4>(1).shifted_left(200)), ExactRational(1).scaled(200));
    EXPECT_EQ(ExactRational(-WideInt<3>(Int128{1} << 100)).to_string(),
              "-1267650600228229401496703205376");
}

TEST(ExactRational, MalformedTextIsRefused) {
    for (const char* text : {"", "-", "1/", "/2", "1/0", "a", "1.5", "1/-2", " 1", "+1", "1/2/3"})
        EXPECT_THROW((void)q(text), trisect::UsageError) << text;
    EXPECT_THROW(ExactRational(1) / ExactRational(), trisect::UsageError);
    EXPECT_THROW((void)ExactRational::from_double(INFINITY), trisect::UsageError);
}

TEST(ExactRational, EveryDoubleComesBack) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 20000; ++i) {
        double v = 0;
        const std::uint64_t bits = random();
        static_assert(sizeof v == sizeof bits);
        std::memcpy(&v, &bits, sizeof v);
        if (!std::isfinite(v)) continue;
        EXPECT_EQ(ExactRational::from_double(v).to_double(), v);
    }
    EXPECT_EQ(ExactRational::from_double(0x1p-1074).to_double(), 0x1p-1074);
}

TEST(ExactRational, RoundsToNearestTiesToEven) {
    const ExactRational ulp = ExactRational(1).scaled(-52);
    EXPECT_EQ((ExactRational(1) + ulp / ExactRational(2)).to_double(), 1.0);
    EXPECT_EQ((ExactRational(1) + ulp * q("3/2")).to_double(), 1.0 + 0x1p-51);
    EXPECT_EQ((ExactRational(1) + ulp * q("1000001/2000000")).to_double(), 1.0 + 0x1p-52);
    EXPECT_EQ((-ExactRational(1) - ulp * q("1000001/2000000")).to_double(), -1.0 - 0x1p-52);
    EXPECT_EQ(q("1/3").to_double(), 1.0 / 3.0);
    EXPECT_EQ((ExactRational(1) - ulp / ExactRational(4)).to_double(), 1.0);  // carries upwards
}

TEST(ExactRational, SubnormalResultsAreRoundedOnce) {
    const ExactRational tiny = ExactRational(1).scaled(-1074);
    EXPECT_EQ((tiny * q("1/2")).to_double(), 0.0);
    EXPECT_EQ((tiny * q("3/2")).to_double(), 0x1p-1073);
    EXPECT_EQ((tiny * q("2000001/4000000")).to_double(), 0x1p-1074);
    EXPECT_EQ((tiny * q("1/5")).to_double(), 0.0);
    EXPECT_EQ(tiny.scaled(-9000).to_double(), 0.0);
    // 5 / 2 of the smallest number plus a bit far below the 53rd: above the tie.
    EXPECT_EQ((tiny * (q("5/2") + ExactRational(1).scaled(-70))).to_double(), 3 * 0x1p-1074);
    EXPECT_EQ(ExactRational(1).scaled(1024).to_double(), std::numeric_limits<double>::infinity());
    EXPECT_EQ(ExactRational(1).scaled(90000).to_double(), std::numeric_limits<double>::infinity());
}

}  // namespace
