// SPDX-License-Identifier: Apache-2.0
//
// Scenes of solids, one of which is cut while others move, against scenes of models.

#include <trisect/bsp/interference/interference_scene.h>

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "reference/random_solids.h"
#include "support/solids.h"

namespace {

using trisect::BodyId;
using trisect::Expression;
using trisect::InterferenceModel;
using trisect::Point3d;
using trisect::Pose;
using trisect::Relation;
using trisect::Scene;
using trisect::ScenePair;
using trisect::Solid;

TEST(SceneOfSolids, AStockIsCutWhileOthersMove) {
    reference::Random random(5);
    Solid stock = solids::box(0, 0, 0, 16, 16, 4);
    const std::vector<Solid> others{solids::box(0, 2), solids::ball(1.5, 3),
                                    solids::box(0, 0, 0, 1, 1, 6),
                                    solids::box(-20, -20, -2, 40, 40, 0)};
    Scene scene;
    Scene models;
    const BodyId part = scene.add(stock);
    BodyId model = models.add(InterferenceModel(stock));
    std::vector<BodyId> bodies;
    for (const Solid& s : others) {
        bodies.push_back(scene.add(s));
        EXPECT_EQ(models.add(InterferenceModel(s)), bodies.back());
    }
    std::map<Relation, int> seen;
    for (int cut = 0; cut < 30; ++cut) {
        const auto x = static_cast<double>(random.below(15));
        const auto y = static_cast<double>(random.below(15));
        const auto z = static_cast<double>(random.below(4));
        stock = evaluate(Expression(stock) - Expression(solids::box(x, y, z, x + 2, y + 2, 5)));
        scene.replace(part, stock);
        // The same slot with another model.
        models.remove(model);
        model = models.add(InterferenceModel(stock));
        ASSERT_EQ(model.index, part.index);
        for (std::size_t i = 0; i + 1 < bodies.size(); ++i) {
            const Pose pose = Pose::from_translation(
                {x + static_cast<double>(random.below(3)) - 1,
                 y + static_cast<double>(random.below(3)) - 1,
                 z + static_cast<double>(random.below(4)) - (i == 1 ? 0.5 : 0)});
            scene.set_pose(bodies[i], pose);
            models.set_pose(bodies[i], pose);
        }
        const std::vector<ScenePair> found = scene.interfering({.contacts = true});
        std::vector<ScenePair> expected = models.interfering();
        ASSERT_EQ(found.size(), expected.size()) << "cut " << cut;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].a.index, expected[i].a.index);
            EXPECT_EQ(found[i].b.index, expected[i].b.index);
            EXPECT_EQ(found[i].relation, expected[i].relation);
            const bool meet = found[i].relation == Relation::Touching ||
                              found[i].relation == Relation::Overlapping;
            if (meet) {
                EXPECT_FALSE(found[i].named_contacts.empty()) << to_string(found[i].relation);
            }
            ++seen[found[i].relation];
        }
    }
    EXPECT_GT(seen[Relation::Touching], 10);
    EXPECT_GT(seen[Relation::Overlapping], 10);
}

TEST(SceneOfSolids, MixedWithModelsAndEmptySolids) {
    Scene scene;
    const BodyId block = scene.add(solids::box(0, 2));
    const BodyId model = scene.add(InterferenceModel(solids::box(1, 3)));
    const BodyId nothing = scene.add(Solid());
    ASSERT_EQ(scene.interfering().size(), 1U);
    EXPECT_EQ(scene.interfering().front().relation, Relation::Overlapping);
    EXPECT_THROW((void)scene.model(block), trisect::UsageError);
    EXPECT_NO_THROW((void)scene.model(model));
    scene.replace(nothing, solids::box(2, 4));
    EXPECT_EQ(scene.interfering().size(), 3U);
    scene.replace(model, Solid());
    EXPECT_EQ(scene.interfering().size(), 1U);
    EXPECT_EQ(scene.interfering().front().relation, Relation::Touching);
    EXPECT_THROW(scene.replace({77, 1}, Solid()), trisect::UsageError);
}

}  // namespace
