// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/boxes/crossing_place.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::detail::sides_crossing;
using Vector = std::array<double, 3>;

Vector random_vector(Random& random, int extent) {
    Vector v;
    for (double& x : v) x = static_cast<double>(random.between(-extent, extent));
    return v;
}

Vector along(const Vector& p, const Vector& u, double t) {
    return {p[0] + t * u[0], p[1] + t * u[1], p[2] + t * u[2]};
}

}  // namespace

// Whole numbers, so the common point is known exactly; moved corners must stay within the error.
TEST(SidesCrossing, ThePlaceIsWithinItsError) {
    Random random(20261129);
    int found = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vector place = random_vector(random, 1000);
        const Vector u = random_vector(random, 60);
        const Vector v = random_vector(random, 60);
        const auto part = [&] { return static_cast<double>(random.between(0, 9)); };
        Vector p = along(place, u, -part());
        Vector q = along(place, u, part() + 1);
        Vector r = along(place, v, -part());
        Vector s = along(place, v, part() + 1);
        const double error = i % 2 == 0 ? 0 : 0x1p-30;
        for (Vector* corner : {&p, &q, &r, &s})
            for (double& x : *corner) x += error * static_cast<double>(random.between(-1, 1));
        const auto crossing = sides_crossing(p, q, r, s, 4000, error);
        const Vector m{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
        const bool parallel = m[0] == 0 && m[1] == 0 && m[2] == 0;
        EXPECT_FALSE(parallel && crossing && error == 0);
        if (!crossing || parallel) continue;
        ++found;
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_LE(std::fabs(crossing->at[k] - place[k]), crossing->error);
    }
    EXPECT_GT(found, 15000);
}
