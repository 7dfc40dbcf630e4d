// SPDX-License-Identifier: Apache-2.0
//
// Formulas that are edited operand by operand, evaluated again and from the beginning.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/edited_formula.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/diagnostics.h>

namespace {

using trisect::ChangeReport;
using trisect::EditedFormula;
using trisect::evaluate;
using trisect::EvaluateCounters;
using trisect::Expression;
using trisect::Point3d;
using trisect::Solid;

bool is_same_set(const Solid& a, const Solid& b) { return evaluate(Expression(a) ^ b).is_empty(); }

// On a small grid, so that faces, edges and corners coincide.
Solid random_operand(std::mt19937& random) {
    const auto at = [&] { return static_cast<double>(random() % 12); };
    const Point3d low{at(), at(), at()};
    const auto size = [&] { return static_cast<double>(1 + random() % 4); };
    if (random() % 3 == 0)
        return Solid::from_mesh(
            transformed(trisect::make_icosphere(1 + static_cast<double>(random() % 2), 1),
                        trisect::AffineMap::translation(low)));
    return Solid::from_mesh(
        trisect::make_box(low, {low[0] + size(), low[1] + size(), low[2] + size()}));
}

// (a - (b | c ...)) | (d & e) | f ... in a random arrangement that edits leave alone.
class Document {
public:
    explicit Document(std::uint32_t seed) : random_(seed), shape_(seed % 3) {
        for (int i = 0; i < 12; ++i) operands_.push_back(random_operand(random_));
    }
    void edit() {
        const std::size_t at = random_() % operands_.size();
        const auto place = operands_.begin() + static_cast<std::ptrdiff_t>(at);
        const auto what = random_() % 6;
        if (what == 0 && operands_.size() > 6) {
            operands_.erase(place);
        } else if (what == 1) {
            operands_.insert(place, random_operand(random_));
        } else {
            *place = random_operand(random_);
        }
    }
    [[nodiscard]] Expression formula() const {
        const std::vector<Solid> first(operands_.begin(), operands_.begin() + 4);
        const std::vector<Solid> rest(operands_.begin() + 4, operands_.end());
        const Expression tools = Expression::any_of(std::span<const Solid>(rest));
        const Expression base = Expression::any_of(std::span<const Solid>(first));
        if (shape_ == 0) return base - tools;
        if (shape_ == 1) return (first[0] & first[1]) | (first[2] - first[3]) | tools;
        return (base ^ first[1]) & tools;
    }

private:
    std::mt19937 random_;
    std::uint32_t shape_;
    std::vector<Solid> operands_;
};

TEST(EditedFormula, ChainsOfEditsAreWhatTheFormulasAre) {
    std::size_t in_a_box = 0;
    std::size_t edits = 0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        Document document(seed);
        // Small leaves, so that little solids have trees.
        trisect::EvaluateOptions options;
        options.leaf_polygons = 8;
        EditedFormula edited(options);
        (void)edited.evaluate(document.formula());
        for (int step = 0; step < 8; ++step) {
            document.edit();
            const Expression formula = document.formula();
            ChangeReport report;
            const Solid again = edited.evaluate(formula, &report);
            const Solid whole = evaluate(formula);
            ASSERT_TRUE(is_same_set(again, whole)) << seed << ' ' << step;
            ASSERT_EQ(exact_volume(again), exact_volume(whole)) << seed << ' ' << step;
            in_a_box += report.box ? 1 : 0;
            ++edits;
        }
    }
    EXPECT_GT(in_a_box, edits / 2);
}

TEST(EditedFormula, NothingThatChangedIsNothingToDo) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(2, 2));
    const Solid b = Solid::from_mesh(trisect::make_box({0, 0, 0}, {3, 3, 3}));
    EditedFormula edited;
    ChangeReport report;
    const Solid first = edited.evaluate(a - b, &report);
    EXPECT_TRUE(report.evaluated_all);
    EXPECT_TRUE(is_same_set(edited.evaluate(a - b, &report), first));
    EXPECT_EQ(report.changed_operands, 0U);
    EXPECT_FALSE(report.box);
    EXPECT_FALSE(report.evaluated_all);
}

TEST(EditedFormula, AllIsEvaluatedWhereTheChangeIsNotBounded) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(2, 2));
    const Solid b = Solid::from_mesh(trisect::make_box({0, 0, 0}, {3, 3, 3}));
    const Solid below = Solid::half_space(std::array<double, 4>{0, 0, 1, 0});
    EditedFormula edited;
    ChangeReport report;
    const std::vector<Expression> chain{a - b, ~(a - b), a - below, a & b, Solid(), a | b};
    for (const Expression& formula : chain)
        EXPECT_TRUE(is_same_set(edited.evaluate(formula, &report), evaluate(formula)));
    EXPECT_FALSE(report.evaluated_all);
    (void)edited.evaluate(~a, &report);
    EXPECT_TRUE(report.evaluated_all);
    (void)edited.evaluate(a - below, &report);
    EXPECT_TRUE(report.evaluated_all);
}

TEST(EditedFormula, OperandsOfVeryDifferentSizeComeAndGo) {
    const Solid small = Solid::from_mesh(trisect::make_icosphere(1.0 / 3, 2));
    const Solid large =
        Solid::from_mesh(trisect::make_box({0x1p80, 0, 0}, {0x1p81, 0x1p80, 0x1p80}));
    const Solid near = Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1}));
    EditedFormula edited;
    const std::vector<Expression> chain{small | large, small | near, small | large, small - near};
    for (const Expression& formula : chain)
        EXPECT_EQ(exact_volume(edited.evaluate(formula)), exact_volume(evaluate(formula)));
}

// A plate with pins, of which one moves.
Expression plate(double x_of_one) {
    static const Solid base = Solid::from_mesh(trisect::make_box({0, 0, 0}, {64, 64, 1}));
    static const std::vector<Solid> pins = [] {
        std::vector<Solid> out;
        for (int x = 0; x < 30; ++x)
            for (int y = 0; y < 30; ++y)
                out.push_back(Solid::from_mesh(
                    transformed(trisect::make_cylinder(0.5, 3, 24),
                                trisect::AffineMap::translation({2.0 * x + 2, 2.0 * y + 2, 0.5}))));
        return out;
    }();
    std::vector<Expression> terms(pins.begin(), pins.end());
    terms[434] =
        Solid::from_mesh(transformed(trisect::make_cylinder(0.5, 3, 24),
                                     trisect::AffineMap::translation({x_of_one, 30.25, 0.5})));
    terms.emplace_back(base);
    return Expression::any_of(terms);
}

TEST(EditedFormula, AMovedPinCostsTheCellsAroundIt) {
    trisect::EvaluateOptions options;
    options.threads = 1;
    EditedFormula edited(options);
    (void)edited.evaluate(plate(30));
    const trisect::Diagnostics<EvaluateCounters> of_change;
    ChangeReport report;
    const Solid again = edited.evaluate(plate(30.5), &report);
    const EvaluateCounters change = of_change.counters();
    const Solid whole = evaluate(plate(30.5), options);
    EXPECT_EQ(report.changed_operands, 2U);
    EXPECT_LT(change.mixed_leaves, 12U);
    EXPECT_GT(change.shared_cells, 4U);
    EXPECT_TRUE(is_same_set(again, whole));
    EXPECT_EQ(exact_volume(again), exact_volume(whole));
}

}  // namespace
