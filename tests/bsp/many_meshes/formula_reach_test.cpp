// SPDX-License-Identifier: Apache-2.0
//
// Boxes around the boundaries of formulas (formula_reach.h).

#include <trisect/bsp/many_meshes/formula_reach.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::Solid;
using trisect::detail::Box;
using trisect::detail::reach_of;
using trisect::detail::Residual;
using Kind = Residual::Kind;

Solid cube(double x) {
    trisect::SolidOptions options;
    options.import.lattice = trisect::Lattice{0};
    return Solid::from_mesh(trisect::make_box({x, 0, 0}, {x + 4, 4, 4}), options);
}

class FormulaReach : public testing::Test {
protected:
    FormulaReach() {
        // The third one is apart from the first one; the last one is all but a cube.
        for (const Solid& s : {cube(0), cube(2), cube(5), evaluate(~cube(1))})
            solids_.push_back(trisect::detail::state_of(s));
    }
    static Residual::Ref slot(int i) { return Residual::of_slot(i); }
    static Residual::Ref all(Kind kind, std::vector<Residual::Ref> terms) {
        return Residual::of_distinct(kind, std::move(terms));
    }
    // The lowest and the highest place along x.
    [[nodiscard]] std::optional<std::array<double, 2>> along_x(const Residual::Ref& f) const {
        const std::optional<Box> box = reach_of(*f, solids_);
        if (!box || box->is_empty()) return std::nullopt;
        return std::array{static_cast<double>(box->lo[0]), static_cast<double>(box->hi[0])};
    }
    trisect::detail::SolidStates solids_;
};

TEST_F(FormulaReach, OfOperations) {
    using Ends = std::array<double, 2>;
    EXPECT_EQ(along_x(slot(1)), (Ends{2, 6}));
    EXPECT_EQ(along_x(all(Kind::And, {slot(0), slot(1)})), (Ends{2, 4}));
    EXPECT_EQ(along_x(all(Kind::Or, {slot(0), slot(2)})), (Ends{0, 9}));
    EXPECT_EQ(along_x(all(Kind::And, {slot(0), Residual::negation(slot(1))})), (Ends{0, 4}));
    EXPECT_EQ(along_x(all(Kind::Xor, {slot(0), slot(1)})), (Ends{0, 6}));
    // Complements have the reach of what they are the complement of.
    EXPECT_EQ(along_x(Residual::negation(all(Kind::Or, {slot(0), slot(1)}))), (Ends{0, 6}));
    EXPECT_EQ(along_x(slot(3)), (Ends{1, 5}));
    EXPECT_EQ(along_x(all(Kind::Or, {slot(3), slot(0)})), (Ends{1, 5}));
    // Nothing is left of what is apart.
    const auto nothing = reach_of(*all(Kind::And, {slot(0), slot(2)}), solids_);
    ASSERT_TRUE(nothing.has_value());
    EXPECT_TRUE(nothing->is_empty());
}

}  // namespace
