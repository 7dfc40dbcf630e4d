// SPDX-License-Identifier: Apache-2.0
//
// Contacts of two posed triangles against rationals: the points and the features that meet there.

#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <trisect/kernel/pose.h>

#include "reference/triangle_contact.h"
#include "support/pose_oracle.h"

namespace {

using oracle::map_of;
using oracle::PoseKind;
using oracle::random_pose;
using oracle::RationalMap;
using trisect::Lattice;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::Pose;
using trisect::detail::Feature;
using trisect::detail::PosedPair;
using trisect::detail::PosedTriangle;
using trisect::detail::TriangleContact;
using trisect::detail::TrianglePairTest;

struct Triangle {
    std::array<Point, 3> corners;
    Plane plane;

    Triangle(const Point& a, const Point& b, const Point& c, const Plane& p)
        : corners{a, b, c}, plane(p) {}
    explicit Triangle(const std::array<LatticePoint, 3>& c)
        : corners{c[0], c[1], c[2]}, plane(Plane::through(c[0], c[1], c[2])) {}

    [[nodiscard]] PosedTriangle posed() const {
        return {{corners.data(), corners.data() + 1, corners.data() + 2}, &plane};
    }
    [[nodiscard]] reference::Triangle3 moved(const RationalMap& map) const {
        return {map(oracle::rational(corners[0])), map(oracle::rational(corners[1])),
                map(oracle::rational(corners[2]))};
    }
};

int code(const Feature& f) {
    if (f.is_interior()) return 6;
    return static_cast<int>(f.index()) + (f.is_corner() ? 0 : 3);
}

using Codes = std::vector<std::pair<int, int>>;

Codes codes_of(const TriangleContact& c) {
    Codes codes;
    for (const auto& p : c.corners()) codes.emplace_back(code(p.a), code(p.b));
    std::ranges::sort(codes);
    return codes;
}

// How often each number of points occurred, and how often in one plane.
struct Tally {
    std::array<int, 7> count{};
    int coplanar = 0;
    int crossing = 0;
};

void expect_same(const Triangle& a, const Triangle& b, const Pose& pa, const Pose& pb,
                 Tally& tally) {
    const PosedPair poses(pa, Lattice{}, pb, Lattice{});
    TrianglePairTest test(poses);
    const TriangleContact found = test(a.posed(), b.posed());
    const auto ra = a.moved(map_of(pa));
    const auto rb = b.moved(map_of(pb));
    Codes expected;
    for (const auto& [point, parts] : reference::contact(ra, rb)) expected.push_back(parts);
    std::ranges::sort(expected);
    EXPECT_EQ(codes_of(found), expected);
    EXPECT_EQ(codes_of(test(a.posed(), b.posed())), expected);  // from what was kept
    ++tally.count[found.count];

    const auto normal = [](const reference::Triangle3& t) {
        return reference::cross(reference::subtracted(t[1], t[0]),
                                reference::subtracted(t[2], t[0]));
    };
    reference::Point3 na = normal(ra);
    reference::Point3 nb = normal(rb);
    if (pa.is_mirror())
        for (auto& v : na) v = -v;
    if (pb.is_mirror())
        for (auto& v : nb) v = -v;
    const reference::Point3 zero{};
    const bool coplanar = reference::cross(na, nb) == zero &&
                          reference::dot(na, reference::subtracted(rb[0], ra[0])) == 0;
    EXPECT_EQ(found.coplanar, coplanar);
    if (coplanar) {
        EXPECT_EQ(found.opposite, reference::dot(na, nb) < 0);
        ++tally.coplanar;
    }
    // Crossing: a point halfway between the two is in both interiors.
    bool crossing = false;
    if (!coplanar && expected.size() == 2) {
        const auto points = reference::contact(ra, rb);
        const auto& p = points.begin()->first;
        const auto& q = points.rbegin()->first;
        const reference::Point3 middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
        crossing = reference::part_at(ra, middle) == 6 && reference::part_at(rb, middle) == 6;
    }
    EXPECT_EQ(found.crossing, crossing);
    tally.crossing += crossing ? 1 : 0;
}

std::array<LatticePoint, 3> random_corners(oracle::Source& random, std::int64_t size, bool flat) {
    for (;;) {
        std::array<LatticePoint, 3> c;
        for (auto& p : c)
            p = {random.between(0, size), random.between(0, size),
                 flat ? 0 : random.between(0, size)};
        if (!are_collinear(c[0], c[1], c[2])) return c;
    }
}

TEST(MovedTrianglePairs, OnASmallGridUnderTranslationsAndQuarterTurns) {
    oracle::Source random(21);
    Tally tally;
    for (int round = 0; round < 30000; ++round) {
        const bool flat = random.below(3) == 0;
        const Pose pa = random.coin() ? Pose() : random_pose(random, PoseKind::QuarterTurns, 2);
        const Pose pb =
            random.coin()
                ? random_pose(random, PoseKind::QuarterTurns, 2)
                : Pose::from_translation({std::floor(oracle::real(random, 2)),
                                          std::floor(oracle::real(random, 2)), flat ? 0.0 : 1.0});
        expect_same(Triangle(random_corners(random, 4, flat)),
                    Triangle(random_corners(random, 4, flat)), pa, pb, tally);
    }
    for (const int count : tally.count) EXPECT_GT(count, 2);
    EXPECT_GT(tally.coplanar, 1000);
    EXPECT_GT(tally.crossing, 1000);
}

TEST(MovedTrianglePairs, UnderQuaternionsDoublesAndMirrors) {
    oracle::Source random(22);
    Tally tally;
    for (int round = 0; round < 10000; ++round) {
        const std::array<PoseKind, 5> kinds{PoseKind::Quaternion, PoseKind::WideQuaternion,
                                            PoseKind::Rotation, PoseKind::Affine, PoseKind::Mirror};
        const Pose pb = random_pose(random, kinds[random.below(kinds.size())], 3);
        expect_same(Triangle(random_corners(random, 5, false)),
                    Triangle(random_corners(random, 5, false)), Pose(), pb, tally);
    }
    EXPECT_GT(tally.crossing, 100);
}

// Both under one rotation, mirrored or not, that no double survives: contact stays as it is.
TEST(MovedTrianglePairs, KeepContactUnderACommonPose) {
    oracle::Source random(23);
    Tally tally;
    for (int round = 0; round < 10000; ++round) {
        const std::array<PoseKind, 4> kinds{PoseKind::WideQuaternion, PoseKind::Rotation,
                                            PoseKind::Affine, PoseKind::Mirror};
        const Pose frame = random_pose(random, kinds[random.below(kinds.size())], 3);
        const Pose step = Pose::from_doubles({random.coin() ? -1.0 : 1.0, 0, 0, 1,  //
                                              0, 1, 0, 0, 0, 0, 1, 0});
        const bool flat = random.coin();
        expect_same(Triangle(random_corners(random, 3, flat)),
                    Triangle(random_corners(random, 3, flat)), frame, frame * step, tally);
    }
    EXPECT_GT(tally.coplanar, 3000);
    for (const int count : tally.count) EXPECT_GT(count, 0);
}

// Corners that are points of three planes, as booleans make them: thirds and sevenths of a grid.
TEST(MovedTrianglePairs, OfPlanePoints) {
    oracle::Source random(24);
    Tally tally;
    const auto axis_point = [&](bool flat) {
        const std::int64_t d = random.coin() ? 3 : 7;
        return Point(Plane::axis_aligned(0, d, random.between(0, 3 * d)),
                     Plane::axis_aligned(1, d, random.between(0, 3 * d)),
                     Plane::axis_aligned(2, d, flat ? d : random.between(0, 3 * d)));
    };
    const auto flat_triangle = [&]() -> Triangle {
        for (;;) {
            const std::array<Point, 3> c{axis_point(true), axis_point(true), axis_point(true)};
            const auto p = oracle::rational(c[0]);
            const auto q = oracle::rational(c[1]);
            const auto r = oracle::rational(c[2]);
            const int turn =
                sgn(mpq_class((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])));
            if (turn == 0) continue;
            const Plane up = Plane::axis_aligned(2, 1, 1);
            return {c[0], c[1], c[2], turn > 0 ? up : up.flipped()};
        }
    };
    for (int round = 0; round < 6000; ++round) {
        const Pose frame =
            random_pose(random, random.coin() ? PoseKind::Quaternion : PoseKind::Identity, 3);
        const Pose b =
            random.coin() ? frame : frame * random_pose(random, PoseKind::QuarterTurns, 2);
        expect_same(flat_triangle(), flat_triangle(), frame, b, tally);
        expect_same(Triangle(random_corners(random, 3, false)), flat_triangle(), frame, b, tally);
    }
    EXPECT_GT(tally.coplanar, 1000);
    EXPECT_GT(tally.crossing, 500);
}

}  // namespace
