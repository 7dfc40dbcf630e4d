// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/import/import_triangles.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cone.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/validate.h>

namespace trisect {
namespace {

double volume(const PolygonMesh& mesh) {
    const auto m = import_mesh(mesh).mesh;
    double v = 0;
    for (const auto& t : m.triangles) {
        std::array<Point3d, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = to_user(m.points[t[i]], m.lattice);
        v += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
             p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
             p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    return v / 6;
}

void expect_clean_solid(const PolygonMesh& m) {
    const auto r = validate(m);
    EXPECT_TRUE(r.empty()) << r.to_string();
    EXPECT_TRUE(r.lattice().lossless);
}

TEST(Primitives, BoxIsExact) {
    const auto m = make_box({-1, 2, 3}, {1, 4, 5.5});
    expect_clean_solid(m);
    EXPECT_EQ(volume(m), 10);
    EXPECT_THROW(static_cast<void>(make_box({1, 0, 2})), UsageError);
    EXPECT_THROW(static_cast<void>(make_box({1, 1, std::numeric_limits<double>::infinity()})),
                 UsageError);
}

TEST(Primitives, PrismOverAConcavePolygonOfEitherOrientation) {
    Outline l{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
    expect_clean_solid(make_prism(l, 2));
    EXPECT_EQ(volume(make_prism(l, 2)), 10);
    std::reverse(l.begin(), l.end());
    EXPECT_EQ(volume(make_prism(l, 2)), 10);
    EXPECT_EQ(make_prism(l, 2).face_count(), 8U);
    EXPECT_THROW(static_cast<void>(make_prism({{0, 0}, {1, 1}}, 1)), UsageError);
    EXPECT_THROW(static_cast<void>(make_prism({{0, 0}, {1, 1}, {2, 2}}, 1)), UsageError);
    EXPECT_THROW(static_cast<void>(make_prism(l, 0)), UsageError);
}

TEST(Primitives, RegularPrismWithFourSidesIsExact) {
    EXPECT_EQ(volume(make_regular_prism(4, 1, 1)), 2);
    expect_clean_solid(make_regular_prism(7, 3, 1));
    EXPECT_THROW(static_cast<void>(make_regular_prism(2, 1, 1)), UsageError);
}

TEST(Primitives, CylinderApproachesItsVolume) {
    const auto m = make_cylinder(2, 3, 256);
    expect_clean_solid(m);
    EXPECT_EQ(m.face_count(), 258U);
    EXPECT_NEAR(volume(m), std::numbers::pi * 12, 0.01);
}

TEST(Primitives, ConeWithApexOnEitherSideAndFrustum) {
    expect_clean_solid(make_cone(2, 0, 3, 100));
    expect_clean_solid(make_cone(0, 2, 3, 100));
    expect_clean_solid(make_cone(2, 1, 3, 100));
    EXPECT_NEAR(volume(make_cone(2, 0, 3, 256)), std::numbers::pi * 4, 0.01);
    EXPECT_THROW(static_cast<void>(make_cone(0, 0, 1)), UsageError);
    EXPECT_THROW(static_cast<void>(make_cone(1, -1, 1)), UsageError);
}

TEST(Primitives, Spheres) {
    const double v = std::numbers::pi * 4 / 3;
    expect_clean_solid(make_icosphere(1, 3));
    expect_clean_solid(make_uv_sphere(1, 31, 17));
    EXPECT_EQ(make_icosphere(1, 3).face_count(), 1280U);
    EXPECT_EQ(make_uv_sphere(1, 8, 5).face_count(), 64U);
    EXPECT_NEAR(volume(make_icosphere(1, 4)), v, 0.02);
    EXPECT_NEAR(volume(make_uv_sphere(1, 64, 64)), v, 0.02);
    EXPECT_THROW(static_cast<void>(make_icosphere(-1)), UsageError);
    EXPECT_THROW(static_cast<void>(make_icosphere(1, 11)), UsageError);
    EXPECT_THROW(static_cast<void>(make_uv_sphere(1, 8, 1)), UsageError);
}

TEST(Primitives, Torus) {
    const auto m = make_torus(3, 1, 48, 24);
    expect_clean_solid(m);
    EXPECT_NEAR(volume(m), 2 * std::numbers::pi * std::numbers::pi * 3, 1);
    EXPECT_THROW(static_cast<void>(make_torus(1, 1)), UsageError);
}

TEST(Primitives, ExtrusionWithHolesInARow) {
    Outline plate{{0, 0}, {20, 0}, {20, 10}, {0, 10}};
    std::vector<Outline> holes;
    for (double x = 1; x < 19; x += 3)
        for (double y = 1; y < 9; y += 3)
            holes.push_back({{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}});
    const auto m = make_extrusion(plate, holes, -1, 1);
    expect_clean_solid(m);
    EXPECT_EQ(volume(m), 2 * (200.0 - 4 * static_cast<double>(holes.size())));
}

TEST(Primitives, ExtrusionWithRoundHolesOfEitherOrientation) {
    Outline ring, hole;
    for (int i = 0; i < 60; ++i) {
        const double a = i * std::numbers::pi / 30;
        ring.push_back({10 * std::cos(a), 10 * std::sin(a)});
        hole.push_back(
            {std::round(1000 * std::cos(a)) / 200, std::round(1000 * std::sin(a)) / 200});
    }
    const std::vector<Outline> holes{hole};
    const auto r = validate(make_extrusion(ring, holes, 0, 4));
    EXPECT_TRUE(r.is_solid()) << r.to_string();
    EXPECT_EQ(r.count(DefectKind::SelfIntersection), 0U);
}

// Orders of magnitude below the plate's last bits.
TEST(Primitives, ExtrusionWithATinyHole) {
    const Outline plate{{-1, -1}, {1.1, -1}, {1.1, 1.3}, {-1, 1.3}};
    const std::vector<Outline> hole{{{1e-20, 0}, {-1e-20, 1e-20}, {-1e-20, -1e-20}}};
    const ImportedMesh m =
        detail::import_mesh(make_extrusion(plate, hole, 0, 1), {}, Fractions::Kept);
    EXPECT_TRUE(m.report.lattice.lossless);
    EXPECT_EQ(m.report.degenerate_faces_dropped, 0U);
    EXPECT_EQ(m.report.nonplanar_faces, 0U);
    EXPECT_TRUE(validate(m.mesh).empty()) << validate(m.mesh).to_string();
    const auto exact = [](double v) { return ExactRational::from_double(v); };
    const ExactRational square = (exact(1.1) + exact(1)) * (exact(1.3) + exact(1));
    const ExactRational triangle = exact(2e-20) * exact(1e-20);
    EXPECT_EQ(exact_volume(m.mesh), square - triangle);
}

TEST(Primitives, ExtrusionRefusesHolesOutside) {
    const Outline plate{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    const std::vector<Outline> crossing{{{3, 1}, {6, 1}, {6, 2}, {3, 2}}};
    EXPECT_THROW(static_cast<void>(make_extrusion(plate, crossing, 0, 1)), UsageError);
    EXPECT_THROW(static_cast<void>(make_extrusion(plate, {}, 1, 0)), UsageError);
}

}  // namespace
}  // namespace trisect
