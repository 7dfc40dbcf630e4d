// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/coherent/separating_planes.h>

#include "reference/random_solids.h"
#include "support/triangle_oracle.h"

namespace {

using brute::Point3;
using brute::Rational;
using reference::Random;
using trisect::detail::ApproximateMap;
using trisect::detail::Float4;
using trisect::detail::ObbChild;
using trisect::detail::ObbId;
using trisect::detail::ObbNode;
using trisect::detail::ObbPose;
using trisect::detail::ObbTree;
using trisect::detail::OrientedBox;
using trisect::detail::PlanePose;
using trisect::detail::SeparatingPlanes;
using trisect::detail::Vector3;

struct Soup {
    std::vector<Vector3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

Soup soup_of(const trisect::PolygonMesh& mesh) {
    Soup s;
    for (const auto& p : mesh.points) s.positions.push_back(p);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        for (std::size_t i = 2; i < corners.size(); ++i)
            s.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    return s;
}

double uniform(Random& random) {
    return static_cast<double>(random.between(-(1 << 26), 1 << 26)) * 0x1p-26;
}

Rational rational(float v) { return Rational(static_cast<double>(v)); }

// Whether a point, in units of the tree, is in both of the sets that a box stands for.
void expect_contains(const OrientedBox& box, const Point3& p) {
    std::array<Point3, 3> u;
    Point3 d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = p[k] - rational(box.center[k]);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) u[i][k] = rational(box.axis[i][k]);
    const auto dot = [](const Point3& a, const Point3& b) {
        return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    };
    const auto product = [](const Point3& a, const Point3& b) {
        return Point3{Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
                      Rational(a[0] * b[1] - a[1] * b[0])};
    };
    const Rational det = dot(u[0], product(u[1], u[2]));
    ASSERT_NE(det, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(abs(dot(u[i], d)), rational(box.half[i]));
        // Cramer: the coefficient of axis i.
        const Rational s(dot(d, product(u[(i + 1) % 3], u[(i + 2) % 3])) / det);
        EXPECT_LE(abs(s), rational(box.half[i]));
    }
}

// All triangles below a box are in it; every triangle is in one leaf.
void check_below(const ObbTree& tree, const Soup& soup, ObbId id, double error,
                 std::vector<std::uint32_t>& seen, std::vector<OrientedBox>& above) {
    above.push_back(tree.box(id));
    const ObbChild child = tree.child(id);
    if (child.is_leaf()) {
        for (std::uint32_t i = 0; i < child.count(); ++i) {
            const std::uint32_t t = tree.order[child.first() + i];
            EXPECT_EQ(tree.corners[child.first() + i], soup.triangles[t]);
            ++seen[t];
            for (const std::uint32_t corner : soup.triangles[t])
                for (const double e : {-error, error}) {
                    Point3 p;
                    for (std::size_t k = 0; k < 3; ++k)
                        p[k] = (Rational(soup.positions[corner][k]) + Rational(e) -
                                Rational(tree.origin[k])) /
                               Rational(tree.unit);
                    for (const OrientedBox& b : above) expect_contains(b, p);
                }
        }
    } else {
        const ObbNode& n = tree.nodes[child.node()];
        for (std::uint32_t k = 0; k < 4; ++k)
            if (n.half[0][k] >= 0)
                check_below(tree, soup, ObbId::of(child.node(), k), error, seen, above);
    }
    above.pop_back();
}

void expect_sound(const Soup& soup, double error, std::uint32_t leaf) {
    const ObbTree tree(soup.positions, error, soup.triangles, {leaf});
    std::vector<std::uint32_t> seen(soup.triangles.size(), 0);
    std::vector<OrientedBox> above;
    check_below(tree, soup, ObbId{}, error, seen, above);
    for (const std::uint32_t n : seen) EXPECT_EQ(n, 1U);
}

TEST(ObbTree, BoxesContainTheirTrianglesExactly) {
    expect_sound(soup_of(trisect::make_torus(1, 0.25, 12, 9)), 0, 1);
    expect_sound(soup_of(trisect::make_torus(1, 0.25, 12, 9)), 1e-6, 3);
    expect_sound(soup_of(trisect::make_icosphere(1e-9, 2)), 0, 1);
    expect_sound(soup_of(trisect::make_box({1e9, 1e9, 1e9}, {1e9 + 1, 1e9 + 2, 1e9 + 3})), 0, 2);
}

TEST(ObbTree, FlatLongAndTinyTriangles) {
    Random random(7);
    Soup s;
    for (std::uint32_t i = 0; i < 90; ++i) {
        const double size = std::ldexp(1.0, -static_cast<int>(random.between(0, 40)));
        for (int k = 0; k < 3; ++k)
            s.positions.push_back({uniform(random), size * uniform(random), size * size});
        s.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    expect_sound(s, 0, 1);
    expect_sound(s, 0, 7);
}

TEST(ObbTree, ManyEqualTrianglesStillDivide) {
    Soup s;
    s.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    s.triangles.assign(200, {0, 1, 2});
    expect_sound(s, 0, 1);
}

TEST(ObbTree, NoTrianglesNoBoxes) {
    EXPECT_TRUE(ObbTree({}, 0, {}).is_empty());
    EXPECT_TRUE(ObbTree().is_empty());
}

// A frame at random, its axes rounded to floats as in a tree.
trisect::detail::AreaFrame random_frame(Random& random) {
    const Vector3 a{uniform(random), uniform(random), uniform(random)};
    const Vector3 b{uniform(random), uniform(random), uniform(random)};
    return trisect::detail::triangle_frame({0, 0, 0}, a, b);
}

OrientedBox random_box(Random& random) {
    OrientedBox box;
    const auto frame = random_frame(random);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) box.axis[i][k] = static_cast<float>(frame.axis[i][k]);
        box.center[i] = static_cast<float>(0.5 * uniform(random));
        box.half[i] =
            static_cast<float>(std::ldexp(0.25, -static_cast<int>(random.between(0, 12))));
    }
    return box;
}

ObbNode node_of(const std::array<OrientedBox, 4>& boxes) {
    ObbNode n;
    for (std::size_t lane = 0; lane < 4; ++lane)
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) n.axis[i][k][lane] = boxes[lane].axis[i][k];
            n.center[i][lane] = boxes[lane].center[i];
            n.half[i][lane] = boxes[lane].half[i];
        }
    return n;
}

// A tree of one empty node, so that poses know the size of things.
ObbTree frame_of_reference() {
    ObbTree t;
    t.nodes.resize(1);
    t.reach = 2;
    t.radius = 2;
    return t;
}

Vector3 point_of(const OrientedBox& b, const Vector3& s) {
    Vector3 p{};
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = static_cast<double>(b.center[k]);
        for (std::size_t i = 0; i < 3; ++i)
            p[k] += s[i] * static_cast<double>(b.half[i]) * static_cast<double>(b.axis[i][k]);
    }
    return p;
}

enum class Kind { Rotation, Mirror, Scaled, Affine };

ApproximateMap random_map(Random& random, Kind kind) {
    ApproximateMap map;
    const auto f = random_frame(random);
    const double scale =
        kind == Kind::Scaled ? std::ldexp(1.0, static_cast<int>(random.between(-20, 20))) : 1;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            map.m[i][k] = scale * f.axis[i][k];
            if (kind == Kind::Mirror && k == 0) map.m[i][k] = -map.m[i][k];
            if (kind == Kind::Affine) map.m[i][k] += uniform(random);
        }
    return map;
}

// Boxes that share a point, mostly a corner or a point of an edge or face of both, are never apart.
TEST(ObbPose, BoxesWithACommonPointAreNotFoundApart) {
    const ObbTree frame = frame_of_reference();
    Random random(11);
    const auto coefficient = [&random] {
        return random.chance(3, 4) ? (random.chance(1, 2) ? 1.0 : -1.0) : uniform(random);
    };
    for (const Kind kind : {Kind::Rotation, Kind::Mirror, Kind::Scaled, Kind::Affine})
        for (int trial = 0; trial < 5000; ++trial) {
            const std::array<OrientedBox, 4> four{random_box(random), random_box(random),
                                                  random_box(random), random_box(random)};
            const ObbNode node = node_of(four);
            const OrientedBox one = random_box(random);
            const std::size_t lane = static_cast<std::size_t>(trial % 4);
            ApproximateMap map = random_map(random, kind);
            const Vector3 s{coefficient(), coefficient(), coefficient()};
            const Vector3 r{coefficient(), coefficient(), coefficient()};
            for (const bool single_a : {true, false}) {
                const Vector3 in_a = point_of(single_a ? one : four[lane], s);
                const Vector3 in_b = point_of(single_a ? four[lane] : one, r);
                map.t = {};
                map.t = trisect::detail::minus(in_a, map(in_b));
                const ObbPose pose(frame, frame, map);
                ASSERT_FALSE(pose.is_apart());
                const unsigned hits =
                    single_a ? pose.overlaps(one, node) : pose.overlaps(node, one);
                ASSERT_NE(hits >> lane & 1U, 0U) << "trial " << trial;
            }
        }
}

// Two boxes pushed apart from a common corner along the normal of one or the product of edges.
TEST(ObbPose, BoxesASmallGapApartAreFoundApart) {
    const ObbTree frame = frame_of_reference();
    Random random(12);
    int found = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        OrientedBox one = random_box(random);
        const std::array<OrientedBox, 4> four{random_box(random), random_box(random),
                                              random_box(random), random_box(random)};
        ApproximateMap map = random_map(random, Kind::Rotation);
        const std::size_t lane = static_cast<std::size_t>(trial % 4);
        // The supporting corner of B against the normal of A's face 0.
        Vector3 normal{};
        for (std::size_t k = 0; k < 3; ++k) normal[k] = static_cast<double>(one.axis[0][k]);
        Vector3 s{};
        for (std::size_t i = 0; i < 3; ++i) {
            Vector3 u{};
            for (std::size_t k = 0; k < 3; ++k) u[k] = static_cast<double>(four[lane].axis[i][k]);
            s[i] = trisect::detail::dot(normal, map(u)) > 0 ? -1 : 1;
        }
        Vector3 target = point_of(one, {1, uniform(random), uniform(random)});
        for (std::size_t k = 0; k < 3; ++k) target[k] += 1e-4 * normal[k];
        map.t = trisect::detail::minus(target, map(point_of(four[lane], s)));
        const ObbPose pose(frame, frame, map);
        found += (pose.overlaps(one, node_of(four)) >> lane & 1U) == 0 ? 1 : 0;
    }
    EXPECT_EQ(found, 2000);
}

TEST(ObbPose, UnusedLanesMeetNothing) {
    const ObbTree frame = frame_of_reference();
    Random random(13);
    ObbNode node =
        node_of({random_box(random), random_box(random), random_box(random), random_box(random)});
    for (auto& h : node.half) h[2] = -1e30F;
    const ObbPose pose(frame, frame, ApproximateMap{});
    OrientedBox all;
    all.axis = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    all.half = {2, 2, 2};
    EXPECT_EQ(pose.overlaps(all, node), 11U);
    EXPECT_EQ(pose.overlaps(node, all), 11U);
}

TEST(ObbPose, FarApartModelsAreApartAtOnce) {
    const ObbTree frame = frame_of_reference();
    ApproximateMap map;
    map.t = {5, 0, 0};
    EXPECT_TRUE(ObbPose(frame, frame, map).is_apart());
    map.t = {3.9, 0, 0};
    EXPECT_FALSE(ObbPose(frame, frame, map).is_apart());
}

// Planes found under one pose, under another one with boxes that are no farther apart than a given
// way: they never say more.
TEST(ObbPose, PlanesKeptFromAnotherPoseNeverSayTooMuch) {
    const ObbTree frame = frame_of_reference();
    Random random(14);
    int parted = 0;
    for (const Kind kind : {Kind::Rotation, Kind::Mirror, Kind::Scaled, Kind::Affine})
        for (int trial = 0; trial < 2000; ++trial) {
            const std::array<OrientedBox, 4> four{random_box(random), random_box(random),
                                                  random_box(random), random_box(random)};
            const ObbNode node = node_of(four);
            const OrientedBox one = random_box(random);
            const std::size_t lane = static_cast<std::size_t>(trial % 4);
            ApproximateMap map = random_map(random, kind);
            const Vector3 s{uniform(random), uniform(random), uniform(random)};
            const Vector3 r{uniform(random), uniform(random), uniform(random)};
            const Vector3 way{uniform(random), uniform(random), uniform(random)};
            const double length = std::sqrt(trisect::detail::dot(way, way));
            for (const bool single_a : {true, false}) {
                const Vector3 in_a = point_of(single_a ? one : four[lane], s);
                const Vector3 in_b = point_of(single_a ? four[lane] : one, r);
                map.t = {};
                map.t = trisect::detail::minus(in_a, map(in_b));
                ApproximateMap before = random_map(random, kind);
                if (trial % 2 == 0) {  // turned by little
                    const double angle = 0.05 * uniform(random);
                    for (std::size_t j = 0; j < 3; ++j) {
                        before.m[0][j] =
                            std::cos(angle) * map.m[0][j] - std::sin(angle) * map.m[1][j];
                        before.m[1][j] =
                            std::sin(angle) * map.m[0][j] + std::cos(angle) * map.m[1][j];
                        before.m[2][j] = map.m[2][j];
                    }
                }
                before.t = map.t;
                for (std::size_t k = 0; k < 3; ++k) {
                    map.t[k] += way[k];
                    before.t[k] += 2 * way[k];
                }
                const ObbPose pose(frame, frame, map);
                Float4 gaps{};
                Float4 kept{};
                for (const ObbPose& from : {ObbPose(frame, frame, before), pose}) {
                    SeparatingPlanes planes;
                    const PlanePose then(from, 0.25);
                    const PlanePose now(pose, 0.25 + pose.turn_from(from));
                    if (single_a) {
                        gaps = from.gaps(one, node, planes.along);
                        planes.set(then, gaps, node);
                    } else {
                        gaps = from.gaps(node, one, planes.along);
                        planes.set(then, gaps, one);
                    }
                    kept = planes.gaps(now);
                    if (!(gaps[lane] > 0)) continue;
                    ASSERT_LE(static_cast<double>(kept[lane]), length * (1 + 1e-6)) << trial;
                    parted += kept[lane] > 0 ? 1 : 0;
                }
                // Now from the pose itself: what was found is kept.
                ASSERT_LE(static_cast<double>(gaps[lane]), length * (1 + 1e-6)) << trial;
                if (kind != Kind::Scaled && gaps[lane] > 1e-3F) {
                    ASSERT_GT(kept[lane], 0.99F * gaps[lane] - 1e-4F) << trial;
                }
            }
        }
    EXPECT_GT(parted, 1000);
}

TEST(ObbPose, DisplacementIsAtLeastThatOfEveryPoint) {
    const ObbTree frame = frame_of_reference();
    Random random(15);
    double closest = 0;
    for (const Kind kind : {Kind::Rotation, Kind::Mirror, Kind::Scaled, Kind::Affine})
        for (int trial = 0; trial < 2000; ++trial) {
            ApproximateMap one = random_map(random, kind);
            ApproximateMap other = random_map(random, trial % 3 == 0 ? Kind::Rotation : kind);
            if (trial % 3 == 1) {  // nearly the same
                other = one;
                for (auto& row : other.m)
                    for (double& c : row) c += 1e-9 * uniform(random);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                one.t[k] = uniform(random);
                other.t[k] = one.t[k] + (trial % 2 == 0 ? 0 : 0.01 * uniform(random));
            }
            const double bound =
                ObbPose(frame, frame, one).displacement_from(ObbPose(frame, frame, other));
            for (int n = 0; n < 20; ++n) {
                Vector3 x{uniform(random), uniform(random), uniform(random)};
                const double length = std::sqrt(trisect::detail::dot(x, x)) + 1e-9;
                for (double& c : x) c *= 2 / length;
                const Vector3 moved = trisect::detail::minus(one(x), other(x));
                const double way = std::sqrt(trisect::detail::dot(moved, moved));
                ASSERT_LE(way, bound);
                closest = std::max(closest, way / bound);
            }
        }
    EXPECT_GT(closest, 0.9);
}

}  // namespace
