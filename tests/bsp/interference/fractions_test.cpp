// SPDX-License-Identifier: Apache-2.0
//
// Placed solids whose coordinates have bits behind the point: the same solids in larger units give
// the same answers, whichever of the two have fractions; and solids of wide doubles agree with
// brute force in rationals.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_overlap.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>

#include "support/fraction_models.h"
#include "support/interference_oracle.h"
#include "support/models.h"
#include "support/pose_oracle.h"

namespace {

using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::InterferenceQuery;
using trisect::LatticeMesh;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using trisect::test::in_units_of;
using trisect::test::model_in_units_of;
using trisect::test::with_fractions;

constexpr std::array<std::array<int, 2>, 5> both_bits{
    {{8, 0}, {0, 24}, {56, 56}, {70, 3}, {24, 66}}};

std::string everything_about(const InterferenceModel& a, const Pose& pose_a,
                             const InterferenceModel& b, const Pose& pose_b) {
    trisect::InterferenceOptions options;
    options.contacts = options.regions = true;
    const auto all = interfere(a, pose_a, b, pose_b, options);
    if (all.contacts != brute::contacts(a, pose_a, b, pose_b)) return "wrong contacts";
    return brute::wrong_regions(a, pose_a, b, pose_b, all);
}

TEST(InterferenceFractions, RandomScenesAreRelatedAsWithoutThem) {
    std::map<Relation, int> seen;
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        const InterferenceModel a(scene.a.solid());
        const InterferenceModel b(scene.b.solid());
        const Relation relation = interfere(a, scene.pose_a, b, scene.pose_b).relation;
        ++seen[relation];
        const auto squared = exact_squared_distance(a, scene.pose_a, b, scene.pose_b);
        const auto& bits = both_bits[seed % both_bits.size()];
        const InterferenceModel fa = with_fractions(a, bits[0]);
        const InterferenceModel fb = with_fractions(b, bits[1]);
        const auto found = interfere(fa, scene.pose_a, fb, scene.pose_b).relation;
        EXPECT_EQ(found, relation) << "seed " << seed;
        EXPECT_EQ(InterferenceQuery(fa, fb).relation(scene.pose_a, scene.pose_b), relation)
            << "seed " << seed;
        EXPECT_EQ(everything_about(fa, scene.pose_a, fb, scene.pose_b), "") << "seed " << seed;
        EXPECT_EQ(exact_squared_distance(fa, scene.pose_a, fb, scene.pose_b), squared)
            << "seed " << seed;
        if (!squared || squared->sign() == 0) continue;
        const double distance = std::sqrt(squared->to_double());
        for (const double limit : {distance * (1 - 0x1p-52), distance, distance * (1 + 0x1p-52)})
            EXPECT_EQ(are_nearer_than(fa, scene.pose_a, fb, scene.pose_b, limit),
                      are_nearer_than(a, scene.pose_a, b, scene.pose_b, limit))
                << "seed " << seed;
    }
    EXPECT_EQ(seen.size(), 6U);
}

// A mesh keeps its order; so all numbers are the same, doubles too.
TEST(InterferenceFractions, DistancesAndContactsOfAMeshAreEqualInEveryBit) {
    const PolygonMesh ball = trisect::make_icosphere(3, 1);
    PolygonMesh rough = ball;
    for (auto& p : rough.points)
        for (double& c : p) c = std::nearbyint(c * 1024);
    const LatticeMesh whole = in_units_of(rough, 0);
    const InterferenceModel plain(Solid::from_lattice_mesh(whole));
    oracle::Source random(3);
    for (int round = 0; round < 24; ++round) {
        const auto kind = oracle::pose_kinds[static_cast<std::size_t>(round) % 6];
        const Pose pose = oracle::random_pose(random, kind, 5000);
        const auto expected = boundary_distance(plain, Pose(), plain, pose);
        trisect::InterferenceOptions options;
        options.contacts = true;
        const auto contacts = interfere(plain, Pose(), plain, pose, options);
        for (const auto& bits : both_bits) {
            const InterferenceModel a(Solid::from_lattice_mesh(with_fractions(whole, bits[0])));
            const InterferenceModel b(Solid::from_lattice_mesh(with_fractions(whole, bits[1])));
            const auto found = boundary_distance(a, Pose(), b, pose);
            ASSERT_TRUE(found && expected);
            EXPECT_EQ(found->lower, expected->lower);
            EXPECT_EQ(found->upper, expected->upper);
            EXPECT_EQ(found->a, expected->a);
            EXPECT_EQ(found->b, expected->b);
            EXPECT_EQ(found->on_a, expected->on_a);
            EXPECT_EQ(found->on_b, expected->on_b);
            const auto fine = interfere(a, Pose(), b, pose, options);
            EXPECT_EQ(fine.relation, contacts.relation);
            EXPECT_EQ(fine.contacts, contacts.contacts);
        }
    }
}

// A ball of doubles as they come out of a turn.
PolygonMesh wide_ball(oracle::Source& random, std::uint32_t subdivisions) {
    PolygonMesh ball = trisect::make_icosphere(1, subdivisions);
    const double c = std::cos(oracle::real(random, 3));
    const double s = std::sqrt(1 - c * c);
    const double u = std::cos(oracle::real(random, 3));
    const double v = std::sqrt(1 - u * u);
    for (auto& p : ball.points) {
        const std::array<double, 3> q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
        p = {q[0], u * q[1] - v * q[2], v * q[1] + u * q[2]};
    }
    return ball;
}

bool has_fractions(const InterferenceModel& model) {
    for (const trisect::Point& p : model.brep().points())
        if (p.is_lattice() && !p.lattice().is_whole()) return true;
    return false;
}

TEST(InterferenceFractions, WideBallsAgreeWithRationals) {
    oracle::Source random(4);
    std::map<Relation, int> seen;
    for (int round = 0; round < 18; ++round) {
        const InterferenceModel a = model_in_units_of(wide_ball(random, 0), -45);
        const InterferenceModel b = model_in_units_of(wide_ball(random, 0), -40);
        ASSERT_TRUE(has_fractions(a) && has_fractions(b));
        const auto kind = oracle::pose_kinds[static_cast<std::size_t>(round) % 9];
        const Pose pose = oracle::random_pose(random, kind, 1);
        ++seen[interfere(a, Pose(), b, pose).relation];
        EXPECT_EQ(everything_about(a, Pose(), b, pose), "") << round;
    }
    EXPECT_GT(seen[Relation::Overlapping], 0);
}

// Six times the volume, rounded.
double volume_of(const std::array<trisect::Point3d, 4>& p) {
    const auto minus = [](const trisect::Point3d& u, const trisect::Point3d& v) {
        return std::array<double, 3>{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
    };
    const auto u = minus(p[1], p[0]);
    const auto v = minus(p[2], p[0]);
    const auto w = minus(p[3], p[0]);
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
           u[2] * (v[0] * w[1] - v[1] * w[0]);
}

PolygonMesh tetrahedron(const std::array<trisect::Point3d, 4>& p) {
    PolygonMesh mesh;
    mesh.points.assign(p.begin(), p.end());
    for (const std::array<std::uint32_t, 3>& f :
         {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
        if (volume_of(p) > 0)
            mesh.add_face(std::vector<std::uint32_t>{f[0], f[1], f[2]});
        else
            mesh.add_face(std::vector<std::uint32_t>{f[0], f[2], f[1]});
    }
    return mesh;
}

// Two tetrahedra on both sides of one triangle of random doubles, on different lattices, in place
// and under poses that both have in common.
TEST(InterferenceFractions, SolidsWithACommonFaceTouch) {
    oracle::Source random(5);
    const auto corner = [&random] {
        return trisect::Point3d{oracle::real(random, 1), oracle::real(random, 1),
                                oracle::real(random, 0.5)};
    };
    for (int round = 0; round < 60; ++round) {
        std::array<trisect::Point3d, 4> p{corner(), corner(), corner(), {0, 0, 2}};
        std::array<trisect::Point3d, 4> q = p;
        q[3] = {0, 0, -2};
        // A steep triangle has both on one side.
        if (!(volume_of(p) * volume_of(q) < 0)) continue;
        if (round % 3 == 1) q[0] = {oracle::real(random, 1) - 3, 7, oracle::real(random, 1)};
        const InterferenceModel a = model_in_units_of(tetrahedron(p), -45);
        const InterferenceModel b = model_in_units_of(tetrahedron(q), -30 - round % 16);
        ASSERT_TRUE(has_fractions(a));
        const auto kind = oracle::pose_kinds[static_cast<std::size_t>(round) % 9];
        const Pose pose = oracle::random_pose(random, kind, 1);
        for (const Pose& both : {Pose(), pose}) {
            const auto relation = interfere(a, both, b, both).relation;
            if (round % 3 != 1) {
                EXPECT_EQ(relation, Relation::Touching) << round;
                EXPECT_EQ(exact_squared_distance(a, both, b, both), ExactRational()) << round;
            }
            EXPECT_EQ(InterferenceQuery(a, b).relation(both, both), relation) << round;
            EXPECT_EQ(everything_about(a, both, b, both), "") << round;
        }
    }
}

// Each box on the lattice that its size suggests.
InterferenceModel box_in_its_units(const trisect::Point3d& low, const trisect::Point3d& high) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k)
        most = std::max({most, std::abs(low[k]), std::abs(high[k])});
    return model_in_units_of(trisect::make_box(low, high), std::ilogb(most) + 1 - 45);
}

TEST(InterferenceFractions, FlushBoxesOfAnySizeTouch) {
    const InterferenceModel small = box_in_its_units({0, 0, 0}, {0.3, 0.3, 0.3});
    ASSERT_TRUE(has_fractions(small));
    const Pose turn = Pose::from_quaternion({3, 1, 2, 5}, {0.1, 0.7, 1e3});
    for (const double size : {0.5, 7.0, 1000.0, 1e5}) {
        const InterferenceModel large = box_in_its_units({0.3, -1, -1}, {size, size, size});
        const InterferenceModel cut = box_in_its_units({0.3 - 0x1p-54, -1, -1}, {size, 2, 2});
        const InterferenceModel apart = box_in_its_units({0.3 + 0x1p-54, -1, -1}, {size, 2, 2});
        ASSERT_TRUE(has_fractions(large));
        for (const Pose& pose : {Pose(), turn}) {
            trisect::InterferenceOptions options;
            options.contacts = true;
            const auto flush = interfere(small, pose, large, pose, options);
            EXPECT_EQ(flush.relation, Relation::Touching) << size;
            const bool shares_area = std::ranges::any_of(
                flush.contacts, [](const auto& c) { return c.dimension == 2 && c.opposite; });
            EXPECT_TRUE(shares_area) << size;
            EXPECT_EQ(interfere(small, pose, cut, pose).relation, Relation::Overlapping) << size;
            EXPECT_EQ(interfere(small, pose, apart, pose).relation, Relation::Disjoint) << size;
            EXPECT_FALSE(are_nearer_than(small, pose, apart, pose, 0x1p-54));
            EXPECT_TRUE(are_nearer_than(small, pose, apart, pose, 0x1.00001p-54));
        }
    }
}

TEST(InterferenceFractions, FlushBoxesShareNoVolume) {
    const InterferenceModel small = box_in_its_units({0, 0, 0}, {0.3, 0.3, 0.3});
    const InterferenceModel large = box_in_its_units({0.3, -1, -1}, {1000, 2, 2});
    const InterferenceModel cut = box_in_its_units({0.3 - 0x1p-54, -1, -1}, {1000, 2, 2});
    EXPECT_TRUE(overlap(small, Pose(), large, Pose()).scaled_solid.is_empty());
    const auto sliver = overlap(small, Pose(), cut, Pose());
    EXPECT_TRUE(sliver.is_exact);
    const ExactRational side = ExactRational::from_double(0.3);
    EXPECT_EQ(sliver.volume, side * side * ExactRational(1).scaled(-54));
    // Corners on one lattice, but for bits behind the point.
    const double edge = 0.25 + 0x1p-54;
    const InterferenceModel unit = box_in_its_units({0, 0, 0}, {edge, edge, edge});
    const auto inside =
        overlap(models::box(0, 8), Pose(), unit, Pose::from_translation({0x1p-54, 0, 0}));
    EXPECT_TRUE(inside.is_exact);
    const ExactRational length = ExactRational::from_double(edge);
    EXPECT_EQ(inside.volume, length * length * length);
}

TEST(InterferenceFractions, OverlapsOfRandomScenesHaveTheSameVolume) {
    int exact = 0;
    for (std::uint64_t seed = 9000; seed < 9040; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        const InterferenceModel a(scene.a.solid());
        const InterferenceModel b(scene.b.solid());
        const auto expected = overlap(a, scene.pose_a, b, scene.pose_b);
        const auto& bits = both_bits[seed % both_bits.size()];
        const auto found = overlap(with_fractions(a, bits[0]), scene.pose_a,
                                   with_fractions(b, bits[1]), scene.pose_b);
        EXPECT_EQ(found.is_exact, expected.is_exact) << "seed " << seed;
        if (!expected.is_exact) continue;
        ++exact;
        EXPECT_EQ(found.volume, expected.volume) << "seed " << seed;
    }
    EXPECT_GT(exact, 20);
}

// A query that goes with the motion, through every kind of answer; balls inside both are used after
// a thousand questions.
TEST(InterferenceFractions, CoherentQueriesAreThoseOfWholeSolids) {
    PolygonMesh ball = trisect::make_icosphere(1, 2);
    for (auto& p : ball.points)
        for (double& c : p) c = std::nearbyint(c * 4096) / 4096;
    const LatticeMesh whole = in_units_of(ball, -12);
    const InterferenceModel plain(Solid::from_lattice_mesh(whole));
    const InterferenceModel a(Solid::from_lattice_mesh(with_fractions(whole, 60)));
    const InterferenceModel b(Solid::from_lattice_mesh(with_fractions(whole, 17)));
    InterferenceQuery query(plain, plain);
    InterferenceQuery fine(a, b);
    InterferenceQuery mixed(plain, b);
    std::map<Relation, int> seen;
    for (int i = 0; i < 1500; ++i) {
        const double t = 0.01 * i;
        const Pose pose =
            i % 100 == 99 ? Pose()
                          : Pose::from_quaternion({7, i % 13, 1, 2},
                                                  {2.5 * std::sin(t), 0.3 * std::cos(3 * t), 0});
        const Relation r = query.relation(Pose(), pose);
        EXPECT_EQ(fine.relation(Pose(), pose), r) << i;
        EXPECT_EQ(mixed.relation(Pose(), pose), r) << i;
        ++seen[r];
    }
    EXPECT_GT(seen[Relation::Disjoint], 100);
    EXPECT_GT(seen[Relation::Overlapping], 100);
    EXPECT_EQ(seen[Relation::Equal], 15);
}

TEST(InterferenceFractions, ScenesHaveTheSamePairs) {
    using trisect::SceneBroadPhase;
    oracle::Source random(6);
    const std::array<int, 4> bits{0, 8, 40, 70};
    for (const auto phase :
         {SceneBroadPhase::SweepAndPrune, SceneBroadPhase::BoxTree, SceneBroadPhase::HashGrid,
          SceneBroadPhase::HierarchicalGrid, SceneBroadPhase::Octree, SceneBroadPhase::KdTree,
          SceneBroadPhase::ChainBoxes}) {
        trisect::Scene plain({phase});
        trisect::Scene fine({phase});
        for (int i = 0; i < 40; ++i) {
            const double size = static_cast<double>(random.between(1, 3));
            const InterferenceModel box = models::box(0, size);
            const Pose pose = oracle::random_pose(
                random, i % 4 == 3 ? oracle::PoseKind::Quaternion : oracle::PoseKind::QuarterTurns,
                4);
            (void)plain.add(box, pose);
            (void)fine.add(with_fractions(box, bits[random.below(4)]), pose);
        }
        const auto expected = plain.interfering();
        const auto found = fine.interfering();
        EXPECT_GT(expected.size(), 20U);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].a, expected[i].a);
            EXPECT_EQ(found[i].b, expected[i].b);
            EXPECT_EQ(found[i].relation, expected[i].relation);
        }
    }
}

}  // namespace
