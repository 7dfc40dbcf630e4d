// SPDX-License-Identifier: Apache-2.0
//
// Formulas over many meshes that are evaluated pair by pair, without a tree
// (many_meshes_without_tree.h), against the naive engine in rationals and against a tree of cells,
// and how often each decides.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include "engines.h"

namespace many_meshes_test {
namespace {

using reference::Expression;
using reference::Operand;
using trisect::detail::SolidState;
using Kind = Expression::Kind;

struct Count {
    int tried = 0;
    int without_tree = 0;
    int by_tree = 0;  // of those, since faces may go straight across each other
    int with_sheets = 0;
};

using Evaluate = decltype(trisect::detail::FormulaRule::evaluate);

// By the rule alone, wherever the meshes lie. \pre they are on one lattice
std::shared_ptr<const SolidState> without_tree(
    const trisect::Expression& expression, std::uint32_t threads = 1,
    trisect::detail::EvaluateStats* found = nullptr,
    Evaluate evaluate = &trisect::detail::evaluate_many_without_tree) {
    using namespace trisect::detail;
    const Translation t = engines::each_once(expression);
    std::vector<std::shared_ptr<const SolidState>> states;
    for (const trisect::Solid& s : t.slots) states.push_back(trisect::detail::state_of(s));
    trisect::EvaluateOptions options;
    options.threads = threads;
    trisect::detail::EvaluateStats stats;
    auto out = evaluate_by({&may_be_many_meshes, evaluate}, t.formula, states,
                           EvaluateSettings{options, SplittingOffset::of_thread()}, stats);
    if (found != nullptr) *found = stats;
    return out;
}

trisect::Solid by_cells(const trisect::Expression& expression) {
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});  // counted by cells
    return trisect::evaluate(expression);
}

// Nothing where the set is unbounded.
std::optional<trisect::PolygonMesh> mesh_of(const SolidState& state) {
    try {
        return trisect::detail::assemble_mesh(state);
    } catch (const trisect::UnsupportedError&) {
        return std::nullopt;
    }
}

void expect_same_as_cells(const trisect::Expression& expression, Count& count) {
    ++count.tried;
    const auto state = without_tree(expression);
    if (state == nullptr) return;
    ++count.without_tree;
    const auto mesh = mesh_of(*state);
    const auto expected = mesh_of(*trisect::detail::state_of(by_cells(expression)));
    ASSERT_EQ(mesh.has_value(), expected.has_value());
    if (!mesh) return;
    EXPECT_EQ(mesh->corners, expected->corners);
    EXPECT_TRUE(mesh->points == expected->points);
    EXPECT_EQ(engines::open_edge(*mesh), "");
    EXPECT_FALSE(state->lazy_tree()->is_cut());
}

void expect_agreement(const std::vector<Operand>& operands, const Expression& expression,
                      Count& count,
                      Evaluate evaluate = &trisect::detail::evaluate_many_without_tree) {
    std::vector<trisect::Solid> solids;
    solids.reserve(operands.size());
    for (const auto& o : operands) solids.push_back(engines::solid(o, trisect::Embedding::Assume));
    const trisect::Expression formula = engines::formula(expression, solids);
    ++count.tried;
    const auto state = without_tree(formula, 1, nullptr, evaluate);
    if (state == nullptr) return;
    ++count.without_tree;
    if (std::get<trisect::detail::UndividedMeshes>(state->form).may_have_sheets)
        ++count.with_sheets;
    try {
        const auto expected = reference::evaluate(operands, expression);
        const trisect::Brep brep = trisect::detail::assemble_brep(*state, {});
        EXPECT_EQ(engines::difference(brep, reference::canonical_boundary(expected.cells)), "");
        const trisect::Solid solid = trisect::detail::solid_of(state);
        EXPECT_EQ(solid.is_empty() || solid.is_whole_space(), brep.is_empty());
        // Also the edges in which faces go straight across each other.
        const trisect::BrepCounts of_cells = by_cells(formula).to_brep().counts();
        EXPECT_EQ(brep.counts().edges, of_cells.edges);
        EXPECT_EQ(brep.counts().faces, of_cells.faces);
        if (const auto mesh = mesh_of(*state)) {
            EXPECT_EQ(engines::open_edge(*mesh), "");
        }
    } catch (const trisect::UnsupportedError&) {
    }
    const auto& form = std::get<trisect::detail::UndividedMeshes>(state->form);
    if (form.may_have_straight_crossings) {
        count.by_tree += state->lazy_tree()->is_cut() ? 1 : 0;
    } else {
        EXPECT_FALSE(state->lazy_tree()->is_cut());
    }
}

// Some operands are complements.
Expression random_formula(reference::Random& random, std::size_t n, Kind kind) {
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < n; ++i) {
        const Expression leaf = Expression::leaf(i);
        terms.push_back(random.between(0, 2) == 0 ? Expression::node(Kind::Complement, {leaf})
                                                  : leaf);
    }
    return Expression::node(kind, terms);
}

TEST(ManyMeshes, InGeneralPosition) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 610000);
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < 3 + seed % 3; ++i)
            operands.push_back(engines::mapped(reference::random_embedded_solid(random), random));
        expect_agreement(operands,
                         random_formula(random, operands.size(),
                                        seed % 2 == 0 ? Kind::Union : Kind::Intersection),
                         count);
    }
    EXPECT_GT(count.without_tree, 140);
}

// Unions, intersections and differences of each other, over operands `first` to `end`.
// Leaves beyond the operands name these again.
Expression random_nested(reference::Random& random, std::size_t first, std::size_t end,
                         std::size_t operands = ~std::size_t{0}) {
    if (first + 1 == end) {
        const Expression leaf = Expression::leaf(first % operands);
        return random.between(0, 4) == 0 ? Expression::node(Kind::Complement, {leaf}) : leaf;
    }
    const std::size_t middle =
        first + 1 + static_cast<std::size_t>(random.between(0, static_cast<int>(end - first) - 2));
    constexpr std::array kinds{Kind::Union, Kind::Intersection, Kind::Difference};
    return Expression::node(kinds[static_cast<std::size_t>(random.between(0, 2))],
                            {random_nested(random, first, middle, operands),
                             random_nested(random, middle, end, operands)});
}

TEST(ManyMeshes, OfEachOtherInGeneralPosition) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 630000);
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < 3 + seed % 4; ++i)
            operands.push_back(engines::mapped(reference::random_embedded_solid(random), random));
        expect_agreement(operands, random_nested(random, 0, operands.size()), count);
    }
    EXPECT_GT(count.without_tree, 180);
}

// Few go by the tree, some of them when the boundary is put together.
TEST(ManyMeshes, OfEachOtherOnASmallGrid) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 640000);
        const auto operands = reference::random_family(random, 3 + seed % 4, true);
        expect_agreement(operands, random_nested(random, 0, operands.size()), count);
    }
    EXPECT_GT(count.without_tree, 85);
    EXPECT_LT(count.by_tree, 5);
}

// Nearly everything touches there. Few go by the tree.
TEST(ManyMeshes, OnASmallGrid) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 620000);
        const auto operands = reference::random_family(random, 3 + seed % 3, true);
        expect_agreement(operands,
                         random_formula(random, operands.size(),
                                        seed % 2 == 0 ? Kind::Union : Kind::Intersection),
                         count);
    }
    EXPECT_GT(count.without_tree, 130);
}

// Where doubles leave pairs open or not, whatever the coordinates' digits. The most pairs that they
// left open.
std::uint64_t expect_same(const std::vector<Operand>& operands, const Expression& all) {
    std::uint64_t most = 0;
    const auto expected = reference::canonical_boundary(reference::evaluate(operands, all).cells);
    for (const int bits : {0, 2, 24, 70}) {
        SCOPED_TRACE("bits " + std::to_string(bits));
        std::vector<trisect::Solid> solids;
        for (const auto& o : operands)
            solids.push_back(engines::solid(o, trisect::Embedding::Assume, bits));
        std::uint64_t doubtful = 0;
        const auto difference =
            engines::pairwise_difference(engines::formula(all, solids), {}, expected, doubtful);
        EXPECT_EQ(difference, std::optional<std::string>(""));
        most = std::max(most, doubtful);
    }
    return most;
}

Expression of_all(Kind kind, std::size_t operands) {
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < operands; ++i) terms.push_back(Expression::leaf(i));
    return Expression::node(kind, terms);
}

void expect_union(const std::vector<Operand>& operands) {
    EXPECT_GT(expect_same(operands, of_all(Kind::Union, operands.size())), 0U);
}

// Tools that are apart are not compared with each other, and those that are not stay together.
TEST(ManyMeshes, ToolsInClusters) {
    std::vector<Operand> operands{reference::box({0, 0, 0}, {60, 20, 6})};
    for (std::int64_t i = 0; i < 6; ++i) {
        const Operand tool =
            reference::prism({{2, 2}, {7, 3}, {8, 8}, {3, 7}}, i % 2 == 0 ? 3 : 0, 6);
        operands.push_back(
            reference::translated(tool, {10 * i - (i == 3 ? 4 : 0), i == 5 ? 15 : 3, 0}));
    }
    expect_same(operands, of_all(Kind::Difference, operands.size()));
    operands.erase(operands.begin());
    expect_same(operands, of_all(Kind::Union, operands.size()));
}

// Caps of fans in one plane.
TEST(ManyMeshes, CapsOfOnePlane) {
    const auto disc = [](std::int64_t x) {
        reference::LatticePolygon outline;
        for (int i = 0; i < 14; ++i) {
            const double angle = 0.4487 * i;
            outline.push_back(
                {x + std::llround(60 * std::cos(angle)), std::llround(60 * std::sin(angle))});
        }
        return reference::prism(outline, 0, 9);
    };
    expect_union({disc(0), disc(20), disc(41)});
}

// The end of the first tent is cut away but for what lies between its slope and that of the second
// one, which are in one plane; the plate's lower side crosses that.
TEST(ManyMeshes, AStripOfNoWidthIsCrossed) {
    const auto tent = [](std::int64_t x) {
        return reference::translated(
            reference::axes_rotated(reference::prism({{3, 9}, {13, 2}, {13, 14}}, 0, 13), 2),
            {x, 0, 0});
    };
    expect_union({reference::box({2, 1, 6}, {14, 15, 8}), tent(0), tent(2)});
}

// An edge of a solid lies in a face that recedes from it, and a third solid goes through both.
TEST(ManyMeshes, AFaceCrossesTwoThatTouch) {
    const Operand octahedron{
        {{{2, 4, 5}, {9, 0, 5}, {9, 4, 12}}},   {{{9, 0, 5}, {2, 4, 5}, {9, 4, 1}}},
        {{{9, 0, 5}, {10, 4, 5}, {9, 4, 12}}},  {{{10, 4, 5}, {9, 0, 5}, {9, 4, 1}}},
        {{{10, 4, 5}, {9, 14, 5}, {9, 4, 12}}}, {{{9, 14, 5}, {10, 4, 5}, {9, 4, 1}}},
        {{{9, 14, 5}, {2, 4, 5}, {9, 4, 12}}},  {{{2, 4, 5}, {9, 14, 5}, {9, 4, 1}}}};
    const Operand bracket = reference::prism(
        {{4, 1}, {15, 1}, {15, 13}, {13, 13}, {13, 3}, {8, 3}, {8, 4}, {4, 4}}, 1, 15);
    expect_union({octahedron, bracket,
                  reference::tetrahedron({5, 4, 2}, {14, 4, 11}, {13, 3, 5}, {4, 3, 0})});
}

// A ridge stands with its edge where the edge of a groove below reaches up to the same face, and
// both have the same two planes: the faces of all three planes go straight across the line.
TEST(ManyMeshes, FacesCrossStraightInALine) {
    Count count;
    for (std::size_t turns = 0; turns < 3; ++turns)
        for (const std::int64_t end : {9, 10, 11}) {
            SCOPED_TRACE(std::to_string(turns) + ", " + std::to_string(end));
            std::vector<Operand> operands{
                reference::prism({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, 0, 10),
                reference::prism({{10, 10}, {8, 6}, {12, 6}}, 10 - end, end),
                reference::prism({{10, 10}, {12, 14}, {8, 14}}, 0, 10)};
            for (Operand& o : operands) o = reference::axes_rotated(o, turns);
            expect_agreement(
                operands,
                Expression::node(
                    Kind::Union,
                    {Expression::node(Kind::Difference, {Expression::leaf(0), Expression::leaf(1)}),
                     Expression::leaf(2)}),
                count);
        }
    EXPECT_EQ(count.without_tree, 9);
    EXPECT_EQ(count.by_tree, 0);
}

// Solids that stand on each other are united, and tools that are flush with them are subtracted
// from some: those that are united have to grow, and the tools more than these.
TEST(ManyMeshes, ToolsAreFlushWithWhatStandsOnSomething) {
    Count count;
    for (std::size_t turns = 0; turns < 3; ++turns)
        for (const std::int64_t top : {4, 6, 8}) {
            SCOPED_TRACE(std::to_string(turns) + ", " + std::to_string(top));
            std::vector<Operand> operands{
                reference::box({0, 0, 0}, {10, 10, 4}), reference::box({2, 2, 4}, {8, 8, top + 2}),
                reference::prism({{4, 4}, {6, 4}, {6, 6}, {5, 7}, {4, 6}}, 4, top + 2),
                reference::box({0, 4, 1}, {10, 6, 4})};
            for (Operand& o : operands) o = reference::axes_rotated(o, turns);
            const auto leaf = [](std::size_t i) { return Expression::leaf(i); };
            expect_agreement(
                operands,
                Expression::node(Kind::Union,
                                 {Expression::node(Kind::Difference, {leaf(0), leaf(3)}),
                                  Expression::node(Kind::Difference, {leaf(1), leaf(2)})}),
                count);
        }
    EXPECT_EQ(count.without_tree, 9);
    EXPECT_EQ(count.by_tree, 0);
}

// Each tube fills the bore of the next larger one, and all end in one plane: what is bored has to
// grow less than its bore, which has to grow less than the tube that fills it.
TEST(ManyMeshes, TubesInTubesThatEndInOnePlane) {
    Count count;
    for (std::size_t turns = 0; turns < 3; ++turns)
        for (const std::int64_t step : {1, 2}) {
            SCOPED_TRACE(std::to_string(turns) + ", " + std::to_string(step));
            std::vector<Operand> operands;
            std::vector<Expression> tubes;
            for (std::int64_t i = 0; i < 3; ++i) {
                const auto bar = [&](std::int64_t in) {
                    return reference::axes_rotated(
                        reference::box({in, in, 0}, {20 - in, 20 - in, 9}), turns);
                };
                tubes.push_back(Expression::node(
                    Kind::Difference,
                    {Expression::leaf(operands.size()), Expression::leaf(operands.size() + 1)}));
                operands.push_back(bar(2 * i));
                operands.push_back(bar(2 * i + step));
            }
            expect_agreement(operands, Expression::node(Kind::Union, tubes), count);
        }
    EXPECT_EQ(count.without_tree, 6);
    EXPECT_EQ(count.by_tree, 0);
}

// Leaves are named again: copies of operands take their places, and coincide with them.
TEST(ManyMeshes, OperandsComeTwice) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 660000);
        const std::size_t n = 2 + seed % 3;
        const auto operands = reference::random_family(random, n, true);
        expect_agreement(operands, random_nested(random, 0, n + 1 + seed % 4, n), count);
    }
    EXPECT_GT(count.without_tree, 150);
}

// Nothing bounds the result: whole facets face each other.
TEST(ManyMeshes, OperandsThatComeTwiceMakeWholeSpace) {
    trisect::PolygonMesh moved = trisect::make_icosphere(1, 3);
    for (auto& p : moved.points) p[0] += 0.51;
    const trisect::Expression a = trisect::Solid::from_mesh(trisect::make_icosphere(1, 3));
    const trisect::Expression b = trisect::Solid::from_mesh(moved);
    const trisect::Solid whole = evaluate((a | b) | (~a & ~b));
    EXPECT_TRUE(std::holds_alternative<trisect::detail::UndividedMeshes>(
        trisect::detail::state_of(whole)->form));
    EXPECT_TRUE(whole.is_whole_space());
    EXPECT_FALSE(whole.is_empty());
    EXPECT_THROW((void)whole.to_mesh(), trisect::UnsupportedError);
    const trisect::Solid none = evaluate((a & b) & (~a | ~b));
    EXPECT_TRUE(none.is_empty());
    EXPECT_FALSE(none.is_whole_space());
    EXPECT_EQ(none.to_mesh().face_count(), 0U);
}

// Moved the wrong way, meshes leave gaps and sheets in every fourth formula.
TEST(ManyMeshes, SheetsOnASmallGrid) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 650000);
        const auto operands = reference::random_family(random, 3 + seed % 4, true);
        const Expression formula =
            seed % 3 == 0 ? random_formula(random, operands.size(),
                                           seed % 2 == 0 ? Kind::Union : Kind::Intersection)
                          : random_nested(random, 0, operands.size());
        expect_agreement(operands, formula, count, &trisect::detail::evaluate_many_with_sheets);
    }
    EXPECT_GT(count.without_tree, 147);
    EXPECT_GT(count.with_sheets, 30);
    EXPECT_LT(count.by_tree, 5);
}

// Plates lie on each other in one plane, turned against each other, so that edges of sheets cross;
// some cover others twice.
TEST(ManyMeshes, SheetsLieOnEachOther) {
    const reference::LatticePolygon square{{0, 0}, {12, 0}, {12, 12}, {0, 12}};
    const reference::LatticePolygon turned{{6, -3}, {15, 6}, {6, 15}, {-3, 6}};
    const reference::LatticePolygon wide{{-2, 3}, {14, 2}, {14, 10}, {-2, 9}};
    std::vector<Operand> operands{reference::prism(square, 0, 4), reference::prism(turned, 4, 8),
                                  reference::prism(wide, 0, 4), reference::prism(wide, 4, 7),
                                  reference::box({2, 2, 4}, {10, 11, 9})};
    const auto leaf = [](std::size_t i) { return Expression::leaf(i); };
    const auto node = [](Kind kind, const std::vector<Expression>& terms) {
        return Expression::node(kind, terms);
    };
    Count count;
    for (const Expression& formula :
         {of_all(Kind::Union, 5),
          node(Kind::Union, {node(Kind::Difference, {leaf(0), leaf(3)}),
                             node(Kind::Difference, {leaf(1), leaf(2)}), leaf(4)}),
          node(Kind::Difference, {node(Kind::Union, {leaf(0), leaf(1)}), leaf(2), leaf(3)}),
          node(Kind::Union, {node(Kind::Intersection, {leaf(0), leaf(2)}),
                             node(Kind::Intersection, {leaf(1), leaf(3)})}),
          node(Kind::Union, {node(Kind::Difference, {leaf(2), leaf(0)}),
                             node(Kind::Difference, {leaf(4), leaf(1)}), leaf(3)})})
        for (std::size_t turns = 0; turns < 3; ++turns) {
            std::vector<Operand> all;
            for (const Operand& o : operands) all.push_back(reference::axes_rotated(o, turns));
            expect_agreement(all, formula, count);
            expect_agreement(all, formula, count, &trisect::detail::evaluate_many_with_sheets);
        }
    EXPECT_EQ(count.without_tree, 30);
    EXPECT_GT(count.with_sheets, 5);
    EXPECT_EQ(count.by_tree, 0);
}

// The empty set and whole space are no operands.
TEST(ManyMeshes, ConstantsAreLeftOut) {
    std::vector<trisect::Solid> solids;
    for (const std::int64_t x : {0, 3, 6})
        solids.push_back(
            engines::solid(reference::box({x, 0, 0}, {x + 4, 4, 4}), trisect::Embedding::Assume));
    const trisect::Expression all = trisect::Expression::any_of({solids[0], solids[1], solids[2]});
    const auto left = trisect::detail::translate_without_constants((all | trisect::Solid()) &
                                                                   trisect::Solid::whole_space());
    EXPECT_EQ(left.slots.size(), 3U);
    EXPECT_EQ(trisect::detail::translate_without_constants(trisect::Solid()).slots.size(), 1U);
    EXPECT_EQ(trisect::volume(trisect::evaluate(all | trisect::Solid())), 160);
    EXPECT_TRUE(trisect::evaluate(all & trisect::Solid()).is_empty());
    EXPECT_TRUE(trisect::evaluate(all | trisect::Solid::whole_space()).is_whole_space());
}

// Copies along an axis, parts on top of each other, tools flush with what they cut.
TEST(ManyMeshes, InSpecialPositionByAnyThread) {
    std::vector<Operand> stack;
    std::vector<Operand> copies;
    for (std::int64_t i = 0; i < 5; ++i) {
        stack.push_back(reference::box({0, 0, 3 * ((7 * i) % 5)}, {8, 8, 3 * ((7 * i) % 5) + 3}));
        copies.push_back(
            reference::translated(reference::prism({{0, 0}, {9, 1}, {4, 8}}, 0, 9), {0, 0, i}));
    }
    expect_union(stack);
    expect_union(copies);
}

// Of radius `radius`, turned and moved.
trisect::Solid sphere(double radius, double turn, double move) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(radius, 2);
    for (trisect::Point3d& p : mesh.points)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double angle = turn * (1 + 0.37 * static_cast<double>(axis));
            double& x = p[axis];
            double& y = p[(axis + 1) % 3];
            const double turned = std::cos(angle) * x - std::sin(angle) * y;
            y = std::sin(angle) * x + std::cos(angle) * y + move;
            x = turned;
        }
    return trisect::Solid::from_mesh(mesh);
}

TEST(ManyMeshes, CornerByCornerLikeCells) {
    Count count;
    for (const int n : {3, 4, 7, 12}) {
        SCOPED_TRACE(n);
        std::vector<trisect::Solid> equal;
        std::vector<trisect::Solid> nested;
        std::vector<trisect::Solid> apart;
        for (int i = 0; i < n; ++i) {
            equal.push_back(sphere(1 + 0.01 * (i * 7 % n) / n, 0.3 + i, 0));
            nested.push_back(sphere(1 + 0.1 * i, 0.3 + i, 0));
            apart.push_back(sphere(1, 0.3 + i, 0.5 * i));
        }
        for (const auto& solids : {equal, nested, apart}) {
            expect_same_as_cells(trisect::Expression::any_of(solids), count);
            expect_same_as_cells(trisect::Expression::all_of(solids), count);
            expect_same_as_cells(
                solids[0] - trisect::Expression::any_of(std::span(solids).subspan(1)), count);
            expect_same_as_cells(~trisect::Expression::any_of(solids), count);
            const std::size_t half = solids.size() / 2;
            const auto first = std::span(solids).first(half);
            const auto last = std::span(solids).subspan(half);
            expect_same_as_cells(
                trisect::Expression::any_of(first) - trisect::Expression::all_of(last), count);
            expect_same_as_cells(
                trisect::Expression::any_of(first) & trisect::Expression::any_of(last), count);
        }
    }
    EXPECT_EQ(count.without_tree, count.tried);
}

std::vector<trisect::Point3d> sorted_points(const SolidState& state) {
    std::vector<trisect::Point3d> points = trisect::detail::assemble_mesh(state).points;
    std::ranges::sort(points);
    return points;
}

// Solids within each other that stand on one plane: the larger ones are moved out of the smaller
// ones, so that nothing crosses and each step leaves what it has of one of them.
TEST(ManyMeshes, NestedOnOnePlaneDoNotCross) {
    std::vector<trisect::Solid> solids;
    for (int i = 0; i < 9; ++i) {
        const double size = 20 - 2 * (i * 4 % 9);
        solids.push_back(
            trisect::Solid::from_mesh(trisect::make_box({-size, -size, 0}, {size, size, size})));
    }
    const auto rest = std::span(solids).subspan(1);
    for (const trisect::Expression& e :
         {trisect::Expression::any_of(solids), trisect::Expression::all_of(solids),
          solids[0] & trisect::Expression::any_of(rest),
          trisect::Expression::any_of(rest) - solids[0]}) {
        trisect::detail::EvaluateStats stats;
        const auto state = without_tree(e, 1, &stats);
        ASSERT_NE(state, nullptr);
        EXPECT_EQ(stats.pairs_cutting, 0U);
        EXPECT_EQ(engines::open_edge(trisect::detail::assemble_mesh(*state)), "");
        EXPECT_EQ(sorted_points(*state), sorted_points(*trisect::detail::state_of(by_cells(e))));
    }
}

// Whichever thread makes them.
TEST(ManyMeshes, ParallelPairsGiveTheSame) {
    std::vector<trisect::Solid> solids;
    for (int i = 0; i < 12; ++i) solids.push_back(sphere(1 + 0.05 * (i % 3), 0.3 + i, 0.02 * i));
    for (const trisect::Expression& e :
         {trisect::Expression::any_of(solids), trisect::Expression::all_of(solids),
          trisect::Expression::any_of(std::span(solids).first(5)) &
              trisect::Expression::any_of(std::span(solids).subspan(5))}) {
        const auto alone = without_tree(e);
        ASSERT_NE(alone, nullptr);
        const trisect::PolygonMesh expected = trisect::detail::assemble_mesh(*alone);
        for (const std::uint32_t threads : {2U, 5U}) {
            const auto state = without_tree(e, threads);
            ASSERT_NE(state, nullptr);
            const trisect::PolygonMesh mesh = trisect::detail::assemble_mesh(*state);
            EXPECT_EQ(mesh.corners, expected.corners);
            EXPECT_TRUE(mesh.points == expected.points);
        }
    }
}

}  // namespace
}  // namespace many_meshes_test
