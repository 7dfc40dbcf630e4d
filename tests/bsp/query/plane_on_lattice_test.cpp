// SPDX-License-Identifier: Apache-2.0
//
// Planes given by doubles, on lattices of several units: on which side lattice points are is
// compared with rationals.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/predicates.h>

#include "support/lattice_arithmetic.h"
#include "support/query_oracle.h"

namespace {

using brute::Rational;
using trisect::Lattice;
using trisect::Plane;
using trisect::plane_on_lattice;

int sign_by_rationals(const std::array<double, 4>& plane, Lattice lattice,
                      const trisect::LatticePoint& p) {
    const auto n = brute::point({plane[0], plane[1], plane[2]});
    const Rational d = brute::point({plane[3], 0, 0})[0];
    const Rational unit = brute::point({std::ldexp(1.0, lattice.exponent), 0, 0})[0];
    Rational sum = d;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        sum += n[k] * unit * brute::point({p[i].to_double(), 0, 0})[0];
    }
    return sum > 0 ? 1 : (sum < 0 ? -1 : 0);
}

TEST(PlaneOnLattice, SidesOfLatticePointsAreThoseByRationals) {
    reference::Random random(4);
    int on = 0;
    for (int round = 0; round < 3000; ++round) {
        Lattice lattice;
        lattice.exponent = 8 * static_cast<int>(random.between(-3, 3));
        const bool small = round % 2 != 0;  // points on the plane occur
        std::array<double, 4> plane{};
        for (std::size_t i = 0; i < 4; ++i) {
            const double m = static_cast<double>(random.between(small ? -3 : -(1 << 30), 1 << 2));
            const int e = small ? 0 : static_cast<int>(random.between(-12, 12));
            plane[i] = std::ldexp(m, e + (i == 3 && small ? lattice.exponent : 0));
        }
        if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0) continue;
        const Plane p = plane_on_lattice(plane, lattice);
        for (int k = 0; k < 20; ++k) {
            const auto c = [&] { return random.between(-4, 4) * (small ? 1 : 1 << 20); };
            const trisect::LatticePoint q{c(), c(), c()};
            const int sign = trisect::sign_of(side_of(q, p));
            EXPECT_EQ(sign, sign_by_rationals(plane, lattice, q)) << round;
            on += sign == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(on, 500);
}

TEST(PlaneOnLattice, WhatIsNoPlaneOrTooLongIsRefused) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)plane_on_lattice({0, 0, 0, 1}, {}), trisect::UsageError);
    EXPECT_THROW((void)plane_on_lattice({1, infinite, 0, 1}, {}), trisect::UsageError);
    EXPECT_THROW((void)plane_on_lattice({1, 0, 0, std::nan("")}, {}), trisect::UsageError);
    EXPECT_THROW((void)plane_on_lattice({1, 0x1p-120, 0, 0}, {}), trisect::LimitError);
    EXPECT_THROW((void)plane_on_lattice({1, 0, 0, 0x1p200}, {}), trisect::LimitError);
    EXPECT_NO_THROW((void)plane_on_lattice({1, 0x1p-100, 0, 0}, {}));
    EXPECT_NO_THROW((void)plane_on_lattice({1, 0, 0, 0x1p160}, {}));
}

TEST(BrepIndexOfABox, LatticePointsAndNamesOfLocations) {
    const trisect::BrepIndex index(
        trisect::Solid::from_mesh(trisect::make_box({0, 0, 0}, {2, 2, 2})));
    const std::int64_t unit = std::llround(std::ldexp(1.0, -index.solid().lattice().exponent));
    const auto name = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        return std::string(
            to_string(index.locate(trisect::LatticePoint{x * unit, y * unit, z * unit}).location));
    };
    EXPECT_EQ(name(1, 1, 1), "inside");
    EXPECT_EQ(name(3, 1, 1), "outside");
    EXPECT_EQ(name(2, 1, 1), "face");
    EXPECT_EQ(name(2, 2, 1), "edge");
    EXPECT_EQ(name(2, 0, 2), "vertex");
    const auto hit = index.first_facet(trisect::Ray{{-1, 0.5, 1}, {0.5, 0, 0}});
    ASSERT_TRUE(hit.has_value());
    EXPECT_LE(hit->lo, 2.0);
    EXPECT_GE(hit->hi, 2.0);
    EXPECT_FALSE(index.first_facet(trisect::Ray{{-1, 0.5, 1}, {-1, 0, 0}}).has_value());
}

}  // namespace
