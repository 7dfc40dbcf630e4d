// SPDX-License-Identifier: Apache-2.0
//
// The tree as a structure: sizes on known solids, walks, points given as doubles, and what goes in.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "support/breps.h"
#include "support/probes.h"

namespace trisect {
namespace {

using Leaf = MspTree::Leaf;
using Ref = MspTree::Ref;
using test::cube;
using test::rectangle;
using test::reversed;
using test::SolidSketch;

TEST(MspTree, MovedFromIsTheEmptySet) {
    static_assert(std::is_nothrow_move_constructible_v<MspTree>);
    static_assert(std::is_nothrow_move_assignable_v<MspTree>);
    MspTree a = MspTree::from_brep(cube(4));
    const MspTree taken = std::move(a);
    // NOLINTNEXTLINE(bugprone-use-after-move): that is the test
    EXPECT_EQ(a.locate(LatticePoint{1, 2, 3}), Ref::leaf(Leaf::Out));
    a.validate();
    EXPECT_GT(taken.node_count(), 0U);
    a = taken;
    EXPECT_EQ(a.node_count(), taken.node_count());
}

TEST(MspTree, EmptySet) {
    const MspTree tree;
    EXPECT_EQ(tree.locate(LatticePoint{1, 2, 3}), Ref::leaf(Leaf::Out));
    EXPECT_EQ(tree.stats().leaves[3], 1U);
    EXPECT_EQ(tree.stats().depth, 0U);
    tree.validate();
    EXPECT_EQ(MspTree::from_brep(Brep()).root(), Ref::leaf(Leaf::Out));
}

TEST(MspTree, CubeIsAChainOfSixPlanes) {
    const Brep brep = cube(8);
    const MspTree tree = MspTree::from_brep(brep);
    const MspStats stats = tree.stats();
    EXPECT_EQ(stats.nodes[3], 6U);
    EXPECT_EQ(stats.leaves[3], 7U);
    EXPECT_EQ(stats.space_depth, 6U);
    EXPECT_EQ(stats.faces, 6U);
    EXPECT_EQ(stats.polygons, 6U);
    EXPECT_EQ(stats.fragments, 6U);
    EXPECT_DOUBLE_EQ(stats.fragments_per_polygon(), 1.0);
    // Each edge is cut in the plane that comes first of its two, each vertex on one line of these.
    EXPECT_EQ(stats.nodes[2], 12U);
    EXPECT_EQ(stats.nodes[1], 8U);
    EXPECT_EQ(stats.leaves_of_kind[static_cast<std::size_t>(Leaf::OnFace)], 6U);
    EXPECT_EQ(stats.leaves_of_kind[static_cast<std::size_t>(Leaf::OnEdge)], 12U);
    EXPECT_EQ(stats.leaves_of_kind[static_cast<std::size_t>(Leaf::OnVertex)], 8U);
    EXPECT_EQ(stats.planes, 6U);
    EXPECT_GT(stats.bytes_per_face(), 0.0);
}

TEST(MspTree, NamesAreHandles) {
    const Brep brep = cube(8);
    const MspTree tree = MspTree::from_brep(brep);
    for (const VertexId v : brep.vertices()) {
        const Ref leaf = tree.locate(brep.point(v));
        ASSERT_EQ(leaf.kind(), Leaf::OnVertex);
        EXPECT_EQ(leaf.vertex(), v);
    }
    const Ref face = tree.locate(LatticePoint{8, 3, 4});
    ASSERT_EQ(face.kind(), Leaf::OnFace);
    EXPECT_GT(brep.plane(face.face()).normal(0), 0);
    const Ref edge = tree.locate(LatticePoint{8, 0, 4});
    ASSERT_EQ(edge.kind(), Leaf::OnEdge);
    const HalfedgeId h = brep.halfedge(edge.edge());
    EXPECT_EQ(brep.point(brep.origin(h)).lattice().x, 8);
    EXPECT_EQ(brep.point(brep.target(h)).lattice().y, 0);
    EXPECT_EQ(tree.locate(LatticePoint{4, 4, 4}), Ref::leaf(Leaf::In));
    EXPECT_EQ(tree.locate(LatticePoint{8, 8, 9}), Ref::leaf(Leaf::Out));
}

TEST(MspTree, WalkMeetsEveryNodeOnce) {
    const MspTree tree = MspTree::from_brep(cube(8));
    std::size_t met = 0;
    std::vector<Ref> pending{tree.root()};
    while (!pending.empty()) {
        const Ref at = pending.back();
        pending.pop_back();
        if (at.is_leaf()) continue;
        ++met;
        const MspTree::Node& node = tree.node(at);
        EXPECT_TRUE(tree.plane(node).is_valid());
        for (const Ref child : {node.below, node.on, node.above}) {
            if (!child.is_leaf()) {
                EXPECT_EQ(tree.dimension(child), tree.dimension(at) - (child == node.on ? 1 : 0));
            }
            pending.push_back(child);
        }
    }
    EXPECT_EQ(met, tree.node_count());
}

TEST(MspTree, PointsAsGivenInDoubles) {
    const Brep brep = cube(8, Lattice{-8});  // a unit of 2^-8: the side is 1/32
    const MspTree tree = MspTree::from_brep(brep);
    const double side = 0.03125;
    const auto kind = [&tree](double x, double y, double z) {
        return tree.locate(Point3d{x, y, z}).kind();
    };
    EXPECT_EQ(kind(0, 0, 0), Leaf::OnVertex);
    EXPECT_EQ(kind(side, 0, side), Leaf::OnVertex);
    EXPECT_EQ(kind(side, 0.01, 0), Leaf::OnEdge);
    EXPECT_EQ(kind(side, 0.01, 0.02), Leaf::OnFace);
    EXPECT_EQ(kind(std::nextafter(side, 0), 0.01, 0.02), Leaf::In);
    EXPECT_EQ(kind(std::nextafter(side, 1), 0.01, 0.02), Leaf::Out);
    const double tiny = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(kind(tiny, 0.01, 0.02), Leaf::In);
    EXPECT_EQ(kind(-tiny, 0.01, 0.02), Leaf::Out);
    EXPECT_EQ(kind(tiny, 0, 0), Leaf::OnEdge);
    EXPECT_EQ(kind(tiny, tiny, tiny), Leaf::In);
    const double huge = std::numeric_limits<double>::max();
    EXPECT_EQ(kind(huge, -huge, 0), Leaf::Out);
    EXPECT_THROW((void)kind(std::numeric_limits<double>::quiet_NaN(), 0, 0), UsageError);
    EXPECT_THROW((void)kind(0, std::numeric_limits<double>::infinity(), 0), UsageError);
}

TEST(MspTree, AgreesWithTheClassicTree) {
    reference::Random random(3);
    for (int i = 0; i < 30; ++i) {
        const LatticeMesh mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const BspTree classic = build_bsp(mesh);
        const MspTree tree = MspTree::from_brep(brep_from_lattice_mesh(mesh));
        for (int k = 0; k < 300; ++k) {
            const LatticePoint p{random.between(-1, 16), random.between(-1, 16),
                                 random.between(-1, 16)};
            const Leaf found = tree.locate(p).kind();
            const auto membership = found == Leaf::Out  ? BspTree::Membership::Outside
                                    : found == Leaf::In ? BspTree::Membership::Inside
                                                        : BspTree::Membership::OnBoundary;
            ASSERT_EQ(membership, classic.classify(p)) << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(MspTree, PaperBoundOnAGridOfPlates) {
    // k plates across each axis, interlocking: Θ(n^1.5) pieces are enough for orthogonal faces
    // (Paterson and Yao 1992), against n² in general.
    SolidSketch sketch;
    const std::int64_t k = 4;
    for (std::int64_t i = 0; i < k; ++i)
        for (std::int64_t j = 0; j < k; ++j) {
            sketch.box({4 * i, 4 * j, -9}, {4 * i + 1, 4 * j + 1, 99});
            sketch.box({-9, 4 * i + 2, 4 * j}, {99, 4 * i + 3, 4 * j + 1});
            sketch.box({4 * i + 2, -9, 4 * j + 2}, {4 * i + 3, 99, 4 * j + 3});
        }
    const Brep brep = sketch.build();
    const MspTree tree = MspTree::from_brep(brep);
    const MspStats stats = tree.stats();
    const auto n = static_cast<double>(stats.polygons);
    EXPECT_LE(static_cast<double>(stats.fragments), n * std::sqrt(n));
    EXPECT_EQ(test::first_difference(tree, test::answered_probes(brep, 300, 5)), "");
}

std::vector<MspPolygon> polygons_of(const Brep& brep) {
    std::vector<MspPolygon> polygons;
    for (const FaceId f : brep.faces()) {
        MspPolygon p;
        std::vector<LatticePoint> corners;
        for (const HalfedgeId h : brep.halfedges(f)) {
            corners.push_back(brep.point(brep.origin(h)).lattice());
            p.edges.push_back(brep.edge(h).index);
            p.vertices.push_back(brep.origin(h).index);
        }
        p.shape = ConvexPolygon::from_corners(brep.plane(f), corners);
        p.face = f.index;
        polygons.push_back(std::move(p));
    }
    return polygons;
}

TEST(MspTree, PolygonsInACell) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {8, 8, 8}).box({10, 0, 0}, {14, 4, 4});
    const Brep brep = sketch.build();
    const MspTree whole = MspTree::from_brep(brep);
    // Walls between lattice positions, as cells have them.
    const auto wall = [](int axis, std::int64_t position, bool upper) {
        const Plane p = Plane::axis_aligned(axis, 256, position * 256 + 127);
        return upper ? p : p.flipped();
    };
    const std::vector<Plane> walls{wall(0, 2, false), wall(0, 11, true), wall(1, -3, false),
                                   wall(1, 5, true),  wall(2, 3, false), wall(2, 12, true)};
    const MspTree cell = MspTree::from_polygons(polygons_of(brep), walls);
    cell.validate();
    EXPECT_LT(cell.stats().nodes[3], whole.stats().nodes[3]);
    for (std::int64_t x = 3; x <= 11; ++x)
        for (std::int64_t y = -2; y <= 5; ++y)
            for (std::int64_t z = 4; z <= 12; ++z) {
                const LatticePoint p{x, y, z};
                ASSERT_EQ(cell.locate(p), whole.locate(p)) << x << ' ' << y << ' ' << z;
            }
}

TEST(MspTree, PolygonsThatMissTheCell) {
    const std::vector<Plane> walls{Plane::axis_aligned(0, 1, -1)};
    const auto tree = MspTree::from_polygons(polygons_of(cube(4)), walls, Leaf::In);
    EXPECT_EQ(tree.root(), Ref::leaf(Leaf::In));
}

TEST(MspTree, PolygonsWhoseEdgesDoNotMatch) {
    // The cube's top in two halves, whose border is no edge of the cube; the neighbours' edges are
    // whole.
    const Brep brep = cube(8);
    std::vector<MspPolygon> polygons = polygons_of(brep);
    const MspTree whole = MspTree::from_brep(brep);
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        if (brep.plane(FaceId(i)).normal(2) <= 0) continue;
        MspPolygon half = polygons[i];
        const Plane cut = Plane::axis_aligned(0, 1, 3);
        MspPolygon other = half;
        half.shape.split(cut, half.shape, other.shape);
        const auto relabel = [&](MspPolygon& p) {
            p.edges.clear();
            p.vertices.clear();
            for (std::size_t k = 0; k < p.shape.size(); ++k) {
                const Ref vertex = whole.locate(p.shape.vertex(k));
                p.vertices.push_back(vertex.kind() == Leaf::OnVertex ? vertex.entity()
                                                                     : MspPolygon::none);
                const bool is_cut = p.shape.edge(k) == cut || p.shape.edge(k) == cut.flipped();
                p.edges.push_back(MspPolygon::none);
                for (std::size_t e = 0; !is_cut && e < polygons[i].edges.size(); ++e)
                    if (polygons[i].shape.edge(e) == p.shape.edge(k))
                        p.edges.back() = polygons[i].edges[e];
            }
        };
        relabel(half);
        relabel(other);
        polygons[i] = half;
        polygons.push_back(other);
        break;
    }
    ASSERT_EQ(polygons.size(), 7U);
    const MspTree tree = MspTree::from_polygons(polygons, {});
    tree.validate(brep);
    EXPECT_EQ(test::first_difference(tree, test::answered_probes(brep, 1000, 1)), "");
    EXPECT_EQ(tree.stats().faces, 6U);
}

TEST(MspTree, BoundariesThatMeetThemselves) {
    // Against the precondition; there is an end to it all the same, and no crash.
    reference::Random random(5);
    std::size_t trees = 0;
    for (int i = 0; i < 100; ++i) {
        const Brep brep =
            brep_from_lattice_mesh(engines::lattice_mesh(reference::random_operand(random)));
        try {
            const MspTree tree = MspTree::from_brep(brep);
            EXPECT_NO_THROW((void)tree.locate(LatticePoint{5, 5, 5}));
            ++trees;
        } catch (const Error& e) {
            EXPECT_TRUE(e.code() == ErrorCode::Internal || e.code() == ErrorCode::Unsupported);
        }
    }
    EXPECT_GT(trees, 50U);
}

TEST(MspTree, OrderOfFacesDoesNotMatter) {
    const Brep plate = test::prism({rectangle(0, 0, 20, 12), reversed(rectangle(2, 2, 6, 6))}, 3);
    const auto probes = test::answered_probes(plate, 500, 1);
    MspOptions options;
    for (const std::uint32_t candidates : {1U, 2U, 100U}) {
        options.candidates = candidates;
        EXPECT_EQ(test::first_difference(MspTree::from_brep(plate, options), probes), "");
    }
}

}  // namespace
}  // namespace trisect
