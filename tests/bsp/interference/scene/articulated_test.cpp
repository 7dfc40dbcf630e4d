// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "exact_pose.h"
#include "reference/random_solids.h"
#include "support/scene_solids.h"

namespace {

using reference::Random;
using scene_test::exact;
using scene_test::ExactPose;
using scene_test::ExactRational;
using trisect::BodyId;
using trisect::InterferenceModel;
using trisect::Joint;
using trisect::LimitError;
using trisect::LinkOptions;
using trisect::Pose;
using trisect::Ratio;
using trisect::Relation;
using trisect::Scene;
using trisect::Solid;
using trisect::UsageError;

InterferenceModel rod() {
    return InterferenceModel(Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 4})));
}

Pose at(double x, double y, double z) { return Pose::from_translation({x, y, z}); }

/// A tree of links with everything about it in fractions.
struct Linkage {
    Scene scene;
    struct Link {
        BodyId id;
        int carrier = -1;
        Joint joint;
        std::array<double, 3> vector{};
        std::array<std::int64_t, 3> axis{};
        Pose mount;
        Ratio value;
    };
    std::vector<Link> links;

    [[nodiscard]] ExactPose motion(const Link& l) const {
        if (l.joint.kind() == Joint::Kind::Revolute)
            return ExactPose::turn(l.vector, l.axis, l.value.numerator, l.value.denominator);
        ExactPose out;
        if (l.joint.kind() == Joint::Kind::Prismatic) {
            const ExactRational r = ExactRational(l.value.numerator) / l.value.denominator;
            for (std::size_t k = 0; k < 3; ++k)
                out.rows[k][3] = ExactRational::from_double(l.vector[k]) * r;
        }
        return out;
    }
    [[nodiscard]] ExactPose expected(std::size_t i) const {
        const Link& l = links[i];
        if (l.carrier < 0) return exact(l.mount);
        return expected(static_cast<std::size_t>(l.carrier)) * exact(l.mount) * motion(l);
    }
    void expect_exact_poses() const {
        for (std::size_t i = 0; i < links.size(); ++i)
            ASSERT_EQ(exact(scene.pose(links[i].id)), expected(i)) << i;
    }
};

Linkage::Link random_link(Random& random) {
    Linkage::Link l;
    for (double& c : l.vector) c = static_cast<double>(random.between(-9, 9)) / 8;
    l.mount = at(static_cast<double>(random.between(-3, 3)), 0.1, 4);
    switch (random.below(4)) {
        case 0:
            l.joint = Joint::fixed();
            break;
        case 1:
            l.joint = Joint::prismatic(l.vector);
            break;
        default:
            while (l.axis == std::array<std::int64_t, 3>{})
                for (std::int64_t& c : l.axis) c = random.between(-2, 2);
            l.joint = Joint::revolute(l.vector, l.axis);
            break;
    }
    return l;
}

TEST(ArticulatedScene, PosesAreExactProductsAlongTheChain) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        Linkage linkage;
        Linkage::Link base;
        base.mount = at(0.1, 0.2, 0.3);
        base.id = linkage.scene.add(rod(), base.mount);
        linkage.links.push_back(base);
        for (int i = 1; i < 9; ++i) {
            Linkage::Link l = random_link(random);
            // Mostly a chain, now and then a branch.
            l.carrier = random.chance(3, 4) ? i - 1 : static_cast<int>(random.between(0, i - 1));
            LinkOptions options;
            options.mount = l.mount;
            l.id = linkage.scene.add_link(linkage.links[static_cast<std::size_t>(l.carrier)].id,
                                          rod(), l.joint, options);
            linkage.links.push_back(l);
        }
        linkage.expect_exact_poses();
        for (int step = 0; step < 10; ++step) {
            std::vector<Scene::JointValue> values;
            for (Linkage::Link& l : linkage.links) {
                if (l.carrier < 0 || l.joint.kind() == Joint::Kind::Fixed) continue;
                if (!random.chance(1, 2)) continue;
                l.value = {random.between(-7, 7), random.between(1, 7)};
                values.push_back({l.id, l.value});
            }
            if (step % 2 == 0) {
                linkage.scene.set_joints(values);
            } else {
                for (const auto& v : values) linkage.scene.set_joint(v.link, v.value);
            }
            linkage.links[0].mount = Pose::from_quaternion({step + 1, 1, 0, 0}, {0.5, 0, 0});
            linkage.scene.set_pose(linkage.links[0].id, linkage.links[0].mount);
            linkage.expect_exact_poses();
        }
    }
}

TEST(ArticulatedScene, NeighboursOfAJointAreNotAskedAboutUnlessWanted) {
    Scene scene;
    const BodyId base = scene.add(rod());
    LinkOptions options;
    options.mount = at(0, 0, 4);
    const BodyId link = scene.add_link(base, rod(), Joint::fixed(), options);
    EXPECT_TRUE(scene.interfering().empty());
    options.meets_carrier = true;
    options.mount = at(1, 0, 0);
    const BodyId other = scene.add_link(base, rod(), Joint::fixed(), options);
    const auto found = scene.interfering();
    // Side by side with the base, and along an edge with the first link.
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].a, base);
    EXPECT_EQ(found[0].b, other);
    EXPECT_EQ(found[0].relation, Relation::Touching);
    EXPECT_EQ(found[1].a, link);
    EXPECT_EQ(found[1].relation, Relation::Touching);
}

TEST(ArticulatedScene, AnElbowThatFoldsBackTouchesExactly) {
    // Three rods. The second turns about the edge it shares with the first, the third slides on.
    Scene scene;
    const BodyId a = scene.add(rod());
    LinkOptions options;
    options.mount = at(0, 0, 4);
    const BodyId b = scene.add_link(a, rod(), Joint::revolute({1, 0, 0}, {0, 1, 0}), options);
    const BodyId c = scene.add_link(b, rod(), Joint::prismatic({0, 0, 4}), options);
    scene.set_joint(b, {1, 0});  // half a turn: b lies beside a, c below b
    // c is behind b's far end: at z from 0 down to -4, side by side with nothing but the edge line.
    auto found = scene.interfering();
    EXPECT_EQ(found.size(), 1U);
    scene.set_joint(c, {-1, 1});  // back by its own length, into b, flush beside a
    found = scene.interfering();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].a, a);
    EXPECT_EQ(found[0].b, c);
    EXPECT_EQ(found[0].relation, Relation::Touching);
    // The smallest turn more, and it enters.
    scene.set_joint(b, {1LL << 50, -1});
    found = scene.interfering();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].relation, Relation::Overlapping);
    // The smallest turn less, and all that is left is the edge about which it turns.
    scene.set_joint(b, {1LL << 50, 1});
    found = scene.interfering();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].relation, Relation::Touching);
}

TEST(ArticulatedScene, ALongChainEndsAtAStatedLimitAndChangesNothing) {
    Scene scene;
    std::vector<BodyId> ids{scene.add(rod())};
    LinkOptions options;
    options.mount = at(0, 0, 4);
    std::vector<Scene::JointValue> values;
    for (int i = 0; i < 60; ++i) {
        const std::array<std::int64_t, 3> axis{i % 3 == 0, i % 3 == 1, i % 3 == 2};
        ids.push_back(scene.add_link(ids.back(), rod(), Joint::revolute({0, 0, 0}, axis), options));
        values.push_back({ids.back(), {1, 1001 + 2 * i}});
    }
    const Pose before = scene.pose(ids.back());
    try {
        scene.set_joints(values);
        FAIL() << "sixty joints should not fit";
    } catch (const LimitError& e) {
        EXPECT_NE(std::string(e.what()).find("joints above"), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("447"), std::string::npos) << e.what();
    }
    EXPECT_EQ(scene.pose(ids.back()), before);
    EXPECT_EQ(scene.joint_value(ids[1]).numerator, 0);
    scene.set_joint(ids[1], {1, 1});
    EXPECT_EQ(scene.pose(ids[2]), Pose::from_quaternion({1, 1, 0, 0}, {0, 0, 4}) * at(0, 0, 4));
}

TEST(ArticulatedScene, MisuseIsRefused) {
    Scene scene;
    const BodyId base = scene.add(rod());
    const BodyId link = scene.add_link(base, rod(), Joint::revolute({0, 0, 0}, {0, 0, 1}));
    EXPECT_THROW(scene.remove(base), UsageError);
    EXPECT_THROW(scene.set_pose(link, at(1, 0, 0)), UsageError);
    EXPECT_THROW(scene.set_joint(base, {1, 1}), UsageError);
    EXPECT_THROW((void)scene.joint(base), UsageError);
    const std::vector<Scene::JointValue> twice{{link, {1, 1}}, {link, {1, 2}}};
    EXPECT_THROW(scene.set_joints(twice), UsageError);
    EXPECT_THROW(scene.set_joint(link, {0, 0}), UsageError);
    EXPECT_THROW(scene.add_link({99, 1}, rod(), Joint::fixed()), UsageError);
    EXPECT_EQ(scene.size(), 2U);
    scene.remove(link);
    scene.remove(base);
    EXPECT_EQ(scene.size(), 0U);
}

}  // namespace
