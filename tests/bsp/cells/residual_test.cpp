// SPDX-License-Identifier: Apache-2.0
//
// Residuals: simplification must never change the value, and must leave nothing behind that is
// already known.

#include <trisect/bsp/cells/residual.h>

#include <gtest/gtest.h>

#include <array>

#include "reference/random_solids.h"

namespace {

using trisect::detail::Residual;
using trisect::detail::simplified;
using trisect::detail::SlotValues;
using trisect::detail::value_of;
using Kind = Residual::Kind;
using Ref = Residual::Ref;

Ref slot(std::int32_t i) { return Residual::of_slot(i); }

Ref combined(Kind kind, std::initializer_list<Ref> terms) {
    return Residual::combination(kind, std::span<const Ref>(terms.begin(), terms.size()));
}

bool is_constant(const Ref& r, bool value) {
    return r->kind == Kind::Constant && r->value == value;
}

TEST(Residual, ConstantsDecideOrDisappear) {
    const Ref yes = Residual::constant(true);
    const Ref no = Residual::constant(false);
    EXPECT_TRUE(is_constant(combined(Kind::And, {slot(0), no}), false));
    EXPECT_TRUE(is_constant(combined(Kind::Or, {slot(0), yes}), true));
    EXPECT_EQ(combined(Kind::And, {slot(0), yes})->kind, Kind::Slot);
    EXPECT_EQ(combined(Kind::Or, {no, slot(0)})->kind, Kind::Slot);
    EXPECT_EQ(combined(Kind::Xor, {no, slot(0)})->kind, Kind::Slot);
    EXPECT_EQ(combined(Kind::Xor, {yes, slot(0)})->kind, Kind::Not);
    EXPECT_EQ(combined(Kind::Xor, {yes, slot(0), yes})->kind, Kind::Slot);
}

TEST(Residual, NoTermsAreTheNeutralElement) {
    EXPECT_TRUE(is_constant(combined(Kind::And, {}), true));
    EXPECT_TRUE(is_constant(combined(Kind::Or, {}), false));
    EXPECT_TRUE(is_constant(combined(Kind::Xor, {}), false));
}

TEST(Residual, DoubleNegationsCancel) {
    const Ref a = slot(0);
    EXPECT_EQ(Residual::negation(Residual::negation(a)), a);
    EXPECT_TRUE(is_constant(Residual::negation(Residual::constant(true)), false));
}

TEST(Residual, NestedOperatorsOfOneKindAreOne) {
    const Ref r = combined(Kind::Or, {combined(Kind::Or, {slot(0), slot(1)}), slot(2)});
    EXPECT_EQ(r->children.size(), 3U);
    const Ref s = combined(Kind::And, {combined(Kind::Or, {slot(0), slot(1)}), slot(2)});
    EXPECT_EQ(s->children.size(), 2U);
}

TEST(Residual, EqualTermsAreOneAndCancelInAnExclusiveOr) {
    const Ref a = slot(0);
    const Ref b = combined(Kind::And, {a, slot(1)});
    EXPECT_EQ(combined(Kind::Or, {a, b, a})->children.size(), 2U);
    EXPECT_EQ(combined(Kind::And, {a, a}), a);
    EXPECT_EQ(combined(Kind::Xor, {a, b, a}), b);
    EXPECT_TRUE(is_constant(combined(Kind::Xor, {a, b, a, b}), false));
}

// Every level names the one below twice: as a tree it would have 2^60 leaves.
TEST(Residual, SharedSubformulasAreLookedAtOnce) {
    Ref r = slot(0);
    for (int i = 0; i < 60; ++i) {
        const Ref low = combined(Kind::And, {r, slot(1 + i % 3)});
        const Ref high = combined(Kind::Or, {r, Residual::negation(slot(1 + (i + 1) % 3))});
        r = combined(Kind::Xor, {low, high});
    }
    for (int mask = 0; mask < 16; ++mask) {
        SlotValues values(4);
        for (std::size_t k = 0; k < 4; ++k) values[k] = static_cast<std::int8_t>(mask >> k & 1);
        bool expected = values[0] > 0;
        for (std::size_t i = 0; i < 60; ++i)
            expected =
                (expected && values[1 + i % 3] > 0) != (expected || values[1 + (i + 1) % 3] == 0);
        EXPECT_EQ(value_of(*r, values), expected) << mask;
        EXPECT_TRUE(is_constant(simplified(r, values), expected)) << mask;
        SlotValues partial = values;
        partial[2] = -1;
        EXPECT_EQ(value_of(*simplified(r, partial), values), expected) << mask;
    }
    std::array<int, 4> met{};
    for_each_slot(*r, [&](std::int32_t s) { met[static_cast<std::size_t>(s)] = 1; });
    EXPECT_EQ(met, (std::array<int, 4>{1, 1, 1, 1}));
}

TEST(Residual, NothingKnownMeansTheSameObject) {
    const Ref r = combined(Kind::Xor, {combined(Kind::And, {slot(0), slot(1)}), slot(2)});
    EXPECT_EQ(simplified(r, {-1, -1, -1}), r);
}

TEST(Residual, OneUnknownIsLeftBare) {
    const Ref r = combined(Kind::Or, {combined(Kind::And, {slot(0), slot(1)}), slot(2)});
    EXPECT_EQ(simplified(r, {1, -1, 0})->kind, Kind::Slot);
    EXPECT_TRUE(is_constant(simplified(r, {0, -1, 0}), false));
    EXPECT_TRUE(is_constant(simplified(r, {-1, -1, 1}), true));
}

Ref random_formula(reference::Random& random, int depth) {
    if (depth == 0 || random.chance(1, 6)) return slot(static_cast<std::int32_t>(random.below(5)));
    if (random.chance(1, 5)) return Residual::negation(random_formula(random, depth - 1));
    constexpr std::array kinds{Kind::And, Kind::Or, Kind::Xor};
    std::vector<Ref> terms;
    for (std::size_t i = random.below(3) + 1; i > 0; --i)
        terms.push_back(random_formula(random, depth - 1));
    return Residual::combination(kinds[random.below(3)], terms);
}

TEST(Residual, SimplifiedFormulasHaveTheSameValueAndNameNoKnownSlot) {
    reference::Random random(5);
    for (int round = 0; round < 3000; ++round) {
        const Ref formula = random_formula(random, 4);
        SlotValues full(5);
        SlotValues part(5);
        for (std::size_t i = 0; i < 5; ++i) {
            full[i] = random.chance(1, 2) ? 1 : 0;
            part[i] = random.chance(1, 2) ? full[i] : std::int8_t{-1};
        }
        const Ref rest = simplified(formula, part);
        EXPECT_EQ(value_of(*rest, full), value_of(*formula, full));
        for_each_slot(*rest,
                      [&](std::int32_t s) { EXPECT_EQ(part[static_cast<std::size_t>(s)], -1); });
    }
}

}  // namespace
