// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/refined_point.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

#include "support/gmp_oracle.h"

namespace refined_point_test {
namespace {

using trisect::LatticePoint;
using trisect::Plane;
using trisect::RefinedPoint;

void expect_enclosed(const RefinedPoint& refined, const trisect::HomogeneousPoint& exact) {
    for (std::size_t k = 0; k < 3; ++k) {
        mpq_class at(oracle::integer(exact.xyz[k]), oracle::integer(exact.w));
        at.canonicalize();
        const mpq_class off = mpq_class(refined.high[k]) + mpq_class(refined.low[k]) - at;
        EXPECT_LE(abs(off), mpq_class(refined.error));
    }
}

TEST(RefinedPoint, IsWithinItsError) {
    std::mt19937_64 random(7);
    int fine = 0;
    int found = 0;
    constexpr int rounds = 2000;
    for (int n = 0; n < rounds; ++n) {
        const int bits = 12 + n % 40;
        const auto coordinate = [&] { return static_cast<std::int64_t>(random()) >> (63 - bits); };
        const auto point = [&] { return LatticePoint{coordinate(), coordinate(), coordinate()}; };
        std::array<LatticePoint, 9> corners;
        for (LatticePoint& c : corners) c = point();
        std::array<std::optional<Plane>, 3> planes;
        std::array<trisect::CornerPlane, 3> by_corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const LatticePoint* const c = &corners[3 * i];
            planes[i] = Plane::through(c[0], c[1], c[2]);
            by_corners[i].corners = {c, c + 1, c + 2};
        }
        if (!planes[0]->is_valid() || !planes[1]->is_valid() || !planes[2]->is_valid()) continue;
        const auto exact = intersect(*planes[0], *planes[1], *planes[2]);
        if (!exact) continue;
        const auto approximation = approximate(*planes[0], *planes[1], *planes[2]);
        const auto of_planes = refined_point(approximation, *planes[0], *planes[1], *planes[2]);
        const auto of_corners = refined_point(approximation, by_corners);
        for (const auto& refined : {of_planes, of_corners}) {
            if (!refined) continue;
            ++found;
            expect_enclosed(*refined, *exact);
            double size = 0;
            for (const double c : refined->high) size = std::max(size, std::fabs(c));
            fine += refined->error <= 0x1p-85 * size ? 1 : 0;
        }
    }
    EXPECT_GT(found, rounds);
    EXPECT_GT(fine, found / 2);
}

}  // namespace
}  // namespace refined_point_test
