// SPDX-License-Identifier: Apache-2.0
//
// Measures of the same doubles on coarser lattices, where coordinates have bits behind the point.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/winding_number.h>

#include "support/fractions.h"

namespace {

using trisect::LatticeMesh;
using trisect::test::with_fractions;

constexpr std::array<int, 4> shifts{8, 24, 56, 72};

// Corners of a sphere, moved by up to 2^bits units: nothing is flat.
LatticeMesh uneven_sphere(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    LatticeMesh mesh = trisect::import_mesh(trisect::make_icosphere(1 << 10, 2)).mesh;
    for (trisect::LatticePoint& p : mesh.points)
        for (trisect::Coordinate* const c : {&p.x, &p.y, &p.z})
            *c = c->to_integer() + static_cast<std::int64_t>(random() % 37) - 18;
    return mesh;
}

TEST(Fractions, KeepVolumesAreasAndCentroids) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const LatticeMesh mesh = uneven_sphere(seed);
        const auto volume = exact_volume(mesh);
        EXPECT_GT(volume.sign(), 0);
        for (const int bits : shifts) {
            const LatticeMesh same = with_fractions(mesh, bits);
            EXPECT_FALSE(std::ranges::all_of(same.points, &trisect::LatticePoint::is_whole));
            EXPECT_EQ(exact_volume(same), volume) << bits;
            EXPECT_EQ(trisect::volume(same), trisect::volume(mesh)) << bits;
            EXPECT_EQ(exact_centroid(same), exact_centroid(mesh)) << bits;
            EXPECT_EQ(area(same).value, area(mesh).value) << bits;
        }
    }
}

// The integers around far points are beyond all coordinates.
TEST(Fractions, FarPointsAreOutside) {
    const LatticeMesh mesh = uneven_sphere(9);
    for (const double far : {1e10, 0x1p53, 1e30, 1e300})
        for (const double sign : {1.0, -1.0})
            for (std::size_t axis = 0; axis < 3; ++axis) {
                trisect::ExactPoint p;
                p[axis] = trisect::ExactRational::from_double(sign * far);
                EXPECT_EQ(winding_number(mesh, p), 0);
                EXPECT_EQ(winding_number(with_fractions(mesh, 24), p), 0);
            }
}

TEST(Fractions, KeepWindingNumbers) {
    std::mt19937_64 random(5);
    const LatticeMesh mesh = uneven_sphere(9);
    int inside = 0;
    for (int round = 0; round < 60; ++round) {
        trisect::ExactPoint p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = trisect::ExactRational(static_cast<std::int64_t>(random() % 2800) - 1400);
        if (round % 4 == 0) {  // a corner: on the surface
            const auto& c = mesh.points[random() % mesh.points.size()];
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = trisect::ExactRational::from_double(c.doubles()[k])
                           .scaled(mesh.lattice.exponent);
        }
        const auto expected = winding_number(mesh, p);
        inside += expected.value_or(0);
        for (const int bits : shifts)
            EXPECT_EQ(winding_number(with_fractions(mesh, bits), p), expected) << bits;
    }
    EXPECT_GT(inside, 5);
}

}  // namespace
