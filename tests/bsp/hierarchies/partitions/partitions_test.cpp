// SPDX-License-Identifier: Apache-2.0
//
// Partitions of space as structures over two models: no pair of triangles that meets is left out,
// none comes up twice, the closest pair is found, and sizes are linear.
#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/partitions/partitions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/boundary_pairs.h>
#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "support/scene_solids.h"

namespace {

using reference::Random;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Solid;
using trisect::hierarchies::CostCounters;
using trisect::hierarchies::PairStructure;

using Make = std::unique_ptr<PairStructure> (*)(const InterferenceModel&, const InterferenceModel&);
using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

struct Kind {
    const char* name;
    Make make;

    friend std::ostream& operator<<(std::ostream& out, const Kind& k) { return out << k.name; }
};

/// All pairs of triangles that meet, exactly.
Pairs meeting(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
              const Pose& pose_b) {
    const trisect::detail::PosedPair poses(pose_a, a.lattice(), pose_b, b.lattice());
    trisect::detail::TrianglePairTest test(poses);
    Pairs r;
    for (std::uint32_t i = 0; i < a.triangle_count(); ++i)
        for (std::uint32_t j = 0; j < b.triangle_count(); ++j)
            if (test(posed_triangle(trisect::detail::data_of(a), i),
                     posed_triangle(trisect::detail::data_of(b), j))
                    .meets())
                r.emplace(i, j);
    return r;
}

Pairs candidates(PairStructure& s, CostCounters& counters) {
    Pairs r;
    s.candidates(
        [&r](std::uint32_t i, std::uint32_t j) {
            EXPECT_TRUE(r.emplace(i, j).second) << i << " " << j << " twice";
            return false;
        },
        counters);
    return r;
}

/// The least distance of candidates in doubles, A's lattice the world's.
double nearest(PairStructure& s, CostCounters& counters) {
    const auto& a = trisect::detail::data_of(s.model_a());
    const auto& b = trisect::detail::data_of(s.model_b());
    const trisect::detail::ApproximateMap map = trisect::detail::approximate_map(
        s.pose_a(), s.model_a().lattice(), s.pose_b(), s.model_b().lattice());
    double least = std::numeric_limits<double>::infinity();
    s.near(
        least,
        [&](std::uint32_t i, std::uint32_t j) {
            ++counters.primitive_tests;
            trisect::detail::TriangleCorners p;
            trisect::detail::TriangleCorners q;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = a.position(a.triangles[i].vertex[k]);
                q[k] = map(b.position(b.triangles[j].vertex[k]));
            }
            const bool meet =
                trisect::detail::compare_triangles(p, q, 0) != trisect::detail::PairVerdict::Apart;
            const double d = meet ? 0 : std::sqrt(trisect::detail::closest_points(p, q).squared);
            least = std::min(least, d);
            return least * (1 + 1e-9);
        },
        counters);
    return least;
}

class Partitions : public testing::TestWithParam<Kind> {
protected:
    /// Trees of face planes are as deep as the solid makes them.
    static bool is_plane_tree() {
        const std::string name = GetParam().name;
        return name == "Bsp" || name == "Msp";
    }
};

TEST_P(Partitions, SolidsOnASmallGridThatTouchAndCoincide) {
    std::size_t met = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Random random(seed);
        const InterferenceModel a = scene_test::random_model(random);
        const InterferenceModel b = scene_test::random_model(random);
        const auto structure = GetParam().make(a, b);
        for (int pose = 0; pose < 4; ++pose) {
            const Pose pose_a = scene_test::random_pose(random);
            const Pose pose_b = scene_test::random_pose(random);
            CostCounters counters;
            structure->place(pose_a, pose_b, counters);
            const Pairs found = candidates(*structure, counters);
            const Pairs expected = meeting(a, pose_a, b, pose_b);
            ASSERT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()))
                << seed << " " << pose;
            met += expected.size();
        }
    }
    EXPECT_GT(met, 1000U);
}

TEST_P(Partitions, ClosestTrianglesOfSolidsOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const InterferenceModel a = scene_test::random_model(random);
        const InterferenceModel b = scene_test::random_model(random);
        const auto structure = GetParam().make(a, b);
        const auto far = [&random] { return static_cast<double>(random.between(-30, 30)); };
        const Pose pose_b = Pose::from_quaternion({3, 1, 0, 1}, {far(), far(), far()});
        CostCounters counters;
        structure->place(Pose(), pose_b, counters);
        const double found = nearest(*structure, counters);
        trisect::detail::DistanceSearch search(trisect::detail::data_of(a), structure->pose_a(),
                                               trisect::detail::data_of(b), pose_b);
        search.run();
        // The search's distance is in the user's units.
        const double unit = std::ldexp(1.0, a.lattice().exponent);
        EXPECT_NEAR(found * unit, search.upper(), 1e-9 * (1 + search.upper())) << seed;
    }
}

InterferenceModel torus(std::uint32_t around, std::uint32_t across) {
    return InterferenceModel(Solid::from_mesh(trisect::make_torus(1, 0.2, around, across)));
}

TEST_P(Partitions, InterlockedToriAreApartAndTouchNothingOfEachOther) {
    const InterferenceModel a = torus(40, 20);
    const auto structure = GetParam().make(a, a);
    CostCounters counters;
    const Pose turned = Pose::from_quaternion({1, 1, 0, 0}, {1, 0, 0});
    structure->place(Pose(), turned, counters);
    EXPECT_TRUE(meeting(a, Pose(), a, turned).empty());
    // All triangles of B are brought along, few pairs are left.
    EXPECT_LE(candidates(*structure, counters).size(), a.triangle_count());
    EXPECT_GE(counters.updates, a.triangle_count());
    EXPECT_LE(counters.updates, a.triangle_count() + 1);
    CostCounters near_counters;
    const double found = nearest(*structure, near_counters);
    trisect::detail::DistanceSearch search(trisect::detail::data_of(a), Pose(),
                                           trisect::detail::data_of(a), turned);
    search.run();
    EXPECT_NEAR(std::ldexp(found, a.lattice().exponent), search.upper(), 1e-9);
    EXPECT_LT(near_counters.primitive_tests, a.triangle_count() * a.triangle_count() / 20);
}

TEST_P(Partitions, TheSizeIsLinear) {
    std::vector<double> per_triangle;
    for (const std::uint32_t n : {20U, 40U, 60U}) {
        const InterferenceModel a = torus(2 * n, n);
        const auto report = GetParam().make(a, a)->build_report();
        per_triangle.push_back(static_cast<double>(report.bytes) /
                               static_cast<double>(a.triangle_count()));
        EXPECT_LE(per_triangle.back(), is_plane_tree() ? 1200 : 600);
        if (!is_plane_tree()) {
            EXPECT_LE(report.depth, 24U);
        }
    }
    EXPECT_LE(per_triangle.back(), 1.5 * per_triangle.front());
}

// A plate of two large triangles a side beside a ball of small ones: the plate may not be listed in
// every cell, nor the ball in every cell of the plate.
TEST_P(Partitions, ASmallBallOnALargePlate) {
    const Solid ball = Solid::from_mesh(trisect::make_uv_sphere(1, 32, 16));
    const Solid plate = Solid::from_mesh(trisect::make_box({-1000, -1000, -1}, {1000, 1000, 0}));
    const InterferenceModel a(trisect::evaluate(trisect::Expression(ball) | plate));
    const InterferenceModel b(ball);
    const auto structure = GetParam().make(a, b);
    EXPECT_LE(structure->build_report().bytes, 800 * a.triangle_count());
    CostCounters counters;
    const Pose pose = Pose::from_translation({0.5, 0.25, 0.5});
    structure->place(Pose(), pose, counters);
    const Pairs found = candidates(*structure, counters);
    const Pairs expected = meeting(a, Pose(), b, pose);
    EXPECT_FALSE(expected.empty());
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
}

// A partition that knows inside from outside needs no pair of triangles to see that solids overlap.
TEST_P(Partitions, DeepPenetrationIsSeenWithoutAPairOfTrianglesByTreesOfPlanes) {
    const InterferenceModel a(Solid::from_mesh(trisect::make_uv_sphere(3, 24, 12)));
    const auto structure = GetParam().make(a, a);
    CostCounters counters;
    structure->place(Pose(), Pose::from_quaternion({5, 1, 2, 0}, {1, 1, 0.5}), counters);
    EXPECT_EQ(relation(*structure, counters), trisect::Relation::Overlapping);
    EXPECT_EQ(counters.primitive_tests == 0, is_plane_tree());
    // Trees alone see it: B's triangles stay where they are.
    EXPECT_EQ(counters.updates == 0, is_plane_tree());
    // One that is wholly inside is proved by the boundaries being apart, as anywhere.
    CostCounters inside;
    structure->place(Pose(), Pose::from_doubles({0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0}),
                     inside);
    EXPECT_EQ(relation(*structure, inside), trisect::Relation::Contains);
}

// No vertex of the beam is inside of the plate, but parts of its faces are.
TEST_P(Partitions, ABeamThroughAPlate) {
    const InterferenceModel plate(Solid::from_mesh(trisect::make_box({-10, -10, -1}, {10, 10, 1})));
    const InterferenceModel beam(Solid::from_mesh(trisect::make_box({-1, -1, -10}, {1, 1, 10})));
    const auto structure = GetParam().make(plate, beam);
    CostCounters counters;
    structure->place(Pose(), Pose::from_quaternion({9, 1, 1, 1}), counters);
    EXPECT_EQ(relation(*structure, counters), trisect::Relation::Overlapping);
    EXPECT_EQ(counters.primitive_tests == 0, is_plane_tree());
}

// Two cubes through each other as one mesh, and one twice, which are no embedded boundaries.
TEST_P(Partitions, BoundariesThatAreNotEmbeddedLoseNothing) {
    for (const double shift : {0.0, 1.0, 2.0}) {
        trisect::PolygonMesh mesh = trisect::make_box({0, 0, 0}, {3, 3, 3});
        const trisect::PolygonMesh other = trisect::make_box({shift, shift, 1}, {shift + 3, 5, 2});
        const auto corners = static_cast<std::uint32_t>(mesh.points.size());
        const auto first = static_cast<std::uint32_t>(mesh.corners.size());
        mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
        for (const std::uint32_t c : other.corners) mesh.corners.push_back(c + corners);
        for (std::size_t f = 1; f < other.face_begin.size(); ++f)
            mesh.face_begin.push_back(other.face_begin[f] + first);
        const InterferenceModel a(Solid::from_mesh(mesh));
        const InterferenceModel b(Solid::from_mesh(trisect::make_uv_sphere(1, 8, 4)));
        const auto structure = GetParam().make(a, b);
        for (int x = -1; x < 7; ++x)
            for (int y = -1; y < 7; ++y) {
                const Pose pose = Pose::from_translation({1.0 * x, 1.0 * y, 1.5});
                CostCounters counters;
                structure->place(Pose(), pose, counters);
                const Pairs found = candidates(*structure, counters);
                const Pairs expected = meeting(a, Pose(), b, pose);
                EXPECT_TRUE(
                    std::includes(found.begin(), found.end(), expected.begin(), expected.end()))
                    << shift << " " << x << " " << y;
            }
    }
}

/// Boxes on the places of a grid, moved by chance, as one solid.
Solid field_of_obstacles(int n) {
    Random random(11);
    std::vector<trisect::Expression> boxes;
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z) {
                const auto at = [&random](int i) {
                    return 16.0 * i + static_cast<double>(random.between(0, 6));
                };
                const trisect::Point3d low{at(x), at(y), at(z)};
                boxes.push_back(
                    Solid::from_mesh(trisect::make_box(low, {low[0] + 5, low[1] + 6, low[2] + 7})));
            }
    return trisect::evaluate(trisect::Expression::any_of(boxes));
}

TEST(FreeSpace, AFlightThroughObstaclesCostsTheTetrahedraThatAreCrossed) {
    const InterferenceModel a(field_of_obstacles(8));
    const InterferenceModel b(Solid::from_mesh(trisect::make_uv_sphere(1.5, 12, 8)));
    const auto structure = trisect::hierarchies::make_free_space_partition(a, b);
    std::size_t free_frames = 0;
    std::size_t hits = 0;
    constexpr int frames = 400;
    CostCounters all;
    for (int f = 0; f < frames; ++f) {
        // From outside, along a curve between and through obstacles, and out again.
        const double s = f * 0.005;
        const Pose pose = Pose::from_quaternion(
            {7, f % 5, 1, 0}, {-20 + 180 * s * 0.9, 64 + 50 * s * (1 - s / 2), 120 - 50 * s});
        CostCounters counters;
        structure->place(Pose(), pose, counters);
        const Pairs found = candidates(*structure, counters);
        if (f % 8 == 0) {
            const Pairs expected = meeting(a, Pose(), b, pose);
            ASSERT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()))
                << f;
            hits += expected.empty() ? 0 : 1;
        }
        // Nothing near: the body is one volume, its triangles stay where they are.
        if (counters.updates == 1) ++free_frames;
        EXPECT_LT(counters.volume_tests, 4000U) << f;
        all += counters;
    }
    EXPECT_GT(hits, 3U);
    EXPECT_GT(free_frames, frames / 10U);
    EXPECT_LT(all.volume_tests / frames, 1000U);
    EXPECT_GT(structure->build_report().volumes, 10000U);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Partitions,
    testing::Values(Kind{"Octree", trisect::hierarchies::make_octree_partition},
                    Kind{"KdTree", trisect::hierarchies::make_kd_tree_partition},
                    Kind{"RTree", trisect::hierarchies::make_r_tree_partition},
                    Kind{"HashGrid", trisect::hierarchies::make_hash_grid_partition},
                    Kind{"HierarchicalGrid",
                         trisect::hierarchies::make_hierarchical_grid_partition},
                    Kind{"Bsp", trisect::hierarchies::make_bsp_partition},
                    Kind{"Msp", trisect::hierarchies::make_msp_partition},
                    Kind{"FreeSpace", trisect::hierarchies::make_free_space_partition}),
    [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
