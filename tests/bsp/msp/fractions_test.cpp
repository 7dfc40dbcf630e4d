// SPDX-License-Identifier: Apache-2.0
//
// Trees of boundaries whose coordinates have bits behind the point: the same leaves as on a finer
// lattice, and right where no lattice of whole coordinates would do.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/msp_tree.h>

#include "engines/engines.h"
#include "prisms.h"
#include "support/breps.h"
#include "support/fractions.h"
#include "support/probes.h"
#include "support/random_result.h"

namespace trisect {
namespace {

using test::SolidSketch;
using test::with_fractions;

constexpr std::array<int, 4> shifts{8, 24, 56, 70};
constexpr std::array all_heuristics{MspHeuristic::AsGiven, MspHeuristic::LeastSplits,
                                    MspHeuristic::Balanced, MspHeuristic::LargestFirst};

Point with_fractions_at(const Point& p, int bits) {
    if (p.is_lattice()) return with_fractions(p.lattice(), bits);
    const auto& planes = p.plane_point()->planes;
    return {with_fractions(planes[0], bits), with_fractions(planes[1], bits),
            with_fractions(planes[2], bits)};
}

// The same boundary with every vertex named by planes of faces at it.
Brep named_by_planes(const Brep& brep) {
    BrepBuilder builder(brep.lattice());
    for (const VertexId v : brep.vertices()) {
        std::vector<Plane> planes;
        for (const HalfedgeId h : brep.outgoing_halfedges(v))
            planes.push_back(brep.plane(brep.face(h)));
        bool found = false;
        for (std::size_t i = 0; i < planes.size() && !found; ++i)
            for (std::size_t j = 0; j < i && !found; ++j)
                for (std::size_t k = 0; k < j && !found; ++k) {
                    if (!meet_in_a_point(planes[i], planes[j], planes[k])) continue;
                    builder.add_vertex(Point(planes[i], planes[j], planes[k]));
                    found = true;
                }
        EXPECT_TRUE(found);
    }
    for (const FaceId f : brep.faces()) {
        std::vector<std::vector<std::uint32_t>> loops;
        for (const LoopId l : brep.loops(f)) {
            auto& loop = loops.emplace_back();
            for (const HalfedgeId h : brep.halfedges(l)) loop.push_back(brep.origin(h).index);
        }
        builder.add_face(brep.plane(f), loops, brep.source(f));
    }
    return std::move(builder).build();
}

void expect_the_same_leaves(const Brep& whole, const std::vector<test::Probe>& probes,
                            const Brep& same, int bits) {
    for (const MspHeuristic h : all_heuristics) {
        MspOptions options;
        options.split_heuristic = h;
        const MspTree coarse = MspTree::from_brep(same, options);
        ASSERT_NO_THROW(coarse.validate(same, 16));
        EXPECT_EQ(coarse.node_count(), MspTree::from_brep(whole, options).node_count());
        for (const test::Probe& p : probes) {
            ASSERT_EQ(coarse.locate(with_fractions_at(p.point, bits)), p.expected) << bits;
            if (!p.point.is_lattice()) continue;
            const LatticePoint at = with_fractions(p.point.lattice(), bits);
            ASSERT_EQ(coarse.locate(at), p.expected) << bits;
            Point3d user = at.doubles();
            for (double& c : user) c = coarse.lattice().to_double(c);
            ASSERT_EQ(coarse.locate(user), p.expected) << bits;
        }
    }
}

void expect_the_same_leaves(const Brep& brep, std::size_t count, std::uint32_t seed) {
    const auto probes = test::answered_probes(brep, count, seed);
    for (const int bits : shifts)
        expect_the_same_leaves(brep, probes, with_fractions(brep, bits), bits);
}

TEST(MspFractions, KeepLeavesOfSketches) {
    SolidSketch cavity;
    cavity.box({0, 0, 0}, {12, 12, 12}).box({3, 4, 5}, {7, 8, 9}, false);
    expect_the_same_leaves(cavity.build(), 100, 1);
    SolidSketch edge;
    edge.box({0, 0, 0}, {4, 4, 4}).box({4, 4, 2}, {8, 8, 9});
    expect_the_same_leaves(edge.build(), 100, 2);
    expect_the_same_leaves(test::prism_over_a_star(), 100, 3);
    expect_the_same_leaves(test::prism_with_straight_corners(), 100, 4);
}

TEST(MspFractions, KeepLeavesOfResults) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Brep brep = brute::random_result(seed, 3, false).solid.to_brep();
        if (!brep.is_empty()) expect_the_same_leaves(brep, 40, static_cast<std::uint32_t>(seed));
    }
}

TEST(MspFractions, KeepLeavesOfTrianglesOfEmbeddedSolids) {
    reference::Random random(3);
    for (int i = 0; i < 4; ++i) {
        const LatticeMesh mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        expect_the_same_leaves(brep_from_lattice_mesh(mesh), 40, 5);
    }
}

// Names by planes do not show that a corner is a lattice point.
TEST(MspFractions, CornersThatPlanesName) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {8, 8, 8});
    const Brep box = sketch.build();
    const auto probes = test::answered_probes(box, 100, 6);
    for (const int bits : shifts) {
        const Brep same = named_by_planes(with_fractions(box, bits));
        EXPECT_FALSE(same.point(VertexId(7)).is_lattice());
        expect_the_same_leaves(box, probes, same, bits);
    }
    // Coplanar triangles: the plane between them goes through both corners.
    LatticeMesh mesh;
    for (const VertexId v : box.vertices()) mesh.points.push_back(box.point(v).lattice());
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    std::vector<LatticePoint> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back({(i & 1) != 0 ? 8 : 0, (i & 2) != 0 ? 8 : 0, (i & 4) != 0 ? 8 : 0});
    mesh.points = corners;
    const Brep triangles = brep_from_lattice_mesh(mesh);
    const auto on_triangles = test::answered_probes(triangles, 100, 7);
    for (const int bits : shifts)
        expect_the_same_leaves(triangles, on_triangles,
                               named_by_planes(with_fractions(triangles, bits)), bits);
}

// A sphere of doubles as they come, of which no 53 bits hold all.
LatticeMesh uneven_ball(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uneven(0.9, 1);
    const PolygonMesh sphere = make_icosphere(1, 1);
    LatticeMesh mesh;
    mesh.lattice.exponent = -40;
    for (const Point3d& p : sphere.points) {
        const double size = uneven(random);
        const auto c = [&](double v) {
            const double units = std::ldexp(size * v * uneven(random), 40);
            return Coordinate(
                std::ldexp(std::rint(std::ldexp(units, fraction_limit)), -fraction_limit));
        };
        mesh.points.push_back({c(p[0]), c(p[1]), c(p[2])});
    }
    for (std::size_t f = 0; f < sphere.face_count(); ++f) {
        const auto t = sphere.face(f);
        mesh.triangles.push_back({t[0], t[1], t[2]});
    }
    return mesh;
}

TEST(MspFractions, DoublesAsTheyCome) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const LatticeMesh mesh = uneven_ball(seed);
        const Brep brep = brep_from_lattice_mesh(mesh);
        const MspTree tree = MspTree::from_brep(brep);
        ASSERT_NO_THROW(tree.validate(brep));
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> anywhere(-1, 1);
        int inside = 0;
        for (int i = 0; i < 200; ++i) {
            Point3d p{anywhere(random), anywhere(random), anywhere(random)};
            // Next to a corner.
            if (i % 2 == 0) {
                p = mesh.points[random() % mesh.points.size()].doubles();
                for (double& c : p) c = std::nextafter(mesh.lattice.to_double(c), anywhere(random));
            }
            ExactPoint exact;
            for (std::size_t k = 0; k < 3; ++k) exact[k] = ExactRational::from_double(p[k]);
            const auto winding = winding_number(mesh, exact);
            const auto found = tree.locate(p);
            if (winding) {
                ASSERT_EQ(found, MspTree::Ref::leaf(*winding > 0 ? MspTree::Leaf::In
                                                                 : MspTree::Leaf::Out));
                inside += *winding;
            } else {
                ASSERT_GT(found.kind(), MspTree::Leaf::In);
            }
        }
        EXPECT_GT(inside, 10);
    }
}

}  // namespace
}  // namespace trisect
