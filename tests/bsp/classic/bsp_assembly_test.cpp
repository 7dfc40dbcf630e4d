// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/classic/bsp_assembly.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/bsp_merge.h>
#include <trisect/bsp/classic/bsp_boundary.h>
#include <trisect/kernel/error.h>

#include "meshes.h"

namespace trisect {
namespace {

/// Invariants that the faces themselves show: corners on their plane, edges between different
/// points, no two neighbours in one plane.
void expect_maximal_faces(const Brep& brep) {
    for (const HalfedgeId h : brep.halfedges()) {
        const Plane& plane = brep.plane(brep.face(h));
        const Plane& other = brep.plane(brep.face(brep.twin(h)));
        EXPECT_EQ(side_of(brep.point(brep.origin(h)), plane), Side::On);
        EXPECT_FALSE(brep.point(brep.origin(h)) == brep.point(brep.target(h)));
        EXPECT_FALSE(is_same_plane(plane, other) && same_orientation(plane, other));
    }
}

TEST(BspAssembly, NothingGivesTheEmptyBrep) { EXPECT_TRUE(brep_from_fragments({}, {}).is_empty()); }

TEST(BspAssembly, TrianglesOfABoxBecomeSixFaces) {
    const auto fragments = convex_polygons(test::box({0, 0, 0}, {4, 6, 8}));
    const Brep brep = brep_from_fragments(fragments, {-8});
    EXPECT_EQ(brep.lattice().exponent, -8);
    EXPECT_EQ(brep.counts().faces, 6U);
    EXPECT_EQ(brep.counts().edges, 12U);
    EXPECT_EQ(brep.counts().vertices, 8U);
    expect_maximal_faces(brep);
}

TEST(BspAssembly, AnOpenBoundaryIsRefused) {
    auto fragments = convex_polygons(test::box({0, 0, 0}, {4, 6, 8}));
    fragments.pop_back();
    EXPECT_THROW((void)brep_from_fragments(fragments, {}), Error);
}

// However the boundary is cut, the same faces come out.
TEST(BspAssembly, FacesDoNotDependOnTheCuts) {
    const LatticeMesh mesh = test::joined(test::sphere({0, 0, 0}, 1000, 9, 6),
                                          test::sphere({1500, 900, 300}, 650, 7, 4));
    const BrepCounts whole = brep_from_fragments(convex_polygons(mesh), {}).counts();
    for (const std::uint32_t candidates : {1U, 3U, 9U}) {
        const auto fragments = boundary_of(build_bsp(mesh, {candidates, 0}));
        EXPECT_GT(fragments.size(), mesh.triangles.size());
        EXPECT_EQ(brep_from_fragments(fragments, {}).counts(), whole);
    }
}

TEST(BspAssembly, RandomResultsAreClosedAndMaximal) {
    std::mt19937 random(30);
    for (int i = 0; i < 100; ++i) {
        const BspTree a = build_bsp(test::random_tetrahedron(random, 6));
        const BspTree b = build_bsp(test::random_box(random, 6));
        const BspTree c = build_bsp(test::random_tetrahedron(random, 6));
        const BspTree mixed = merge(merge(a, b, BooleanRule::symmetric_difference()), c,
                                    BooleanRule::symmetric_difference());
        const auto fragments = boundary_of(mixed);
        const Brep brep = brep_from_fragments(fragments, {});
        expect_maximal_faces(brep);
        // The same set from another tree.
        const auto again = boundary_of(build_bsp(fragments, {2, 8}));
        EXPECT_EQ(brep_from_fragments(again, {}).counts(), brep.counts());
    }
}

}  // namespace
}  // namespace trisect
