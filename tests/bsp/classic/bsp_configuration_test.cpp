// SPDX-License-Identifier: Apache-2.0
//
// Booleans by configuration: every way in which two solids can touch.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/bsp_merge.h>
#include <trisect/bsp/classic/bsp_assembly.h>
#include <trisect/bsp/classic/bsp_boundary.h>

#include "meshes.h"
#include "support/lattice_arithmetic.h"

namespace trisect {
namespace {

constexpr BooleanRule unite = BooleanRule::set_union();
constexpr BooleanRule intersect_sets = BooleanRule::set_intersection();
constexpr BooleanRule subtract = BooleanRule::set_difference();
constexpr BooleanRule exclude = BooleanRule::symmetric_difference();

struct Result {
    ExactRational volume;
    Brep brep;
    BrepCounts counts;
};

Result evaluate(BooleanRule rule, const LatticeMesh& a, const LatticeMesh& b) {
    const auto fragments = boundary_of(merge(build_bsp(a), build_bsp(b), rule));
    Result r{enclosed_volume(fragments), brep_from_fragments(fragments, {}), {}};
    r.counts = r.brep.counts();
    return r;
}

void expect_counts(const Result& r, std::size_t vertices, std::size_t edges, std::size_t faces,
                   std::size_t shells) {
    EXPECT_EQ(r.counts.vertices, vertices);
    EXPECT_EQ(r.counts.edges, edges);
    EXPECT_EQ(r.counts.faces, faces);
    EXPECT_EQ(r.counts.shells, shells);
}

const LatticeMesh cube = test::box({0, 0, 0}, {4, 4, 4});

/// Solids that have no inner point in common with the cube.
void expect_only_touching(const LatticeMesh& other, std::size_t vertex_contacts,
                          std::size_t edge_contacts, const LatticeMesh& first = cube) {
    const ExactRational va = test::volume(first);
    const ExactRational vb = test::volume(other);
    const Result sum = evaluate(unite, first, other);
    EXPECT_EQ(sum.volume, va + vb);
    EXPECT_EQ(sum.brep.vertex_contact_count(), vertex_contacts);
    EXPECT_EQ(sum.brep.edge_contact_count(), edge_contacts);
    EXPECT_TRUE(evaluate(intersect_sets, first, other).brep.is_empty());
    EXPECT_EQ(evaluate(subtract, first, other).volume, va);
    EXPECT_EQ(evaluate(exclude, first, other).volume, va + vb);
}

TEST(BspConfiguration, Disjoint) {
    expect_only_touching(test::box({5, 0, 0}, {8, 3, 3}), 0, 0);
    expect_counts(evaluate(unite, cube, test::box({5, 0, 0}, {8, 3, 3})), 16, 24, 12, 2);
}

TEST(BspConfiguration, VertexOnVertex) {
    expect_only_touching(test::box({4, 4, 4}, {6, 6, 6}), 1, 0);
    expect_counts(evaluate(unite, cube, test::box({4, 4, 4}, {6, 6, 6})), 16, 24, 12, 2);
}

TEST(BspConfiguration, VertexOnEdge) {
    expect_only_touching(test::tetrahedron({2, 4, 4}, {1, 6, 7}, {3, 6, 8}, {2, 8, 7}), 1, 0);
}

// A face does not know what touches it from outside between its edges: no contact is recorded.
TEST(BspConfiguration, VertexOnFace) {
    expect_only_touching(test::tetrahedron({2, 2, 4}, {1, 1, 7}, {3, 1, 7}, {2, 3, 8}), 0, 0);
}

TEST(BspConfiguration, EdgeOnEqualEdge) {
    expect_only_touching(test::box({4, 4, 0}, {6, 6, 4}), 2, 1);
    expect_counts(evaluate(unite, cube, test::box({4, 4, 0}, {6, 6, 4})), 16, 24, 12, 2);
}

TEST(BspConfiguration, EdgeOnCollinearEdge) {
    // The common part of the edges is from z = 1 to z = 4; its ends become vertices of both.
    expect_only_touching(test::box({4, 4, 1}, {6, 6, 6}), 2, 1);
    expect_only_touching(test::box({4, 4, 1}, {6, 6, 3}), 2, 1);
}

TEST(BspConfiguration, EdgesCross) {
    const LatticeMesh roof = test::tetrahedron({-2, 0, 0}, {2, 0, 0}, {0, -2, -3}, {0, 2, -3});
    const LatticeMesh keel = test::tetrahedron({0, -2, 0}, {0, 2, 0}, {-2, 0, 3}, {2, 0, 3});
    expect_only_touching(keel, 1, 0, roof);
}

TEST(BspConfiguration, EdgeOnFace) {
    const LatticeMesh keel = test::tetrahedron({1, 2, 4}, {3, 2, 4}, {2, 1, 6}, {2, 3, 6});
    expect_only_touching(keel, 0, 0);
    expect_counts(evaluate(unite, cube, keel), 12, 18, 10, 2);
}

TEST(BspConfiguration, EqualFaces) {
    const LatticeMesh next = test::box({4, 0, 0}, {9, 4, 4});
    expect_only_touching(next, 0, 0);
    expect_counts(evaluate(unite, cube, next), 8, 12, 6, 1);
}

TEST(BspConfiguration, FaceWithinFace) {
    const LatticeMesh knob = test::box({4, 1, 1}, {6, 3, 3});
    expect_only_touching(knob, 0, 0);
    const Result sum = evaluate(unite, cube, knob);
    expect_counts(sum, 16, 24, 11, 1);
    EXPECT_EQ(sum.counts.loops, 12U);  // the cube's face has a hole
    EXPECT_EQ(sum.counts.euler_characteristic(), 2);
}

TEST(BspConfiguration, FacesOverlapPartly) {
    const LatticeMesh step = test::box({4, 2, 2}, {8, 6, 6});
    expect_only_touching(step, 0, 0);
    EXPECT_EQ(evaluate(unite, cube, step).counts.euler_characteristic(), 2);
    EXPECT_EQ(evaluate(unite, cube, step).counts.faces, 12U);
}

TEST(BspConfiguration, EqualSolids) {
    expect_counts(evaluate(unite, cube, cube), 8, 12, 6, 1);
    expect_counts(evaluate(intersect_sets, cube, cube), 8, 12, 6, 1);
    EXPECT_TRUE(evaluate(subtract, cube, cube).brep.is_empty());
    EXPECT_TRUE(evaluate(exclude, cube, cube).brep.is_empty());
}

TEST(BspConfiguration, Nested) {
    const LatticeMesh inner = test::box({1, 1, 1}, {3, 3, 3});
    expect_counts(evaluate(unite, cube, inner), 8, 12, 6, 1);
    expect_counts(evaluate(intersect_sets, cube, inner), 8, 12, 6, 1);
    const Result hollow = evaluate(subtract, cube, inner);
    expect_counts(hollow, 16, 24, 12, 2);
    EXPECT_EQ(hollow.volume, ExactRational(56));
    EXPECT_TRUE(evaluate(subtract, inner, cube).brep.is_empty());
}

TEST(BspConfiguration, NestedAndFlush) {
    const LatticeMesh corner = test::box({0, 0, 0}, {2, 2, 2});
    const Result notch = evaluate(subtract, cube, corner);
    expect_counts(notch, 14, 21, 9, 1);
    EXPECT_EQ(notch.volume, ExactRational(56));
    expect_counts(evaluate(unite, cube, corner), 8, 12, 6, 1);
}

TEST(BspConfiguration, ThroughHole) {
    const Result ring = evaluate(subtract, cube, test::box({1, 1, -1}, {3, 3, 5}));
    expect_counts(ring, 16, 24, 10, 1);
    EXPECT_EQ(ring.counts.euler_characteristic(), 0);
    EXPECT_EQ(ring.volume, ExactRational(48));
}

// A hole that reaches the outline of its face in one point is part of the outline.
TEST(BspConfiguration, HoleTouchesTheOutlineInAVertex) {
    const LatticeMesh drill = test::tetrahedron({0, 0, 4}, {3, 1, 4}, {1, 3, 4}, {2, 2, 2});
    const Result pit = evaluate(subtract, cube, drill);
    EXPECT_EQ(pit.volume, test::volume(cube) - test::volume(drill));
    EXPECT_EQ(pit.counts.loops, pit.counts.faces);
    EXPECT_EQ(pit.counts.faces, 9U);
}

// Two regions of one plane that touch in a vertex are two faces.
TEST(BspConfiguration, FacesOfOnePlaneTouchInAVertex) {
    const Result sum =
        evaluate(unite, test::box({0, 0, 0}, {4, 4, 4}), test::box({4, 4, 0}, {6, 6, 4}));
    EXPECT_EQ(sum.counts.faces, 12U);
    EXPECT_EQ(sum.counts.loops, 12U);
}

/// The length that two intervals share, 0 when they only touch.
std::int64_t common(std::int64_t a0, std::int64_t a1, std::int64_t b0, std::int64_t b1) {
    return std::max<std::int64_t>(0, std::min(a1, b1) - std::max(a0, b0));
}

// All positions of small boxes around a box: every touching configuration of boxes occurs.
TEST(BspConfiguration, AllPositionsOfTwoBoxes) {
    const LatticeMesh a = test::box({0, 0, 0}, {2, 2, 2});
    const BspTree tree = build_bsp(a);
    for (const LatticePoint size :
         {LatticePoint{2, 2, 2}, LatticePoint{1, 1, 1}, LatticePoint{3, 1, 2}}) {
        for (std::int64_t i = 0; i < 343; ++i) {
            const LatticePoint at{i % 7 - 4, i / 7 % 7 - 4, i / 49 - 4};
            const BspTree other = build_bsp(test::box(at, at + size));
            const std::int64_t both = common(0, 2, at.x.to_integer(), at.x + size.x) *
                                      common(0, 2, at.y.to_integer(), at.y + size.y) *
                                      common(0, 2, at.z.to_integer(), at.z + size.z);
            const std::int64_t own = size.x * size.y * size.z;
            const auto check = [&](BooleanRule rule, std::int64_t volume) {
                const auto fragments = boundary_of(merge(tree, other, rule));
                EXPECT_EQ(enclosed_volume(fragments), ExactRational(volume));
                EXPECT_EQ(brep_from_fragments(fragments, {}).is_empty(), volume == 0);
            };
            SCOPED_TRACE(i);
            check(unite, 8 + own - both);
            check(intersect_sets, both);
            check(subtract, 8 - both);
            check(exclude, 8 + own - 2 * both);
        }
    }
}

}  // namespace
}  // namespace trisect
