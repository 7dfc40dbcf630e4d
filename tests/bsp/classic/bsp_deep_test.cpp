// SPDX-License-Identifier: Apache-2.0
//
// Trees as deep as they have nodes, on a thread with a small stack.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/bsp_merge.h>
#include <trisect/bsp/classic/bsp_boundary.h>

#include "meshes.h"
#include "support/lattice_arithmetic.h"
#include "support/small_stack.h"

namespace trisect {
namespace {

using Membership = BspTree::Membership;
using NodeId = BspTree::NodeId;

const NodeId in(BspTree::Label::In);
const NodeId out(BspTree::Label::Out);

/// Slabs 2i <= x <= 2i + 1 for i < n: every second leaf is In.
BspTree slabs(std::uint32_t n) {
    std::vector<BspTree::Node> nodes;
    for (std::uint32_t i = 0; i < 2 * n; ++i) {
        const Plane plane = Plane::axis_aligned(0, 1, i);
        const bool last = i + 1 == 2 * n;
        nodes.push_back({plane, i % 2 == 0 ? out : in, last ? out : NodeId(i + 1)});
    }
    return BspTree(std::move(nodes));
}

/// A prism over a polygon with corners on a parabola: convex, all faces different.
std::vector<ConvexPolygon> parabolic_prism(std::int64_t n, std::int64_t height) {
    std::vector<LatticePoint> base;
    for (std::int64_t i = -n; i <= n; ++i) base.push_back({i, i * i, 0});
    std::vector<ConvexPolygon> faces;
    for (std::size_t i = 0; i < base.size(); ++i) {
        const LatticePoint up{0, 0, height};
        const LatticePoint a = base[i];
        const LatticePoint b = base[(i + 1) % base.size()];
        const std::vector<LatticePoint> wall{a, b, b + up, a + up};
        faces.push_back(ConvexPolygon::from_corners(Plane::through(a, b, b + up), wall));
    }
    std::vector<LatticePoint> top;
    for (const LatticePoint& p : base) top.push_back(p + LatticePoint{0, 0, height});
    std::vector<LatticePoint> bottom(base.rbegin(), base.rend());
    const Plane ceiling = Plane::axis_aligned(2, 1, height);
    const Plane floor = Plane::axis_aligned(2, 1, 0).flipped();
    faces.insert(faces.begin(), ConvexPolygon::from_corners(floor, bottom));
    faces.insert(faces.begin(), ConvexPolygon::from_corners(ceiling, top));
    return faces;
}

TEST(BspDeep, ListsOfManyPlanes) {
    EXPECT_EQ(test::run_with_small_stack([] {
                  const BspTree tree = slabs(50000);
                  EXPECT_EQ(tree.depth(), 100000U);
                  EXPECT_EQ(tree.classify(LatticePoint{70001, 0, 0}), Membership::OnBoundary);
                  EXPECT_EQ(tree.complement().depth(), 100000U);
                  EXPECT_EQ(tree.reduced().depth(), 100000U);
                  tree.validate();
              }),
              "");
}

TEST(BspDeep, MergingLists) {
    EXPECT_EQ(
        test::run_with_small_stack([] {
            const BspTree tree = slabs(400);
            const BspTree slice = build_bsp(test::box({5, 0, 0}, {700, 10, 10}));
            const BspTree cut = merge(tree, slice, BooleanRule::set_intersection());
            EXPECT_EQ(enclosed_volume(boundary_of(cut)), ExactRational(34700));
            EXPECT_TRUE(is_same_set(merge(slice, tree, BooleanRule::set_intersection()), cut));
            EXPECT_TRUE(merge(tree, tree, BooleanRule::set_difference()).is_constant());
        }),
        "");
}

TEST(BspDeep, ConvexSolidIsAList) {
    EXPECT_EQ(
        test::run_with_small_stack([] {
            const BspTree tree = build_bsp(parabolic_prism(2000, 10), {1, 8});
            EXPECT_EQ(tree.depth(), 4003U);
            EXPECT_EQ(tree.classify(LatticePoint{0, 1, 5}), Membership::Inside);
            EXPECT_EQ(tree.classify(LatticePoint{17, 289, 5}), Membership::OnBoundary);
            EXPECT_EQ(tree.classify(LatticePoint{17, 288, 5}), Membership::Outside);
            EXPECT_EQ(tree.complement().classify(LatticePoint{17, 288, 5}), Membership::Inside);
        }),
        "");
}

}  // namespace
}  // namespace trisect
