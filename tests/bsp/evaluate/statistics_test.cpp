// SPDX-License-Identifier: Apache-2.0
//
// The counters: a fast path that is off does not change results, only these numbers.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include <trisect/brep/primitives/cone.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include "engines/evaluate_stats.h"

namespace {

using trisect::Diagnostics;
using trisect::evaluate;
using trisect::EvaluateCounters;
using trisect::PredicateCounters;
using trisect::Solid;
using trisect::StopScope;
using trisect::test::EvaluateStats;

// Two balls in general position: no two of their planes or vertices coincide.
class TwoBalls : public ::testing::Test {
protected:
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 4));
    const Solid b = Solid::from_mesh(
        trisect::transformed(trisect::make_icosphere(1, 4),
                             trisect::compose(trisect::AffineMap::translation({0.43, 0.31, 0.27}),
                                              trisect::AffineMap::rotation({1, 2, 3}, 37))));
    // By cells: a limit of work is counted by them.
    static Solid divided(const trisect::Expression& expression, EvaluateStats* stats = nullptr) {
        const StopScope scope({.max_work = std::uint64_t{1} << 60});
        return evaluate(expression, {}, stats);
    }
};

// Of two large meshes only the facets that come near the other one are looked at.
TEST_F(TwoBalls, AreNotDividedWhereTheyAreFarFromEachOther) {
    EvaluateStats stats;
    EvaluateStats by_cells;
    (void)evaluate(a | b, {}, &stats);
    (void)divided(a | b, &by_cells);
    EXPECT_GT(stats.pairs_cutting, 0U);
    EXPECT_EQ(stats.doubtful_pairs, 0U);
    EXPECT_LE(stats.pairs_cutting, by_cells.pairs_cutting);  // some count in several cells
    EXPECT_LT(2 * stats.listed_polygons, by_cells.listed_polygons);
    EXPECT_EQ(stats.traces, 0U);
    EXPECT_GT(stats.untouched_polygons, 1000U);
    EXPECT_LT(stats.memory, by_cells.memory);
}

// Two cones of which the second one is moved across its axis. Walls of one end in the plane of the
// other one's cap, many of them beside the facet of it whose box they meet.
TEST(Caps, WallsThatEndBesideThemAreNoDoubtfulPairs) {
    const trisect::PolygonMesh mesh = trisect::make_cone(1, 0.25, 1, 400);
    const Solid a = Solid::from_mesh(mesh);
    const Solid b = Solid::from_mesh(
        trisect::transformed(mesh, trisect::AffineMap::translation({0.4375, 0.28125, 0})));
    EvaluateStats stats;
    const Solid both = evaluate(a & b, {}, &stats);
    EXPECT_EQ(stats.exact_leaves, 0U);
    EXPECT_GT(stats.doubtful_pairs, 300U);
    EXPECT_LT(4 * stats.doubtful_pairs, 3 * stats.pairs_boxes);
    const StopScope by_cells({.max_work = std::uint64_t{1} << 60});
    EXPECT_EQ(both.to_brep().counts(), evaluate(a & b).to_brep().counts());
}

TEST_F(TwoBalls, AreDecidedByTheFilterNearlyAlways) {
    const Diagnostics<PredicateCounters> diagnostics;
    EvaluateStats stats;
    const Solid both = divided(a & b, &stats);
    EXPECT_FALSE(both.to_brep().is_empty());
    const PredicateCounters made = diagnostics.counters();
    const auto filtered = made.filtered;
    const auto exact = made.exact_narrow + made.exact_wide;
    EXPECT_GT(filtered, 1000U);
    EXPECT_LT(exact * 20, filtered);
}

// The short ways of leaves, by their counts: one trace serves what hangs together, and within a cut
// facet winding numbers are carried over. (A symmetric difference is cut at once.)
TEST_F(TwoBalls, WindingNumbersAreCarriedOverInsteadOfTraced) {
    EvaluateStats stats;
    (void)divided(a ^ b, &stats);
    EXPECT_GT(stats.untouched_polygons, 1000U);
    EXPECT_GT(stats.traces_within, stats.pieces / 2);
    EXPECT_LT(stats.traces * 4, stats.pieces + stats.untouched_polygons);
}

// Nothing touches without crossing, so no leaf needs more than doubles.
TEST_F(TwoBalls, AllLeavesAreArrangedInDoubles) {
    for (const std::uint32_t leaf : {20U, 100U, 1000U}) {
        trisect::EvaluateOptions options;
        options.leaf_polygons = leaf;
        EvaluateStats stats;
        (void)evaluate(a - b, options, &stats);
        EXPECT_GT(stats.mixed_leaves, 0U);
        EXPECT_EQ(stats.filtered_leaves, stats.mixed_leaves);
    }
}

// Every cell is resolved by one rule of the table.
TEST_F(TwoBalls, CountersOfRulesAddUp) {
    const Solid c = divided(a - b);
    for (const trisect::Expression& e :
         {trisect::Expression(a) ^ b, c | b, c - Solid::from_mesh(trisect::make_icosphere(1, 1))}) {
        EvaluateStats stats;
        (void)divided(e, &stats);
        EXPECT_EQ(stats.mixed_leaves, stats.grid_leaves + stats.filtered_leaves +
                                          stats.prism_leaves + stats.exact_leaves);
        EXPECT_EQ(stats.cells, stats.constant_cells + stats.shared_cells + stats.mixed_leaves +
                                   stats.halved_cells + stats.divided_cells);
        EXPECT_GT(stats.divided_cells, 0U);
    }
}

TEST_F(TwoBalls, CellsAndPairsAreFew) {
    EvaluateStats stats;
    (void)divided(a | b, &stats);
    EXPECT_GT(stats.cells, 0U);
    EXPECT_GE(stats.cells, stats.shared_cells + stats.constant_cells + stats.mixed_leaves);
    EXPECT_GT(stats.shared_cells, 0U);
    EXPECT_GT(stats.mixed_leaves, 0U);
    EXPECT_GT(stats.depth, 0);
    EXPECT_LE(stats.pairs_cutting, stats.pairs_boxes);
    EXPECT_GT(stats.pairs_cutting, 0U);
    // Wasted candidates: pairs that were looked at for each one that cut.
    EXPECT_LT(stats.pairs_boxes, 30 * stats.pairs_cutting);
    // Generic segments are hardly ever degenerate.
    EXPECT_LE(stats.traces_retried * 20, stats.traces + 20);
}

TEST_F(TwoBalls, CountersStartAtZeroForEveryEvaluation) {
    EvaluateStats first;
    EvaluateStats second;
    (void)evaluate(a | b, {}, &first);
    (void)evaluate(a | b, {}, &second);
    EXPECT_EQ(first.cells, second.cells);
    EXPECT_EQ(first.listed_polygons, second.listed_polygons);
    EXPECT_EQ(first.pairs_cutting, second.pairs_cutting);
    EXPECT_EQ(first.traces, second.traces);
}

// Each looks at what was done since it began, whatever there is beside it.
TEST_F(TwoBalls, DiagnosticsCountFromTheirBeginning) {
    const Diagnostics<EvaluateCounters> outer;
    EvaluateStats first;
    (void)evaluate(a | b, {}, &first);
    const Diagnostics<EvaluateCounters> inner;
    EXPECT_EQ(inner.counters(), EvaluateCounters{});
    EvaluateStats second;
    (void)evaluate(a ^ b, {}, &second);
    EXPECT_GT(second.cells, 0U);
    EXPECT_EQ(inner.counters(), second);
    EvaluateCounters both = first;
    both += second;
    EXPECT_EQ(outer.counters(), both);
    both -= first;
    EXPECT_EQ(both, static_cast<const EvaluateCounters&>(second));
}

// What the evaluator itself has counted, by one thread or by all of them.
TEST_F(TwoBalls, DiagnosticsAreThoseOfTheEvaluator) {
    namespace detail = trisect::detail;
    // Large leaves are refined for good: every evaluation has solids of its own.
    const auto fresh = [] {
        const auto turned = trisect::compose(trisect::AffineMap::translation({0.43, 0.31, 0.27}),
                                             trisect::AffineMap::rotation({1, 2, 3}, 37));
        const auto ball = [](std::uint32_t n) { return trisect::make_icosphere(1, n); };
        const trisect::Expression large = Solid::from_mesh(ball(5));
        return (large ^ Solid::from_mesh(trisect::transformed(ball(5), turned))) -
               Solid::from_mesh(ball(4));
    };
    std::optional<EvaluateCounters> one;
    for (const std::uint32_t threads : {1U, 4U}) {
        detail::EvaluateSettings settings;
        settings.threads = threads;
        const detail::Translation t = detail::translate(fresh());
        detail::SolidStates states;
        for (const Solid& s : t.slots) states.push_back(detail::state_of(s));
        (void)detail::move_to_common_lattice(states, settings.lattices);
        detail::EvaluateStats expected;
        (void)detail::evaluate_tree(t.formula, states, settings, expected);
        const trisect::Expression formula = fresh();
        const Diagnostics<EvaluateCounters> diagnostics;
        trisect::EvaluateReport report;
        (void)trisect::evaluate(formula, settings, &report);
        EXPECT_GT(expected.cells, 100U);
        EXPECT_EQ(diagnostics.counters().cells, expected.cells);
        EXPECT_EQ(diagnostics.counters().pairs_boxes, expected.pairs_boxes);
        EXPECT_EQ(diagnostics.counters().listed_polygons, expected.listed_polygons);
        EXPECT_EQ(report.depth, expected.depth);
        if (threads == 1) {
            EXPECT_EQ(diagnostics.counters(), expected);
            EXPECT_EQ(report.memory, expected.memory);
            one = expected;
        } else {
            EXPECT_EQ(diagnostics.counters().cells, one->cells);
        }
    }
}

TEST_F(TwoBalls, DiagnosticsOfAThreadAreItsOwn) {
    const Diagnostics<EvaluateCounters> here;
    EvaluateStats stats;
    std::thread([&] { (void)evaluate(a | b, {}, &stats); }).join();
    EXPECT_GT(stats.cells, 0U);
    EXPECT_EQ(here.counters(), EvaluateCounters{});
}

TEST_F(TwoBalls, AWorkBudgetThatIsSpentIsALimit) {
    {
        const StopScope scope({.max_work = 5});
        EXPECT_THROW((void)evaluate(a | b), trisect::LimitError);
        EXPECT_EQ(scope.work(), 6U);
    }
    const StopScope scope({.max_work = 1'000'000});
    EvaluateStats stats;
    EXPECT_FALSE(evaluate(a | b, {}, &stats).is_empty());
    EXPECT_EQ(scope.work(), stats.cells + stats.pairs_boxes);
}

TEST_F(TwoBalls, EvaluationsInNestedScopesShareTheirBudgets) {
    EvaluateStats stats;
    (void)divided(a | b, &stats);
    const std::uint64_t once = stats.cells + stats.pairs_boxes;
    const StopScope outer({.max_work = 3 * once - 1});
    {
        const StopScope inner({.max_work = 2 * once});
        for (int i = 0; i < 2; ++i) EXPECT_FALSE(evaluate(a | b).is_empty());
        EXPECT_EQ(inner.work(), 2 * once);
        EXPECT_THROW((void)evaluate(a | b), trisect::LimitError);  // the inner one is spent
        EXPECT_EQ(inner.work(), 2 * once + 1);
    }
    EXPECT_EQ(outer.work(), 2 * once + 1);
    const StopScope wide({.max_work = 10 * once});
    try {
        (void)evaluate(a | b);
        ADD_FAILURE() << "the outer scope has less left";
    } catch (const trisect::LimitError& e) {
        EXPECT_NE(std::string(e.what()).find(std::to_string(3 * once - 1)), std::string::npos);
    }
}

TEST_F(TwoBalls, AnEvaluationCountsBesideOtherCalls) {
    StopScope scope({.max_work = 1'000'000});
    (void)a.to_mesh(1);
    const std::uint64_t before = scope.work();
    EXPECT_GT(before, 0U);
    EvaluateStats stats;
    (void)evaluate(a | b, {}, &stats);
    EXPECT_EQ(scope.work(), before + stats.cells + stats.pairs_boxes);
}

// By several threads, since nothing limits the work.
TEST_F(TwoBalls, AScopeWithoutLimitsCountsTheWorkOfAllThreads) {
    trisect::EvaluateOptions options;
    options.threads = 4;
    const StopScope scope(nullptr);
    EvaluateStats stats;
    (void)evaluate(a ^ b, options, &stats);
    EXPECT_EQ(scope.work(), stats.cells + stats.pairs_boxes);
}

TEST_F(TwoBalls, AMemoryBudgetIsALimitJustBelowWhatIsNeeded) {
    // What is held at once depends on how many threads hold it.
    trisect::EvaluateOptions options;
    options.threads = 1;
    EvaluateStats stats;
    (void)evaluate(a | b, options, &stats);
    ASSERT_GT(stats.memory, 1000U);
    for (const bool inside : {false, true}) {
        // The smallest limit holds, wherever it is.
        const std::uint64_t wide = 10 * stats.memory;
        {
            const StopScope outer({.max_memory = inside ? wide : stats.memory - 1});
            const StopScope inner({.max_memory = inside ? stats.memory - 1 : wide});
            const StopScope none(nullptr);
            EXPECT_THROW((void)evaluate(a | b, options), trisect::LimitError);
        }
        const StopScope outer({.max_memory = inside ? wide : stats.memory});
        const StopScope inner({.max_memory = inside ? stats.memory : wide});
        EXPECT_FALSE(evaluate(a | b, options).is_empty());
    }
}

TEST_F(TwoBalls, CancellationStopsAnEvaluationAndHarmsNoOperand) {
    std::atomic<bool> stop = true;
    const StopScope scope(&stop);
    EXPECT_THROW((void)evaluate(a | b), trisect::CancelledError);
    stop = false;
    EXPECT_FALSE(evaluate(a | b).is_empty());
}

}  // namespace
