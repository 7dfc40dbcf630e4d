// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/mend.h>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/kernel/error.h>

#include "brep/mend/broken_meshes.h"

namespace trisect {
namespace {

using test::cuboid;

MendOptions all_of(double distance) {
    MendOptions options;
    options.orient_faces = true;
    options.orient_shells = true;
    options.seams = distance;
    options.fill_planar_holes = true;
    options.drop_duplicates = true;
    return options;
}

TEST(Mended, NothingIsDoneThatIsNotAskedFor) {
    PolygonMesh mesh = test::flipped(test::without_face(cuboid(), 2));
    mesh.points.push_back({7, 7, 7});
    test::turn(mesh, 1);
    const MendedMesh out = mended(mesh, {});
    EXPECT_FALSE(MendOptions().any());
    EXPECT_EQ(out.mesh, mesh);
    EXPECT_FALSE(out.report.changed());
    EXPECT_EQ(out.report.open.size(), 1U);
    EXPECT_EQ(out.report.misoriented_edges, 3U);
}

TEST(Mended, AnEmptyMesh) {
    const MendedMesh out = mended({}, all_of(1));
    EXPECT_EQ(out.mesh, PolygonMesh());
    EXPECT_TRUE(out.report.is_closed());
    PolygonMesh points;
    points.points = {{1, 2, 3}, {1, 2, 3}};
    EXPECT_EQ(mended(points, all_of(1)).mesh.face_count(), 0U);
}

TEST(Mended, ASolidStaysAsItIs) {
    for (const PolygonMesh& mesh : {cuboid(), make_icosphere(1, 2)}) {
        const MendedMesh out = mended(mesh, all_of(1e-9));
        EXPECT_EQ(out.mesh, mesh);
        EXPECT_FALSE(out.report.changed());
    }
}

TEST(Mended, CoordinatesStayToTheBit) {
    PolygonMesh mesh = test::flipped(cuboid({-0.0, 1e-30, 0.1}, {1, 2, 1e5}));
    const MendedMesh out = mended(mesh, all_of(0));
    ASSERT_EQ(out.mesh.points.size(), mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(out.mesh.points[i][k], mesh.points[i][k]);
            EXPECT_EQ(std::signbit(out.mesh.points[i][k]), std::signbit(mesh.points[i][k]));
        }
    EXPECT_EQ(out.report.turned_shells, 1U);
}

TEST(Mended, HugeAndTinyCoordinates) {
    for (const double scale : {1e300, 1e-300, 0x1p1000, 0x1p-1000}) {
        PolygonMesh mesh = test::flipped(cuboid({0, 0, 0}, {scale, scale, scale}));
        append(mesh, test::without_face(cuboid({3 * scale, 0, 0}, {4 * scale, scale, scale}), 4));
        const MendedMesh out = mended(mesh, all_of(scale / 1024));
        EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
        EXPECT_EQ(out.report.filled_holes, 1U);
    }
}

TEST(Mended, BadInput) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        PolygonMesh mesh = cuboid();
        mesh.points[3][1] = bad;
        EXPECT_THROW((void)mended(mesh, all_of(1)), LimitError);
    }
    PolygonMesh mesh = cuboid();
    mesh.corners[5] = 99;
    EXPECT_THROW((void)mended(mesh, all_of(1)), UsageError);
}

TEST(Mended, ALatticeRoundsFirst) {
    PolygonMesh mesh = cuboid();
    mesh.points[0] = {1e-4, -1e-4, 0};
    MendOptions options;
    options.orient_faces = true;
    options.lattice = Lattice{-8};
    const MendedMesh out = mended(mesh, options);
    EXPECT_EQ(out.mesh, cuboid());
    EXPECT_FALSE(out.report.lattice.lossless);
}

// A cube with coordinates that differ in bits which only a fine lattice has: import rounds it.
TEST(Mended, WhatOnlyRoundingClosesIsRounded) {
    PolygonMesh mesh = test::flipped(cuboid());
    Point3d beside = mesh.points[mesh.corners[0]];
    ASSERT_EQ(beside[1], 0);
    beside[1] = 1e-40;
    mesh.points.push_back(beside);
    mesh.corners[0] = 8;
    MendOptions options;
    options.orient_shells = true;
    options.drop_duplicates = true;
    const MendedMesh out = mended(mesh, options);
    EXPECT_EQ(out.report.turned_shells, 1U);
    EXPECT_EQ(out.report.joined.size(), 1U);
    EXPECT_EQ(out.report.max_move, 1e-40);
    EXPECT_FALSE(out.report.lattice.lossless);
    EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
}

// All kinds in one mesh, in any order of its faces: the same outcome, and one that is clean.
TEST(Mended, AllTogether) {
    const PolygonMesh ball = test::in_triangles(make_uv_sphere(1, 20, 11));
    PolygonMesh mesh = test::cut_apart(ball, 1e-5, 9);
    append(mesh, cuboid({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    append(mesh, test::without_face(cuboid({2, 2, 2}, {3, 3, 3}), 3));
    std::mt19937 random(5);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (random() % 2 == 0) test::turn(mesh, f);
    mesh.add_face(std::vector<std::uint32_t>(mesh.face(7).begin(), mesh.face(7).end()));
    const MendedMesh out = mended(mesh, all_of(1e-4));
    EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
    EXPECT_TRUE(out.report.is_closed());
    EXPECT_EQ(out.report.filled_holes, 1U);
    EXPECT_EQ(out.report.duplicate_faces.size(), 1U);
    EXPECT_NEAR(test::volume_below(out.mesh).to_double(),
                test::volume_below(ball).to_double() - 0.008 + 1, 1e-3);
    EXPECT_EQ(mended(mesh, all_of(1e-4)).mesh, out.mesh);
    // Mending again changes nothing.
    EXPECT_FALSE(mended(out.mesh, all_of(1e-4)).report.changed());
}

}  // namespace
}  // namespace trisect
