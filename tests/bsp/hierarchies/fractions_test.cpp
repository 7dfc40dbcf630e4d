// SPDX-License-Identifier: Apache-2.0
//
// All structures over solids whose coordinates have bits behind the point: the answers are those on
// a finer lattice, exactly.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/partitions/inner_balls.h>
#include <trisect/bsp/hierarchies/partitions/plane_tree.h>
#include <trisect/bsp/hierarchies/partitions/split_cells.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/fractions.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;
using trisect::test::with_fractions;

constexpr std::array<int, 2> shifts{24, 70};

struct Answers {
    bool meet = false;
    std::vector<FacePair> faces;
    Relation relation{};
    ClosestFeatures closest;
    friend bool operator==(const Answers&, const Answers&) = default;
};

Answers answers_of(PairStructure& structure, const Pose& a, const Pose& b) {
    CostCounters counters;
    structure.place(a, b, counters);
    return {boundaries_meet(structure, counters), meeting_faces(structure, counters),
            relation(structure, counters), closest(structure, counters)};
}

void expect_the_same_answers(const LatticeMesh& a, const LatticeMesh& b,
                             const std::vector<Pose>& poses) {
    const InterferenceModel whole_a(Solid::from_lattice_mesh(a));
    const InterferenceModel whole_b(Solid::from_lattice_mesh(b));
    const auto all_pairs = make_structure(StructureKind::AllPairs, whole_a, whole_b);
    for (const Pose& pose : poses) {
        const Answers expected = answers_of(*all_pairs, {}, pose);
        for (const int bits : shifts) {
            const InterferenceModel fine_a(Solid::from_lattice_mesh(with_fractions(a, bits)));
            const InterferenceModel fine_b(Solid::from_lattice_mesh(with_fractions(b, bits)));
            for (const StructureInfo& kind : all_structures()) {
                SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(bits) + " bits");
                ASSERT_EQ(answers_of(*make_structure(kind.kind, fine_a, fine_b), {}, pose),
                          expected);
                ASSERT_EQ(answers_of(*make_structure(kind.kind, fine_a, whole_b), {}, pose),
                          expected);
                ASSERT_EQ(answers_of(*make_structure(kind.kind, whole_a, fine_b), {}, pose),
                          expected);
            }
        }
    }
}

TEST(HierarchyFractions, KeepAnswersOnSmallGrids) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const LatticeMesh a = engines::lattice_mesh(reference::random_embedded_solid(random));
        const LatticeMesh b = engines::lattice_mesh(reference::random_embedded_solid(random));
        if (a.triangles.empty() || b.triangles.empty()) continue;
        expect_the_same_answers(
            a, b, {Pose::from_translation({3, 1, -2}), Pose::from_translation({40, 1, -2})});
    }
}

LatticeMesh torus() { return import_mesh(make_torus(100, 25, 16, 8)).mesh; }

TEST(HierarchyFractions, SplitCellsOfATorus) {
    const LatticeMesh mesh = torus();

    for (const int bits : {8, 24, 72}) {
        const InterferenceModel model(Solid::from_lattice_mesh(with_fractions(mesh, bits)));
        const SplitCells splitters = SplitCells::over(trisect::detail::data_of(model), 32);
        EXPECT_GT(splitters.cells.size(), 4U) << bits;
        for (const SplitCells::Cell& cell : splitters.cells)
            for (const ConvexPolygon& p : cell.polygons) {
                for (const Plane& splitter : cell.splitters) {
                    const auto parts = p.classify(splitter);
                    EXPECT_GT(parts.below, 0U);
                    EXPECT_EQ(parts.above, 0U);
                }
                for (const Point& v : p.vertices())
                    for (std::size_t k = 0; k < 3; ++k) {
                        EXPECT_LE(cell.box.lo[k], v.approximation().c[k]);
                        EXPECT_GE(cell.box.hi[k], v.approximation().c[k]);
                    }
            }
        for (const auto make : {PlaneTree::classic, PlaneTree::multidimensional})
            EXPECT_EQ(make(trisect::detail::data_of(model)).stray_count(), 0U);
    }
}

}  // namespace
