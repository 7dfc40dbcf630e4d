// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/point_2d.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/flat_formula.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace trisect {
namespace {

Outline square(double low, double high) {
    return {{low, low}, {high, low}, {high, high}, {low, high}};
}

Outline rectangle(const Point2d& low, const Point2d& high) {
    return {low, {high[0], low[1]}, high, {low[0], high[1]}};
}

Solid prism(const std::vector<Outline>& outlines, OutlineRule rule = OutlineRule::Odd) {
    return flat_prism(outlines, rule, 0, 1);
}

std::string exact(const Solid& solid) { return exact_volume(solid).to_string(); }

void expect_valid(const Solid& solid) {
    const ValidationReport report = validate(solid.to_mesh());
    EXPECT_TRUE(report.defects().empty()) << report.defects().size() << " defects";
}

// What a formula of flat prisms and one of solids have in common.
void expect_same(const Solid& flat, const Expression& solids) {
    EXPECT_TRUE(evaluate(flat ^ solids).is_empty());
    EXPECT_EQ(exact(flat), exact(evaluate(solids)));
}

TEST(FlatPrism, OutlinesByTheirRules) {
    const std::vector<Outline> outlines{square(0, 4), square(1, 3), square(1, 2)};
    EXPECT_EQ(exact(prism(outlines)), "13");
    EXPECT_EQ(exact(prism(outlines, OutlineRule::Positive)), "16");
    EXPECT_TRUE(prism({}).is_empty());
    EXPECT_TRUE(evaluate(prism({{{0, 0}, {1, 1}, {2, 2}}})).is_empty());
    EXPECT_THROW((void)flat_prism(outlines, OutlineRule::Odd, 1, 1), UsageError);
}

TEST(FlatPrism, SidesThatAreCommonAreGone) {
    const Solid both =
        evaluate(prism({rectangle({0, 0}, {1, 2})}) | prism({rectangle({1, 0}, {3, 2})}));
    EXPECT_EQ(flat_outlines(both)->points.size(), 4);
    EXPECT_EQ(both.to_mesh().face_count(), 12);
    const Solid part = evaluate(prism({square(0, 2)}) - prism({rectangle({0, 1}, {1, 2})}));
    EXPECT_EQ(flat_outlines(part)->points.size(), 6);
    expect_valid(part);
}

// Boxes with one centre have nothing to be divided by.
TEST(FlatPrism, ManySidesWithOneCentre) {
    std::vector<Outline> stars;
    for (int i = 1; i <= 12; ++i) {
        const double size = i;
        stars.push_back({{-size, -1}, {size, 1}, {-size, 1}, {size, -1}});
    }
    EXPECT_EQ(exact(evaluate(prism(stars, OutlineRule::Positive))),
              exact(evaluate(prism({stars.back()}, OutlineRule::Positive))));
}

TEST(FlatPrism, TouchingCornersStayOneVertexEach) {
    const Solid both = evaluate(prism({square(0, 1)}) | prism({square(1, 2)}));
    EXPECT_EQ(flat_outlines(both)->points.size(), 7);
    expect_same(both, Solid::from_mesh(make_box({0, 0, 0}, {1, 1, 1})) |
                          Solid::from_mesh(make_box({1, 1, 0}, {2, 2, 1})));
    // A hole that touches the outline in a corner and in the middle of a side.
    const Solid hole = evaluate(prism({square(0, 4)}) - prism({{{0, 0}, {2, 1}, {4, 2}, {1, 3}}}));
    EXPECT_EQ(exact(hole), "11");
    EXPECT_EQ(exact(evaluate(hole & Solid::half_space({0, 0, 2, -1}))), "11/2");
}

// Three lines through one point, which is no double.
TEST(FlatPrism, CrossingsThatCoincide) {
    const Solid a = prism({{{0, 0}, {3, 1}, {3, 3}}});
    const Solid b = prism({{{0, 3}, {3, 0}, {3, 3}}});
    const Solid c = prism({{{0, 1.5}, {1.5, 0}, {3, 0}}});
    const Solid all = evaluate((a ^ b) | (b & c));
    const Solid again = evaluate((a | b) - (a & (b - c)));
    EXPECT_EQ(exact(evaluate(all - again)), exact(evaluate((all | again) - again)));
    expect_same(evaluate(a & b), evaluate(Expression(a) & Solid(b)));
}

TEST(FlatPrism, ResultsAreOperandsOfSolids) {
    const Solid a = prism({square(0, 3)});
    const Solid b = prism({{{1, 1}, {5, 2}, {2, 5}}});
    const Solid c = evaluate(a - b);
    EXPECT_FALSE(flat_outlines(c)->is_exact);
    const Solid box = Solid::from_mesh(make_box({0, 0, 0.25}, {2, 2, 2}));
    const Solid cut = evaluate(c - box);
    expect_valid(cut);
    const Solid boxes = evaluate(Solid::from_mesh(make_box({0, 0, 0}, {3, 3, 1})) - box);
    EXPECT_EQ(exact(cut), exact(evaluate(boxes - b)));
    EXPECT_EQ(exact(evaluate(transformed(c, AffineMap::translation({1, 0, 0})))), exact(c));
}

TEST(FlatPrism, OtherHeightsAndAxesGoTheWayOfSolids) {
    const Solid low = flat_prism(std::array{square(0, 2)}, OutlineRule::Odd, 0, 1);
    const Solid high = flat_prism(std::array{square(1, 3)}, OutlineRule::Odd, 0.5, 2);
    EXPECT_EQ(exact(evaluate(low | high)), "19/2");
    const AffineMap map{{{{0, 0, 1, 0}, {0, 2, 0, 0}, {1, 0, 0, 5}}}};
    const auto moved = flat_prism(std::array{square(0, 2)}, OutlineRule::Odd, 0, 1, map);
    ASSERT_TRUE(moved.has_value());
    EXPECT_EQ(exact(*moved), "8");
    EXPECT_EQ(bounds(*moved)->hi[2], 7);
    EXPECT_EQ(bounds(*moved)->hi[0], 1);
    EXPECT_EQ(volume(Solid::from_mesh(moved->to_mesh())), 8);
    EXPECT_FALSE(flat_prism(std::array{square(0, 2)}, OutlineRule::Odd, 0, 1,
                            AffineMap::rotation({1, 0, 0}, 30)));
}

// Where its sides cross within units of the lattice it is no mesh, and goes as what it is made of.
TEST(FlatPrism, CrossingsAreMadeOfMeshes) {
    const Solid sign = prism({{{0, 0}, {7, 1}, {6, 4}, {1, 5}}});
    const Solid bar = prism({{{2, -1}, {4, -1}, {5, 6}, {3, 6}}});
    const Solid flat = evaluate(sign - bar);
    const Solid base = Solid::from_mesh(make_box({-2, -2, -1}, {9, 8, 0}));
    const Solid peg = Solid::from_mesh(make_box({0, 0, 0.5}, {1, 7, 2}));
    const Expression formula = (base | flat) - peg;
    const auto prisms = detail::over_prisms(detail::translate(formula));
    ASSERT_TRUE(prisms.has_value());
    EXPECT_EQ(prisms->slots.size(), 4U);
    EXPECT_FALSE(detail::over_prisms(detail::translate(base - peg)).has_value());
    EXPECT_FALSE(detail::over_prisms(detail::translate(base | sign)).has_value());
    const Solid result = evaluate(formula);
    expect_valid(result);
    // Pair by pair, and the mesh did not take the tree.
    const auto state = detail::state_of(result);
    EXPECT_TRUE(std::holds_alternative<detail::UndividedMeshes>(state->form));
    ASSERT_NE(state->lazy_tree(), nullptr);
    EXPECT_FALSE(state->lazy_tree()->is_cut());
    const Expression as_written = (base | (sign - bar)) - peg;
    EXPECT_TRUE(evaluate(result ^ as_written).is_empty());
    EXPECT_EQ(exact(result), exact(evaluate(as_written)));
}

TEST(FlatPrism, MirrorsKeepTheInside) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto mirrored = flat_prism(std::array{square(1, 3)}, OutlineRule::Positive, 0, 2,
                                         AffineMap::mirror(axis));
        EXPECT_EQ(exact(*mirrored), "8") << axis;
        EXPECT_EQ(volume(Solid::from_mesh(mirrored->to_mesh())), 8) << axis;
    }
}

TEST(FlatPrism, BetweenOtherHeights) {
    const Solid a = evaluate(prism({square(0, 3)}) - prism({{{1, 1}, {5, 2}, {2, 5}}}));
    const auto higher = flat_prism_between(a, -0.1, 0.2);
    ASSERT_TRUE(higher.has_value());
    EXPECT_NEAR(volume(*higher), 0.3 * volume(a), 1e-12);
    EXPECT_FALSE(flat_prism_between(Solid::from_mesh(make_box({1, 1, 1})), 0, 1));
}

TEST(FlatPrism, FacesHaveTheNamesOfTheirOperands) {
    const Solid a = prism({square(0, 2)});
    const Solid b = prism({square(1, 3)});
    MeshMap map;
    (void)evaluate(a | b).to_mesh(map);
    bool has_a = false;
    bool has_b = false;
    for (const FaceSource& name : map.source) {
        has_a = has_a || name.operand == map.source.front().operand;
        has_b = has_b || name.operand != map.source.front().operand;
    }
    EXPECT_TRUE(has_a && has_b);
}

TEST(FlatPrism, ComplementsAreSolids) {
    const Solid outside = evaluate(~Expression(prism({square(0, 1)})));
    EXPECT_FALSE(outside.is_empty());
    EXPECT_TRUE(evaluate(outside & prism({square(0, 1)})).is_empty());
}

}  // namespace
}  // namespace trisect
