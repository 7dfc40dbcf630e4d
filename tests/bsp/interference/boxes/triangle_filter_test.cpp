// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>

#include <trisect/bsp/interference/boxes/triangle_filter.h>

#include "reference/random_solids.h"
#include "support/triangle_oracle.h"

namespace {

using brute::Triangle3;
using reference::Random;
using trisect::detail::compare_triangles;
using trisect::detail::PairVerdict;
using trisect::detail::TriangleCorners;

bool is_flat(const TriangleCorners& t) {
    double n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        n += std::abs((t[1][i] - t[0][i]) * (t[2][j] - t[0][j]) -
                      (t[1][j] - t[0][j]) * (t[2][i] - t[0][i]));
    }
    return n == 0;
}

TriangleCorners on_grid(Random& random, std::int64_t size, double scale, double shift) {
    for (;;) {
        TriangleCorners t;
        for (auto& p : t)
            for (double& c : p) c = static_cast<double>(random.between(0, size)) * scale + shift;
        if (!is_flat(t)) return t;
    }
}

Triangle3 exact(const TriangleCorners& t) {
    return {brute::exact(t[0]), brute::exact(t[1]), brute::exact(t[2])};
}

// Every certain verdict must be right. Returns whether there was one.
bool expect_right(const TriangleCorners& p, const TriangleCorners& q, double error) {
    switch (compare_triangles(p, q, error)) {
        case PairVerdict::Apart:
            EXPECT_FALSE(brute::meet(exact(p), exact(q)));
            return true;
        case PairVerdict::Crossing:
            EXPECT_TRUE(brute::cross(exact(p), exact(q)));
            return true;
        case PairVerdict::Unknown:
            return false;
    }
    return false;
}

TEST(TriangleFilter, TrianglesOnASmallGridWhereEverythingCoincides) {
    Random random(1);
    int certain = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto p = on_grid(random, 4, 1, 0);
        const auto q = on_grid(random, 4, 1, 0);
        certain += expect_right(p, q, 0) ? 1 : 0;
    }
    EXPECT_GT(certain, 12000);
}

TEST(TriangleFilter, SmallTrianglesFarFromTheOriginOfTheLattice) {
    Random random(2);
    int certain = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto p = on_grid(random, 1000, 1, 0x1p52);
        const auto q = on_grid(random, 1000, 1, 0x1p52);
        certain += expect_right(p, q, 0) ? 1 : 0;
    }
    EXPECT_GT(certain, 3900);
}

TEST(TriangleFilter, NearlyTouchingTrianglesOfLargeCoordinates) {
    Random random(3);
    for (int i = 0; i < 4000; ++i) {
        auto p = on_grid(random, 4, 0x1p50, 0);
        const auto q = on_grid(random, 4, 0x1p50, 0);
        for (auto& c : p)
            for (double& v : c) v += static_cast<double>(random.between(-1, 1));
        if (!is_flat(p)) (void)expect_right(p, q, 0);
    }
}

TEST(TriangleFilter, VerdictsHoldForAllTrianglesWithinTheError) {
    Random random(4);
    for (int i = 0; i < 4000; ++i) {
        const auto p = on_grid(random, 6, 1, 0);
        const auto q = on_grid(random, 6, 1, 0);
        const double error = std::ldexp(1.0, -static_cast<int>(random.between(4, 24)));
        const PairVerdict verdict = compare_triangles(p, q, error);
        if (verdict == PairVerdict::Unknown) continue;
        for (int j = 0; j < 4; ++j) {
            auto r = q;
            for (auto& c : r)
                for (double& v : c) v += error * static_cast<double>(random.between(-1, 1));
            const bool meets = brute::meet(exact(p), exact(r));
            EXPECT_EQ(meets, verdict == PairVerdict::Crossing);
        }
    }
}

TEST(TriangleFilter, MostRandomPairsAreCertain) {
    Random random(5);
    int certain = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto p = on_grid(random, 1000000007, 0x1p-30, 0);
        const auto q = on_grid(random, 1000000007, 0x1p-30, 0);
        certain += expect_right(p, q, 0x1p-50) ? 1 : 0;
    }
    EXPECT_EQ(certain, 2000);
}

}  // namespace
