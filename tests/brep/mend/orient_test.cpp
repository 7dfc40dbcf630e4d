// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/mend.h>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>

#include "brep/mend/broken_meshes.h"

namespace trisect {
namespace {

using test::cuboid;
using test::turn;
using test::volume_below;

MendOptions faces_only() {
    MendOptions options;
    options.orient_faces = true;
    return options;
}

MendOptions shells_only(InnerShells inner = InnerShells::Cavities) {
    MendOptions options;
    options.orient_shells = true;
    options.inner_shells = inner;
    return options;
}

TEST(OrientFaces, ATurnedFaceIsTurnedBack) {
    PolygonMesh mesh = cuboid();
    turn(mesh, 3);
    const MendedMesh out = mended(mesh, faces_only());
    EXPECT_EQ(out.report.turned_faces, std::vector<std::uint32_t>{3});
    EXPECT_TRUE(out.report.is_closed());
    EXPECT_EQ(out.mesh.points, mesh.points);
    EXPECT_EQ(out.mesh.face_begin, mesh.face_begin);
    EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
}

TEST(OrientFaces, RandomFacesOfATorus) {
    const PolygonMesh torus = test::in_triangles(make_torus(3, 1, 24, 12));
    for (unsigned seed = 0; seed < 20; ++seed) {
        PolygonMesh mesh = torus;
        std::mt19937 random(seed);
        std::vector<std::uint32_t> turned;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            if (random() % 3 == 0) {
                turn(mesh, f);
                turned.push_back(f);
            }
        const MendedMesh out = mended(mesh, faces_only());
        EXPECT_EQ(out.report.turned_faces, turned);  // fewer than half
        EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
        EXPECT_EQ(volume_below(out.mesh), volume_below(torus));
    }
}

TEST(OrientFaces, ConnectionIsByValue) {
    // A soup: no two faces have an index in common.
    PolygonMesh soup;
    const PolygonMesh box = cuboid();
    for (std::size_t f = 0; f < box.face_count(); ++f) {
        std::vector<std::uint32_t> loop;
        for (const std::uint32_t c : box.face(f)) {
            loop.push_back(static_cast<std::uint32_t>(soup.points.size()));
            soup.points.push_back(box.points[c]);
        }
        soup.add_face(loop);
    }
    turn(soup, 0);
    const MendedMesh out = mended(soup, faces_only());
    EXPECT_EQ(out.report.turned_faces, std::vector<std::uint32_t>{0});
    EXPECT_EQ(out.mesh.points, soup.points);
    EXPECT_TRUE(validate(out.mesh).is_solid());
}

TEST(OrientFaces, AMoebiusStripIsLeftAndNamed) {
    PolygonMesh mesh = cuboid({5, 5, 5}, {6, 6, 6});
    turn(mesh, 1);
    const std::uint32_t first = 8;
    constexpr std::uint32_t n = 12;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * 3.14159265358979 * i / n;
        const double half = angle / 2;
        for (const double side : {-0.5, 0.5})
            mesh.points.push_back({(2 + side * std::cos(half)) * std::cos(angle),
                                   (2 + side * std::cos(half)) * std::sin(angle),
                                   side * std::sin(half)});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = first + 2 * i;
        const std::uint32_t b = i + 1 < n ? a + 2 : first + 1;
        const std::uint32_t c = i + 1 < n ? a + 3 : first;
        mesh.add_triangle(a, b, a + 1);
        mesh.add_triangle(b, c, a + 1);
    }
    const MendedMesh out = mended(mesh, faces_only());
    EXPECT_EQ(out.report.turned_faces, std::vector<std::uint32_t>{1});
    ASSERT_EQ(out.report.unorientable.size(), 1U);
    EXPECT_EQ(out.report.unorientable[0].face, 6U);
    EXPECT_EQ(out.report.unorientable[0].faces, 2 * n);
    ASSERT_EQ(out.report.open.size(), 1U);  // its rim
    EXPECT_TRUE(out.report.open[0].is_loop);
    EXPECT_EQ(out.report.open[0].edges, 2 * n);
    EXPECT_FALSE(out.report.is_closed());
    for (std::size_t f = 6; f < mesh.face_count(); ++f)
        EXPECT_TRUE(std::ranges::equal(out.mesh.face(f), mesh.face(f)));
}

TEST(OrientFaces, CubesThatShareAnEdgeAreTwoParts) {
    PolygonMesh mesh = test::together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1}));
    turn(mesh, 2);
    turn(mesh, 9);
    const MendedMesh out = mended(mesh, faces_only());
    EXPECT_EQ(out.report.turned_faces, (std::vector<std::uint32_t>{2, 9}));
    EXPECT_TRUE(validate(out.mesh).is_solid());
}

TEST(OrientShells, InsideOut) {
    const MendedMesh out = mended(test::flipped(cuboid()), shells_only());
    EXPECT_EQ(out.report.turned_shells, 1U);
    EXPECT_EQ(out.report.turned_faces.size(), 6U);
    EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
}

PolygonMesh nested(unsigned turned, int depth) {
    PolygonMesh mesh;
    for (int i = 0; i < depth; ++i) {
        const double r = 10 - i;
        const PolygonMesh box = cuboid({-r, -r, -r}, {r, r, r});
        append(mesh, (turned >> i & 1U) != 0 ? test::flipped(box) : box);
    }
    return mesh;
}

TEST(OrientShells, NestedShellsAlternate) {
    ExactRational wanted = 0;
    for (int i = 0; i < 4; ++i)
        wanted += ExactRational(i % 2 == 0 ? 8 : -8) * (10 - i) * (10 - i) * (10 - i);
    for (unsigned turned = 0; turned < 16; ++turned) {
        const MendedMesh out = mended(nested(turned, 4), shells_only());
        EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
        EXPECT_EQ(volume_below(out.mesh), wanted);
        // The second and the fourth one are to be turned over.
        EXPECT_EQ(out.report.turned_shells, std::popcount(turned ^ 10U));
    }
}

TEST(OrientShells, OrEachCountsAsMaterial) {
    for (unsigned turned = 0; turned < 8; ++turned) {
        const MendedMesh out = mended(nested(turned, 3), shells_only(InnerShells::Material));
        EXPECT_EQ(out.report.turned_shells, std::popcount(turned));
        EXPECT_EQ(volume_below(out.mesh), volume_below(nested(0, 3)));
        EXPECT_TRUE(out.report.shells_left.empty());
    }
}

TEST(OrientShells, ShellsThatMeetOthersAreLeft) {
    PolygonMesh mesh = test::flipped(cuboid({0, 0, 0}, {4, 4, 4}));
    append(mesh, cuboid({2, 2, 2}, {6, 6, 6}));              // crosses the first one
    append(mesh, cuboid({2.5, 2.5, 2.5}, {3.5, 3.5, 3.5}));  // lies in both
    append(mesh, test::flipped(cuboid({9, 9, 9}, {10, 10, 10})));
    const MendedMesh out = mended(mesh, shells_only());
    EXPECT_EQ(out.report.turned_shells, 1U);
    ASSERT_EQ(out.report.shells_left.size(), 3U);
    EXPECT_EQ(out.report.shells_left[0], (ShellLeft{0, 6, ShellTrouble::MeetsOthers}));
    EXPECT_EQ(out.report.shells_left[1], (ShellLeft{6, 6, ShellTrouble::MeetsOthers}));
    EXPECT_EQ(out.report.shells_left[2], (ShellLeft{12, 6, ShellTrouble::WithinMeeting}));
    // As material, each by itself.
    const MendedMesh material = mended(mesh, shells_only(InnerShells::Material));
    EXPECT_EQ(material.report.turned_shells, 2U);
    EXPECT_TRUE(material.report.shells_left.empty());
}

TEST(OrientShells, TouchingInAPointIsNoMeeting) {
    PolygonMesh mesh = test::flipped(cuboid({0, 0, 0}, {4, 4, 4}));
    append(mesh, test::flipped(cuboid({4, 4, 4}, {6, 6, 6})));
    // An inner octahedron that touches the wall in its corner.
    PolygonMesh inner;
    inner.points = {{0, 2, 2}, {2, 2, 2}, {1, 1, 2}, {1, 3, 2}, {1, 2, 1}, {1, 2, 3}};
    for (const std::uint32_t x : {0U, 1U})
        for (const std::uint32_t y : {2U, 3U})
            for (const std::uint32_t z : {4U, 5U}) inner.add_triangle(x, y, z);
    append(mesh, inner);
    MendOptions options = shells_only();
    options.orient_faces = true;
    const MendedMesh out = mended(mesh, options);
    EXPECT_TRUE(out.report.shells_left.empty());
    EXPECT_TRUE(validate(out.mesh).is_solid()) << test::findings(out.mesh);
    EXPECT_EQ(volume_below(out.mesh), ExactRational(64 + 8) - ExactRational(4) / 3);
}

TEST(OrientShells, OpenAndFlatShellsAreLeft) {
    PolygonMesh mesh = test::without_face(cuboid(), 0);
    PolygonMesh flat;  // two triangles back to back
    flat.points = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    flat.add_triangle(0, 1, 2);
    flat.add_triangle(0, 2, 1);
    append(mesh, flat);
    append(mesh, test::flipped(cuboid({8, 8, 8}, {9, 9, 9})));
    const MendedMesh out = mended(mesh, shells_only());
    ASSERT_EQ(out.report.shells_left.size(), 2U);
    EXPECT_EQ(out.report.shells_left[0].trouble, ShellTrouble::Open);
    EXPECT_EQ(out.report.shells_left[1].trouble, ShellTrouble::NoVolume);
    EXPECT_EQ(out.report.turned_shells, 1U);
}

TEST(OrientShells, OneWithinAShellThatWindsTwice) {
    // Two equal layers of one shell are one way around, so what is inside is a cavity.
    PolygonMesh mesh = cuboid({0, 0, 0}, {8, 8, 8});
    append(mesh, cuboid({3, 3, 3}, {5, 5, 5}));
    const MendedMesh out = mended(mesh, shells_only());
    EXPECT_EQ(out.report.turned_shells, 1U);
    EXPECT_EQ(volume_below(out.mesh), ExactRational(512 - 8));
}

TEST(OrientShells, ManySpheres) {
    PolygonMesh mesh;
    std::mt19937 random(7);
    std::size_t turned = 0;
    for (int i = 0; i < 60; ++i) {
        PolygonMesh ball = make_icosphere(1, 1);
        for (Point3d& p : ball.points) p[0] += 3 * i;
        const bool turns = random() % 2 == 0;
        if (turns) ++turned;
        append(mesh, turns ? test::flipped(ball) : ball);
    }
    const MendedMesh out = mended(mesh, shells_only());
    EXPECT_EQ(out.report.turned_shells, turned);
    EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
}

}  // namespace
}  // namespace trisect
