// SPDX-License-Identifier: Apache-2.0
//
// Volumes contain what they were made from, and turned ones what it is turned into: random points
// of triangles in exact rationals, under exact poses.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/pairs/tree_frame.h>
#include <trisect/bsp/hierarchies/volumes/kdop.h>
#include <trisect/bsp/hierarchies/volumes/small_hull.h>
#include <trisect/bsp/hierarchies/volumes/sphere_kind.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose/relative_pose.h>

#include "reference/random_solids.h"
#include "support/numbers.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;
using numbers::exact;
using reference::Random;
using Exact3 = std::array<ExactRational, 3>;

// In the frame of a tree, from lattice units.
Exact3 in_frame(const Exact3& p, const TreeFrame& frame) {
    Exact3 z;
    for (std::size_t k = 0; k < 3; ++k) z[k] = (p[k] - exact(frame.origin[k])) / exact(frame.unit);
    return z;
}

// A random point of a triangle, by weights that are multiples of 1/8: sides and corners too.
Exact3 random_point(const std::array<Exact3, 3>& corners, Random& random) {
    const std::int64_t u = random.between(0, 8);
    const std::int64_t v = random.between(0, 8 - u);
    const std::array<std::int64_t, 3> w{u, v, 8 - u - v};
    Exact3 p;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            p[k] = p[k] + corners[i][k] * ExactRational(w[i]) / ExactRational(8);
    return p;
}

template <std::size_t K>
bool contains(const KDop<K>& volume, const Exact3& z) {
    for (std::size_t i = 0; i < K / 2; ++i) {
        ExactRational along;
        for (std::size_t k = 0; k < 3; ++k)
            along = along + ExactRational(KDop<K>::directions[i][k]) * z[k];
        if (exact(static_cast<double>(volume.h[i])) < along) return false;
        if (along < ExactRational(0) - exact(static_cast<double>(volume.h[K / 2 + i])))
            return false;
    }
    return true;
}

bool contains(const Sphere& s, const Exact3& z) {
    ExactRational square;
    for (std::size_t k = 0; k < 3; ++k) {
        const ExactRational d = z[k] - exact(static_cast<double>(s.center[k]));
        square = square + d * d;
    }
    const ExactRational r = exact(static_cast<double>(s.radius));
    return square <= r * r;
}

// In none of 26 directions beyond the corners by more than the radius.
bool contains(const SmallHull& hull, const Exact3& z) {
    for (std::size_t i = 0; i < 26; ++i) {
        std::array<double, 3> d{};
        for (std::size_t k = 0; k < 3; ++k)
            d[k] = (i < 13 ? 1 : -1) * KDop<26>::directions[i % 13][k];
        double most = -1000;
        for (std::size_t v = 0; v < hull.count; ++v) {
            const auto p = hull.point(v);
            // Of floats, so that the sum is off by an ulp of a double at most.
            most = std::max(most, d[0] * p[0] + d[1] * p[1] + d[2] * p[2]);
        }
        ExactRational beyond = ExactRational(0) - exact(most + 0x1p-48);
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            beyond = beyond + exact(d[k]) * z[k];
            square += d[k] * d[k];
        }
        const ExactRational radius = exact(static_cast<double>(hull.radius));
        if (beyond.sign() > 0 && exact(square) * radius * radius < beyond * beyond) return false;
    }
    return true;
}

template <std::size_t K>
struct OfSlabs {
    KDopTurn turn;
    explicit OfSlabs(const FrameMap& map) : turn(KDop<K>::directions, map) {}
    static KDop<K> fit(const std::vector<std::array<double, 3>>& corners, double error) {
        KDop<K> r;
        r.add(corners, error);
        return r;
    }
    [[nodiscard]] KDop<K> moved(const KDop<K>& v) const { return v.turned(turn); }
};

struct OfSpheres {
    SphereKind::Pose pose;
    explicit OfSpheres(const FrameMap& map) : pose(map) {}
    static Sphere fit(const std::vector<std::array<double, 3>>& corners, double error) {
        return SphereKind::fit(corners, error);
    }
    [[nodiscard]] Sphere moved(const Sphere& v) const { return pose.moved(v); }
};

struct OfHulls {
    FrameMap map;
    explicit OfHulls(const FrameMap& m) : map(m) {}
    static SmallHull fit(const std::vector<std::array<double, 3>>& corners, double error) {
        return SmallHull::around(corners, error);
    }
    [[nodiscard]] SmallHull moved(const SmallHull& v) const { return v.moved(map); }
};

template <class Kind>
void expect_containment(std::int64_t most_triangles = 9) {
    Random random(11);
    const InterferenceModel whole(Solid::from_mesh(make_torus(3, 1, 16, 9)));
    const auto& m = trisect::detail::data_of(whole);
    const TreeFrame frame(m);
    for (int round = 0; round < 60; ++round) {
        std::vector<std::array<double, 3>> corners;
        std::vector<std::uint32_t> triangles;
        const std::int64_t count = random.between(1, most_triangles);
        for (std::int64_t i = 0; i < count; ++i) {
            triangles.push_back(static_cast<std::uint32_t>(
                random.between(0, static_cast<std::int64_t>(m.triangles.size()) - 1)));
            for (const VertexId v : m.triangles[triangles.back()].vertex)
                corners.push_back(frame(m.position(v)));
        }
        const auto volume = Kind::fit(corners, frame.error);
        const auto some = [&random] { return static_cast<double>(random.between(-9, 9)) / 7; };
        std::array<double, 12> rows{};
        for (double& r : rows) r = some();
        rows[0] += 3;  // regular
        rows[5] -= 3;
        rows[10] += 3;
        const Pose pose =
            round % 2 == 0 ? Pose::from_quaternion({random.between(1, 9), random.between(-9, 9),
                                                    random.between(-9, 9), random.between(-9, 9)},
                                                   {some(), some(), some()})
                           : Pose::from_doubles(rows);
        const detail::RelativePose to_a =
            detail::relative_pose(Pose(), whole.lattice(), pose, whole.lattice());
        const FrameMap map(frame, frame, detail::approximate_map(to_a));
        const auto moved_volume = Kind(map).moved(volume);
        for (const std::uint32_t t : triangles) {
            std::array<Exact3, 3> here;
            std::array<Exact3, 3> there;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto place = detail::exact_place(m.brep.point(m.triangles[t].vertex[i]));
                here[i] = in_frame(moved(place, detail::RelativePose()).c, frame);
                there[i] = in_frame(moved(place, to_a).c, frame);
            }
            for (int i = 0; i < 6; ++i) {
                EXPECT_TRUE(contains(volume, random_point(here, random))) << round;
                EXPECT_TRUE(contains(moved_volume, random_point(there, random))) << round;
            }
        }
    }
}

TEST(VolumeContainment, OfSlabsOfThreeDirections) { expect_containment<OfSlabs<6>>(); }
TEST(VolumeContainment, OfSlabsOfSevenDirections) { expect_containment<OfSlabs<14>>(); }
TEST(VolumeContainment, OfSlabsOfNineDirections) { expect_containment<OfSlabs<18>>(); }
TEST(VolumeContainment, OfSlabsOfThirteenDirections) { expect_containment<OfSlabs<26>>(); }
TEST(VolumeContainment, OfHullsOfAFewTriangles) { expect_containment<OfHulls>(); }
TEST(VolumeContainment, OfHullsWithFewerCornersThanPoints) { expect_containment<OfHulls>(40); }
TEST(VolumeContainment, OfSpheres) { expect_containment<OfSpheres>(); }

// The gap of hulls of two boxes that face each other, and 0 where they overlap.
TEST(VolumeContainment, HullsOfBoxesHaveTheGapOfTheBoxes) {
    std::vector<std::array<double, 3>> box;
    for (const double x : {-0.5, 0.0})
        for (const double y : {-0.25, 0.25})
            for (const double z : {-0.25, 0.25}) box.push_back({x, y, z});
    const SmallHull a = SmallHull::around(box, 0);
    for (const double gap : {0.5, 0.125, 0.001, -0.1}) {
        std::vector<std::array<double, 3>> other = box;
        for (auto& p : other) p[0] += 0.5 + gap;
        const SmallHull b = SmallHull::around(other, 0);
        for (const GapEffort effort : {GapEffort::Sign, GapEffort::Value}) {
            std::array<double, 3> direction{0.1, 0.9, -0.3};
            const double found = gap_of(a, b, effort, direction);
            EXPECT_LE(found, std::max(0.0, gap));
            if (effort == GapEffort::Value) {
                EXPECT_GE(found, 0.9 * gap - 1e-5);
            }
            EXPECT_EQ(found > 0, gap > 0);
        }
    }
}

// Turned slabs are as tight as they can be where a quarter turn brings directions onto others.
TEST(VolumeContainment, TurnedByQuartersNothingGrows) {
    const InterferenceModel whole(Solid::from_mesh(make_torus(3, 1, 16, 9)));
    const TreeFrame frame(trisect::detail::data_of(whole));
    std::vector<std::array<double, 3>> corners;
    for (const auto& p : trisect::detail::data_of(whole).positions) corners.push_back(frame(p));
    const KDop<26> volume = OfSlabs<26>::fit(corners, frame.error);
    detail::ApproximateMap quarter;
    quarter.m = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    const KDop<26> turned =
        volume.turned(KDopTurn(KDop<26>::directions, FrameMap(frame, frame, quarter)));
    EXPECT_NEAR(turned.size(), volume.size(), 1e-5);
}

}  // namespace
