// SPDX-License-Identifier: Apache-2.0
//
// OpenSCAD's rounded numbers. Volumes that are compared are those of OpenSCAD (version 2021.01)
// with CGAL, counted from the fractions in its .nef3 files (scripts/compare-openscad --grid).
#include <trisect/bsp/csg/grid/csg_grid_points.h>
#include <trisect/bsp/csg/grid/csg_openscad_grid.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include <string>

namespace trisect {
namespace {

std::string volume_of(const std::string& text, CsgReport* report = nullptr) {
    return exact_volume(evaluate_on_openscad_grid(parse_csg(text, "f"), {}, report)).to_string();
}

TEST(CsgOpenScadGrid, CornersAreCutOffTowardsZero) {
    PolygonMesh mesh;
    mesh.points = {{0x1.8p-20, -0x1.8p-20, 0.3}, {1, 0, 0}, {0, 1, 0}};
    mesh.add_triangle(0, 1, 2);
    const auto out = detail::on_openscad_grid(mesh);
    ASSERT_TRUE(out);
    EXPECT_EQ(out->points[0], (Point3d{0x1p-20, -0x1p-20, 314572 * 0x1p-20}));
    mesh.points[0] = {1e300, 0, 0};
    EXPECT_FALSE(detail::on_openscad_grid(mesh));
}

TEST(CsgOpenScadGrid, NeighbouringCellsBecomeOne) {
    PolygonMesh mesh;
    mesh.points = {
        {0, 0, 0}, {1, 0, 0}, {1, 0x1p-20, 0}, {0, 1, 0}, {0x1p-20, 1 + 0x1p-20, 0x1p-20}};
    const std::array<std::uint32_t, 5> loop{0, 1, 2, 3, 4};
    mesh.add_face(loop);
    const auto out = detail::on_openscad_grid(mesh);
    ASSERT_TRUE(out);
    EXPECT_EQ(out->points.size(), 3U);
    EXPECT_EQ(out->face(0).size(), 3U);
    // Two cells apart they are two.
    mesh.points[2] = {1, 0x1p-19, 0};
    EXPECT_EQ(detail::on_openscad_grid(mesh)->points.size(), 4U);
}

TEST(CsgOpenScadGrid, AboutConvex) {
    PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.add_triangle(0, 2, 1);
    mesh.add_triangle(0, 1, 3);
    mesh.add_triangle(0, 3, 2);
    EXPECT_FALSE(detail::is_about_convex(mesh));  // open
    mesh.add_triangle(1, 2, 3);
    EXPECT_TRUE(detail::is_about_convex(mesh));
    // Two pieces.
    for (const Point3d& p : {Point3d{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}})
        mesh.points.push_back(p);
    mesh.add_triangle(4, 6, 5);
    mesh.add_triangle(4, 5, 7);
    mesh.add_triangle(4, 7, 6);
    mesh.add_triangle(5, 6, 7);
    EXPECT_FALSE(detail::is_about_convex(mesh));
}

TEST(CsgOpenScadGrid, VolumesOfShapes) {
    EXPECT_EQ(volume_of("cube(size = 2);"), "8");
    // 0.1 is 104857 cells of 2^-20.
    EXPECT_EQ(volume_of("cube(size = [0.1, 1, 1]);"), "104857/1048576");
    EXPECT_EQ(volume_of("difference() { cube(size = 1); cube(size = [0.1, 1, 1]); }"),
              "943719/1048576");
    // Moved before it is cut off.
    EXPECT_EQ(volume_of("multmatrix([[1,0,0,0.1],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
                        "{ cube(size = [0.1, 1, 1]); }"),
              "52429/524288");
    EXPECT_EQ(volume_of("cube(size = [1e-7, 1, 1]);"), "0");
    EXPECT_EQ(volume_of("union();"), "0");
    EXPECT_EQ(volume_of("intersection() { cube(size = 1); group(); }"), "0");
    EXPECT_EQ(volume_of("difference() { group(); cube(size = 1); }"), "0");
    EXPECT_EQ(volume_of("difference() { cube(size = 1); group(); }"), "1");
    EXPECT_EQ(volume_of("!cube(size = 1); cube(size = 3);"), "1");
}

TEST(CsgOpenScadGrid, WhatIsNotOnItIsRefusedByName) {
    for (const std::string name : {"hull", "linear_extrude", "square", "import", "minkowski",
                                   "surface", "resize", "projection", "text", "roof"}) {
        try {
            (void)volume_of("cube(size = 1);\n " + name + "();");
            ADD_FAILURE() << name;
        } catch (const CsgError& e) {
            EXPECT_EQ(e.code(), ErrorCode::Unsupported);
            EXPECT_EQ(e.place().line, 2U);
            EXPECT_NE(std::string(e.what()).find(name), std::string::npos);
        }
    }
}

TEST(CsgOpenScadGrid, ARoundedGroupIsARemark) {
    CsgReport report;
    (void)volume_of(
        "multmatrix([[0.6,-0.8,0,0],[0.8,0.6,0,0],[0,0,1,0],[0,0,0,1]]) {"
        "cube(size = 0.3); cube(size = [1, 0.2, 0.2]); }",
        &report);
    ASSERT_EQ(report.remarks.size(), 1U);
    EXPECT_NE(report.remarks[0].find("multmatrix"), std::string::npos);
    (void)volume_of(
        "multmatrix([[0,-1,0,2],[1,0,0,0],[0,0,1,0],[0,0,0,1]]) {"
        "cube(size = 0.3); cube(size = [1, 0.2, 0.2]); }",
        &report);
    EXPECT_TRUE(report.remarks.empty());
    EXPECT_EQ(report.by_name.at("cube").nodes, 2U);
}

}  // namespace
}  // namespace trisect
