// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/bsp_tree.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/kernel/error.h>

namespace trisect {
namespace bsp_tree_test {
namespace {

using Label = BspTree::Label;
using Membership = BspTree::Membership;
using Node = BspTree::Node;
using NodeId = BspTree::NodeId;

constexpr NodeId in(Label::In);
constexpr NodeId out(Label::Out);
NodeId inner(std::uint32_t i) { return NodeId(i); }

Plane at(int axis, std::int64_t position) { return Plane::axis_aligned(axis, 1, position); }

TEST(BspTree, MovedFromIsTheEmptySet) {
    static_assert(std::is_nothrow_move_constructible_v<BspTree>);
    static_assert(std::is_nothrow_move_assignable_v<BspTree>);
    BspTree a = BspTree::half_space(at(0, 4));
    const BspTree taken = std::move(a);
    EXPECT_TRUE(a.is_constant());  // NOLINT(bugprone-use-after-move): that is the test
    EXPECT_EQ(a.classify(LatticePoint{1, 2, 3}), Membership::Outside);
    EXPECT_EQ(taken.classify(LatticePoint{1, 2, 3}), Membership::Inside);
    BspTree b = taken;
    a = std::move(b);
    EXPECT_EQ(a.classify(LatticePoint{1, 2, 3}), Membership::Inside);
    EXPECT_TRUE(b.is_constant());  // NOLINT(bugprone-use-after-move)
}

TEST(BspTree, ConstantsHoldAllOrNothing) {
    EXPECT_TRUE(BspTree().is_constant());
    EXPECT_EQ(BspTree().classify(LatticePoint{1, 2, 3}), Membership::Outside);
    EXPECT_EQ(BspTree(Label::In).classify(LatticePoint{1, 2, 3}), Membership::Inside);
    EXPECT_EQ(BspTree().complement().root(), in);
    EXPECT_EQ(BspTree().depth(), 0U);
    EXPECT_EQ(BspTree().node_count(), 1U);
}

TEST(BspTree, HalfSpaceIsBelowItsPlane) {
    const BspTree tree = BspTree::half_space(at(0, 5));
    EXPECT_EQ(tree.classify(LatticePoint{4, 9, 9}), Membership::Inside);
    EXPECT_EQ(tree.classify(LatticePoint{5, 9, 9}), Membership::OnBoundary);
    EXPECT_EQ(tree.classify(LatticePoint{6, 9, 9}), Membership::Outside);
    EXPECT_EQ(tree.complement().classify(LatticePoint{6, 9, 9}), Membership::Inside);
    EXPECT_EQ(tree.complement().classify(LatticePoint{5, 9, 9}), Membership::OnBoundary);
    EXPECT_EQ(tree.depth(), 1U);
    EXPECT_EQ(tree.node_count(), 3U);
    EXPECT_EQ(tree.leaf_count(), 2U);
}

TEST(BspTree, PlanePointsAreClassifiedExactly) {
    const Plane third = Plane::axis_aligned(0, 3, 1);  // x = 1/3
    const BspTree tree = BspTree::half_space(third);
    EXPECT_EQ(tree.classify(Point(Plane::axis_aligned(0, 6, 2), at(1, 0), at(2, 0))),
              Membership::OnBoundary);
    EXPECT_EQ(tree.classify(Point(Plane::axis_aligned(0, 3000001, 1000000), at(1, 0), at(2, 0))),
              Membership::Inside);
    EXPECT_EQ(tree.classify(Point(Plane::axis_aligned(0, 2999999, 1000000), at(1, 0), at(2, 0))),
              Membership::Outside);
}

// The plane x = 0 separates two equal sets: a point on it is in the middle of both.
TEST(BspTree, APlaneWithinTheSolidIsNoBoundary) {
    const BspTree tree({{at(0, 0), inner(1), inner(2)}, {at(1, 0), in, out}, {at(1, 0), in, out}});
    EXPECT_EQ(tree.classify(LatticePoint{0, -1, 0}), Membership::Inside);
    EXPECT_EQ(tree.classify(LatticePoint{0, 1, 0}), Membership::Outside);
    EXPECT_EQ(tree.classify(LatticePoint{0, 0, 0}), Membership::OnBoundary);
    EXPECT_EQ(tree.reduced().node_count(), 3U);
    EXPECT_EQ(tree.reduced().classify(LatticePoint{0, -1, 0}), Membership::Inside);
}

TEST(BspTree, ReductionDropsEqualLeavesUpToTheRoot) {
    const BspTree tree({{at(0, 0), inner(1), in}, {at(1, 0), in, inner(2)}, {at(2, 0), in, in}});
    EXPECT_TRUE(tree.reduced().is_constant());
    EXPECT_EQ(tree.reduced().root(), in);
}

TEST(BspTree, ReductionKeepsDifferentSubtrees) {
    const BspTree tree({{at(0, 0), inner(1), inner(2)}, {at(1, 0), in, out}, {at(1, 1), in, out}});
    EXPECT_EQ(tree.reduced().node_count(), 7U);
}

TEST(BspTree, MalformedNodesAreRefused) {
    const auto make = [](std::vector<Node> nodes) { return BspTree(std::move(nodes)); };
    EXPECT_THROW(make({{Plane(), in, out}}), Error);
    EXPECT_THROW(make({{at(0, 0), inner(1), out}}), Error);
    EXPECT_THROW(make({{at(0, 0), inner(0), out}}), Error);
    EXPECT_THROW(make({{at(0, 0), in, out}, {at(0, 1), in, out}}), Error);
    EXPECT_THROW(make({{at(0, 0), inner(1), inner(1)}, {at(0, 1), in, out}}), Error);
    EXPECT_TRUE(make({}).is_constant());
}

}  // namespace
}  // namespace bsp_tree_test
}  // namespace trisect
