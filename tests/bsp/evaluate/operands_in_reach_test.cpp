// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/operands_in_reach.h>

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/evaluate/formula_operands.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {
namespace {

Solid box_at(const Point3d& at, double size = 1, int exponent = -4) {
    SolidOptions options;
    options.import.lattice = Lattice{exponent};
    return Solid::from_mesh(
        make_box({at[0], at[1], at[2]}, {at[0] + size, at[1] + size, at[2] + size}), options);
}

Translation translated(const Expression& e) {
    return with_named_slots(translate_without_constants(e));
}

int left_of(const Expression& e) {
    const Translation t = with_operands_in_reach(translated(e));
    return t.formula->kind == Residual::Kind::Constant ? 0 : static_cast<int>(t.slots.size());
}

class OperandsInReachOfBoxes : public ::testing::Test {
protected:
    Expression part_ = box_at({0, 0, 0}, 2);
    Expression tool_ = box_at({1, 1, 1});
    Expression beside_ = box_at({5, 0, 0}, 1, -7);
    Expression far_ = box_at({-9, 20, 3});
};

TEST_F(OperandsInReachOfBoxes, ToolsBesideAPart) {
    EXPECT_EQ(left_of(part_ - tool_ - beside_ - far_), 2);
    EXPECT_EQ(left_of(part_ - (tool_ | beside_ | far_)), 2);
    EXPECT_EQ(left_of(part_ - beside_ - far_), 1);
    EXPECT_EQ(left_of(~(part_ - (tool_ | beside_))), 2);
    EXPECT_EQ(left_of(~part_ | tool_ | beside_), 2);
}

TEST_F(OperandsInReachOfBoxes, NothingInCommon) {
    EXPECT_EQ(left_of(part_ & beside_ & far_), 0);
    EXPECT_EQ(left_of(~(part_ & beside_ & tool_)), 0);
    EXPECT_TRUE(evaluate(part_ & beside_ & far_).is_empty());
    EXPECT_TRUE(evaluate(~(part_ & beside_ & far_)).is_whole_space());
}

TEST_F(OperandsInReachOfBoxes, TermsOfTerms) {
    EXPECT_EQ(left_of((part_ & beside_) | (part_ & tool_) | far_), 3);
    EXPECT_EQ(left_of((part_ - beside_) ^ (tool_ & far_) ^ far_), 2);
    EXPECT_EQ(left_of((part_ | beside_) - tool_), 3);
    // What is named twice stays where it is in reach once.
    EXPECT_EQ(left_of((part_ - beside_) | (beside_ - tool_)), 2);
}

TEST_F(OperandsInReachOfBoxes, AllStayInUnions) {
    EXPECT_EQ(left_of(part_ | beside_ | far_), 3);
    EXPECT_EQ(left_of(part_ ^ beside_ ^ far_), 3);
    EXPECT_EQ(left_of(part_ - beside_), 2);  // of two each rule finds out by itself
}

// Boxes that end where others begin are not beside each other.
TEST_F(OperandsInReachOfBoxes, ThoseThatTouchStay) {
    const Expression touching = box_at({2, 0, 0});
    EXPECT_EQ(left_of(part_ - tool_ - touching), 3);
}

Expression random_formula(std::mt19937_64& random, const std::vector<Solid>& solids, int depth) {
    if (depth == 0) return solids[random() % solids.size()];
    Expression out = random_formula(random, solids, depth - 1);
    for (std::uint64_t n = 1 + random() % 2; n > 0; --n) {
        Expression term = random_formula(random, solids, depth - 1);
        switch (random() % 4) {
            case 0:
                out = out | term;
                break;
            case 1:
                out = out & term;
                break;
            case 2:
                out = out - term;
                break;
            default:
                out = ~(out - term);
                break;
        }
    }
    return out;
}

TEST(OperandsInReach, TheSameSetsAsWithAllOperands) {
    std::mt19937_64 random(30301);
    int less = 0;
    for (int run = 0; run < 300; ++run) {
        std::vector<Solid> solids;
        for (int i = 0; i < 6; ++i)
            solids.push_back(box_at(
                {0.75 * static_cast<double>(random() % 8), 0.75 * static_cast<double>(random() % 4),
                 0.75 * static_cast<double>(random() % 2)},
                1 + static_cast<double>(random() % 2), -4 - run % 3));
        const Translation all = translated(random_formula(random, solids, 2));
        const Translation some = with_operands_in_reach(all);
        if (some.formula == all.formula) continue;
        ++less;
        const Solid expected = evaluate_translation(all, {}, nullptr);
        const Solid result = evaluate_translation(some, {}, nullptr);
        EXPECT_TRUE(evaluate(Expression(result) ^ expected).is_empty()) << run;
    }
    EXPECT_GT(less, 50);
}

}  // namespace
}  // namespace trisect::detail
