// SPDX-License-Identifier: Apache-2.0
//
// Solids inside solids, cavities inside cavities, and the two sets without boundary.

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <trisect/brep/measure.h>

#include "figures.h"

namespace nesting_test {
namespace {

using degeneracy::cube;
using degeneracy::Figures;
using degeneracy::figures;
using reference::Operand;
using trisect::evaluate;
using trisect::Expression;
using trisect::Solid;

Solid solid(const Operand& o) { return engines::solid(o); }

Figures of(const Expression& e) { return figures(evaluate(e).to_brep()); }

// Shells that bound material, then those that bound cavities.
std::array<std::size_t, 2> shell_signs(const trisect::Brep& brep) {
    std::array<std::size_t, 2> n{};
    for (const trisect::ShellId s : brep.shells())
        ++n[trisect::sign_of_volume(brep, s) > 0 ? 0 : 1];
    return n;
}

const Figures cube4{8, 12, 6, 6, 1, "64", 96};
const Figures two_shells{16, 24, 12, 12, 2, "56", 120};
const Figures four_shells{32, 48, 24, 24, 4, "640", 600 + 384 + 216 + 96};

TEST(Nesting, CavityOfACube) {
    const trisect::Brep brep = evaluate(solid(cube(0, 4)) - solid(cube(1, 3))).to_brep();
    EXPECT_EQ(figures(brep), two_shells);
    EXPECT_EQ(shell_signs(brep), (std::array<std::size_t, 2>{1, 1}));
}

TEST(Nesting, CavityFilledAgainVanishes) {
    const Solid hollow = evaluate(solid(cube(0, 4)) - solid(cube(1, 3)));
    EXPECT_EQ(of(hollow | solid(cube(1, 3))), cube4);
    EXPECT_EQ(of(hollow ^ solid(cube(1, 3))), cube4);
    EXPECT_TRUE(evaluate(hollow & solid(cube(1, 3))).is_empty());
}

TEST(Nesting, CavityFilledInPart) {
    const Solid hollow = evaluate(solid(cube(0, 4)) - solid(cube(1, 3)));
    // One half of the cavity, flush with five of its faces.
    EXPECT_EQ(of(hollow | solid(reference::box({1, 1, 1}, {2, 3, 3}))),
              (Figures{16, 24, 12, 12, 2, "60", 96 + 16}));
    // A body that floats in the cavity.
    const Solid wide = evaluate(solid(cube(0, 10)) - solid(cube(1, 9)));
    EXPECT_EQ(of(wide | solid(cube(4, 6))), (Figures{24, 36, 18, 18, 3, "496", 600 + 384 + 24}));
}

TEST(Nesting, CavityInABodyInACavity) {
    const Expression e =
        solid(cube(0, 10)) - (solid(cube(1, 9)) - (solid(cube(2, 8)) - solid(cube(3, 7))));
    const trisect::Brep brep = evaluate(e).to_brep();
    EXPECT_EQ(figures(brep), four_shells);
    EXPECT_EQ(shell_signs(brep), (std::array<std::size_t, 2>{2, 2}));
}

TEST(Nesting, FourShellsInOneMesh) {
    Operand mesh = reference::concatenated(cube(0, 10), reference::reversed(cube(1, 9)));
    mesh = reference::concatenated(mesh, cube(2, 8));
    mesh = reference::concatenated(mesh, reference::reversed(cube(3, 7)));
    for (const auto embedding : {trisect::Embedding::Assume, trisect::Embedding::Resolve}) {
        const Solid s = engines::solid(mesh, embedding);
        EXPECT_EQ(figures(s.to_brep()), four_shells);
        EXPECT_EQ(of(s), four_shells);
        // What is cut out of all shells at once: a bar from outside to the innermost cavity.
        const Solid bar = solid(reference::box({-1, 4, 4}, {5, 6, 6}));
        EXPECT_EQ(trisect::exact_volume(evaluate(s - bar).to_brep()).to_string(), "632");
        EXPECT_EQ(trisect::exact_volume(evaluate(s & bar).to_brep()).to_string(), "8");
    }
}

TEST(Nesting, EqualOperandsInAnyNumber) {
    const Operand c = cube(0, 4);
    std::vector<Expression> same;
    for (int i = 0; i < 12; ++i) same.emplace_back(solid(c));
    EXPECT_EQ(of(Expression::any_of(same)), cube4);
    EXPECT_EQ(of(Expression::all_of(same)), cube4);
    EXPECT_TRUE(evaluate(same[0] - same[1]).is_empty());
    EXPECT_TRUE(evaluate((same[0] ^ same[1]) ^ (same[2] ^ same[3])).is_empty());
    EXPECT_EQ(of((same[0] ^ same[1]) ^ same[2]), cube4);
}

TEST(Nesting, EmptySetAndWholeSpaceAsOperands) {
    const Solid c = solid(cube(0, 4));
    const Solid none;
    const Solid all = Solid::whole_space();
    EXPECT_EQ(of(c | none), cube4);
    EXPECT_EQ(of(none | c), cube4);
    EXPECT_EQ(of(c ^ none), cube4);
    EXPECT_EQ(of(c - none), cube4);
    EXPECT_EQ(of(c & all), cube4);
    EXPECT_TRUE(evaluate(c & none).is_empty());
    EXPECT_TRUE(evaluate(none - c).is_empty());
    EXPECT_TRUE(evaluate(c - all).is_empty());
    EXPECT_TRUE(evaluate(c | all).is_whole_space());
    EXPECT_TRUE(evaluate(none | none).is_empty());
    EXPECT_TRUE(evaluate(none ^ all).is_whole_space());
    EXPECT_EQ(of(all - c), (Figures{8, 12, 6, 6, 1, "-64", 96}));
    EXPECT_EQ(of(all - (all - c)), cube4);
}

}  // namespace
}  // namespace nesting_test
