// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/formula_halves.h>

#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace trisect::detail {
namespace {

using Kind = Residual::Kind;
using Ref = Residual::Ref;

Ref slots(Kind kind, std::int32_t first, std::int32_t end) {
    std::vector<Ref> terms;
    for (std::int32_t i = first; i < end; ++i) terms.push_back(Residual::of_slot(i));
    return Residual::of_distinct(kind, terms);
}

std::set<std::int32_t> slots_of(const Residual& formula) {
    std::set<std::int32_t> out;
    for_each_slot(formula, [&](std::int32_t s) { out.insert(s); });
    return out;
}

using Slots = std::set<std::int32_t>;

// Halves joined over values of their own are the formula, for all values of its slots.
void expect_same_values(const Ref& formula, std::int32_t n) {
    const auto halves = halves_of(*formula);
    ASSERT_TRUE(halves.has_value());
    const Ref joined = halves->joined(0, 1);
    for (std::uint32_t bits = 0; bits < 1U << n; ++bits) {
        SlotValues values;
        for (std::int32_t i = 0; i < n; ++i)
            values.push_back(static_cast<std::int8_t>(bits >> i & 1U));
        SlotValues of_halves;
        for (const Ref& term : halves->terms)
            of_halves.push_back(value_of(*term, values) ? std::int8_t{1} : std::int8_t{0});
        EXPECT_EQ(value_of(*joined, of_halves), value_of(*formula, values)) << bits;
    }
}

TEST(FormulaHalves, HaveHalfTheSlotsInTheirOrder) {
    for (const Kind kind : {Kind::And, Kind::Or, Kind::Xor}) {
        const Ref formula = slots(kind, 0, 6);
        const auto halves = halves_of(*formula);
        ASSERT_TRUE(halves.has_value());
        EXPECT_EQ(slots_of(*halves->terms[0]), (Slots{0, 1, 2}));
        EXPECT_EQ(slots_of(*halves->terms[1]), (Slots{3, 4, 5}));
        expect_same_values(formula, 6);
        expect_same_values(Residual::negation(formula), 6);
    }
}

TEST(FormulaHalves, CountSlotsOfTerms) {
    const std::array terms{Residual::of_slot(0), Residual::negation(slots(Kind::Or, 1, 8))};
    const Ref formula = Residual::combination(Kind::And, terms);
    const auto halves = halves_of(*formula);
    ASSERT_TRUE(halves.has_value());
    EXPECT_EQ(slots_of(*halves->terms[0]), Slots{0});
    EXPECT_EQ(slots_of(*halves->terms[1]).size(), 7U);
    expect_same_values(formula, 8);
}

// (0 xor 1) or (2 and 3) or (1 and 4) or 5: the first and the third term name slot 1.
TEST(FormulaHalves, KeepTermsWithACommonSlotTogether) {
    const auto pair = [](Kind kind, std::int32_t a, std::int32_t b) {
        return Residual::of_distinct(kind, {Residual::of_slot(a), Residual::of_slot(b)});
    };
    const std::array terms{pair(Kind::Xor, 0, 1), pair(Kind::And, 2, 3), pair(Kind::And, 1, 4),
                           Residual::of_slot(5)};
    const Ref formula = Residual::combination(Kind::Or, terms);
    const auto halves = halves_of(*formula);
    ASSERT_TRUE(halves.has_value());
    EXPECT_EQ(slots_of(*halves->terms[0]), (Slots{0, 1, 4}));
    EXPECT_EQ(slots_of(*halves->terms[1]), (Slots{2, 3, 5}));
    expect_same_values(formula, 6);
}

TEST(FormulaHalves, AreNoneWhereAllTermsHaveCommonSlots) {
    const std::array terms{slots(Kind::And, 0, 3), slots(Kind::And, 2, 5), slots(Kind::And, 4, 7)};
    EXPECT_FALSE(halves_of(*Residual::combination(Kind::Or, terms)));
    EXPECT_FALSE(halves_of(*Residual::of_slot(3)));
    EXPECT_FALSE(halves_of(*Residual::negation(Residual::of_slot(3))));
    EXPECT_FALSE(halves_of(*Residual::constant(true)));
}

}  // namespace
}  // namespace trisect::detail
