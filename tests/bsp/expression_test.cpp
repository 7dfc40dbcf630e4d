// SPDX-License-Identifier: Apache-2.0
//
// Formulas: what the operators mean, and that long ones cost neither stack nor quadratic time.

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>

#include <gtest/gtest.h>

#include <ctime>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/expression_node.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "support/solids.h"

namespace {

using solids::volume;
using trisect::detail::ExpressionNode;
using trisect::detail::root_of;
using trisect::detail::SplittingOffset;

using trisect::evaluate;
using trisect::Expression;
using trisect::Solid;

constexpr int chain_length = 100'000;
constexpr int evaluated_length = 50'000;

Solid box(const reference::LatticePoint& low, const reference::LatticePoint& high) {
    return engines::solid(reference::box(low, high));
}

class Operators : public ::testing::Test {
protected:
    const Solid a = box({0, 0, 0}, {2, 2, 2});
    const Solid b = box({1, 0, 0}, {4, 2, 2});
    const Solid c = box({0, 0, 1}, {4, 2, 2});
};

TEST_F(Operators, MeanWhatTheyMeanForSets) {
    EXPECT_EQ(volume(a), "8");
    EXPECT_EQ(volume(a | b), "16");
    EXPECT_EQ(volume(a & b), "4");
    EXPECT_EQ(volume(a - b), "4");
    EXPECT_EQ(volume(b - a), "8");
    EXPECT_EQ(volume(a ^ b), "12");
    EXPECT_EQ(volume(~~a), "8");
    EXPECT_EQ(volume(~(~a | ~b)), "4");
}

TEST_F(Operators, ComplementOfABoundedSetIsMinusItsVolumeAndNotEmpty) {
    const Solid outside = evaluate(~a);
    EXPECT_FALSE(outside.is_empty());
    EXPECT_FALSE(outside.is_whole_space());
    EXPECT_EQ(trisect::exact_volume(outside.to_brep()).to_string(), "-8");
    EXPECT_TRUE(evaluate(outside & a).is_empty());
    EXPECT_TRUE(evaluate(outside | a).is_whole_space());
}

TEST_F(Operators, KindsAndChildrenAreAsWritten) {
    const Expression e = a | b;
    EXPECT_EQ(root_of(e)->kind, ExpressionNode::Kind::Or);
    ASSERT_EQ(root_of(e)->children.size(), 2U);
    EXPECT_EQ(root_of(e)->children[1]->kind, ExpressionNode::Kind::Leaf);
    EXPECT_EQ(trisect::detail::state_of(root_of(e)->children[1]->solid),
              trisect::detail::state_of(b));
    EXPECT_EQ(root_of(~e)->children[0], root_of(e));
    const Expression copy = e;
    EXPECT_EQ(root_of(copy), root_of(e));
}

TEST_F(Operators, ManyTermsInOneNode) {
    const std::vector<Expression> terms{a, b, c};
    EXPECT_EQ(volume(Expression::any_of(terms)), "16");
    EXPECT_EQ(volume(Expression::all_of(terms)), "2");
    const std::vector<Expression> one{a};
    EXPECT_EQ(volume(Expression::any_of(one)), "8");
    EXPECT_EQ(volume(Expression::all_of(one)), "8");
}

TEST_F(Operators, MovedFromIsTheFormulaOfTheEmptySet) {
    static_assert(std::is_nothrow_move_constructible_v<Expression>);
    Expression e = a | b;
    const Expression taken = std::move(e);
    ASSERT_NE(root_of(e), nullptr);  // NOLINT(bugprone-use-after-move): that is the test
    EXPECT_TRUE(evaluate(e).is_empty());
    EXPECT_EQ(volume(taken - e), volume(taken));
    EXPECT_EQ(volume(taken & ~e), volume(taken));
}

TEST_F(Operators, WallsThatMayMeetCornersAreRefused) {
    for (const std::uint32_t offset : {0U, 2U, 3U, 63U, 82U, 192U, 193U})
        EXPECT_THROW(const SplittingOffset refused(offset), trisect::UsageError) << offset;
    for (const std::uint32_t offset : {1U, 5U, 83U, 191U}) {
        const SplittingOffset taken(offset);
        EXPECT_FALSE(evaluate(a | b).is_empty()) << SplittingOffset::of_thread();
    }
}

TEST_F(Operators, NoTermsAreTheNeutralElement) {
    EXPECT_TRUE(evaluate(Expression::any_of({})).is_empty());
    EXPECT_TRUE(evaluate(Expression::all_of({})).is_whole_space());
}

TEST_F(Operators, OneSolidInManyPlacesIsOneOperand) {
    EXPECT_TRUE(evaluate(a ^ a).is_empty());
    EXPECT_TRUE(evaluate(a - a).is_empty());
    EXPECT_TRUE(evaluate(a | ~a).is_whole_space());
}

// ---------------------------------------------------------------------------------------------

class LongChains : public Operators {
protected:
    // A hundred different solids, used over and over.
    std::vector<Solid> pool() const {
        std::vector<Solid> out;
        for (std::int64_t i = 0; i < 100; ++i) out.push_back(box({4 * i, 0, 0}, {4 * i + 2, 2, 2}));
        return out;
    }
    // Nothing is asserted about time, but quadratic passes would take minutes here.
    void TearDown() override {
        const auto spent = static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
        RecordProperty("milliseconds", static_cast<int>(1000 * spent));
    }

private:
    std::clock_t start_ = std::clock();
};

TEST_F(LongChains, AreBuiltCopiedAndDestroyed) {
    Expression e = a;
    std::vector<Expression> kept;
    for (int i = 0; i < chain_length; ++i) {
        e = i % 3 == 0 ? e - b : (i % 3 == 1 ? e | c : b ^ e);
        if (i % 1000 == 0) kept.push_back(e);
    }
    EXPECT_NE(root_of(e), nullptr);
    // Destroyed from the middle outwards: each piece frees what only it holds.
    while (!kept.empty()) kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(kept.size() / 2));
}

TEST_F(LongChains, SharedSubformulasAreDestroyedOnce) {
    Expression e = a;
    for (int i = 0; i < 200; ++i) e = e | e;  // 2^200 leaves when written out
    EXPECT_EQ(root_of(e)->children[0], root_of(e)->children[1]);
}

TEST_F(LongChains, ManyTermsAtOnce) {
    const std::vector<Solid> solids = pool();
    std::vector<Expression> terms;
    for (int i = 0; i < chain_length; ++i)
        terms.emplace_back(solids[static_cast<std::size_t>(i) % solids.size()]);
    EXPECT_EQ(volume(Expression::any_of(terms)), "800");
}

TEST_F(LongChains, LeftDeepUnion) {
    const std::vector<Solid> solids = pool();
    Expression e = solids[0];
    for (int i = 1; i < evaluated_length; ++i)
        e = e | solids[static_cast<std::size_t>(i) % solids.size()];
    EXPECT_EQ(volume(e), "800");
}

TEST_F(LongChains, LeftDeepDifference) {
    const std::vector<Solid> solids = pool();
    Expression e = box({0, 0, 0}, {400, 2, 2});
    for (int i = 0; i < evaluated_length; ++i)
        e = e - solids[static_cast<std::size_t>(i) % solids.size()];
    EXPECT_EQ(volume(e), "800");
}

// a - (b - (a - ...)): no two operators of one kind follow each other, and the formula nests deep.
Expression right_deep(const Solid& a, const Solid& b, int length) {
    Expression e = a;
    for (int i = 0; i < length; ++i) e = (i % 2 == 0 ? b : a) - e;
    return e;
}

TEST_F(LongChains, RightDeepDifference) {
    // After an even number of steps the value is a - (b - a) = a.
    EXPECT_EQ(volume(right_deep(a, b, 1000)), "8");
    EXPECT_EQ(volume(right_deep(a, b, 1001)), "8");  // b - a
}

TEST_F(LongChains, AlternatingUnionAndDifference) {
    Expression e = a;
    for (int i = 0; i < 1000; ++i) e = i % 2 == 0 ? e - b : e | c;
    // The last step is the union with c: (... - b) | c = (a - b) | c.
    EXPECT_EQ(volume(e), "10");
}

TEST_F(LongChains, DeeperAlternationIsAStatedLimit) {
    EXPECT_THROW((void)evaluate(right_deep(a, b, chain_length)), trisect::LimitError);
}

TEST_F(LongChains, ManyDifferentSolids) {
    std::vector<Expression> terms;
    for (std::int64_t i = 0; i < 3000; ++i)
        terms.emplace_back(box({2 * i, 0, 0}, {2 * i + 1, 1, 1}));
    EXPECT_EQ(volume(Expression::any_of(terms)), "3000");
}

// Every level names the one below twice, under different operations.
TEST_F(Operators, SharedSubformulasAreTranslatedOnce) {
    Expression e = a;
    for (int i = 0; i < 60; ++i) {
        const Expression other = i % 2 == 0 ? b : c;
        e = (e - other) ^ (e | other);
    }
    // Whatever e is, (e - x) ^ (e | x) is x: the last level has the say.
    EXPECT_EQ(volume(e), volume(c));
    EXPECT_TRUE(evaluate(e ^ c).is_empty());
}

TEST_F(Operators, PrefixesThatAreKeptDoNotMakeAChainDeep) {
    std::vector<Expression> prefixes{a};
    for (int i = 0; i < chain_length; ++i) prefixes.push_back(prefixes.back() | (i % 2 ? b : c));
    EXPECT_EQ(volume(prefixes.back()), "16");
}

TEST(Formulas, UniteSolidsAsTheyAre) {
    const std::vector<Solid> solids{box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3})};
    EXPECT_EQ(volume(Expression::any_of(solids)), "15");
    EXPECT_EQ(volume(Expression::all_of(solids)), "1");
    EXPECT_EQ(volume(Expression::any_of({solids[0], solids[1] - solids[0]})), "15");
    // `Solid c = a - b;` names a deleted constructor whose comment has the cure.
    static_assert(!std::is_convertible_v<Expression, Solid>);
    static_assert(std::is_convertible_v<Solid, Expression>);
}

}  // namespace
