// SPDX-License-Identifier: Apache-2.0
//
// What an operation does not touch is shared with its operand, node by node, and not visited.

#include <gtest/gtest.h>

#include <unordered_set>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>

#include "engines/evaluate_stats.h"

namespace {

using trisect::evaluate;
using trisect::Solid;
using trisect::detail::CellNode;
using trisect::test::EvaluateStats;

using Nodes = std::unordered_set<const CellNode*>;

void collect(const CellNode* node, Nodes& out) {
    std::vector<const CellNode*> open{node};
    while (!open.empty()) {
        const CellNode* n = open.back();
        open.pop_back();
        if (!out.insert(n).second || n->is_leaf()) continue;
        for (int i = 0; i < 2; ++i) open.push_back(n->child(i).node.get());
    }
}

Nodes nodes_of(const Solid& s) {
    Nodes out;
    collect(trisect::detail::state_of(s)->root().node.get(), out);
    return out;
}

std::size_t shared_nodes(const Solid& a, const Solid& b) {
    const Nodes of_a = nodes_of(a);
    std::size_t n = 0;
    for (const CellNode* node : nodes_of(b)) n += of_a.contains(node) ? 1 : 0;
    return n;
}

Solid ball() { return Solid::from_mesh(trisect::make_icosphere(100, 5)); }  // 20,480 triangles

Solid small_box(double x, double y, double z) {
    return Solid::from_mesh(trisect::make_box({x, y, z}, {x + 2, y + 3, z + 1}));
}

// With a tree, so that it is not compared as a whole.
Solid ball_with_tree() {
    Solid out = ball();
    out.refine();
    return out;
}

// One that has been cut.
Solid refined_ball() {
    return evaluate(ball_with_tree() -
                    Solid::from_mesh(trisect::make_box({50, -20, -20}, {120, 20, 20})));
}

TEST(CellSharing, ATouchlessOperandIsSharedWhole) {
    const Solid a = ball_with_tree();
    EvaluateStats stats;
    const Solid rest = evaluate(a - small_box(500, 500, 500), {}, &stats);
    EXPECT_GE(stats.shared_cells, 1U);
    EXPECT_EQ(stats.mixed_leaves, 0U);
    EXPECT_LT(stats.cells, 20U);
    EXPECT_EQ(trisect::exact_volume(rest.to_brep()), trisect::exact_volume(a.to_brep()));
}

TEST(CellSharing, ATreeSharesItsNodesWithWhatIsLeftOfIt) {
    const Solid a = refined_ball();
    EvaluateStats stats;
    const Solid b = evaluate(a - small_box(-400, 0, 0), {}, &stats);
    EXPECT_EQ(stats.mixed_leaves, 0U);
    EXPECT_GE(stats.shared_cells, 1U);
    const std::size_t all = nodes_of(a).size();
    EXPECT_GE(shared_nodes(a, b) * 10, all * 9);
}

TEST(CellSharing, ACutInARefinedPartReadsWhatIsNearIt) {
    const Solid part = ball();
    const Solid plain = evaluate(ball() - small_box(98, 0, 0));
    part.refine();
    EvaluateStats stats;
    const Solid cut = evaluate(part - small_box(98, 0, 0), {}, &stats);
    EXPECT_LT(stats.listed_polygons, 2000U);
    EXPECT_EQ(trisect::exact_volume(cut.to_brep()), trisect::exact_volume(plain.to_brep()));
    EXPECT_EQ(cut.to_brep().counts().faces, plain.to_brep().counts().faces);
}

TEST(CellSharing, ASmallCutCopiesOnlyThePathToIt) {
    const Solid a = refined_ball();
    const std::size_t all = nodes_of(a).size();
    EvaluateStats stats;
    const Solid b = evaluate(a - small_box(0, 0, 98.5), {}, &stats);
    EXPECT_GT(stats.mixed_leaves, 0U);
    EXPECT_GE(shared_nodes(a, b) * 10, all * 8);
    EXPECT_LT(trisect::volume(b.to_brep()), trisect::volume(a.to_brep()));
}

TEST(CellSharing, TheSecondCutAtAPlaceVisitsFewCells) {
    Solid a = evaluate(refined_ball() - small_box(0, 0, 98.5));
    EvaluateStats stats;
    a = evaluate(a - small_box(0.5, 0.5, 98), {}, &stats);
    EXPECT_LT(stats.cells, 300U);
    EXPECT_LT(stats.mixed_leaves, 30U);
    EXPECT_LT(stats.depth, 100);
}

std::size_t fragments_of(const Solid& s) {
    std::size_t n = 0;
    for (const CellNode* node : nodes_of(s)) {
        if (!node->is_leaf()) continue;
        for (const auto& r : node->polygons()) n += r.fragment != nullptr ? 1 : 0;
    }
    return n;
}

// Cavities cut no facet. The first one leaves many small leaves above it, which become one beside
// the second one.
TEST(CellSharing, FacetsAcrossWallsStayWholeWhenLeavesBecomeOne) {
    trisect::EvaluateOptions small_leaves;
    small_leaves.leaf_polygons = 12;
    const Solid first = small_box(-1, -1.5, 97);
    const Solid second = small_box(1.5, -1.5, 97);
    const Solid a = evaluate(ball_with_tree() - first, small_leaves);
    const Solid b = evaluate(a - second);
    EXPECT_EQ(fragments_of(a), 0U);
    EXPECT_LT(nodes_of(b).size(), nodes_of(a).size());
    EXPECT_EQ(fragments_of(b), 0U);
    const Solid cold = evaluate(ball() - (first | second));
    EXPECT_EQ(trisect::exact_volume(b.to_brep()), trisect::exact_volume(cold.to_brep()));
    EXPECT_EQ(b.to_brep().counts().faces, cold.to_brep().counts().faces);
}

TEST(CellSharing, ComplementsShareTheTree) {
    const Solid a = refined_ball();
    const Solid outside = evaluate(~a);
    EXPECT_EQ(shared_nodes(a, outside), nodes_of(a).size());
    EXPECT_EQ(trisect::detail::state_of(evaluate(~outside))->root().node,
              trisect::detail::state_of(a)->root().node);
}

TEST(CellSharing, UnionWithTheEmptySetIsTheSameTree) {
    const Solid a = refined_ball();
    EXPECT_EQ(trisect::detail::state_of(evaluate(a | Solid()))->root().node,
              trisect::detail::state_of(a)->root().node);
    EXPECT_EQ(trisect::detail::state_of(evaluate(a & Solid::whole_space()))->root().node,
              trisect::detail::state_of(a)->root().node);
    EXPECT_TRUE(evaluate(a & Solid()).is_empty());
}

TEST(CellSharing, AChainOfCutsThatRemovesEverythingIsEmpty) {
    Solid a = Solid::from_mesh(trisect::make_box({3, 1, 1}));
    for (int i = 0; i < 3; ++i) {
        const double x = i;
        trisect::EvaluateOptions options;
        options.leaf_polygons = 3;
        a = evaluate(a - Solid::from_mesh(trisect::make_box({x, 0, 0}, {x + 1, 1, 1})), options);
    }
    EXPECT_TRUE(a.to_brep().is_empty());
    EXPECT_TRUE(a.is_empty());
}

}  // namespace
