// SPDX-License-Identifier: Apache-2.0
//
// Classic trees of solids whose coordinates have bits behind the point.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/bsp_boolean.h>
#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/bsp_merge.h>
#include <trisect/bsp/classic/bsp_assembly.h>
#include <trisect/bsp/classic/bsp_boundary.h>
#include <trisect/bsp/classic/bsp_sections.h>
#include <trisect/kernel/number/vector3.h>

#include "meshes.h"
#include "support/fractions.h"

namespace trisect {
namespace {

using Membership = BspTree::Membership;
using test::with_fractions;

constexpr std::array<int, 4> shifts{8, 24, 56, 70};
constexpr std::array rules{BooleanRule::set_union(), BooleanRule::set_intersection(),
                           BooleanRule::set_difference(), BooleanRule::symmetric_difference()};

void expect_the_same_nodes(const BspTree& whole, const BspTree& same, int bits) {
    ASSERT_EQ(whole.nodes().size(), same.nodes().size());
    ASSERT_EQ(whole.root(), same.root());
    for (std::size_t i = 0; i < whole.nodes().size(); ++i) {
        const BspTree::Node& n = whole.nodes()[i];
        const BspTree::Node& m = same.nodes()[i];
        ASSERT_EQ(n.below, m.below);
        ASSERT_EQ(n.above, m.above);
        const Plane plane = with_fractions(n.plane, bits);
        ASSERT_TRUE(is_same_plane(plane, m.plane) && same_orientation(plane, m.plane));
    }
}

// Everything about a boolean of two solids on small grids, where planes coincide.
void expect_the_same_boolean(BooleanRule rule, const LatticeMesh& a, const LatticeMesh& b,
                             std::mt19937& random) {
    const BspTree whole = merge(build_bsp(a), build_bsp(b), rule);
    const auto boundary = boundary_of(whole);
    const Brep brep = brep_from_fragments(boundary, a.lattice);
    for (const int bits : shifts) {
        const LatticeMesh fine_a = with_fractions(a, bits);
        const LatticeMesh fine_b = with_fractions(b, bits);
        const BspTree same = merge(build_bsp(fine_a), build_bsp(fine_b), rule);
        expect_the_same_nodes(whole, same, bits);
        EXPECT_EQ(same.reduced().nodes().size(), whole.reduced().nodes().size());
        for (int i = 0; i < 40; ++i) {
            const LatticePoint p{static_cast<int>(random() % 9) - 1,
                                 static_cast<int>(random() % 9) - 1,
                                 static_cast<int>(random() % 9) - 1};
            ASSERT_EQ(same.classify(with_fractions(p, bits)), whole.classify(p));
        }
        const auto same_boundary = bsp_boolean(rule, fine_a, fine_b);
        ASSERT_EQ(same_boundary.size(), boundary.size());
        EXPECT_EQ(enclosed_volume(same_boundary).scaled(3 * bits), enclosed_volume(boundary));
        const Brep same_brep = brep_from_fragments(same_boundary, fine_a.lattice);
        ASSERT_EQ(same_brep.counts().vertices, brep.counts().vertices);
        ASSERT_EQ(same_brep.counts().faces, brep.counts().faces);
        for (const VertexId v : brep.vertices())
            for (std::size_t k = 0; k < 3; ++k)
                ASSERT_EQ(same_brep.lattice().to_double(same_brep.point(v).nearest()[k]),
                          brep.lattice().to_double(brep.point(v).nearest()[k]));
        EXPECT_EQ(exact_volume(same_brep), exact_volume(brep));
    }
}

TEST(BspFractions, KeepTreesAndBoundaries) {
    std::mt19937 random(11);
    for (int round = 0; round < 12; ++round) {
        const LatticeMesh a =
            round % 2 == 0 ? test::random_tetrahedron(random, 7) : test::random_box(random, 7);
        const LatticeMesh b =
            round % 3 == 0 ? test::random_box(random, 7) : test::random_tetrahedron(random, 7);
        for (const BooleanRule rule : rules) expect_the_same_boolean(rule, a, b, random);
    }
}

TEST(BspFractions, KeepEveryPlaneInItsCell) {
    const LatticeMesh mesh = test::sphere({0, 0, 0}, 1000, 8, 5);
    const BspTree whole = build_bsp(mesh);
    for (const int bits : {8, 24, 56}) {
        const BspTree same = build_bsp(with_fractions(mesh, bits));
        expect_the_same_nodes(whole, same, bits);
        for (const ConvexPolygon& s : cell_sections(same)) EXPECT_FALSE(s.is_empty());
    }
}

// Corners are doubles as they come, from 2^-30 to 2^20 units.
LatticeMesh uneven_tetrahedron(std::mt19937_64& random) {
    std::uniform_real_distribution<double> anywhere(-1, 1);
    const auto coordinate = [&] {
        const double v = std::ldexp(anywhere(random), static_cast<int>(random() % 50) - 30);
        return Coordinate(std::ldexp(std::rint(std::ldexp(v, fraction_limit)), -fraction_limit));
    };
    LatticeMesh mesh;
    for (int i = 0; i < 4; ++i) mesh.points.push_back({coordinate(), coordinate(), coordinate()});
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    if (exact_volume(mesh).sign() < 0)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

TEST(BspFractions, DoublesAsTheyCome) {
    std::mt19937_64 random(7);
    int common = 0;
    for (int round = 0; round < 40; ++round) {
        const LatticeMesh a = uneven_tetrahedron(random);
        LatticeMesh b = uneven_tetrahedron(random);
        if (round % 3 == 0) b.points[0] = a.points[1];
        if (round % 5 == 0) b.points[1] = a.points[2];
        if (exact_volume(b).sign() <= 0) continue;
        const BspTree tree_a = build_bsp(a);
        const BspTree tree_b = build_bsp(b);
        const auto volume = [&](BooleanRule rule) {
            return enclosed_volume(boundary_of(merge(tree_a, tree_b, rule)));
        };
        ASSERT_EQ(enclosed_volume(boundary_of(tree_a)), exact_volume(a));
        const ExactRational both = volume(BooleanRule::set_intersection());
        const ExactRational either = volume(BooleanRule::set_union());
        ASSERT_EQ(both + either, exact_volume(a) + exact_volume(b));
        ASSERT_EQ(volume(BooleanRule::set_difference()), exact_volume(a) - both);
        ASSERT_EQ(volume(BooleanRule::symmetric_difference()), either - both);
        common += both.sign();
        const Brep brep = brep_from_fragments(bsp_boolean(BooleanRule::set_union(), a, b), {});
        ASSERT_EQ(exact_volume(brep), either);
        for (const LatticePoint& p : b.points) {
            ExactPoint at;
            for (std::size_t k = 0; k < 3; ++k)
                at[k] = ExactRational::from_double(detail::coordinate(p, k).to_double());
            const auto winding = winding_number(a, at);
            ASSERT_EQ(tree_a.classify(p), !winding        ? Membership::OnBoundary
                                          : *winding == 0 ? Membership::Outside
                                                          : Membership::Inside);
        }
    }
    EXPECT_GT(common, 10);
}

}  // namespace
}  // namespace trisect
