// SPDX-License-Identifier: Apache-2.0
//
// Signs between two posed solids against rationals that move the points.

#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/pose/moved_predicates.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/pose/relative_pose.h>

#include "support/fractions.h"
#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"
#include "support/pose_oracle.h"

namespace {

using oracle::map_of;
using oracle::pose_kinds;
using oracle::PoseKind;
using oracle::random_pose;
using oracle::RationalMap;
using oracle::RationalPoint;
using trisect::Diagnostics;
using trisect::Lattice;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::Pose;
using trisect::PredicateCounters;
using trisect::detail::BoundedInt;
using trisect::detail::determinant_sign;
using trisect::detail::Direction;
using trisect::detail::MovedPoint;
using trisect::detail::orientation;
using trisect::detail::planar_orientation;
using trisect::detail::PosedPair;
using trisect::detail::PulledPlane;

using Vector = std::array<mpq_class, 3>;

Vector operator-(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

mpq_class det(const Vector& a, const Vector& b, const Vector& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Vector linear(const RationalMap& map, const Vector& v) {
    RationalMap m = map;
    m.t = {};
    return m(v);
}

// Corners of a small grid, of 26 and of 53 bits, and points of three planes.
Point random_point(oracle::Source& random, int bits, bool planes) {
    if (!planes) return random.point(bits);
    for (;;) {
        const Plane p = random.plane(bits);
        const Plane q = random.plane(bits);
        const Plane r = random.plane(bits);
        if (meet_in_a_point(p, q, r)) return {p, q, r};
    }
}

struct Scene {
    PosedPair pair;
    RationalMap to_a;
    RationalMap to_b;
    int bits;
    bool plane_points;
};

Scene random_scene(oracle::Source& random, int round) {
    const std::array<int, 5> sizes{2, 4, 10, 26, 53};
    const int bits = sizes[random.below(sizes.size())];
    const double size = std::ldexp(1.0, bits);
    const auto kind = [&] { return pose_kinds[random.below(pose_kinds.size())]; };
    const Pose a = random.coin() ? Pose() : random_pose(random, kind(), size);
    const Pose b = random_pose(random, kind(), size);
    const Lattice u{random.below(4) == 0 ? -8 : 0};
    const Lattice v{random.below(4) == 0 ? -8 : 0};
    const auto map = oracle::relative(a, u.exponent, b, v.exponent);
    return {PosedPair(a, u, b, v), map, oracle::inverse(map), bits, round % 3 == 0};
}

void expect_same(const Scene& s, const Plane& plane, const std::array<Point, 2>& a,
                 const std::array<Point, 3>& b) {
    const PulledPlane pulled(plane, s.pair.to_a);
    const RationalPoint r = s.to_a(oracle::rational(b[0]));
    const RationalPoint t = s.to_a(oracle::rational(b[1]));
    const RationalPoint p = oracle::rational(a[0]);
    const RationalPoint q = oracle::rational(a[1]);
    EXPECT_EQ(pulled.side_of(b[0]), oracle::side(r, plane));
    const auto numbers = oracle::numbers(plane);
    if (!(b[0] == b[1])) {
        const Vector v = t - r;
        EXPECT_EQ(pulled.along(Direction(b[0], b[1])),
                  sgn(mpq_class(numbers.n[0] * v[0] + numbers.n[1] * v[1] + numbers.n[2] * v[2])));
    }
    const MovedPoint mr(b[0], s.pair.to_a);
    const MovedPoint mt(b[1], s.pair.to_a);
    EXPECT_EQ(orientation(a[0], a[1], mr, mt), sgn(det(q - p, t - r, r - p)));
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>((axis + 1) % 3);
        const auto j = static_cast<std::size_t>((axis + 2) % 3);
        const Vector u = q - p;
        const Vector v = r - p;
        EXPECT_EQ(planar_orientation(a[0], a[1], mr, axis),
                  sgn(mpq_class(u[i] * v[j] - u[j] * v[i])));
    }
    if (a[0] == a[1] || b[0] == b[1] || b[0] == b[2]) return;
    const Vector u = q - p;
    const Vector v = linear(s.to_b, u);
    const Vector w = oracle::rational(b[1]) - oracle::rational(b[0]);
    const Vector x = oracle::rational(b[2]) - oracle::rational(b[0]);
    EXPECT_EQ(determinant_sign(Direction(b[0], b[1]), Direction(b[0], b[2]), Direction(a[0], a[1]),
                               s.pair.to_b),
              sgn(det(w, x, v)));
}

TEST(MovedPredicates, AgreeWithRationalsOnRandomInput) {
    oracle::Source random(11);
    for (int round = 0; round < 6000; ++round) {
        const Scene s = random_scene(random, round);
        const auto point = [&] { return random_point(random, s.bits, s.plane_points); };
        expect_same(s, random.plane(s.bits), {point(), point()}, {point(), point(), point()});
    }
}

// Corners with up to 73 bits behind the point, and points of planes through such.
TEST(MovedPredicates, AgreeWithRationalsOnFractions) {
    oracle::Source random(21);
    for (int round = 0; round < 4000; ++round) {
        const Scene s = random_scene(random, round);
        const int behind = 1 + static_cast<int>(random.below(trisect::fraction_limit));
        const auto plane = [&] { return random.plane(s.bits, random.coin() ? behind : 0); };
        const auto point = [&]() -> Point {
            if (!s.plane_points) return random.point(s.bits, random.coin() ? behind : 1);
            for (;;) {
                const Plane p = plane();
                const Plane q = plane();
                const Plane r = plane();
                if (meet_in_a_point(p, q, r)) return {p, q, r};
            }
        };
        expect_same(s, plane(), {point(), point()}, {point(), point(), point()});
    }
}

// The same scene in units 2^bits times as large has the same signs, flush or not.
TEST(MovedPredicates, AreThoseOfTheSameSceneWithFractions) {
    oracle::Source random(22);
    int on = 0;
    for (int round = 0; round < 4000; ++round) {
        // Quarter turns and translations bring corners of one into planes of the other.
        const PoseKind kind = random.coin() ? PoseKind::QuarterTurns : PoseKind::Translation;
        const Pose pose = random_pose(random, kind, 2);
        const std::array<int, 2> bits{static_cast<int>(random.below(71)),
                                      static_cast<int>(random.below(71))};
        const PosedPair whole(Pose(), Lattice{}, pose, Lattice{});
        const PosedPair fine(Pose(), Lattice{bits[0]}, pose, Lattice{bits[1]});
        const auto corner = [&] { return random.point(2); };
        const std::array<LatticePoint, 3> a{corner(), corner(), corner()};
        const std::array<LatticePoint, 3> b{corner(), corner(), corner()};
        if (are_collinear(a[0], a[1], a[2]) || b[0] == b[1]) continue;
        const auto in_a = [&](const LatticePoint& p) -> Point {
            return trisect::test::with_fractions(p, bits[0]);
        };
        const auto in_b = [&](const LatticePoint& p) -> Point {
            return trisect::test::with_fractions(p, bits[1]);
        };
        const Plane plane = Plane::through(a[0], a[1], a[2]);
        const Plane fine_plane =
            Plane::through(in_a(a[0]).lattice(), in_a(a[1]).lattice(), in_a(a[2]).lattice());
        const PulledPlane pulled(plane, whole.to_a);
        const PulledPlane fine_pulled(fine_plane, fine.to_a);
        const std::array<Point, 3> fine_b{in_b(b[0]), in_b(b[1]), in_b(b[2])};
        const std::array<Point, 3> whole_b{b[0], b[1], b[2]};
        const std::array<Point, 3> whole_a{a[0], a[1], a[2]};
        const std::array<Point, 3> fine_a{in_a(a[0]), in_a(a[1]), in_a(a[2])};
        EXPECT_EQ(fine_pulled.side_of(fine_b[0]), pulled.side_of(whole_b[0]));
        on += pulled.side_of(whole_b[0]) == 0 ? 1 : 0;
        EXPECT_EQ(fine_pulled.along(Direction(fine_b[0], fine_b[1])),
                  pulled.along(Direction(whole_b[0], whole_b[1])));
        const MovedPoint r(whole_b[0], whole.to_a);
        const MovedPoint s(whole_b[1], whole.to_a);
        const MovedPoint fine_r(fine_b[0], fine.to_a);
        const MovedPoint fine_s(fine_b[1], fine.to_a);
        EXPECT_EQ(orientation(fine_a[0], fine_a[1], fine_r, fine_s),
                  orientation(whole_a[0], whole_a[1], r, s));
        EXPECT_EQ(planar_orientation(fine_a[0], fine_a[1], fine_r, 1),
                  planar_orientation(whole_a[0], whole_a[1], r, 1));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(fine_r.is_at(fine_a[i]), r.is_at(whole_a[i]));
    }
    EXPECT_GT(on, 60);
}

// A point of B's lattice next to (or on) a plane of A: the plane's corners brought to B and
// rounded.
TEST(MovedPredicates, AgreeNextToThePlane) {
    oracle::Source random(12);
    int on = 0;
    for (int round = 0; round < 6000; ++round) {
        const Scene s = random_scene(random, round);
        const std::array<LatticePoint, 3> corners{random.point(s.bits), random.point(s.bits),
                                                  random.point(s.bits)};
        if (are_collinear(corners[0], corners[1], corners[2])) continue;
        const auto nearby = [&](const LatticePoint& p) -> Point {
            const RationalPoint x = s.to_b(oracle::rational(p));
            LatticePoint r;
            const std::array<trisect::Coordinate*, 3> at{&r.x, &r.y, &r.z};
            for (std::size_t i = 0; i < 3; ++i) {
                const double c = oracle::nearest(x[i]);
                if (!(std::fabs(c) < 0x1p52)) return random.point(s.bits);
                *at[i] = trisect::Coordinate(std::nearbyint(c));
            }
            return r;
        };
        const Plane plane = Plane::through(corners[0], corners[1], corners[2]);
        const Point p = nearby(corners[0]);
        expect_same(s, plane, {corners[1], corners[2]},
                    {p, nearby(corners[1]), nearby(corners[2])});
        on += PulledPlane(plane, s.pair.to_a).side_of(p) == 0 ? 1 : 0;
    }
    EXPECT_GT(on, 500);  // of translations and quarter turns
}

// Points that are exactly on the plane by construction, also under the rotations and affine maps
// that no moved double would survive: A's corners are images of B's.
TEST(MovedPredicates, FindCoplanarPointsCoplanar) {
    oracle::Source random(13);
    for (int round = 0; round < 2000; ++round) {
        // B is turned by q / |q|² and lives on |q|² times A's grid.
        const std::array<std::int64_t, 4> q{random.between(-3, 3), random.between(-3, 3),
                                            random.between(-3, 3), random.between(1, 3)};
        const std::int64_t n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        const Pose pose = Pose::from_quaternion(q, {5, -3, 2});
        const PosedPair pair(Pose(), Lattice{}, pose, Lattice{});
        const auto map = map_of(pair.to_a);
        const auto image = [&map](const LatticePoint& p) {
            const RationalPoint x = map(oracle::rational(p));
            EXPECT_EQ(x[0].get_den() * x[1].get_den() * x[2].get_den(), 1);
            return LatticePoint{x[0].get_num().get_si(), x[1].get_num().get_si(),
                                x[2].get_num().get_si()};
        };
        const auto corner = [&]() -> LatticePoint {
            const LatticePoint p = random.point(8);
            return {p.x * n, p.y * n, p.z * n};
        };
        const std::array<LatticePoint, 3> b{corner(), corner(), corner()};
        if (are_collinear(b[0], b[1], b[2])) continue;
        const std::array<LatticePoint, 3> a{image(b[0]), image(b[1]), image(b[2])};
        const Plane pa = Plane::through(a[0], a[1], a[2]);
        const Plane pb = Plane::through(b[0], b[1], b[2]);
        const PulledPlane pulled(pa, pair.to_a);
        EXPECT_TRUE(pulled.is_same_as(pb));
        EXPECT_TRUE(pulled.is_same_as(pb.flipped()));
        EXPECT_EQ(pulled.sense_of(pb), 1);
        EXPECT_EQ(pulled.sense_of(pb.flipped()), -1);
        EXPECT_FALSE(pulled.is_same_as(
            Plane::through(b[0] + LatticePoint{1, 1, 1}, b[1], b[2] + LatticePoint{1, 1, 2})));
        const PulledPlane back(pb, pair.to_b);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(pulled.side_of(b[k]), 0);
            EXPECT_EQ(back.side_of(a[k]), 0);
            EXPECT_EQ(pulled.along(Direction(b[k], b[(k + 1) % 3])), 0);
            EXPECT_EQ(orientation(a[k], a[(k + 1) % 3], MovedPoint(b[(k + 1) % 3], pair.to_a),
                                  MovedPoint(b[(k + 2) % 3], pair.to_a)),
                      0);
            EXPECT_EQ(planar_orientation(a[k], a[(k + 1) % 3], MovedPoint(b[k], pair.to_a), 2), 0);
        }
    }
}

TEST(MovedPredicates, DecideByDoublesWhatIsClear) {
    oracle::Source random(14);
    const Diagnostics<PredicateCounters> diagnostics;
    for (int round = 0; round < 1000; ++round) {
        const Pose b = random_pose(random, PoseKind::Rotation, 0x1p20);
        const PosedPair pair(Pose(), Lattice{}, b, Lattice{});
        const Plane plane = random.plane(20);
        const PulledPlane pulled(plane, pair.to_a);
        for (int k = 0; k < 10; ++k) (void)pulled.side_of(random.point(20));
    }
    EXPECT_EQ(diagnostics.counters().filtered, 10000U);
}

TEST(MovedPredicates, CountShortNarrowAndWideStages) {
    const Plane floor = Plane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const auto turned = [](std::int64_t w) {
        return PosedPair(Pose(), Lattice{}, Pose::from_quaternion({w, 0, 0, 1}), Lattice{});
    };
    const PosedPair pair = turned(1);
    const PosedPair long_numbers = turned(std::int64_t{1} << 20);
    const Diagnostics<PredicateCounters> diagnostics;
    EXPECT_EQ(PulledPlane(floor, pair.to_a).side_of(LatticePoint{3, 4, 0}), 0);
    EXPECT_EQ(diagnostics.counters().exact_short, 1U);
    EXPECT_EQ(PulledPlane(floor, long_numbers.to_a).side_of(LatticePoint{3, 4, 0}), 0);
    EXPECT_EQ(diagnostics.counters().exact_narrow, 1U);
    const Point third(Plane::axis_aligned(0, 3, 1), Plane::axis_aligned(1, 3, 1),
                      Plane::axis_aligned(2, 1, 0));
    EXPECT_EQ(PulledPlane(floor, pair.to_a).side_of(third), 0);
    EXPECT_EQ(diagnostics.counters().exact_wide, 1U);
}

// Rotations by quaternions of up to 15 digits have numbers up to 2^31, where 128 bits end; with
// lattices from 2 to 53 bits the sums of lengths come up to the limit and beyond it.
TEST(MovedPredicates, AgreeWhereShortNumbersEnd) {
    oracle::Source random(16);
    const Diagnostics<PredicateCounters> diagnostics;
    for (int round = 0; round < 4000; ++round) {
        const std::int64_t most = std::int64_t{1} << random.below(16);
        const auto q = [&] { return random.between(-most, most); };
        const auto far = [&] { return static_cast<double>(random.between(-most * most, most)); };
        const Pose pose = Pose::from_quaternion({q(), q(), q(), 1}, {far(), far(), far()});
        const PosedPair pair(Pose(), Lattice{}, pose, Lattice{});
        const auto map = map_of(pair.to_a);
        const int bits = 2 + static_cast<int>(random.below(52));
        const Scene s{pair, map, oracle::inverse(map), bits, false};
        const std::array<Point, 3> b{random.point(bits), random.point(bits), random.point(bits)};
        const std::array<Point, 2> a{random.point(bits), random.point(bits)};
        expect_same(s, random.plane(bits), a, b);
        // Multiples of the denominator have images on the lattice.
        const std::int64_t n = 2 + random.between(0, 3);
        const LatticePoint p{n, -n, 2 * n};
        const RationalPoint x = s.to_b(oracle::rational(p));
        if (x[0].get_den() * x[1].get_den() * x[2].get_den() != 1 || abs(x[0]) > 0x1p50 ||
            abs(x[1]) > 0x1p50 || abs(x[2]) > 0x1p50)
            continue;
        const Point image(LatticePoint{x[0].get_num().get_si(), x[1].get_num().get_si(),
                                       x[2].get_num().get_si()});
        EXPECT_TRUE(MovedPoint(image, pair.to_a).is_at(p));
        EXPECT_FALSE(MovedPoint(image, pair.to_a).is_at(LatticePoint{n, -n, 2 * n + 1}));
    }
    EXPECT_GT(diagnostics.counters().exact_short, 0U);
    EXPECT_GT(diagnostics.counters().exact_narrow, 0U);
}

// The widest numbers that are admitted: plane points of 53 bits under a relative pose of nearly 895
// bits. The integers on the stack say themselves when they are exceeded.
TEST(MovedPredicates, TheWidestNumbersFit) {
    oracle::Source random(15);
    int widest = 0;
    for (int round = 0; round < 200; ++round) {
        const auto pose = [&] {
            for (;;) {
                std::array<double, 12> rows{};
                for (double& v : rows)
                    v = std::ldexp(oracle::real(random, 1), static_cast<int>(random.below(235)));
                try {
                    return Pose::from_doubles(rows);
                } catch (const trisect::UsageError&) {
                }
            }
        };
        const Pose a = pose();
        const Pose b = pose();
        Scene s{PosedPair(a, Lattice{}, b, Lattice{}), {}, {}, 53, true};
        s.to_a = map_of(s.pair.to_a);
        s.to_b = map_of(s.pair.to_b);
        widest = std::max(widest, s.pair.to_a.width());
        const auto point = [&] { return random_point(random, 53, true); };
        const std::array<Point, 2> pa{point(), point()};
        const std::array<Point, 3> pb{point(), point(), point()};
        expect_same(s, random.plane(53), pa, pb);
        // The exact stages themselves, whatever the filters say.
        const MovedPoint r(pb[0], s.pair.to_a);
        const MovedPoint t(pb[1], s.pair.to_a);
        for (const BoundedInt& v : r.exact().x)
            EXPECT_LT(v.bit_length(), s.pair.to_a.width() + 386);
        EXPECT_EQ(orientation(pa[0], pa[0], r, t), 0);
        EXPECT_EQ(orientation(pa[0], pa[1], r, r), 0);
        EXPECT_EQ(planar_orientation(pa[0], pa[0], r, 0), 0);
        const PulledPlane pulled(random.plane(53), s.pair.to_a);
        for (const BoundedInt& v : pulled.normal())
            EXPECT_LT(v.bit_length(), s.pair.to_a.width() + 111);
        EXPECT_LT(pulled.offset().bit_length(), s.pair.to_a.width() + 164);
    }
    EXPECT_GT(widest, 700);
}

// The same with fractions: planes and their points of all 126 bits, which fill the last tier.
TEST(MovedPredicates, TheWidestNumbersOfFractionsFit) {
    oracle::Source random(23);
    int widest = 0;
    // Corners that use both ends of the range of coordinates.
    const auto corner = [&random]() -> LatticePoint {
        const auto c = [&] {
            const bool is_large = random.coin();
            const double v = static_cast<double>(random.coordinate(53));
            return trisect::Coordinate(is_large ? v : std::ldexp(v, -trisect::fraction_limit));
        };
        return {c(), c(), c()};
    };
    const auto plane = [&] {
        for (;;) {
            const LatticePoint a = corner();
            const LatticePoint b = corner();
            const LatticePoint c = corner();
            if (!are_collinear(a, b, c)) return Plane::through(a, b, c);
        }
    };
    const auto point = [&]() -> Point {
        for (;;) {
            const Plane p = plane();
            const Plane q = plane();
            const Plane r = plane();
            if (meet_in_a_point(p, q, r)) return {p, q, r};
        }
    };
    for (int round = 0; round < 200; ++round) {
        const int spread = round % 2 == 0 ? 235 : 8;
        const auto pose = [&] {
            for (;;) {
                std::array<double, 12> rows{};
                for (double& v : rows)
                    v = std::ldexp(oracle::real(random, 1),
                                   static_cast<int>(random.below(static_cast<unsigned>(spread))));
                try {
                    return Pose::from_doubles(rows);
                } catch (const trisect::UsageError&) {
                }
            }
        };
        Scene s{PosedPair(pose(), Lattice{}, pose(), Lattice{}), {}, {}, 53, true};
        s.to_a = map_of(s.pair.to_a);
        s.to_b = map_of(s.pair.to_b);
        const std::array<Point, 2> pa{point(), point()};
        const std::array<Point, 3> pb{point(), point(), point()};
        expect_same(s, plane(), pa, pb);
        const MovedPoint r(pb[0], s.pair.to_a);
        const MovedPoint t(pb[1], s.pair.to_a);
        for (const BoundedInt& v : r.exact().x) {
            EXPECT_LT(v.bit_length(), s.pair.to_a.width() + 1046);
            widest = std::max(widest, v.bit_length());
        }
        EXPECT_EQ(orientation(pa[0], pa[0], r, t), 0);
        EXPECT_EQ(orientation(pa[0], pa[1], r, r), 0);
        EXPECT_EQ(planar_orientation(pa[0], pa[0], r, 0), 0);
        const PulledPlane pulled(plane(), s.pair.to_a);
        for (const BoundedInt& v : pulled.normal())
            EXPECT_LT(v.bit_length(), s.pair.to_a.width() + 330);
        EXPECT_LT(pulled.offset().bit_length(), s.pair.to_a.width() + 385);
    }
    EXPECT_GT(widest, 1500);
}

}  // namespace
