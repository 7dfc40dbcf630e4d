// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/bsp_merge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <random>

#include <trisect/bsp/bsp_boolean.h>
#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/classic/bsp_assembly.h>
#include <trisect/bsp/classic/bsp_boundary.h>
#include <trisect/bsp/classic/bsp_sections.h>
#include <trisect/kernel/error.h>

#include "membership_oracle.h"
#include "meshes.h"

namespace trisect {
namespace bsp_merge_test {
namespace {

using Label = BspTree::Label;
using Membership = BspTree::Membership;

constexpr BooleanRule unite = BooleanRule::set_union();
constexpr BooleanRule intersect_sets = BooleanRule::set_intersection();
constexpr BooleanRule subtract = BooleanRule::set_difference();
constexpr BooleanRule exclude = BooleanRule::symmetric_difference();
constexpr std::array<BooleanRule, 4> all_rules{unite, intersect_sets, subtract, exclude};

ExactRational volume_of(const BspTree& tree) { return enclosed_volume(boundary_of(tree)); }

void expect_sound(const BspTree& tree) {
    tree.validate();
    const auto sections = cell_sections(tree);
    EXPECT_TRUE(std::none_of(sections.begin(), sections.end(),
                             [](const ConvexPolygon& s) { return s.is_empty(); }));
    const auto boundary = boundary_of(tree);
    EXPECT_TRUE(std::all_of(boundary.begin(), boundary.end(),
                            [](const ConvexPolygon& f) { return f.is_consistent(); }));
}

/// A random solid and the meshes to ask about it.
struct Operand {
    LatticeMesh mesh;
    BspTree tree;
};

Operand random_operand(std::mt19937& random, int size) {
    Operand o;
    o.mesh =
        random() % 2 == 0 ? test::random_box(random, size) : test::random_tetrahedron(random, size);
    o.tree = build_bsp(o.mesh);
    return o;
}

std::optional<bool> strictly_inside(const LatticeMesh& mesh, const LatticePoint& p) {
    const Membership m = test::brute_force_membership(mesh, p);
    if (m == Membership::OnBoundary) return {};
    return m == Membership::Inside;
}

TEST(BooleanRule, TablesFollowTheNames) {
    for (const bool a : {false, true})
        for (const bool b : {false, true}) {
            EXPECT_EQ(unite(a, b), a || b);
            EXPECT_EQ(intersect_sets(a, b), a && b);
            EXPECT_EQ(subtract(a, b), a && !b);
            EXPECT_EQ(exclude(a, b), a != b);
        }
    EXPECT_EQ(subtract.given_first(true), UnaryRule::Complement);
    EXPECT_EQ(subtract.given_first(false), UnaryRule::Out);
    EXPECT_EQ(subtract.given_second(false), UnaryRule::Keep);
    EXPECT_EQ(unite.given_second(true), UnaryRule::In);
}

TEST(BspMerge, ConstantsAreNeutralOrAbsorbing) {
    const BspTree a = build_bsp(test::box({0, 0, 0}, {4, 4, 4}));
    const BspTree all(Label::In);
    EXPECT_TRUE(is_same_set(merge(a, BspTree(), unite), a));
    EXPECT_TRUE(is_same_set(merge(all, a, intersect_sets), a));
    EXPECT_TRUE(is_same_set(merge(all, a, subtract), a.complement()));
    EXPECT_TRUE(merge(a, all, unite).is_constant());
    EXPECT_TRUE(merge(BspTree(), a, intersect_sets).is_constant());
}

TEST(BspMerge, ASolidAndItself) {
    for (const LatticeMesh& mesh :
         {test::box({0, 0, 0}, {4, 4, 4}), test::sphere({5, 5, 5}, 1000, 9, 6)}) {
        const BspTree a = build_bsp(mesh);
        const BspTree other_planes = build_bsp(mesh, {1, 1});
        EXPECT_EQ(merge(a, other_planes, subtract).root(), BspTree::NodeId(Label::Out));
        EXPECT_EQ(merge(a, other_planes, exclude).root(), BspTree::NodeId(Label::Out));
        EXPECT_EQ(merge(a, a.complement(), unite).root(), BspTree::NodeId(Label::In));
        EXPECT_TRUE(is_same_set(merge(a, other_planes, unite), a));
        EXPECT_TRUE(is_same_set(a.complement().complement(), a));
        EXPECT_FALSE(is_same_set(a, a.complement()));
    }
}

TEST(BspMerge, AThinDifferenceIsFound) {
    const BspTree a = build_bsp(test::box({0, 0, 0}, {1000000, 1000000, 1000000}));
    const BspTree b = build_bsp(test::box({0, 0, 0}, {1000000, 1000000, 1000001}));
    EXPECT_FALSE(is_same_set(a, b));
    EXPECT_EQ(volume_of(merge(b, a, exclude)), ExactRational(1000000000000));
    EXPECT_EQ(merge(a, b, subtract).root(), BspTree::NodeId(Label::Out));
}

TEST(BspMerge, VolumesOfRandomSolidsAddUp) {
    std::mt19937 random(20);
    for (int i = 0; i < 150; ++i) {
        const Operand a = random_operand(random, 5);
        const Operand b = random_operand(random, 5);
        const BspTree both = merge(a.tree, b.tree, intersect_sets);
        const ExactRational common = volume_of(both);
        const ExactRational va = test::volume(a.mesh);
        const ExactRational vb = test::volume(b.mesh);
        ASSERT_EQ(volume_of(merge(a.tree, b.tree, unite)), va + vb - common) << i;
        ASSERT_EQ(volume_of(merge(a.tree, b.tree, subtract)), va - common) << i;
        ASSERT_EQ(volume_of(merge(a.tree, b.tree, exclude)), va + vb - common - common) << i;
        ASSERT_GE(common.sign(), 0);
        expect_sound(both);
    }
}

TEST(BspMerge, MembershipFollowsTheTruthTable) {
    std::mt19937 random(21);
    for (int i = 0; i < 40; ++i) {
        const Operand a = random_operand(random, 6);
        const Operand b = random_operand(random, 6);
        for (const BooleanRule rule : all_rules) {
            const BspTree result = merge(a.tree, b.tree, rule);
            for (int k = 0; k < 100; ++k) {
                const auto uniform = [&] { return static_cast<std::int64_t>(random() % 8) - 1; };
                const LatticePoint p{uniform(), uniform(), uniform()};
                const auto in_a = strictly_inside(a.mesh, p);
                const auto in_b = strictly_inside(b.mesh, p);
                if (!in_a || !in_b) continue;
                ASSERT_EQ(result.classify(p),
                          rule(*in_a, *in_b) ? Membership::Inside : Membership::Outside);
            }
        }
    }
}

TEST(BspMerge, LawsOfSets) {
    std::mt19937 random(22);
    for (int i = 0; i < 40; ++i) {
        const BspTree a = random_operand(random, 4).tree;
        const BspTree b = random_operand(random, 4).tree;
        const BspTree c = random_operand(random, 4).tree;
        EXPECT_TRUE(is_same_set(merge(a, b, unite).complement(),
                                merge(a.complement(), b.complement(), intersect_sets)));
        EXPECT_TRUE(is_same_set(merge(a, b, subtract), merge(a, b.complement(), intersect_sets)));
        EXPECT_TRUE(is_same_set(merge(a, b, unite), merge(b, a, unite)));
        EXPECT_TRUE(
            is_same_set(merge(merge(a, b, unite), c, intersect_sets),
                        merge(merge(a, c, intersect_sets), merge(b, c, intersect_sets), unite)));
        EXPECT_TRUE(is_same_set(merge(merge(a, b, exclude), b, exclude), a));
    }
}

// The whole range of coordinates: every register at its full width.
TEST(BspMerge, LawsHoldAtTheEndsOfTheLattice) {
    std::mt19937_64 random(25);
    const auto uniform = [&] {
        constexpr std::int64_t most = coordinate_limit - 1;
        return std::uniform_int_distribution<std::int64_t>(-most, most)(random);
    };
    const auto point = [&] { return LatticePoint{uniform(), uniform(), uniform()}; };
    for (int i = 0; i < 20; ++i) {
        std::array<BspTree, 2> t;
        for (BspTree& tree : t) {
            const std::array<LatticePoint, 4> p{point(), point(), point(), point()};
            const bool left = side_of(p[3], Plane::through(p[0], p[1], p[2])) == Side::Above;
            LatticeMesh mesh;
            mesh.points = {left ? p[0] : p[1], left ? p[1] : p[0], p[2], p[3]};
            mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
            tree = build_bsp(mesh);
            for (const LatticePoint& corner : p)
                EXPECT_EQ(tree.classify(corner), Membership::OnBoundary);
        }
        const BspTree sum = merge(t[0], t[1], unite);
        expect_sound(sum);
        EXPECT_TRUE(is_same_set(sum.complement(),
                                merge(t[0].complement(), t[1].complement(), intersect_sets)));
        EXPECT_TRUE(is_same_set(build_bsp(boundary_of(sum)), sum));
        EXPECT_EQ(volume_of(sum) + volume_of(merge(t[0], t[1], intersect_sets)),
                  volume_of(t[0]) + volume_of(t[1]));
        EXPECT_FALSE(brep_from_fragments(boundary_of(sum), {}).is_empty());
    }
}

// What a tree bounds, built into a tree again, is the same set.
TEST(BspMerge, ResultsAreOperandsAgain) {
    std::mt19937 random(23);
    BspTree sum;
    for (int i = 0; i < 6; ++i) {
        sum = merge(sum, random_operand(random, 6).tree, i % 3 == 2 ? subtract : unite);
        const BspTree rebuilt = build_bsp(boundary_of(sum));
        EXPECT_TRUE(is_same_set(rebuilt, sum));
        sum = rebuilt;
    }
    expect_sound(sum);
}

TEST(BspMerge, SphereMinusBox) {
    const LatticeMesh ball = test::sphere({0, 0, 0}, 1000, 15, 10);
    const LatticeMesh corner = test::box({0, 0, 0}, {2000, 2000, 2000});
    const BspTree a = build_bsp(ball);
    const BspTree b = build_bsp(corner);
    const BspTree rest = merge(a, b, subtract);
    expect_sound(rest);
    EXPECT_EQ(volume_of(rest) + volume_of(merge(a, b, intersect_sets)), test::volume(ball));
    std::mt19937 random(24);
    for (int i = 0; i < 3000; ++i) {
        const auto uniform = [&] { return static_cast<std::int64_t>(random() % 2100) - 1050; };
        const LatticePoint p{uniform(), uniform(), uniform()};
        const auto in_a = strictly_inside(ball, p);
        const auto in_b = strictly_inside(corner, p);
        if (!in_a || !in_b) continue;
        ASSERT_EQ(rest.classify(p), *in_a && !*in_b ? Membership::Inside : Membership::Outside);
    }
    const Brep brep = brep_from_fragments(boundary_of(rest), {});
    EXPECT_EQ(brep.counts().shells, 1U);
    EXPECT_EQ(brep.counts().euler_characteristic(), 2);
}

TEST(BspMerge, TwoSpheres) {
    const LatticeMesh a = test::sphere({0, 0, 0}, 100000, 16, 10);
    const LatticeMesh b = test::sphere({70000, 30000, 20000}, 100000, 16, 10);
    ASSERT_EQ(a.triangles.size(), 320U);
    const auto start = std::chrono::steady_clock::now();
    const auto fragments = bsp_boolean(unite, a, b);
    const Brep brep = brep_from_fragments(fragments, {});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    RecordProperty("milliseconds", static_cast<int>(1000 * seconds.count()));
    EXPECT_EQ(brep.counts().shells, 1U);
    EXPECT_EQ(brep.counts().euler_characteristic(), 2);
}

TEST(BspBoolean, DifferentLatticesAreRefused) {
    LatticeMesh fine = test::box({0, 0, 0}, {2, 2, 2});
    fine.lattice.exponent = -8;
    EXPECT_THROW((void)bsp_boolean(unite, fine, test::box({0, 0, 0}, {1, 1, 1})), UsageError);
}

}  // namespace
}  // namespace bsp_merge_test
}  // namespace trisect
