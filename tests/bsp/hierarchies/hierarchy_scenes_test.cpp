// SPDX-License-Identifier: Apache-2.0
//
// Small versions of the scenes: every structure gives the same exact answers on every frame, those
// of the queries that use none of them.

#include <gtest/gtest.h>

#include <optional>
#include <tuple>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference_scene.h>

#include "scenes/scenes.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

std::vector<FacePair> meeting_faces_by_contacts(const InterferenceModel& a, const Pose& pose_a,
                                                const InterferenceModel& b, const Pose& pose_b) {
    CostCounters counters;
    const auto all = make_structure(StructureKind::AllPairs, a, b);
    all->place(pose_a, pose_b, counters);
    return meeting_faces(*all, counters);
}

class HierarchyScenes : public testing::TestWithParam<std::string> {};

TEST_P(HierarchyScenes, GiveTheSameAnswersInEveryStructure) {
    const auto scene = scenes::make_pair_scene(GetParam(), scenes::Size::Small);
    if (!scene) GTEST_SKIP() << "its models are not here";
    const InterferenceModel a(Solid::from_mesh(scene->a));
    const InterferenceModel b(Solid::from_mesh(scene->b));
    std::vector<std::unique_ptr<PairStructure>> structures;
    for (const StructureInfo& kind : all_structures())
        if (kind.kind != StructureKind::AllPairs)
            structures.push_back(make_structure(kind.kind, a, b));
    for (std::size_t f = 0; f < scene->frames.size(); ++f) {
        SCOPED_TRACE(f);
        const Pose pose = scenes::pose_of(scene->frames[f]);
        const Relation expected = interfere(a, Pose(), b, pose).relation;
        const auto squared = exact_squared_distance(a, Pose(), b, pose);
        std::optional<std::vector<FacePair>> faces;
        std::optional<ClosestFeatures> nearest;
        if (a.triangle_count() * b.triangle_count() < 4'000'000)
            faces = meeting_faces_by_contacts(a, Pose(), b, pose);
        for (const auto& s : structures) {
            SCOPED_TRACE(s->name());
            CostCounters counters;
            s->place(Pose(), pose, counters);
            EXPECT_EQ(relation(*s, counters), expected);
            const auto found = meeting_faces(*s, counters);
            if (!faces) faces = found;
            EXPECT_EQ(found, *faces);
            EXPECT_EQ(boundaries_meet(*s, counters), !faces->empty());
            const ClosestFeatures c = closest(*s, counters);
            EXPECT_EQ(c.squared, squared);
            if (!nearest) nearest = c;
            EXPECT_EQ(c, *nearest);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, HierarchyScenes, testing::ValuesIn(scenes::pair_scene_names()),
                         [](const auto& i) {
                             std::string name = i.param;
                             for (char& c : name)
                                 if (c == '-') c = '_';
                             return name;
                         });

// The relation of every pair that interferes, in every frame.
using Interfering = std::vector<std::tuple<std::uint32_t, std::uint32_t, Relation>>;

std::vector<Interfering> interfering_pairs(const scenes::SwarmScene& swarm,
                                           SceneBroadPhase broad_phase) {
    SceneOptions options;
    options.broad_phase = broad_phase;
    Scene scene(options);
    std::vector<InterferenceModel> models;
    for (const PolygonMesh& m : swarm.shapes) models.emplace_back(Solid::from_mesh(m));
    std::vector<BodyId> bodies;
    for (const std::size_t shape : swarm.shape_of) bodies.push_back(scene.add(models[shape]));
    std::vector<Interfering> found;
    for (const auto& frame : swarm.frames) {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            scene.set_pose(bodies[i], scenes::pose_of(frame[i]));
        Interfering& now = found.emplace_back();
        for (const ScenePair& p : scene.interfering())
            now.emplace_back(p.a.index, p.b.index, p.relation);
    }
    return found;
}

TEST(SwarmScenes, HaveTheSameInterferingPairsByEveryBroadPhase) {
    for (const std::string& name : scenes::swarm_scene_names()) {
        const auto swarm = scenes::make_swarm_scene(name, scenes::Size::Small);
        const auto expected = interfering_pairs(swarm, SceneBroadPhase::SweepAndPrune);
        std::size_t count = 0;
        for (const Interfering& frame : expected) count += frame.size();
        EXPECT_GT(count, 0U) << name;
        for (const auto kind : {SceneBroadPhase::BoxTree, SceneBroadPhase::HashGrid,
                                SceneBroadPhase::HierarchicalGrid, SceneBroadPhase::Octree,
                                SceneBroadPhase::KdTree, SceneBroadPhase::ChainBoxes})
            EXPECT_EQ(interfering_pairs(swarm, kind), expected)
                << name << " " << static_cast<int>(kind);
    }
}

TEST(SwarmScenes, HaveClosedConvexBodiesAndAPoseForEachInEveryFrame) {
    for (const std::string& name : scenes::swarm_scene_names()) {
        const auto s = scenes::make_swarm_scene(name, scenes::Size::Small);
        for (const PolygonMesh& m : s.shapes) EXPECT_FALSE(Solid::from_mesh(m).is_empty());
        for (const auto& frame : s.frames) EXPECT_EQ(frame.size(), s.shape_of.size());
    }
    const PolygonMesh cube = scenes::cut_cube({3, 4, 5});
    EXPECT_EQ(cube.points.size(), 48U);
    EXPECT_EQ(cube.face_count(), 26U);
    const InterferenceModel model(Solid::from_mesh(cube));
    EXPECT_EQ(model.triangle_count(), 92U);
    EXPECT_EQ(model.stats().faces, 26U);
}

}  // namespace
