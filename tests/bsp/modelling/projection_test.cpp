// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/projection.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "support/solids.h"

namespace trisect {
namespace {

using solids::box;

double area_at(const Solid& solid, double height) {
    return volume(solid_of_region(section(solid, height)));
}

TEST(Projection, SectionsHaveTheirHoles) {
    const Solid hollow = evaluate(box({0, 0, -3}, {6, 6, 3}) - box({1, 1, -2}, {5, 5, 2}));
    EXPECT_EQ(area_at(hollow, 0), 20);
    EXPECT_EQ(area_at(hollow, 2.5), 36);
    EXPECT_EQ(area_at(hollow, 4), 0);
}

/// Where triangles cross the plane, in doubles.
double area_of_crossings(const PolygonMesh& mesh, double height) {
    double twice = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        Point2d from{};
        Point2d to{};
        const auto t = mesh.face(f);
        for (std::size_t k = 0; k < 3; ++k) {
            const Point3d& a = mesh.points[t[k]];
            const Point3d& b = mesh.points[t[(k + 1) % 3]];
            if ((a[2] > height) == (b[2] > height)) continue;
            const double part = (height - a[2]) / (b[2] - a[2]);
            const Point2d p{a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
            (a[2] > height ? from : to) = p;
        }
        twice += from[0] * to[1] - from[1] * to[0];
    }
    return twice / 2;
}

TEST(Projection, SectionsWithoutAFaceInThePlane) {
    const Solid ball = Solid::from_mesh(make_icosphere(2, 3));
    const Solid shell = evaluate(ball - Solid::from_mesh(make_icosphere(1, 2)));
    for (const double height : {-1.7, -0.9, 0.125, 0.3, 1.1})
        EXPECT_NEAR(std::fabs(area_of_crossings(shell.to_mesh(), height)), area_at(shell, height),
                    1e-9)
            << height;
    EXPECT_EQ(area_at(shell, 1e9), 0);
    EXPECT_EQ(area_at(shell, 2.5), 0);
}

TEST(Projection, FacesInThePlaneCountOnBothSides) {
    const Solid steps = evaluate(box({0, 0, 0}, {2, 2, 1}) | box({1, 0, -1}, {3, 2, 0}));
    EXPECT_EQ(area_at(steps, 0), 6);
    EXPECT_EQ(area_at(steps, 1), 4);
    EXPECT_EQ(area_at(steps, -1), 4);
}

/// By the faces that two cuts make.
Solid section_by_cuts(const Solid& solid, double height) {
    const Solid below = Solid::half_space({0, 0, 1, -height});
    const Solid low = evaluate(solid & below);
    const Solid high = evaluate(solid - below);
    const auto faces = [&](const Solid& half, FacesLook look) {
        return half.is_empty() ? Solid()
                               : solid_of_region(region_of_result_faces(half, height, look));
    };
    return evaluate(faces(low, FacesLook::Up) | faces(high, FacesLook::Down));
}

// Of cuts, a corner on a straight side remains where another face ends in it, and is rounded.
void expect_same_section(const Solid& solid, double height, bool has_rounded_corners) {
    const Solid one = solid_of_region(section(solid, height));
    const Solid other = section_by_cuts(solid, height);
    const Solid difference = evaluate(one ^ other);
    if (has_rounded_corners && height == std::floor(height)) {
        EXPECT_LT(volume(difference), 1e-13) << height;
        return;
    }
    EXPECT_TRUE(difference.is_empty()) << height;
    EXPECT_EQ(one.to_mesh().face_count(), other.to_mesh().face_count()) << height;
}

// Faces, edges and corners in the plane, and nothing there; corners that are no doubles.
TEST(Projection, SectionsAreThoseOfCuts) {
    std::mt19937 random(20261129);
    const auto number = [&](std::uint32_t n) { return static_cast<double>(random() % n); };
    const AffineMap turn{{{{0.36, 0.48, -0.8, 0}, {-0.8, 0.6, 0, 0}, {0.48, 0.64, 0.6, 0}}}};
    for (int round = 0; round < 30; ++round) {
        const auto block = [&] {
            const Point3d low{number(4), number(4), number(4)};
            return box(low,
                       {low[0] + 1 + number(3), low[1] + 1 + number(3), low[2] + 1 + number(3)});
        };
        const Solid ball = Solid::from_mesh(
            transformed(make_icosphere(2.5, 1), AffineMap::translation({2, 2, 2})));
        Solid solid = evaluate((block() | block() | block()) - (round % 2 == 0 ? block() : ball));
        if (solid.is_empty()) continue;
        for (const double height : {0.0, 1.0, 2.0, 2.5, 3.1, 4.0})
            expect_same_section(solid, height, round % 2 != 0);
        if (round % 2 == 0) {
            solid = transformed(solid, turn);
            for (const double height : {0.0, 1.3})
                EXPECT_NEAR(area_at(solid, height), volume(section_by_cuts(solid, height)), 1e-12);
            EXPECT_EQ(area_at(solid, 1.3), volume(section_of_mesh(solid.to_mesh(), 1.3)));
        }
    }
}

TEST(Projection, SectionsOfUnboundedSetsAreRefused) {
    EXPECT_THROW(static_cast<void>(section(evaluate(~box({0, 0, 0}, {1, 1, 1})), 3)),
                 UnsupportedError);
    EXPECT_THROW(static_cast<void>(section(Solid::half_space({0, 0, 1, 0}), -1)), UnsupportedError);
}

/// The union of the triangles' own prisms, one operand for each.
Solid shadow_by_triangles(const Solid& solid) {
    const PolygonMesh mesh = solid.to_mesh();
    std::vector<Solid> prisms;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        Outline outline;
        for (const std::uint32_t v : mesh.face(f))
            outline.push_back({mesh.points[v][0], mesh.points[v][1]});
        try {
            prisms.push_back(Solid::from_mesh(make_extrusion(outline, {}, 0, 1)));
        } catch (const UsageError&) {
        }
    }
    return evaluate(Expression::any_of(prisms));
}

void expect_same_shadow(const Solid& solid) {
    const Solid one = shadow(solid);
    const Solid other = shadow_by_triangles(solid);
    EXPECT_EQ(exact_volume(one), exact_volume(other));
    EXPECT_TRUE(evaluate(one ^ other).is_empty());
}

// Layers above each other, walls that stand upright, holes behind others, and corners that were
// rounded, so that walls stand only nearly upright.
TEST(Projection, ShadowsAreUnionsOfTheirTriangles) {
    const Solid ball = Solid::from_mesh(make_icosphere(2, 1));
    const Solid plate = box({-3, -1, 3}, {3, 1, 4});
    expect_same_shadow(evaluate(ball | plate));
    expect_same_shadow(evaluate((box({-3, -3, -3}, {3, 3, 3}) - box({-2, -2, -4}, {2, 2, 4})) |
                                box({-1, -4, 5}, {1, 4, 6})));
    const AffineMap turn{{{{0.36, 0.48, -0.8, 0}, {-0.8, 0.6, 0, 0}, {0.48, 0.64, 0.6, 0}}}};
    const Solid cross = evaluate(box({-3, -1, -1}, {3, 1, 1}) | box({-1, -3, -1}, {1, 3, 1}) |
                                 box({-1, -1, -3}, {1, 1, 3}));
    expect_same_shadow(transformed(cross, turn));
}

TEST(Projection, Shadows) {
    const Solid two = evaluate(box({0, 0, 0}, {2, 2, 1}) | box({1, 1, 5}, {3, 3, 9}));
    EXPECT_EQ(exact_volume(shadow(two)).to_string(), "7");
    const Solid ring = evaluate(box({0, 0, 0}, {6, 6, 1}) - box({1, 1, -1}, {5, 5, 2}));
    EXPECT_EQ(exact_volume(shadow(ring)).to_string(), "20");
    EXPECT_TRUE(shadow(Solid()).is_empty());
    const Solid ball = Solid::from_mesh(make_icosphere(1, 3));
    EXPECT_NEAR(volume(shadow(ball)), 3.1416, 0.02);
}

}  // namespace
}  // namespace trisect
