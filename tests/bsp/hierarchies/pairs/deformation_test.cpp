// SPDX-License-Identifier: Apache-2.0
//
// A solid that changes its shape: structures that are refitted give the answers of all pairs.

#include <gtest/gtest.h>

#include <cmath>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/pairs/deformation.h>
#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

// Bent along the x-axis, a little more for each step, and always so that no faces are coplanar.
InterferenceModel bent_torus(int step) {
    PolygonMesh mesh = make_torus(4, 1, 16, 8);
    for (auto& p : mesh.points) {
        p[2] += 0.05 * step * p[0] * p[0];
        p[1] += 0.2 * std::sin(0.7 * step + p[0]);
    }
    return InterferenceModel(Solid::from_mesh(mesh));
}

TEST(Deformation, KnowsTheTrianglesOfAMeshAgain) {
    const InterferenceModel before = bent_torus(1);
    const InterferenceModel after = bent_torus(3);
    const auto now = same_triangles(before, after);
    ASSERT_TRUE(now.has_value());
    std::vector<bool> seen(now->size());
    for (const std::uint32_t t : *now) {
        ASSERT_LT(t, seen.size());
        EXPECT_FALSE(seen[t]);
        seen[t] = true;
    }
}

TEST(Deformation, OfOtherTrianglesIsRefused) {
    const InterferenceModel torus = bent_torus(0);
    const InterferenceModel box(Solid::from_mesh(make_box({0, 0, 0}, {1, 1, 1})));
    EXPECT_FALSE(same_triangles(torus, box).has_value());
    const auto s = make_structure(StructureKind::Obb, torus, torus);
    CostCounters counters;
    EXPECT_FALSE(s->deform_b(box, counters));
    EXPECT_EQ(s->model_b().triangle_count(), torus.triangle_count());
    EXPECT_TRUE(boundaries_meet(*s, counters));
}

TEST(Deformation, RefittedTreesGiveTheAnswersOfAllPairs) {
    const InterferenceModel fixed(Solid::from_mesh(make_torus(3, 1, 12, 8)));
    std::vector<InterferenceModel> shapes;
    for (int step = 1; step < 5; ++step) shapes.push_back(bent_torus(step));
    const Pose pose = Pose::from_quaternion({5, 1, 2, 0}, {3, 1, 0.5});
    std::size_t refitted = 0;
    for (const StructureInfo& kind : all_structures()) {
        SCOPED_TRACE(kind.name);
        const auto s = make_structure(kind.kind, fixed, shapes[0]);
        CostCounters counters;
        for (std::size_t step = 1; step < shapes.size(); ++step) {
            if (!s->deform_b(shapes[step], counters)) break;
            if (step == 1) ++refitted;
            const auto all = make_structure(StructureKind::AllPairs, fixed, shapes[step]);
            for (PairStructure* p : {s.get(), all.get()}) p->place(Pose(), pose, counters);
            EXPECT_EQ(meeting_faces(*s, counters), meeting_faces(*all, counters));
            EXPECT_EQ(relation(*s, counters), relation(*all, counters));
            EXPECT_EQ(closest(*s, counters), closest(*all, counters));
            for (PairStructure* p : {s.get(), all.get()})
                p->place(Pose(), Pose::from_translation({9, 1, 0}), counters);
            EXPECT_EQ(closest(*s, counters), closest(*all, counters));
        }
    }
    EXPECT_GE(refitted, 14U);
}

}  // namespace
