// SPDX-License-Identifier: Apache-2.0
//
// The named entity equals brute force in rationals, at points of which most are on something.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/cone.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"
#include "prisms.h"
#include "support/breps.h"
#include "support/probes.h"

namespace trisect {
namespace {

using test::cube;
using test::rectangle;
using test::reversed;
using test::SolidSketch;

constexpr std::array heuristics{MspHeuristic::AsGiven, MspHeuristic::LeastSplits,
                                MspHeuristic::Balanced, MspHeuristic::LargestFirst};

void expect_agreement(const Brep& brep, std::size_t count, std::uint32_t seed) {
    const auto probes = test::answered_probes(brep, count, seed);
    for (const MspHeuristic h : heuristics) {
        SCOPED_TRACE("heuristic " + std::to_string(static_cast<int>(h)));
        MspOptions options;
        options.split_heuristic = h;
        const MspTree tree = MspTree::from_brep(brep, options);
        ASSERT_NO_THROW(tree.validate(brep));
        ASSERT_EQ(test::first_difference(tree, probes), "");
    }
}

TEST(MspLocate, Cube) { expect_agreement(cube(8), 1000, 1); }

TEST(MspLocate, CubeWithACavity) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {12, 12, 12}).box({3, 4, 5}, {7, 8, 9}, false);
    expect_agreement(sketch.build(), 1000, 2);
}

TEST(MspLocate, InsideOutCube) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {8, 8, 8}, false);
    expect_agreement(sketch.build(), 500, 3);
}

TEST(MspLocate, PlateWithHoles) {
    expect_agreement(test::prism({rectangle(0, 0, 20, 12), reversed(rectangle(2, 2, 6, 6)),
                                  reversed(rectangle(9, 3, 15, 10))},
                                 3),
                     1000, 4);
}

TEST(MspLocate, PrismOverAStar) { expect_agreement(test::prism_over_a_star(), 1000, 5); }

TEST(MspLocate, StraightCorners) { expect_agreement(test::prism_with_straight_corners(), 500, 6); }

TEST(MspLocate, CubesThatShareAnEdge) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {4, 4, 4}).box({4, 4, 0}, {8, 8, 4});
    expect_agreement(sketch.build(), 1000, 7);
}

TEST(MspLocate, CubesThatShareACorner) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {4, 4, 4}).box({4, 4, 4}, {8, 8, 8});
    expect_agreement(sketch.build(), 1000, 8);
}

TEST(MspLocate, EdgeThatTouchesAnEdgeInPart) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {4, 4, 4}).box({4, 4, 2}, {8, 8, 9});
    expect_agreement(sketch.build(), 1000, 9);
}

Brep tetrahedron(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d,
                 SolidSketch sketch = SolidSketch()) {
    sketch.face({{a, c, b}}).face({{a, b, d}}).face({{b, c, d}}).face({{c, a, d}});
    return sketch.build();
}

TEST(MspLocate, CornerThatTouchesAFace) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {8, 8, 8});
    expect_agreement(tetrahedron({2, 2, 12}, {6, 2, 12}, {2, 7, 12}, {3, 4, 14}, std::move(sketch)),
                     500, 10);
    SolidSketch touching;
    touching.box({0, 0, 0}, {8, 8, 8});
    // The tip is below its base: turned over.
    expect_agreement(
        tetrahedron({2, 2, 12}, {2, 7, 12}, {6, 2, 12}, {3, 4, 8}, std::move(touching)), 1000, 11);
}

TEST(MspLocate, CornerThatTouchesAFaceFromACavity) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {12, 12, 12}).box({2, 2, 2}, {10, 10, 10}, false);
    expect_agreement(tetrahedron({4, 4, 5}, {8, 4, 5}, {4, 9, 5}, {5, 5, 10}, std::move(sketch)),
                     1000, 12);
}

TEST(MspLocate, EdgeThatLiesInAFace) {
    SolidSketch sketch;
    sketch.box({0, 0, 0}, {8, 8, 8});
    // A wedge that stands on its edge.
    expect_agreement(tetrahedron({2, 2, 8}, {4, 7, 12}, {7, 1, 12}, {6, 4, 8}, std::move(sketch)),
                     1000, 13);
}

TEST(MspLocate, Tetrahedron) {
    expect_agreement(tetrahedron({0, 0, 0}, {9, 1, 2}, {2, 8, 1}, {3, 2, 7}), 1000, 14);
}

Brep primitive(const PolygonMesh& mesh) { return Solid::from_mesh(mesh).to_brep(); }

TEST(MspLocate, Primitives) {
    const std::vector<PolygonMesh> meshes{
        make_cone(4, 2, 5, 9),       make_cone(3, 0, 4, 7),   make_cylinder(3, 5, 8),
        make_icosphere(5, 1),        make_uv_sphere(4, 8, 5), make_torus(5, 2, 7, 5),
        make_regular_prism(6, 4, 3),
    };
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        SCOPED_TRACE(i);
        expect_agreement(primitive(meshes[i]), 300, static_cast<std::uint32_t>(i));
    }
}

TEST(MspLocate, TriangulatedFacesOfOnePlane) {
    reference::Random random(7);
    for (int i = 0; i < 5; ++i) {
        const auto operand = reference::random_embedded_solid(random);
        expect_agreement(brep_from_lattice_mesh(engines::lattice_mesh(operand)), 500,
                         static_cast<std::uint32_t>(i));
    }
}

// Computed corners, cavities, contacts of all kinds; what random solids on a small grid give.
TEST(MspLocate, ResultsOfBooleans) {
    reference::Random random(11);
    std::size_t faces = 0;
    std::size_t wrong = 0;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(i);
        const auto operands = reference::random_family(random, 3, true);
        const auto expression = reference::random_expression(random, operands.size(), 3, false);
        std::vector<Solid> solids;
        for (const auto& o : operands) solids.push_back(engines::solid(o, Embedding::Assume));
        const Brep brep = evaluate(engines::formula(expression, solids)).to_brep();
        if (brep.is_empty()) continue;
        // Whether the boolean is right is asked in tests/engines; here it has to be, or faces
        // may overlap.
        const auto expected = reference::evaluate(operands, expression);
        if (!engines::difference(brep, reference::canonical_boundary(expected.cells)).empty()) {
            ++wrong;
            continue;
        }
        faces += brep.faces().size();
        MspOptions options;
        options.split_heuristic = heuristics[static_cast<std::size_t>(i) % heuristics.size()];
        const MspTree tree = MspTree::from_brep(brep, options);
        ASSERT_NO_THROW(tree.validate(brep));
        const auto probes = test::answered_probes(brep, 300, static_cast<std::uint32_t>(i));
        ASSERT_EQ(test::first_difference(tree, probes), "");
    }
    EXPECT_GT(faces, 700U);
    EXPECT_LE(wrong, 5U);
}

}  // namespace
}  // namespace trisect
