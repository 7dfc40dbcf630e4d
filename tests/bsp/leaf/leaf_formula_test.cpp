// SPDX-License-Identifier: Apache-2.0
//
// Rows of a leaf's formula against a walk over the formula: after every change of a winding number
// they must say the same, for trees and for graphs that use a subformula many times, of few
// operands, where there is a table, and of more.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <trisect/bsp/leaf/leaf_formula.h>

#include "reference/random_solids.h"

namespace {

using trisect::detail::LeafFormula;
using trisect::detail::Residual;
using Kind = Residual::Kind;

// Operations over all that was made before, so that subformulas occur again and again.
Residual::Ref random_formula(reference::Random& random, std::int32_t slot_count,
                             std::size_t operations) {
    std::vector<Residual::Ref> made;
    for (std::int32_t s = 0; s < slot_count; ++s) made.push_back(Residual::of_slot(s));
    for (std::size_t i = 0; i < operations; ++i) {
        constexpr std::array kinds{Kind::And, Kind::Or, Kind::Xor};
        std::vector<Residual::Ref> terms;
        for (std::size_t t = 0; t < 2 + random.below(3); ++t)
            terms.push_back(made[random.below(made.size())]);
        const auto formula = Residual::combination(kinds[random.below(3)], terms);
        made.push_back(random.chance(1, 4) ? Residual::negation(formula) : formula);
    }
    return made.back();
}

void expect_rows_follow(const Residual::Ref& formula, std::int32_t slot_count,
                        reference::Random& random) {
    // Operands in another order than their slots.
    std::vector<trisect::detail::LeafOperand> operands(static_cast<std::size_t>(slot_count));
    for (std::int32_t o = 0; o < slot_count; ++o)
        operands[static_cast<std::size_t>(o)].slot = slot_count - 1 - o;
    const trisect::detail::EvaluateSettings options;
    trisect::detail::LeafProblem problem;
    problem.operands = operands;
    problem.formula = formula.get();
    problem.options = &options;
    LeafFormula leaf;
    leaf.start(problem);

    const auto random_winding = [&] {
        return random.chance(1, 3) ? trisect::detail::unknown_winding
                                   : static_cast<int>(random.between(-1, 2));
    };
    std::vector<int> row(leaf.row_size());
    for (std::size_t o = 0; o < operands.size(); ++o) row[o] = random_winding();
    leaf.fill(row);
    const auto expected = [&] {
        trisect::detail::SlotValues values(operands.size(), -1);
        for (std::size_t o = 0; o < operands.size(); ++o)
            if (row[o] != trisect::detail::unknown_winding)
                values[static_cast<std::size_t>(operands[o].slot)] = row[o] > 0 ? 1 : 0;
        return trisect::detail::bounded_value_of(*formula, values);
    };
    ASSERT_EQ(leaf.value(row), expected());
    for (int step = 0; step < 40; ++step) {
        leaf.set(row, random.below(operands.size()), random_winding());
        ASSERT_EQ(leaf.value(row), expected()) << "step " << step;
    }
}

TEST(LeafFormula, RowsFollowEveryChange) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 440000);
        const auto slots = static_cast<std::int32_t>(1 + seed % 7);
        expect_rows_follow(random_formula(random, slots, 1 + seed % 12), slots, random);
    }
}

// More operations than fit into one word of marks, and far more as a tree.
TEST(LeafFormula, GraphsWithManyOperations) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 450000);
        const std::int32_t slots = seed % 2 == 0 ? 7 : 3;
        Residual::Ref formula = random_formula(random, slots, 3);
        for (int i = 0; i < 100; ++i) {
            const auto slot = Residual::of_slot(i % slots);
            const std::array both{formula, slot};
            const std::array twice{Residual::combination(Kind::Xor, both),
                                   Residual::combination(Kind::And, both)};
            formula = Residual::combination(i % 2 == 0 ? Kind::Or : Kind::Xor, twice);
        }
        expect_rows_follow(formula, slots, random);
    }
}

TEST(LeafFormula, OfOneOperandAndOfNone) {
    reference::Random random(1);
    for (const std::int32_t slots : {2, 7}) {
        expect_rows_follow(Residual::of_slot(slots - 1), slots, random);
        expect_rows_follow(Residual::negation(Residual::of_slot(slots - 1)), slots, random);
        expect_rows_follow(Residual::constant(true), slots, random);
    }
}

}  // namespace
