// SPDX-License-Identifier: Apache-2.0
//
// Against brute force: every pair asked by itself, with the filters written out again here.
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reference/random_solids.h"
#include "support/scene_solids.h"

namespace scene_pairs_test {
namespace {

using reference::Random;
using scene_test::random_model;
using scene_test::random_pose;
using trisect::BodyId;
using trisect::CollisionFilter;
using trisect::Diagnostics;
using trisect::InterferenceModel;
using trisect::Joint;
using trisect::LinkOptions;
using trisect::Pose;
using trisect::Relation;
using trisect::Scene;
using trisect::SceneBroadPhase;
using trisect::SceneCounters;
using trisect::SceneQueryOptions;
using trisect::Solid;
using trisect::UsageError;

/// (index, index, relation)
using Found = std::vector<std::tuple<std::uint32_t, std::uint32_t, Relation>>;

Found found_by(Scene& scene, std::uint32_t threads = 1, bool contacts = false) {
    Found out;
    SceneQueryOptions options;
    options.threads = threads;
    options.contacts = contacts;
    for (const trisect::ScenePair& p : scene.interfering(options)) {
        EXPECT_TRUE(scene.contains(p.a));
        EXPECT_TRUE(scene.contains(p.b));
        out.emplace_back(p.a.index, p.b.index, p.relation);
    }
    return out;
}

/// A scene and all that is known about it, kept beside it.
struct Watched {
    explicit Watched(SceneBroadPhase kind) : scene({kind}) {}

    Scene scene;
    struct Body {
        InterferenceModel model;
        CollisionFilter filter;
    };
    std::map<BodyId, Body> bodies;
    std::set<std::pair<BodyId, BodyId>> apart;  // never asked about, both ways

    BodyId add(const InterferenceModel& model, const Pose& pose,
               const CollisionFilter& filter = {}) {
        const BodyId id = scene.add(model, pose, filter);
        bodies[id] = {model, filter};
        return id;
    }
    void remove(BodyId id) {
        scene.remove(id);
        bodies.erase(id);
        std::erase_if(apart, [id](const auto& p) { return p.first == id || p.second == id; });
    }
    void keep_apart(BodyId a, BodyId b) {
        apart.emplace(a, b);
        apart.emplace(b, a);
    }
    [[nodiscard]] Found brute_force() const {
        Found out;
        for (const auto& [a, u] : bodies) {
            for (const auto& [b, v] : bodies) {
                if (a.index >= b.index || apart.count({a, b}) != 0) continue;
                if ((u.filter.groups & v.filter.looks_at) == 0) continue;
                if ((v.filter.groups & u.filter.looks_at) == 0) continue;
                const Relation relation =
                    interfere(u.model, scene.pose(a), v.model, scene.pose(b)).relation;
                if (relation != Relation::Disjoint) out.emplace_back(a.index, b.index, relation);
            }
        }
        std::sort(out.begin(), out.end());
        return out;
    }
};

InterferenceModel cube(double side = 1) {
    return InterferenceModel(Solid::from_mesh(trisect::make_box({side, side, side})));
}

Pose at(double x, double y = 0, double z = 0) { return Pose::from_translation({x, y, z}); }

class ScenePairs : public testing::TestWithParam<SceneBroadPhase> {};

TEST_P(ScenePairs, FlushNestedEqualAndCrossingCubes) {
    Scene scene({GetParam()});
    const InterferenceModel one = cube();
    const InterferenceModel three = cube(3);
    scene.add(one, at(0));
    scene.add(one, at(1));
    scene.add(one, at(1));
    scene.add(one, at(1.5));
    scene.add(three, at(10, -1, -1));
    scene.add(one, at(11));
    scene.add(one, at(12));
    scene.add(one, at(20));
    const Found expected{{0, 1, Relation::Touching},    {0, 2, Relation::Touching},
                         {1, 2, Relation::Equal},       {1, 3, Relation::Overlapping},
                         {2, 3, Relation::Overlapping}, {4, 5, Relation::Contains},
                         {4, 6, Relation::Contains},    {5, 6, Relation::Touching}};
    const Diagnostics<SceneCounters> diagnostics;
    EXPECT_EQ(found_by(scene), expected);
    EXPECT_EQ(diagnostics.counters().interfering, expected.size());
}

TEST_P(ScenePairs, FlushAfterATurnThatNoMatrixOfDoublesHas) {
    // Two cubes turned together by an angle with cosine 3/5: they still share a face.
    const Pose turn = Pose::from_quaternion({2, 0, 0, 1});
    Scene scene({GetParam()});
    scene.add(cube(), turn * at(0));
    scene.add(cube(), turn * at(1));
    const Found expected{{0, 1, Relation::Touching}};
    EXPECT_EQ(found_by(scene), expected);
}

TEST_P(ScenePairs, EmptySolidsInterfereWithNothing) {
    Scene scene({GetParam()});
    scene.add(InterferenceModel());
    scene.add(cube());
    scene.add(InterferenceModel());
    const Diagnostics<SceneCounters> diagnostics;
    EXPECT_TRUE(found_by(scene).empty());
    EXPECT_EQ(diagnostics.counters().bodies, 3U);
    EXPECT_EQ(diagnostics.counters().boxes_met, 0U);
}

TEST_P(ScenePairs, ABodyInThePlaceOfARemovedOneIsAnother) {
    Scene scene({GetParam()});
    const BodyId a = scene.add(cube());
    const BodyId b = scene.add(cube(), at(0.5));
    EXPECT_EQ(found_by(scene).size(), 1U);
    scene.remove(b);
    EXPECT_FALSE(scene.contains(b));
    const BodyId c = scene.add(cube(), at(1));
    EXPECT_EQ(c.index, b.index);
    EXPECT_NE(c, b);
    const Found expected{{a.index, c.index, Relation::Touching}};
    EXPECT_EQ(found_by(scene), expected);
    EXPECT_THROW((void)scene.pose(b), UsageError);
    EXPECT_THROW(scene.set_pose(b, at(1)), UsageError);
    EXPECT_THROW(scene.remove(b), UsageError);
}

TEST_P(ScenePairs, LargeBodiesThatMoveAreRemovedAndReplaced) {
    // Large enough for pairs to remember things; what they remember goes with the bodies.
    const InterferenceModel ball(Solid::from_mesh(trisect::make_icosphere(1, 4)));
    const InterferenceModel other(Solid::from_mesh(trisect::make_icosphere(2, 4)));
    Watched watched(GetParam());
    watched.add(ball, at(0));
    BodyId second = watched.add(ball, at(1));
    for (int frame = 0; frame < 60; ++frame) {
        if (frame % 10 == 9) {
            watched.remove(second);
            second = watched.add(frame % 20 == 9 ? other : ball, at(0.5));
        }
        watched.scene.set_pose(second, at(0.5 + 0.05 * frame, 0.25));
        ASSERT_EQ(found_by(watched.scene, 1, frame % 4 == 0), watched.brute_force()) << frame;
    }
}

TEST_P(ScenePairs, WhatHasNotMovedIsNotAskedAgain) {
    Scene scene({GetParam()});
    const BodyId a = scene.add(cube());
    scene.add(cube(), at(0.5));
    scene.add(cube(), at(1));
    // What one query did.
    const auto counted = [&] {
        const Diagnostics<SceneCounters> diagnostics;
        (void)found_by(scene);
        return diagnostics.counters();
    };
    EXPECT_EQ(counted().asked, 3U);
    const SceneCounters again = counted();
    EXPECT_EQ(again.asked, 0U);
    EXPECT_EQ(again.kept, 3U);
    EXPECT_EQ(again.filtered, 0U);
    scene.set_pose(a, at(0));  // the same again
    EXPECT_EQ(counted().asked, 0U);
    scene.set_pose(a, at(0.25));
    EXPECT_EQ(counted().asked, 2U);
}

TEST_P(ScenePairs, GroupsAndPairsThatAreIgnored) {
    Scene scene({GetParam()});
    const BodyId a = scene.add(cube(), at(0), {1, 2});
    const BodyId b = scene.add(cube(), at(0.5), {2, 1});
    const BodyId c = scene.add(cube(), at(0.75), {2, 3});
    // b does not look at the group of c.
    const Found both{{a.index, b.index, Relation::Overlapping},
                     {a.index, c.index, Relation::Overlapping}};
    const Diagnostics<SceneCounters> diagnostics;
    EXPECT_EQ(found_by(scene), both);
    EXPECT_EQ(diagnostics.counters().filtered, 1U);
    scene.ignore(b, a);
    EXPECT_EQ(found_by(scene), Found({both[1]}));
    scene.ignore(a, b, false);
    scene.set_filter(c, {4, 7});
    EXPECT_EQ(found_by(scene), Found({both[0]}));
    // What is known about ignored pairs goes with the bodies.
    scene.ignore(a, b);
    scene.remove(b);
    scene.add(cube(), at(0.5), {2, 1});
    EXPECT_EQ(found_by(scene), Found({both[0]}));
}

TEST_P(ScenePairs, RandomScenesAsBruteForce) {
    std::map<Relation, int> relations;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        Watched watched(GetParam());
        std::vector<InterferenceModel> models;
        for (int i = 0; i < 6; ++i) models.push_back(random_model(random));
        const auto any_filter = [&random] {
            return CollisionFilter{1U << random.below(2),
                                   static_cast<std::uint32_t>(random.between(1, 7))};
        };
        std::vector<BodyId> ids;
        for (int frame = 0; frame < 12; ++frame) {
            for (int i = 0; i < 3; ++i) {
                ids.push_back(watched.add(models[random.below(models.size())], random_pose(random),
                                          random.chance(1, 3) ? any_filter() : CollisionFilter{}));
            }
            for (const BodyId id : ids)
                if (random.chance(1, 3)) watched.scene.set_pose(id, random_pose(random));
            if (random.chance(1, 2)) {
                const BodyId a = ids[random.below(ids.size())];
                const BodyId b = ids[random.below(ids.size())];
                watched.scene.ignore(a, b);
                watched.keep_apart(a, b);
            }
            if (random.chance(1, 2)) {
                const std::size_t i = random.below(ids.size());
                watched.remove(ids[i]);
                ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(i));
            }
            const Found expected = watched.brute_force();
            ASSERT_EQ(found_by(watched.scene, frame % 2 == 0 ? 1 : 4, frame % 3 == 0), expected)
                << seed << " " << frame;
            for (const auto& [a, b, relation] : expected) ++relations[relation];
        }
    }
    for (const Relation relation : {Relation::Touching, Relation::Overlapping, Relation::Inside,
                                    Relation::Contains, Relation::Equal})
        EXPECT_GT(relations[relation], 0) << static_cast<int>(relation);
}

std::string name_of(const testing::TestParamInfo<SceneBroadPhase>& kind) {
    constexpr std::array names{"Sweep",  "Tree",   "HashGrid",  "HierarchicalGrid",
                               "Octree", "KdTree", "ChainBoxes"};
    return names[static_cast<std::size_t>(kind.param)];
}

INSTANTIATE_TEST_SUITE_P(Kinds, ScenePairs,
                         testing::Values(SceneBroadPhase::SweepAndPrune, SceneBroadPhase::BoxTree,
                                         SceneBroadPhase::HashGrid,
                                         SceneBroadPhase::HierarchicalGrid, SceneBroadPhase::Octree,
                                         SceneBroadPhase::KdTree, SceneBroadPhase::ChainBoxes),
                         name_of);

}  // namespace
}  // namespace scene_pairs_test
