// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/transform.h>

#include <cmath>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/validate/validate.h>

#include "support/mesh_builders.h"

namespace trisect {
namespace {

using test::cuboid;

TEST(AffineMap, QuarterTurnsAboutCoordinateAxesAreExact) {
    const auto m = AffineMap::rotation({0, 0, 5}, 90);
    EXPECT_EQ(m.apply({1, 2, 3}), (Point3d{-2, 1, 3}));
    EXPECT_EQ(AffineMap::rotation({1, 0, 0}, -270).apply({1, 2, 3}), (Point3d{1, -3, 2}));
    EXPECT_EQ(AffineMap::rotation({0, 1, 0}, 450).apply({1, 2, 3}), (Point3d{3, 2, -1}));
    EXPECT_EQ(AffineMap::rotation({0, 1, 0}, 180).apply({1, 2, 3}), (Point3d{-1, 2, -3}));
}

TEST(AffineMap, RotationAboutADiagonalPermutesAxes) {
    const auto p = AffineMap::rotation({1, 1, 1}, 120).apply({1, 2, 3});
    EXPECT_NEAR(p[0], 3, 1e-14);
    EXPECT_NEAR(p[1], 1, 1e-14);
    EXPECT_NEAR(p[2], 2, 1e-14);
    EXPECT_THROW(static_cast<void>(AffineMap::rotation({0, 0, 0}, 1)), UsageError);
}

TEST(AffineMap, CompositionAppliesTheFirstFirst) {
    const auto m = compose(AffineMap::translation({1, 0, 0}), AffineMap::rotation({0, 0, 1}, 90));
    EXPECT_EQ(m.apply({1, 0, 0}), (Point3d{1, 1, 0}));
}

TEST(AffineMap, OrientationIsExactForNearlySingularMatrices) {
    const double e = 0x1p-52;
    AffineMap m;
    m.rows = {{{1 + e, 1, 0, 0}, {1, 1 - e, 0, 0}, {0, 0, 1, 0}}};  // det = -e²
    EXPECT_EQ(m.orientation(), -1);
    m.rows[2][2] = -1;
    EXPECT_EQ(m.orientation(), 1);
    m.rows = {{{1, 2, 3, 0}, {4, 5, 6, 0}, {7, 8, 9, 0}}};
    EXPECT_EQ(m.orientation(), 0);
    EXPECT_THROW(static_cast<void>(transformed(cuboid(), m)), UsageError);
}

TEST(Transform, MirroredMeshStaysOutward) {
    const auto m = transformed(cuboid(), AffineMap::mirror(1));
    EXPECT_TRUE(validate(m).empty());
    EXPECT_FALSE(import_mesh(m).report.inside_out);
    const auto l = mirrored(import_mesh(cuboid()).mesh, 2);
    EXPECT_TRUE(validate(l).empty());
}

TEST(Transform, ExactTransformsOfALatticeMesh) {
    const auto m = import_mesh(cuboid({1, 2, 3}, {4, 6, 8})).mesh;
    EXPECT_EQ(translated(translated(m, {5, -6, 7}), {-5, 6, -7}).points, m.points);
    for (int axis = 0; axis < 3; ++axis) {
        const auto r = rotated_by_quarter_turns(m, axis, 1);
        EXPECT_TRUE(validate(r).empty());
        EXPECT_EQ(rotated_by_quarter_turns(r, axis, -1).points, m.points);
        Point3d direction{};
        direction[static_cast<std::size_t>(axis)] = 1;
        LatticeReport report;
        const auto g = transformed(m, AffineMap::rotation(direction, 90), report);
        EXPECT_EQ(g.points, r.points);
        EXPECT_EQ(g.triangles, r.triangles);
        EXPECT_TRUE(report.lossless);
    }
    EXPECT_THROW(static_cast<void>(translated(m, {coordinate_limit, 0, 0})), LimitError);
}

TEST(Transform, WhatWouldLeaveTheLatticeIsAnError) {
    const auto m = import_mesh(cuboid({1, 2, 3}, {4, 6, 8})).mesh;
    EXPECT_THROW(static_cast<void>(translated(m, {0, coordinate_limit - 1, 0})), LimitError);
    EXPECT_THROW(static_cast<void>(translated(mirrored(m, 2), {0, 0, 1 - coordinate_limit})),
                 LimitError);
    LatticeReport report;
    EXPECT_THROW(static_cast<void>(transformed(m, AffineMap::scaling({1, 0x1p60, 1}), report)),
                 LimitError);
    EXPECT_THROW(static_cast<void>(transformed(m, AffineMap::translation({0, 0, 1e300}), report)),
                 LimitError);
}

TEST(Transform, PowersOfTwoAreExactInBothDirections) {
    const auto m = import_mesh(cuboid({1, 2, 3}, {4, 6, 8})).mesh;
    for (const int power : {-17, -8, -1, 0, 1, 7, 8, 30}) {
        const auto s = scaled_by_power_of_two(m, power);
        for (std::size_t i = 0; i < m.points.size(); ++i)
            EXPECT_EQ(to_user(s.points[i], s.lattice)[0],
                      std::ldexp(to_user(m.points[i], m.lattice)[0], power));
    }
}

TEST(Transform, GeneralRotationReportsItsRounding) {
    const auto m = import_mesh(cuboid({0, 0, 0}, {1, 1, 1}), {.lattice = Lattice{-16}}).mesh;
    LatticeReport report;
    const auto r = transformed(m, AffineMap::rotation({0, 0, 1}, 30), report);
    EXPECT_FALSE(report.lossless);
    EXPECT_EQ(report.moved, 6U);
    EXPECT_LE(report.max_move, 0x1p-17);
    EXPECT_GT(report.max_move, 0);
    EXPECT_EQ(report.flipped_faces, 0U);
    EXPECT_EQ(validate(r).count(DefectKind::OpenEdge), 0U);
}

TEST(Transform, TrianglesThatBecomeFlatAreLeftOutAndTheMeshStaysClosed) {
    const auto m = import_mesh(cuboid({0, 0, 0}, {8, 8, 1})).mesh;
    LatticeReport report;
    const auto r = transformed(m, AffineMap::scaling({1, 1, 0.25}), report);
    EXPECT_EQ(report.flipped_faces, 8U);
    EXPECT_EQ(r.points.size(), 4U);
    EXPECT_EQ(r.triangles.size(), 4U);
    EXPECT_EQ(validate(r).count(DefectKind::OpenEdge), 0U);
    EXPECT_EQ(r.face_of(2), 1U);
}

}  // namespace
}  // namespace trisect
