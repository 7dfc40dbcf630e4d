// SPDX-License-Identifier: Apache-2.0
//
// A wall less 64 openings, as tables of other kernels' exactness have it: inside, flush with both
// ends, and turned. Volumes are compared as fractions, so nothing is near.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>

namespace wall_openings_test {
namespace {

using trisect::evaluate;
using trisect::exact_volume;
using trisect::ExactRational;
using trisect::Expression;
using trisect::Solid;

constexpr int openings = 64;

// By its middle and its sizes, in doubles; turned about its own middle.
Solid box(double x, double y, double z, double dx, double dy, double dz, double degrees = 0) {
    const auto at_origin = trisect::make_box({-dx / 2, -dy / 2, -dz / 2}, {dx / 2, dy / 2, dz / 2});
    const auto turned =
        trisect::transformed(at_origin, trisect::AffineMap::rotation({0, 0, 1}, degrees));
    return Solid::from_mesh(
        trisect::transformed(turned, trisect::AffineMap::translation({x, y, z})));
}

Solid wall(double thickness) {
    return box((openings + 1) / 2.0, thickness / 2, 1.5, openings + 1, thickness, 3);
}

std::vector<Solid> row(double thickness, double z, double height, double degrees) {
    std::vector<Solid> row;
    for (int i = 0; i < openings; ++i)
        row.push_back(box(0.75 + i, thickness / 2, z, 0.5, 1, height, degrees));
    return row;
}

// Openings lie apart, so what they take away is the sum of their parts in the wall.
void expect_exact(const Solid& wall, const std::vector<Solid>& row, std::size_t parts) {
    const Solid left = evaluate(wall - Expression::any_of(row));
    ExactRational taken;
    for (const Solid& opening : row) taken = taken + exact_volume(evaluate(wall & opening));
    EXPECT_EQ(exact_volume(left) + taken, exact_volume(wall));
    EXPECT_EQ(left.to_brep().counts().shells, parts);
    // One after the other leaves the same.
    Solid one_by_one = wall;
    for (const Solid& opening : row) one_by_one = evaluate(one_by_one - opening);
    EXPECT_TRUE(evaluate(left ^ one_by_one).is_empty());
}

TEST(WallOpenings, HaveTheVolumeOfTheirDoubles) {
    for (const double thickness : {0.2, 0.3}) {
        SCOPED_TRACE(thickness);
        expect_exact(wall(thickness), row(thickness, 1, 1, 0), 1);
        expect_exact(wall(thickness), row(thickness, 1.5, 3, 0), openings + 1);
        expect_exact(wall(thickness), row(thickness, 1, 1, 30), 1);
    }
}

// A slab, a box turned by 30 degrees across one of its faces, and one by 45 across both.
TEST(WallOpenings, KeepTheLawsOfSets) {
    const Solid a = box(0, 0, 1.5, 4, 0.4, 3);
    const Solid b = box(1, 0.1, 1.5, 1.2, 1, 1.4, 30);
    const Solid c = box(1.4, 0.15, 1.8, 1.4, 0.9, 1.2, 45);
    const auto volume = [](const Expression& e) { return exact_volume(evaluate(e)); };
    EXPECT_EQ(volume(a | b) + volume(a & b), volume(a) + volume(b));
    EXPECT_EQ(volume(a - b) + volume(a & b), volume(a));
    EXPECT_EQ(volume(a | b | c) + volume(a & b) + volume(b & c) + volume(a & c),
              volume(a) + volume(b) + volume(c) + volume(a & b & c));
    EXPECT_TRUE(evaluate((evaluate(evaluate(a - b) - c)) ^ (a - (b | c))).is_empty());
    EXPECT_TRUE(evaluate(evaluate(a & (b | c)) ^ ((a & b) | (a & c))).is_empty());
}

}  // namespace
}  // namespace wall_openings_test
