// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/curved/tessellate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <trisect/brep/curved/bspline_surface.h>
#include <trisect/brep/curved/curved_shapes.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::CurvedBoundary;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Tessellation;

// Points in all triangles.
template <class Visit>
void for_points_of(const PolygonMesh& mesh, Visit&& visit) {
    constexpr std::array<Point3d, 4> weights{
        {{1, 0, 0}, {0.5, 0.5, 0}, {1.0 / 3, 1.0 / 3, 1.0 / 3}, {0, 0.25, 0.75}}};
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (const Point3d& w : weights) {
            Point3d p{};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3; ++k) p[k] += w[i] * mesh.points[mesh.face(f)[i]][k];
            visit(p);
        }
}

// The distance of a point from a triangle (Ericson, Real-time collision detection, 5.1.5).
double distance_from(const Point3d& p, const std::array<Point3d, 3>& t) {
    const auto minus = [](const Point3d& a, const Point3d& b) {
        return Point3d{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    };
    const auto dot = [](const Point3d& a, const Point3d& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const auto from_side = [&](const Point3d& a, const Point3d& b) {
        const Point3d along = minus(b, a);
        const double s = std::clamp(dot(minus(p, a), along) / dot(along, along), 0.0, 1.0);
        Point3d d = minus(p, a);
        for (std::size_t k = 0; k < 3; ++k) d[k] -= s * along[k];
        return std::sqrt(dot(d, d));
    };
    double least = std::min({from_side(t[0], t[1]), from_side(t[1], t[2]), from_side(t[2], t[0])});
    const Point3d u = minus(t[1], t[0]);
    const Point3d v = minus(t[2], t[0]);
    const Point3d w = minus(p, t[0]);
    const double det = dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v);
    const double a = (dot(v, v) * dot(u, w) - dot(u, v) * dot(v, w)) / det;
    const double b = (dot(u, u) * dot(v, w) - dot(u, v) * dot(u, w)) / det;
    if (a >= 0 && b >= 0 && a + b <= 1) {
        Point3d d = w;
        for (std::size_t k = 0; k < 3; ++k) d[k] -= a * u[k] + b * v[k];
        least = std::min(least, std::sqrt(dot(d, d)));
    }
    return least;
}

// Random points of the surface, and the triangles of their patch.
void expect_surface_within(const CurvedBoundary& boundary, const Tessellation& t, int points) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> parameter(0, 1);
    for (int n = 0; n < points; ++n) {
        const auto patch =
            static_cast<std::uint32_t>(static_cast<std::size_t>(n) % boundary.patches().size());
        const Point3d p =
            evaluate(boundary.patches()[patch], parameter(random), parameter(random)).position;
        double least = HUGE_VAL;
        for (std::size_t f = 0; f < t.mesh.face_count(); ++f) {
            if (t.patch_of_face[f] != patch) continue;
            std::array<Point3d, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k) corners[k] = t.mesh.points[t.mesh.face(f)[k]];
            least = std::min(least, distance_from(p, corners));
        }
        EXPECT_LE(least, t.deviation * (1 + 1e-9)) << patch;
    }
}

// Four times the fewest that a smooth surface of these curvatures needs would be too many.
TEST(Tessellate, NotManyMoreTrianglesThanTheCurvaturesAskFor) {
    EXPECT_LE(tessellate(trisect::make_curved_sphere(3), 0.01).mesh.face_count(), 7000U);
    EXPECT_LE(tessellate(trisect::make_curved_torus(5, 2), 0.01).mesh.face_count(), 18000U);
}

TEST(Tessellate, SphereWithinItsDeviation) {
    const CurvedBoundary sphere = trisect::make_curved_sphere(3);
    std::size_t last = 0;
    for (const double deviation : {0.5, 0.1, 0.01, 0.001}) {
        const Tessellation t = tessellate(sphere, deviation);
        EXPECT_LE(t.deviation, deviation);
        EXPECT_GT(t.mesh.face_count(), last);
        last = t.mesh.face_count();
        double farthest = 0;
        for_points_of(t.mesh, [&](const Point3d& p) {
            farthest = std::max(farthest, std::abs(std::hypot(p[0], p[1], p[2]) - 3));
        });
        EXPECT_LE(farthest, t.deviation);
        EXPECT_GT(farthest, 0.2 * deviation);  // not far too fine
        EXPECT_TRUE(trisect::validate(t.mesh).is_solid());
    }
}

TEST(Tessellate, TorusWithinItsDeviation) {
    const CurvedBoundary torus = trisect::make_curved_torus(5, 2);
    const Tessellation t = tessellate(torus, 0.01);
    double farthest = 0;
    for_points_of(t.mesh, [&](const Point3d& p) {
        const double d = std::hypot(std::hypot(p[0], p[1]) - 5, p[2]);
        farthest = std::max(farthest, std::abs(d - 2));
    });
    EXPECT_LE(farthest, t.deviation);
    EXPECT_TRUE(trisect::validate(t.mesh).is_solid());
    expect_surface_within(torus, t, 300);
    const double volume = trisect::volume(trisect::import_mesh(t.mesh).mesh);
    const double exact = 2 * std::numbers::pi * std::numbers::pi * 5 * 4;
    const double area = 4 * std::numbers::pi * std::numbers::pi * 5 * 2;
    EXPECT_NEAR(volume, exact, area * t.deviation);
}

// Patches of very different levels side by side: no gap along their sides.
TEST(Tessellate, BumpyRingOfBSplines) {
    trisect::BSplineSurface s;
    const std::size_t n = 8;
    for (std::size_t k = 0; k < n + 7; ++k) s.knots_u.push_back(static_cast<double>(k));
    s.knots_v = s.knots_u;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> bump(0.3, 1.8);
    std::vector<double> radius;
    for (std::size_t k = 0; k < n * n; ++k) radius.push_back(k < n * n / 2 ? 1 : bump(random));
    for (std::size_t i = 0; i < n + 3; ++i)
        for (std::size_t j = 0; j < n + 3; ++j) {
            const double a = 2 * std::numbers::pi * static_cast<double>(i % n) / n;
            const double b = 2 * std::numbers::pi * static_cast<double>(j % n) / n;
            const double r = radius[(i % n) * n + j % n];
            s.points.push_back({(6 + r * std::cos(b)) * std::cos(a),
                                (6 + r * std::cos(b)) * std::sin(a), r * std::sin(b)});
        }
    const CurvedBoundary ring(to_bezier(s).patches);
    for (const double deviation : {0.1, 0.004}) {
        const Tessellation t = tessellate(ring, deviation);
        EXPECT_LE(t.deviation, deviation);
        EXPECT_TRUE(trisect::validate(t.mesh).is_solid());
        EXPECT_EQ(t.patch_of_face.size(), t.mesh.face_count());
        expect_surface_within(ring, t, 300);
    }
}

TEST(Tessellate, CurvedPartsEnterBooleans) {
    const auto solid = [](const PolygonMesh& mesh) {
        return trisect::Expression(trisect::Solid::from_mesh(mesh));
    };
    const auto sphere = solid(tessellate(trisect::make_curved_sphere(2), 0.01).mesh);
    const auto cut = evaluate(sphere - solid(trisect::make_box({0, -3, -3}, {3, 3, 3})));
    const double half = 2 * std::numbers::pi * 8 / 3;
    EXPECT_NEAR(trisect::volume(cut.to_brep()), half, 0.01 * 8 * std::numbers::pi);
}

TEST(Tessellate, RefusesDeviationsThatMakeNoSense) {
    const CurvedBoundary sphere = trisect::make_curved_sphere(1);
    EXPECT_THROW((void)tessellate(sphere, 0), trisect::UsageError);
    EXPECT_THROW((void)tessellate(sphere, -1), trisect::UsageError);
    EXPECT_THROW((void)tessellate(sphere, NAN), trisect::UsageError);
    EXPECT_THROW((void)tessellate(sphere, 1e-14), trisect::UsageError);
    EXPECT_THROW((void)tessellate(sphere, 1e-11), trisect::Error);
    EXPECT_THROW((void)trisect::make_curved_torus(1, 1), trisect::UsageError);
}

}  // namespace
