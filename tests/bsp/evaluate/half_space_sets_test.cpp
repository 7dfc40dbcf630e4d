// SPDX-License-Identifier: Apache-2.0
//
// Formulas of half-spaces: alone, with meshes, in one evaluation and step by step.

#include <trisect/bsp/solid.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::evaluate;
using trisect::exact_volume;
using trisect::ExactRational;
using trisect::Expression;
using trisect::Solid;

Solid box(trisect::Point3d lo, trisect::Point3d hi) {
    return Solid::from_mesh(trisect::make_box(lo, hi));
}
Solid cube(double half) { return box({-half, -half, -half}, {half, half, half}); }
Solid below(double a, double b, double c, double d) { return Solid::half_space({a, b, c, d}); }
std::string volume_text(const Expression& e) { return exact_volume(evaluate(e)).to_string(); }

/// lo <= x <= hi, by six half-spaces.
Solid bounded_by_planes(trisect::Point3d lo, trisect::Point3d hi) {
    std::vector<Solid> sides;
    for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 4> plane{};
        plane[k] = 1;
        plane[3] = -hi[k];
        sides.push_back(Solid::half_space(plane));
        plane[k] = -1;
        plane[3] = lo[k];
        sides.push_back(Solid::half_space(plane));
    }
    return evaluate(Expression::all_of(sides));
}

// A plane in a cell went beyond the others along its dominant axis, where it was not cut.
TEST(HalfSpaceSets, SlantedPlanesInOneFormula) {
    const Solid b = cube(8);
    EXPECT_EQ(volume_text(b & below(0, 1, -1, 0) & below(1, 0, -1, 1)), "2475/2");
    EXPECT_EQ(volume_text(below(1, 1, 1, -1) & below(-1, 0, 0, 0) & below(0, -1, 0, 0) &
                          below(0, 0, -1, 0)),
              "1/6");
}

// The reference point lay beyond the limit of space, at which fragments of the wedge end.
TEST(HalfSpaceSets, WedgeThroughTheCornerOfSpace) {
    const Solid wedge = evaluate(below(1, -2, 1, 0) & below(0, 3, 3, 0));
    EXPECT_EQ(volume_text(cube(64) & wedge), "3670016/9");
}

TEST(HalfSpaceSets, OneFormulaIsItsSteps) {
    std::mt19937 random(20261123);
    const auto digit = [&](int n) { return static_cast<double>(random() % (2 * n + 1)) - n; };
    std::size_t with_volume = 0;
    for (int round = 0; round < 300; ++round) {
        const Solid b = cube(round % 2 == 0 ? 8 : 7.3);
        Expression formula = b;
        Solid steps = b;
        Expression alone = below(1, 0, 0, -8);
        for (std::size_t n = 0; n < 2 + static_cast<std::size_t>(round % 3); ++n) {
            std::array<double, 4> plane{digit(2), digit(2), digit(2), digit(6)};
            if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0) plane[2] = 1;
            const Solid h = Solid::half_space(plane);
            const bool minus = random() % 2 == 0;
            formula = minus ? formula - h : formula & h;
            alone = minus ? alone - h : alone & h;
            steps = minus ? evaluate(steps - h) : evaluate(steps & h);
        }
        const ExactRational expected = exact_volume(steps);
        EXPECT_EQ(exact_volume(evaluate(formula)), expected) << round;
        // The planes first, as a set that is kept.
        EXPECT_EQ(exact_volume(evaluate(b & evaluate(alone))), expected) << round;
        with_volume += expected.sign() > 0 ? 1U : 0U;
    }
    EXPECT_GT(with_volume, 100U);
}

// A kept set that is unbounded moves to the finer lattice of what it meets.
TEST(HalfSpaceSets, KeptOnesMeetFinerSolids) {
    const Solid wedge = evaluate(below(1, 0, 0, 0) & below(0, 1, 0, 0));
    const Solid fine = cube(0.1);
    EXPECT_EQ(exact_volume(evaluate(wedge & fine)) * ExactRational(4), exact_volume(fine));
    EXPECT_EQ(exact_volume(evaluate(fine - wedge)) * ExactRational(4),
              exact_volume(fine) * ExactRational(3));
    const Solid other = evaluate(below(2, 0, 0, 1) & below(0, 0, 1, -1));
    const Solid both = evaluate(wedge & other);
    EXPECT_EQ(volume_text(cube(2) & both), "9");
    EXPECT_EQ(exact_volume(evaluate(cube(std::ldexp(1.0, -40)) & wedge)) * ExactRational(4),
              exact_volume(cube(std::ldexp(1.0, -40))));
}

// The unit of the finest one left no room for the others, and nothing was left.
TEST(HalfSpaceSets, LargeAndFineOnesTogether) {
    for (const double at : {6e8, 1e9, 1e10, 1e15})
        EXPECT_EQ(exact_volume(bounded_by_planes({at, 0, 0}, {at + 1, 1, 1})), ExactRational(1))
            << at;
    EXPECT_EQ(trisect::volume(bounded_by_planes({1000, 0, 0}, {1001, 1e-6, 1})), 1e-6);
    EXPECT_EQ(trisect::volume(bounded_by_planes({0, 0, 0}, {1e10, 1e10, 1e10})), 1e30);
}

TEST(HalfSpaceSets, ComplementStaysOneWhereItIsRounded) {
    const auto turn = trisect::AffineMap::rotation({1, 2, 3}, 33);
    const Solid rest = trisect::transformed(evaluate(~cube(0.5)), turn);
    const double volume = trisect::volume(evaluate(cube(16384) & rest));
    EXPECT_NEAR(volume, std::ldexp(1.0, 45) - 1, 0.01);
}

TEST(HalfSpaceSets, UnboundedOnesHaveNoMeasures) {
    const Solid outside = evaluate(~bounded_by_planes({-1, -1, -1}, {1, 1, 1}));
    EXPECT_THROW((void)trisect::bounds(outside), trisect::UnsupportedError);
    EXPECT_THROW((void)trisect::centroid(outside), trisect::UnsupportedError);
    EXPECT_THROW((void)trisect::volume(outside), trisect::UnsupportedError);
    const Solid h = below(1, 0, 0, 0);
    EXPECT_THROW((void)trisect::volume(evaluate(h | ~h)), trisect::UnsupportedError);
    const auto by = trisect::AffineMap::translation({1.1, 0, 0});
    EXPECT_EQ(volume_text(cube(2) & trisect::transformed(below(1, 0, 0, -1), by)),
              exact_volume(evaluate(cube(2) & below(1, 0, 0, -2))).to_string());
}

// Nothing and everything are the same on every lattice.
TEST(HalfSpaceSets, ConstantResultsHaveNoLattice) {
    const Solid a = cube(1);
    const Solid nothing = evaluate(a - a);
    const auto turn = trisect::AffineMap::rotation({1, 2, 3}, 30);
    EXPECT_TRUE(trisect::transformed(nothing, turn).is_empty());
    EXPECT_TRUE(trisect::transformed(evaluate(a | ~a), turn).is_whole_space());
    const double tiny = std::ldexp(1.0, -60);
    EXPECT_EQ(exact_volume(evaluate(cube(tiny) | nothing)), exact_volume(cube(tiny)));
}

}  // namespace
