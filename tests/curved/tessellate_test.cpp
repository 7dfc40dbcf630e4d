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
        EXPECT_GT(farthest, 0.05 * deviation);  // not far too fine
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
