// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/convex/hull_tree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/hierarchies/convex/convex_parts.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

void expect_parts(const InterferenceModel& m, const std::vector<ConvexPart>& parts) {
    std::vector<int> used(m.triangle_count(), 0);
    for (const ConvexPart& part : parts)
        for (const std::uint32_t t : part.triangles) {
            ++used[t];
            const Plane& plane = m.brep().plane(trisect::detail::data_of(m).triangles[t].face);
            for (const std::uint32_t u : part.triangles)
                for (const VertexId v : trisect::detail::data_of(m).triangles[u].vertex)
                    EXPECT_NE(side_of(m.brep().point(v), plane), Side::Above);
        }
    EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](int n) { return n == 1; }));
}

void expect_tree(const InterferenceModel& m, const HullTree& tree) {
    for (const HullTree::Node& n : tree.nodes())
        for (const std::uint32_t t : tree.triangles(n))
            for (const VertexId v : trisect::detail::data_of(m).triangles[t].vertex)
                for (std::size_t f = 0; f < n.hull.face_count(); ++f)
                    ASSERT_NE(side_of(m.brep().point(v), n.hull.plane(f)), Side::Above);
    EXPECT_EQ(tree.triangles(tree.nodes().front()).size(), m.triangle_count());
    for (const HullTree::Node& n : tree.nodes()) {
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < n.child_count; ++i)
            count += tree.nodes()[n.first_child + i].triangle_count;
        if (!n.is_leaf()) {
            EXPECT_EQ(count, n.triangle_count);
        }
    }
}

TEST(ConvexParts, ConvexSolidsAreOnePart) {
    for (const auto& mesh : {make_box({0, 0, 0}, {3, 4, 5}), make_icosphere(1, 2)}) {
        const InterferenceModel m(Solid::from_mesh(mesh));
        const auto parts = convex_parts(m);
        expect_parts(m, parts);
        EXPECT_EQ(parts.size(), 1U);
    }
}

TEST(ConvexParts, ALHasThreeAndATorusSome) {
    const Solid cube = Solid::from_mesh(make_box({0, 0, 0}, {4, 4, 4}));
    const Solid notch = Solid::from_mesh(make_box({2, 2, -1}, {5, 5, 5}));
    const InterferenceModel l(evaluate(cube - notch));
    const auto parts = convex_parts(l);
    expect_parts(l, parts);
    EXPECT_LE(parts.size(), 3U);
    EXPECT_GE(parts.size(), 2U);
    const InterferenceModel torus(Solid::from_mesh(make_torus(4, 1, 24, 12)));
    const auto many = convex_parts(torus);
    expect_parts(torus, many);
    EXPECT_LT(many.size(), torus.triangle_count() / 4);
}

TEST(HullTree, HullsContainTheirTrianglesForAllBranchings) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        reference::Random random(seed);
        // Results of booleans have corners that are no lattice points.
        const InterferenceModel m(engines::solid(reference::random_embedded_solid(random)));
        if (m.is_empty()) continue;
        expect_parts(m, convex_parts(m));
        for (const std::uint32_t branching : {2U, 4U, 8U, 16U}) {
            const HullTree tree(m, {branching, 2});
            expect_tree(m, tree);
            for (const HullTree::Node& n : tree.nodes()) {
                EXPECT_LE(n.child_count, branching);
            }
        }
    }
    const InterferenceModel m(Solid::from_mesh(make_box({0, 0, 0}, {1, 1, 1})));
    EXPECT_THROW(HullTree(m, {1, 4}), UsageError);
    EXPECT_THROW(HullTree(m, {2, 0}), UsageError);
}

TEST(HullTree, FacesThatCoverAConcavityAreNotReal) {
    const Solid cube = Solid::from_mesh(make_box({0, 0, 0}, {4, 4, 4}));
    const Solid notch = Solid::from_mesh(make_box({2, 2, -1}, {5, 5, 5}));
    const InterferenceModel l(evaluate(cube - notch));
    const HullTree tree(l);
    const HullTree::Node& root = tree.nodes().front();
    // The hull of an L: four sides are real, the slope is not, nor are both ends, which are larger
    // than the L.
    ASSERT_EQ(root.hull.face_count(), 7U);
    EXPECT_EQ(std::count(root.real_face.begin(), root.real_face.end(), true), 4);
    const InterferenceModel ball(Solid::from_mesh(make_icosphere(1, 2)));
    const HullTree all(ball);
    const HullTree::Node& top = all.nodes().front();
    EXPECT_EQ(std::count(top.real_face.begin(), top.real_face.end(), false), 0);
    EXPECT_EQ(std::count(top.real_edge.begin(), top.real_edge.end(), false), 0);
}

}  // namespace
