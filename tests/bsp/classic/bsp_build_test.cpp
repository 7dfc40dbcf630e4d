// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/bsp_build.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/bsp/classic/bsp_boundary.h>
#include <trisect/bsp/classic/bsp_sections.h>
#include <trisect/kernel/error.h>

#include "membership_oracle.h"
#include "meshes.h"
#include "support/lattice_arithmetic.h"

namespace trisect {
namespace {

using Membership = BspTree::Membership;

bool every_plane_cuts_its_cell(const BspTree& tree) {
    const std::vector<ConvexPolygon> sections = cell_sections(tree);
    return std::none_of(sections.begin(), sections.end(),
                        [](const ConvexPolygon& s) { return s.is_empty(); });
}

TEST(BspBuild, NoPolygonIsTheEmptySet) {
    EXPECT_TRUE(build_bsp(LatticeMesh{}).is_constant());
    EXPECT_EQ(build_bsp(LatticeMesh{}).classify(LatticePoint{}), Membership::Outside);
}

TEST(BspBuild, BoxHasSixPlanes) {
    const BspTree tree = build_bsp(test::box({0, 0, 0}, {4, 6, 8}));
    EXPECT_EQ(tree.nodes().size(), 6U);
    EXPECT_EQ(tree.classify(LatticePoint{1, 1, 1}), Membership::Inside);
    EXPECT_EQ(tree.classify(LatticePoint{0, 3, 3}), Membership::OnBoundary);
    EXPECT_EQ(tree.classify(LatticePoint{0, 0, 3}), Membership::OnBoundary);
    EXPECT_EQ(tree.classify(LatticePoint{4, 6, 8}), Membership::OnBoundary);
    EXPECT_EQ(tree.classify(LatticePoint{0, 3, 9}), Membership::Outside);
    EXPECT_EQ(enclosed_volume(boundary_of(tree)), ExactRational(192));
}

TEST(BspBuild, InwardBoundaryIsTheComplement) {
    const LatticeMesh inward = test::turned_inside_out(test::box({0, 0, 0}, {4, 4, 4}));
    const BspTree tree = build_bsp(inward);
    EXPECT_EQ(tree.classify(LatticePoint{2, 2, 2}), Membership::Outside);
    EXPECT_EQ(tree.classify(LatticePoint{5, 5, 5}), Membership::Inside);
    EXPECT_EQ(enclosed_volume(boundary_of(tree)), ExactRational(-64));
}

// Opposite coplanar faces in one cell: two boxes on opposite sides of the plane x = 4.
TEST(BspBuild, CoplanarFacesOfBothOrientationsAreToldApart) {
    const LatticeMesh mesh =
        test::joined(test::box({0, 0, 0}, {4, 4, 4}), test::box({4, 6, 0}, {8, 10, 4}));
    const BspTree tree = build_bsp(mesh);
    for (std::int64_t x = -1; x <= 9; ++x)
        for (std::int64_t y = -1; y <= 11; ++y)
            EXPECT_EQ(tree.classify(LatticePoint{x, y, 2}),
                      test::brute_force_membership(mesh, {x, y, 2}))
                << x << " " << y;
}

TEST(BspBuild, CavitiesAndNestedShells) {
    const LatticeMesh mesh =
        test::joined(test::joined(test::box({0, 0, 0}, {12, 12, 12}),
                                  test::turned_inside_out(test::box({2, 2, 2}, {10, 10, 10}))),
                     test::box({4, 4, 4}, {8, 8, 8}));
    const BspTree tree = build_bsp(mesh);
    EXPECT_TRUE(every_plane_cuts_its_cell(tree));
    EXPECT_EQ(enclosed_volume(boundary_of(tree)), ExactRational(1728 - 512 + 64));
    for (std::int64_t x = -1; x <= 13; ++x)
        EXPECT_EQ(tree.classify(LatticePoint{x, 6, 5}),
                  test::brute_force_membership(mesh, {x, 6, 5}))
            << x;
}

TEST(BspBuild, EveryChoiceOfPlanesGivesTheSameSet) {
    const LatticeMesh mesh = test::joined(test::sphere({0, 0, 0}, 1000, 8, 5),
                                          test::sphere({1500, 900, 300}, 700, 7, 4));
    for (const std::uint32_t candidates : {1U, 2U, 50U}) {
        for (const std::uint32_t weight : {0U, 8U, 1000U}) {
            const BspTree tree = build_bsp(mesh, {candidates, weight});
            EXPECT_TRUE(every_plane_cuts_its_cell(tree));
            EXPECT_EQ(enclosed_volume(boundary_of(tree)), test::volume(mesh));
        }
    }
}

// Near and on the surface, where classification is hard: corners, midpoints of edges, neighbours.
TEST(BspBuild, TenThousandPointsAgreeWithBruteForce) {
    const LatticeMesh mesh =
        test::joined(test::joined(test::sphere({0, 0, 0}, 900, 12, 8),
                                  test::turned_inside_out(test::sphere({50, 30, -40}, 500, 8, 6))),
                     test::sphere({1400, 800, 300}, 640, 9, 6));
    const BspTree tree = build_bsp(mesh);
    std::mt19937 random(7);
    const auto uniform = [&](int lo, int hi) {
        return std::int64_t{std::uniform_int_distribution<int>(lo, hi)(random)};
    };
    std::array<int, 3> seen{};
    for (int i = 0; i < 10000; ++i) {
        LatticePoint p{uniform(-1000, 2200), uniform(-1000, 1600), uniform(-1000, 1000)};
        if (i % 2 == 0) {
            const auto& t = mesh.triangles[static_cast<std::size_t>(
                uniform(0, static_cast<int>(mesh.triangles.size()) - 1))];
            const LatticePoint a = mesh.points[t[0]];
            const LatticePoint b = mesh.points[t[static_cast<std::size_t>(uniform(0, 2))]];
            p = {(a.x + b.x) / 2 + uniform(0, 1) - uniform(0, 1), (a.y + b.y) / 2, (a.z + b.z) / 2};
        }
        const Membership expected = test::brute_force_membership(mesh, p);
        ++seen[static_cast<std::size_t>(static_cast<int>(expected) + 1)];
        ASSERT_EQ(tree.classify(p), expected) << p.x << " " << p.y << " " << p.z;
        ASSERT_EQ(tree.classify(Point(p)), expected);
    }
    for (const int n : seen) EXPECT_GT(n, 300);
}

TEST(BspSections, SpaceSectionsReachTheCube) {
    EXPECT_EQ(section_of_space(Plane::axis_aligned(2, 1, 0)).size(), 4U);
    EXPECT_EQ(section_of_space(Plane::axis_aligned(1, 1, coordinate_limit - 1)).size(), 4U);
    const Plane diagonal = Plane::through({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    EXPECT_EQ(section_of_space(diagonal).size(), 6U);
    EXPECT_TRUE(section_of_space(diagonal).is_consistent());
    EXPECT_TRUE(section_of_space(diagonal.flipped()).is_consistent());
}

TEST(BspSections, APlaneThatMissesItsCellHasNone) {
    using NodeId = BspTree::NodeId;
    const NodeId in(BspTree::Label::In);
    const NodeId out(BspTree::Label::Out);
    const BspTree tree({{Plane::axis_aligned(0, 1, 0), NodeId(std::uint32_t{1}), out},
                        {Plane::axis_aligned(0, 1, 5), in, out}});
    const auto sections = cell_sections(tree);
    EXPECT_FALSE(sections[0].is_empty());
    EXPECT_TRUE(sections[1].is_empty());
}

TEST(BspSections, APlaneInTheBorderOfItsCellHasNone) {
    using NodeId = BspTree::NodeId;
    const NodeId in(BspTree::Label::In);
    const NodeId out(BspTree::Label::Out);
    const BspTree tree({{Plane::axis_aligned(0, 1, 5), NodeId(std::uint32_t{1}), out},
                        {Plane::axis_aligned(0, 2, 10).flipped(), in, out}});
    EXPECT_TRUE(cell_sections(tree)[1].is_empty());
    EXPECT_THROW((void)boundary_of(tree), Error);
}

}  // namespace
}  // namespace trisect
