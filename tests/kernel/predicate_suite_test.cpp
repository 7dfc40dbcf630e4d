// SPDX-License-Identifier: Apache-2.0
//
// The suite that tests anyone's predicates (kernel/predicate_suite.h): its exact signs against GMP,
// that it finds what is wrong with plain doubles, that it finds nothing with the kernel's; and the
// sign manifest, one number for a million signs, which every build has to reproduce.

#include <trisect/kernel/predicate_suite.h>

#include <gtest/gtest.h>

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <string>

#include <trisect/kernel/predicate_suite_side.h>

#include "support/sign_manifest.h"

namespace {

namespace suite = trisect::predicate_suite;
using suite::Point2;
using suite::Point3;

// ---------------------------------------------------------------- the suite against GMP

mpq_class det2(const mpq_class& a, const mpq_class& b, const mpq_class& c, const mpq_class& d) {
    return a * d - b * c;
}

int orient2d_by_gmp(const Point2& a, const Point2& b, const Point2& c) {
    const auto q = [](double x) { return mpq_class(x); };
    return sgn(det2(q(b[0]) - q(a[0]), q(b[1]) - q(a[1]), q(c[0]) - q(a[0]), q(c[1]) - q(a[1])));
}

int orient3d_by_gmp(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    std::array<std::array<mpq_class, 3>, 3> m;
    for (std::size_t i = 0; i < 3; ++i) {
        m[0][i] = mpq_class(b[i]) - mpq_class(a[i]);
        m[1][i] = mpq_class(c[i]) - mpq_class(a[i]);
        m[2][i] = mpq_class(d[i]) - mpq_class(a[i]);
    }
    return sgn(mpq_class(m[0][0] * det2(m[1][1], m[1][2], m[2][1], m[2][2]) -
                         m[0][1] * det2(m[1][0], m[1][2], m[2][0], m[2][2]) +
                         m[0][2] * det2(m[1][0], m[1][1], m[2][0], m[2][1])));
}

TEST(PredicateSuite, ExactSignsAreThoseOfGmp) {
    const suite::Options options{.seed = 11, .cases = 2000};
    for (const auto& row : suite::test_orient2d(orient2d_by_gmp, options))
        EXPECT_EQ(row.wrong + row.inconsistent, 0U) << row.family << ": " << row.first;
    for (const auto& row : suite::test_orient3d(orient3d_by_gmp, options))
        EXPECT_EQ(row.wrong + row.inconsistent, 0U) << row.family << ": " << row.first;
}

TEST(PredicateSuite, SumsAndProductsOfLongIntegersAreThoseOfGmp) {
    suite::Generator generator(5);
    for (int round = 0; round < 2000; ++round) {
        const auto p = generator.orient3d(0);
        const auto integer = [](double x, int shift) {
            return suite::Integer(static_cast<std::int64_t>(x), shift);
        };
        const auto expected = [](double x, int shift) -> mpz_class {
            return mpz_class(x) << static_cast<mp_bitcnt_t>(shift);
        };
        const int shift = round % 200;
        const suite::Integer a =
            integer(p[0][0], shift) * integer(p[0][1], 3) + integer(p[1][0], 70);
        const mpz_class b = expected(p[0][0], shift) * expected(p[0][1], 3) + expected(p[1][0], 70);
        EXPECT_EQ(a.sign(), sgn(b));
        const suite::Integer c = a * a - integer(p[1][1], 40) * integer(p[1][2], 2 * shift);
        const mpz_class d = b * b - expected(p[1][1], 40) * expected(p[1][2], 2 * shift);
        EXPECT_EQ(c.sign(), sgn(d));
        EXPECT_EQ((c - c).sign(), 0);
    }
}

// ---------------------------------------------------------------- it finds what is wrong

double orient2d_in_doubles(const Point2& a, const Point2& b, const Point2& c) {
    return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
}

double orient3d_in_doubles(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    std::array<Point3, 3> m{};
    for (std::size_t i = 0; i < 3; ++i)
        m[0][i] = b[i] - a[i], m[1][i] = c[i] - a[i], m[2][i] = d[i] - a[i];
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

TEST(PredicateSuite, PlainDoublesAreWrongInAllNearlyDegenerateFamilies) {
    const suite::Options options{.seed = 1, .cases = 3000};
    for (const auto& row : suite::test_orient2d(orient2d_in_doubles, options)) {
        const std::string family = row.family;
        const bool harmless =
            family == "general" || family == "grid" || family == "line" || family == "twins";
        EXPECT_EQ(row.wrong == 0, harmless) << family;
        EXPECT_EQ(row.first.empty(), harmless) << family;
    }
    for (const auto& row : suite::test_orient3d(orient3d_in_doubles, options)) {
        const std::string family = row.family;
        const bool harmless = family == "general" || family == "grid" || family == "mixed";
        EXPECT_TRUE(row.wrong != 0 || harmless) << family;
    }
}

TEST(PredicateSuite, FamiliesHaveZerosAndSigns) {
    const suite::Options options{.seed = 2, .cases = 3000};
    for (const auto& row : suite::test_orient3d(suite::exact_orient3d, options)) {
        const std::string family = row.family;
        EXPECT_EQ(row.wrong + row.inconsistent, 0U);
        EXPECT_EQ(row.zeros == row.cases, family == "plane") << family;
        if (family == "grid" || family == "plane-ulps" || family == "plane-units") {
            EXPECT_GT(row.zeros, row.cases / 100) << family;
        }
    }
    const auto side = [](const auto&... p) { return suite::exact_side(p...).value(); };
    for (const auto& row : suite::test_side(side, options)) {
        EXPECT_EQ(row.wrong + row.inconsistent, 0U);
        EXPECT_GT(row.cases, 2000U) << row.family;
    }
}

TEST(PredicateSuite, ConventionOfTheOtherHandIsUnderstood) {
    const auto mirrored = [](const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
        return -suite::exact_orient3d(a, b, c, d);
    };
    for (const auto& row : suite::test_orient3d(mirrored, {.seed = 3, .cases = 200}))
        EXPECT_EQ(row.wrong, 0U) << row.family;
}

// ---------------------------------------------------------------- the kernel

TEST(PredicateSuite, TheKernelIsRightInAllFamilies) {
    suite::Generator generator(21);
    std::uint64_t compared = 0;
    for (std::size_t k = 0; k < suite::Generator::orient3d_families.size(); ++k) {
        for (int n = 0; n < 3000; ++n) {
            const auto p = generator.orient3d(k);
            const auto sign = sign_manifest::orient3d_by_kernel(p);
            if (!sign) continue;
            ++compared;
            EXPECT_EQ(*sign, suite::exact_orient3d(p[0], p[1], p[2], p[3]))
                << suite::Generator::orient3d_families[k];
        }
    }
    EXPECT_GT(compared, 15'000U);
    for (const auto& row : suite::test_side(suite::side_by_trisect, {.seed = 22, .cases = 5000}))
        EXPECT_EQ(row.wrong + row.inconsistent, 0U) << row.family << ": " << row.first;
}

TEST(SignManifest, MillionSignsOverAllFamilies) {
    const sign_manifest::SignHash hash = sign_manifest::of_all_families();
    EXPECT_EQ(hash.count(), 1'162'082U);
    EXPECT_EQ(hash.hash(), 16'618'475'444'522'659'819U);
}

}  // namespace
