// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace trisect {
namespace {

std::string volume_of(const std::string& text, CsgReport* report = nullptr) {
    return exact_volume(evaluate_csg(parse_csg(text, "f"), {}, report)).to_string();
}

TEST(CsgEvaluate, BooleansOfBoxesAreExact) {
    EXPECT_EQ(volume_of("cube(size = [2, 3, 4], center = true);"), "24");
    EXPECT_EQ(volume_of("difference() { cube(size = 4); cube(size = [1, 2, 3]); }"), "58");
    EXPECT_EQ(volume_of("intersection() { cube(size = 4);"
                        "multmatrix([[1,0,0,3],[0,1,0,3],[0,0,1,3],[0,0,0,1]]) cube(size = 4); }"),
              "1");
    EXPECT_EQ(volume_of("cube(size = 1); multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
                        "{ cube(size = 1); }"),
              "2");
    EXPECT_EQ(volume_of(""), "0");
}

TEST(CsgEvaluate, RoundShapesHaveTheFacetsOfTheManual) {
    // A square with its corners on the axes.
    EXPECT_EQ(volume_of("cylinder($fn = 4, h = 3, r1 = 2, r2 = 2);"), "24");
    EXPECT_EQ(volume_of("cylinder($fn = 4, h = 3, r1 = 2, r2 = 0, center = true);"), "8");
    EXPECT_EQ(volume_of("difference() { cube(size = [8, 8, 3], center = true);"
                        "cylinder($fn = 4, h = 5, r1 = 2, r2 = 2, center = true); }"),
              "168");
    const auto counts_of = [](const std::string& text) {
        return counts(evaluate_csg(parse_csg(text, "f"))).vertices;
    };
    EXPECT_EQ(counts_of("sphere($fn = 0, $fa = 12, $fs = 2, r = 10);"), 30U * 15U);
    EXPECT_EQ(counts_of("sphere($fn = 0, $fa = 12, $fs = 2, r = 1);"), 5U * 3U);
    EXPECT_EQ(counts_of("cylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 3, r2 = 1);"), 20U);
    EXPECT_EQ(counts_of("cylinder($fn = 7.9, h = 1, r1 = 3, r2 = 0);"), 8U);
}

TEST(CsgEvaluate, ArgumentsWithoutNamesAndDiameters) {
    // Once they were left out, and these were shapes of size 1.
    EXPECT_EQ(volume_of("cube([2, 3, 4], true);"), "24");
    EXPECT_EQ(volume_of("cube(2);"), "8");
    EXPECT_EQ(volume_of("cube(3, size = 2);"), "8");
    EXPECT_EQ(volume_of("linear_extrude(1) projection(true) cube(2, true);"), "4");
    EXPECT_EQ(volume_of("cylinder(3, 2, 0, $fn = 4, true);"), "8");
    EXPECT_EQ(volume_of("cylinder($fn = 4, h = 3, d = 4);"), "24");
    EXPECT_EQ(volume_of("cylinder($fn = 4, h = 3, d1 = 4, r2 = 0);"), "8");
    EXPECT_EQ(volume_of("linear_extrude(3) square([2, 3], true);"), "18");
    EXPECT_EQ(volume_of("linear_extrude(height = 1) circle(d = 4, $fn = 4);"), "8");
    EXPECT_EQ(volume_of("polyhedron([[0,0,0],[6,0,0],[0,1,0],[0,0,1]],"
                        "[[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);"),
              "1");
    EXPECT_EQ(volume_of("sphere(2, $fn = 6);"), volume_of("sphere(d = 4, $fn = 6);"));
}

TEST(CsgEvaluate, PolyhedraAreClockwiseSeenFromOutside) {
    const std::string points = "points = [[0,0,0],[6,0,0],[0,1,0],[0,0,1]], ";
    EXPECT_EQ(volume_of("polyhedron(" + points + "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);"),
              "1");
    try {
        (void)volume_of("\n polyhedron(" + points + "faces = [[0,1,2],[0,3,1],[0,2,3]]);");
        ADD_FAILURE();
    } catch (const CsgError& e) {
        EXPECT_EQ(e.code(), ErrorCode::InvalidSolid);
        EXPECT_EQ(e.place().line, 2U);
    }
}

TEST(CsgEvaluate, Modifiers) {
    EXPECT_EQ(volume_of("cube(size = 1); *cube(size = 2); %cube(size = 3); #cube(size = 1);"), "1");
    EXPECT_EQ(volume_of("cube(size = 5); multmatrix([[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]])"
                        "{ !cube(size = 2); }"),
              "8");
    EXPECT_EQ(volume_of("*minkowski() { cube(size = 1); } cube(size = 1);"), "1");
}

TEST(CsgEvaluate, RegionsAreBooleansOfPrisms) {
    CsgReport report;
    EXPECT_EQ(volume_of("difference() { square(size = [4, 3]); circle($fn = 4, r = 1); }", &report),
              "23/2");
    EXPECT_TRUE(report.is_flat);
    // Odd: the path crosses itself; the second one is a hole.
    EXPECT_EQ(volume_of("polygon(points = [[0,0],[2,2],[2,0],[0,2]], paths = undef);"), "2");
    EXPECT_EQ(volume_of("polygon(points = [[0,0],[4,0],[4,4],[0,4],[1,1],[2,1],[2,2],[1,2]],"
                        "paths = [[0,1,2,3],[4,5,6,7]]);"),
              "15");
    EXPECT_EQ(volume_of("linear_extrude(height = 5, center = true) { difference() {"
                        "square(size = 4, center = true); square(size = 2, center = true); } }",
                        &report),
              "60");
    EXPECT_FALSE(report.is_flat);
    EXPECT_EQ(report.evaluations, 1U);
}

TEST(CsgEvaluate, TaperedTwistedAndTurnedExtrusions) {
    EXPECT_EQ(volume_of("linear_extrude(height = 3, scale = [0, 0])"
                        "square(size = 4, center = true);"),
              "16");
    EXPECT_EQ(volume_of("linear_extrude(height = 3, scale = 0.5) difference() {"
                        "square(size = 4, center = true); square(size = 2, center = true); }"),
              "21");
    EXPECT_EQ(volume_of("rotate_extrude($fn = 4) square(size = [2, 3]);"), "24");
    EXPECT_EQ(volume_of("rotate_extrude($fn = 4, angle = 90) square(size = [2, 3]);"), "6");
    EXPECT_EQ(volume_of("rotate_extrude($fn = 4, angle = -180)"
                        "multmatrix([[1,0,0,-2],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
                        "square(size = [2, 3]);"),
              "12");
    const double twisted = volume(evaluate_csg(
        parse_csg("linear_extrude(height = 1, twist = 90, slices = 50) square(2);", "f")));
    EXPECT_GT(twisted, 0.9);
}

// Edges on lines through the axis have walls with two equal diagonals: the one is taken that goes
// up along the outline, or down where it is twisted the other way, so that mirrored twists have
// equal volumes. The figures are OpenSCAD's.
TEST(CsgEvaluate, EqualDiagonalsOfTwistedWallsFollowTheTwist) {
    const auto twisted = [](const std::string& twist, const std::string& shape) {
        return volume(evaluate_csg(parse_csg(
            "linear_extrude(height = 10, slices = 3, twist = " + twist + ")" + shape, "f")));
    };
    const std::string at_axis = "square(size = 20);";
    EXPECT_NEAR(twisted("30", at_axis), 4211.27441, 1e-3);
    EXPECT_NEAR(twisted("-30", at_axis), 4211.27441, 1e-3);
    const std::string hole_at_axis =
        "difference() { square(size = 60, center = true); square(size = 20); }";
    EXPECT_NEAR(twisted("30", hole_at_axis), 33690.19575, 2e-3);
    EXPECT_NEAR(twisted("-30", hole_at_axis), 33690.19575, 2e-3);
}

TEST(CsgEvaluate, ATurnByNoAngleIsEmpty) {
    EXPECT_EQ(volume_of("rotate_extrude(angle = 0) square(size = 1);"), "0");
}

TEST(CsgEvaluate, HullsAndTurnedGroups) {
    EXPECT_EQ(volume_of("hull() { cube(size = 1);"
                        "multmatrix([[1,0,0,2],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size = 1); }"),
              "3");
    EXPECT_EQ(volume_of("linear_extrude(height = 2) hull() { square(size = 1);"
                        "multmatrix([[1,0,0,2],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) square(size = 1);}"),
              "6");
    // Flush boxes stay one body under a turn that rounds corners.
    CsgReport report;
    const Solid turned = evaluate_csg(
        parse_csg("multmatrix([[0.8,-0.6,0,0],[0.6,0.8,0,0],[0,0,1,0],[0,0,0,1]]) {"
                  "cube(size = [1, 2, 1]); multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
                  "cube(size = 1); }",
                  "f"),
        {}, &report);
    EXPECT_NEAR(volume(turned), 3, 1e-12);
    EXPECT_EQ(report.evaluations, 2U);
}

// The same but for axes that change places and directions, mirrored ones, too.
TEST(CsgEvaluate, ShadowsFromSeveralSidesAreOfOneEvaluation) {
    const std::string bracket =
        "difference() { cube([2, 3, 5]); multmatrix([[1,0,0,1],[0,1,0,-1],[0,0,1,2]])"
        "cube([2, 2, 4]); }";
    const auto shadow = [&](const std::string& matrix) {
        return "linear_extrude(1) projection() multmatrix(" + matrix + ") group() " + bracket;
    };
    // Along each axis the bracket is behind its notch: 6 + 10 + 15.
    CsgReport report;
    const std::string three =
        "linear_extrude(1) projection() " + bracket +
        "multmatrix([[1,0,0,9],[0,1,0,0],[0,0,1,0]])" + shadow("[[0,0,1,0],[1,0,0,0],[0,1,0,0]]") +
        "multmatrix([[1,0,0,-9],[0,1,0,0],[0,0,1,0]])" + shadow("[[0,0,-1,0],[0,1,0,0],[1,0,0,0]]");
    EXPECT_EQ(volume_of(three, &report), "31");
    EXPECT_EQ(report.found_again, 2U);
    // A move is no change of axes, nor is a scale.
    EXPECT_EQ(volume_of(shadow("[[1,0,0,0.25],[0,-1,0,0],[0,0,1,0]]")), "6");
    EXPECT_EQ(volume_of(shadow("[[2,0,0,0],[0,0,1,0],[0,1,0,0]]")), "20");
}

TEST(CsgEvaluate, SumsOffsetsAndProjections) {
    EXPECT_EQ(volume_of("minkowski() { cube(size = [1, 2, 3]); cube(size = 1); cube(size = 2); }"),
              "120");
    EXPECT_EQ(volume_of("linear_extrude(height = 2) minkowski() { square(size = 2);"
                        "square(size = 1); }"),
              "18");
    EXPECT_EQ(
        volume_of("minkowski() { cube(size = 2); intersection() { cube(size = 1);"
                  "multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size = 1); } }"),
        "8");
    EXPECT_EQ(volume_of("linear_extrude(height = 2) offset(delta = 1) square(size = 2);"), "32");
    EXPECT_EQ(volume_of("linear_extrude(height = 2) offset(r = 1, $fn = 4) square(size = 2);"),
              "28");
    EXPECT_EQ(volume_of("projection(cut = true) cube(size = 4, center = true);"), "16");
    EXPECT_EQ(volume_of("projection(cut = false) { cube(size = 2); cube(size = [1, 3, 9]); }"),
              "5");
}

TEST(CsgEvaluate, ResizeFollowsTheLargestNewSize) {
    const std::string box = "cube(size = [1, 2, 3], center = true);";
    EXPECT_EQ(volume_of("resize(newsize = [5, 0, 0], auto = [false, false, false])" + box), "30");
    EXPECT_EQ(volume_of("resize(newsize = [5, 0, 0], auto = true)" + box), "750");
    EXPECT_EQ(volume_of("resize(newsize = [5, 12, 0], auto = [1, 1, 1])" + box), "1080");
    EXPECT_EQ(volume_of("resize(newsize = [-5, 0, 0], auto = [1, 1, 1])" + box), "6");
    EXPECT_EQ(volume_of("resize(newsize = [4, 0, 9], auto = [0, 0, 1]) square(size = 2);"), "8");
}

TEST(CsgEvaluate, AnIntersectionWithAnotherDimensionIsEmpty) {
    EXPECT_EQ(volume_of("intersection() { cube(size = 5); circle(r = 2); }"), "0");
}

class CsgFiles : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& text) {
        const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
        std::ofstream(path) << text;
        return path.string();
    }
};

TEST_F(CsgFiles, HeightFieldsHaveAPointInTheMiddleOfEachCell) {
    const std::string file = write("trisect_heights.dat", "# two rows\n1 2 3\n4 5 7\n");
    EXPECT_EQ(volume_of("surface(file = \"" + file + "\", center = true);"), "29/4");
    const std::string ragged = write("trisect_ragged.dat", "-1 2\n-3 5 6\n2 2\n");
    EXPECT_EQ(volume_of("surface(file = \"" + ragged + "\");"), "99/4");
    const std::string word = write("trisect_word.dat", "1 two\n");
    EXPECT_THROW((void)volume_of("surface(file = \"" + word + "\");"), CsgError);
}

TEST_F(CsgFiles, MeshesAreImportedFromTheFolderOfTheProgram) {
    const std::string file =
        write("trisect_import.off",
              "OFF\n4 4 0\n0 0 0\n6 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    CsgOptions options;
    options.folder = testing::TempDir();
    const CsgTree tree = parse_csg("import(file = \"trisect_import.off\");", "f");
    EXPECT_EQ(exact_volume(evaluate_csg(tree, options)).to_string(), "1");
    options.reads_files = false;
    EXPECT_THROW((void)evaluate_csg(tree, options), CsgError);
    EXPECT_EQ(volume_of("import(file = \"\");"), "0");
}

TEST_F(CsgFiles, DrawingsAreRegions) {
    const std::string lines =
        "0\nLINE\n8\n0\n10\n1\n20\n0\n11\n5\n21\n0\n0\nLINE\n8\n0\n10\n5\n20\n0\n11\n1\n21\n2\n"
        "0\nLINE\n8\n0\n10\n1\n20\n2\n11\n1\n21\n0\n";
    const std::string file =
        write("trisect_lines.dxf", "0\nSECTION\n2\nENTITIES\n" + lines + "0\nENDSEC\n0\nEOF\n");
    CsgReport report;
    EXPECT_EQ(volume_of("import(file = \"" + file + "\", scale = 2);", &report), "16");
    EXPECT_TRUE(report.is_flat);
    EXPECT_EQ(volume_of("linear_extrude(file = \"" + file + "\", height = 3);"), "12");
    EXPECT_EQ(volume_of("linear_extrude(file = \"" + file + "\", height = 3, scale = [0, 0]);"),
              "4");
    EXPECT_GT(volume(evaluate_csg(parse_csg("rotate_extrude(file = \"" + file + "\");", "f"))), 30);
    EXPECT_EQ(volume_of("import(file = \"" + file + "\", layer = \"a\");"), "0");
}

TEST_F(CsgFiles, MissingFilesAreErrorsUnlessTheyMayBeEmpty) {
    const CsgTree tree = parse_csg("cube(size = 1); import(file = \"no.stl\");", "f");
    EXPECT_THROW((void)evaluate_csg(tree), CsgError);
    CsgOptions options;
    options.missing_files_are_empty = true;
    CsgReport report;
    EXPECT_EQ(exact_volume(evaluate_csg(tree, options, &report)).to_string(), "1");
    EXPECT_FALSE(report.remarks.empty());
}

TEST_F(CsgFiles, RefusedShapesAreErrorsUnlessTheyMayBeLeftOut) {
    const CsgTree tree = parse_csg(
        "cube(size = 1);"
        "polyhedron(points = undef, faces = [[0, 1, 2]], convexity = 1);"
        "multmatrix([[1,0,0,nan],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size = 3);"
        "difference() { cube(size = 2); polyhedron(points = [[0,0,0],[1,0,0],[0,1,0]], faces = "
        "[[0, 1, 2]]); }",
        "f");
    EXPECT_THROW((void)evaluate_csg(tree), CsgError);
    CsgOptions options;
    options.leaves_out_refused = true;
    CsgReport report;
    EXPECT_EQ(exact_volume(evaluate_csg(tree, options, &report)).to_string(), "8");
    EXPECT_EQ(report.remarks.size(), 3U);
}

TEST_F(CsgFiles, TheGroundOfHeightsIsAtZeroOrBelow) {
    const std::string high = write("trisect_high.dat", "5 5\n5 5\n");
    EXPECT_EQ(volume_of("surface(file = \"" + high + "\");"), "5");
}

// Beside a cube that the plane does not cut a height field is one of many shapes, and a solid.
TEST_F(CsgFiles, SectionsOfHeightFieldsAreThoseOfTheirSolids) {
    const std::string file =
        write("trisect_cut.dat", "1 2 3 0.1\n4 5 7 2\n0.3 2 2 -1\n3 1 0.7 4\n");
    const std::string surface = "surface(file = \"" + file + "\", center = true);";
    const std::string cube = "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,50]]) cube(size = 1);";
    const std::vector<std::string> axes{
        "[1,0,0,0],[0,1,0,0],[0,0,1,", "[1,0,0,0],[0,1,0,0],[0,0,-1,",
        "[0,0,1,0],[0,1,0,0],[1,0,0,", "[0,0,2,0],[1,0,0,0],[0,-1,0,",
        "[0.1,0,0,0],[0,3,0,0],[0,0,1,"};
    int areas = 0;
    for (const std::string& map : axes)
        for (const std::string height :
             {"-3", "-2", "-1", "-0.75", "0", "0.1", "0.5", "1", "2", "3.3"}) {
            const std::string moved = "multmatrix([" + map + height + "]]) " + surface;
            const std::string alone = volume_of("projection(cut = true) " + moved);
            EXPECT_EQ(alone, volume_of("projection(cut = true) {" + moved + cube + "}")) << moved;
            if (alone != "0") ++areas;
        }
    EXPECT_GT(areas, 25);
}

TEST(CsgEvaluate, EqualShapesAreMadeOnce) {
    CsgReport report;
    EXPECT_EQ(volume_of("cube(size = 1); group() { color([1, 0, 0]) cube(size = 1); }", &report),
              "1");
    EXPECT_EQ(report.leaves, 2U);
    EXPECT_EQ(report.meshes, 1U);
}

// Facets of one mesh that is inside out, beside a mesh without volume.
TEST(CsgEvaluate, HalfOfTheLeastDoubleIsNoSize) {
    EXPECT_EQ(volume_of("cube(size = [5e-324, 20, 20], center = true);"), "0");
    EXPECT_EQ(volume_of("square(size = [5e-324, 20], center = true);"), "0");
}

TEST(CsgEvaluate, AFlatPolyhedronAddsNothing) {
    const std::string faces = "faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);";
    const std::string solid =
        "polyhedron(points = [[45, -2, 0.5], [-2, 3, -2], [5, -2, 3], [4, -2, 90], [2, 7, 5]], " +
        faces;
    const std::string flat =
        "polyhedron(points = [[90, 2, 45], [90, 1, 1], [1, 1, 1], [1, 1, 1]], " + faces;
    EXPECT_EQ(volume_of("union() {" + solid + flat + "}"), volume_of(solid));
}

// Two triangles are left of it, front and back of one.
TEST(CsgEvaluate, OfAFlatPolyhedronNothingIsLeft) {
    const std::string faces = "faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);";
    const std::string flat =
        "polyhedron(points = [[10, 1, 10], [10, 10, 10], [10, 10, 10], [10, 10, 45]], " + faces;
    EXPECT_TRUE(evaluate_csg(parse_csg(flat, "f")).is_empty());
    EXPECT_EQ(evaluate_csg(parse_csg(flat, "f")).to_mesh().face_count(), 0U);
    EXPECT_EQ(volume_of("hull() {" + flat + "}"), "0");
    EXPECT_EQ(volume_of("minkowski() { cube(size = 2);" + flat + "}"), "8");
}

// They are prisms over regions, each with heights of its own.
TEST(CsgEvaluate, HullsOfExtrusionsOfDifferentHeights) {
    const auto extruded = [](const std::string& height, const std::string& size) {
        return "linear_extrude(height = " + height + ") square(" + size + ", true);";
    };
    // A box and a frustum: 100 + 2 (100 + 16 + 40) / 3.
    EXPECT_EQ(volume_of("hull() {" + extruded("1", "10") + extruded("3", "4") + "}"), "204");
    EXPECT_EQ(volume_of("hull() {" + extruded("3", "4") + extruded("1", "10") + "}"), "204");
    EXPECT_EQ(volume_of("hull() {" + extruded("2", "10") + extruded("2", "4") + "}"), "200");
    EXPECT_EQ(volume_of("hull() {" + extruded("1", "2") +
                        "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]])" +
                        extruded("1", "2") + "}"),
              "20");
    EXPECT_EQ(volume_of("linear_extrude(height = 3) hull() { square(2); square([4, 1]); }"), "21");
}

// A wall of the sheared rack is a hair from a side of the block. Rounded, the turned group meets
// itself, and triangles are gone.
TEST(CsgEvaluate, ATurnedGroupOfAlmostFlushWallsMeetsItself) {
    const std::string rack =
        "multmatrix([[1,0,0,62.8318],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
        "multmatrix([[1,0,1,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
        "linear_extrude(height = 10) polygon([[0,-1.16667],[2.40013,-0.16576],[1.94794,0.65989],"
        "[1.40362,1],[1.19365,0.65989],[1.01584,0.354214],[0,-1.44136]]);";
    const std::string block =
        "multmatrix([[1,0,0,10],[0,1,0,-5],[0,0,1,0],[0,0,0,1]]) cube([60, 3.83333, 10]);";
    const std::string turn =
        "multmatrix([[0.5,0.866025,0,0],[-0.866025,0.5,0,0],[0,0,1,0],[0,0,0,1]])";
    const std::string place =
        "multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0],[0,0,0,1]])"
        "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,10],[0,0,0,1]])"
        "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]])"
        "multmatrix([[1,0,0,-39.2699],[0,1,0,0],[0,0,1,0],[0,0,0,1]])";
    const std::string group = "intersection() {" + rack + block + "}";
    const Solid turned = evaluate_csg(parse_csg(turn + place + group, "turned.csg"));
    // Entries of the matrix have six digits: 0.25 + 0.866025^2.
    const double before = volume(evaluate_csg(parse_csg(group, "group.csg")));
    EXPECT_NEAR(volume(turned), before * 0.999999300625, 1e-11);
}

// The sides of the tooth cross the line of its foot: by the even-odd rule, pieces that touch are
// left. Each is sheared as a whole, its crossings are rounded once, and the mesh of a row of them
// is as small as that of one.
TEST(CsgEvaluate, ShearedRegionsWhoseOutlinesCross) {
    const std::string tooth =
        "linear_extrude(height = 8) "
        "polygon([[0,-1],[4,-1],[4,-2],[3.5,-2],[2.5,1],[1.5,1],[0.5,-2],"
        "[0,-2]]);";
    const std::string shear = "multmatrix([[1,0,1,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]])";
    const Solid straight = evaluate_csg(parse_csg(tooth, "straight.csg"));
    const Solid sheared = evaluate_csg(parse_csg(shear + tooth, "sheared.csg"));
    EXPECT_NEAR(volume(sheared), volume(straight), 1e-12);
    EXPECT_EQ(sheared.to_mesh().face_count(), straight.to_mesh().face_count());
    std::string row = "union() {";
    for (const char* x : {"0", "4", "8"})
        row += std::string("multmatrix([[1,0,0,") + x + "],[0,1,0,0],[0,0,1,0],[0,0,0,1]])" +
               shear + tooth;
    const Solid teeth = evaluate_csg(parse_csg(row + "}", "row.csg"));
    EXPECT_NEAR(volume(teeth), 3 * volume(straight), 1e-11);
    EXPECT_LE(teeth.to_mesh().face_count(), 3 * straight.to_mesh().face_count());
}

int code_of(const std::string& text) {
    try {
        (void)volume_of(text);
    } catch (const Error& e) {
        return static_cast<int>(e.code());
    }
    return 0;
}

TEST(CsgEvaluate, Refusals) {
    EXPECT_EQ(code_of("whatever();"), 7);
    EXPECT_EQ(code_of("linear_extrude(file = \"no.dxf\", height = 1);"), 3);
    EXPECT_EQ(code_of("rotate_extrude(file = \"no.dxf\");"), 3);
    EXPECT_EQ(code_of("import(file = \"no.svg\");"), 3);
    EXPECT_EQ(code_of("linear_extrude(file = \"no.stl\", height = 1);"), 3);
    EXPECT_EQ(code_of("surface(file = \"there/is/none.dat\");"), 3);
    EXPECT_EQ(code_of("cube(size = inf);"), 3);
    EXPECT_EQ(code_of("sphere(r = nan);"), 3);
    EXPECT_EQ(code_of("cube(size = [1, 2]);"), 3);
    EXPECT_EQ(code_of("sphere($fn = 1e9, r = 1);"), 5);
    EXPECT_EQ(code_of("linear_extrude(height = 3, slices = 1e308, scale = [1, 0]) group();"), 5);
    EXPECT_EQ(code_of("polygon(points = [[0, 0], [1, 0], [0, 1]], paths = [[0, 1, 3]]);"), 3);
    EXPECT_EQ(code_of("multmatrix([[1, 0]]) cube();"), 3);
    EXPECT_EQ(code_of("rotate_extrude() square(size = 2, center = true);"), 3);
}

TEST(CsgEvaluate, EqualSubtreesAreMadeOnce) {
    const std::string hull = "hull() { cube(size = 1); sphere(r = 1, $fn = 5); } ";
    const std::string extrusion =
        "linear_extrude(height = 1, twist = 20) square(size = 3); rotate_extrude() square(size = "
        "2); ";
    CsgReport once;
    CsgReport twice;
    EXPECT_EQ(volume_of(hull + extrusion, &once),
              volume_of(hull + extrusion + hull + extrusion, &twice));
    EXPECT_EQ(once.found_again, 0U);
    EXPECT_EQ(twice.found_again, 3U);
    EXPECT_EQ(twice.by_name.at("hull"), (CsgNodeCount{2, 1}));
    EXPECT_EQ(twice.by_name.at("linear_extrude"), (CsgNodeCount{2, 1}));
    EXPECT_EQ(twice.by_name.at("cube"), (CsgNodeCount{2, 0}));
    EXPECT_EQ(once.evaluations, twice.evaluations);
    // Nodes that do not count are not counted.
    (void)volume_of("cube(size = 1); *sphere(r = 1); cube(size = 1);", &once);
    EXPECT_EQ(once.by_name.size(), 1U);
    EXPECT_EQ(once.by_name.at("cube"), (CsgNodeCount{2, 1}));
}

TEST(CsgEvaluate, ProgressNamesTheNode) {
    const CsgTree tree = parse_csg(
        "difference() {\n  hull() { cube(size = 1); }\n  *cube(size = 9);\n"
        "  minkowski() { cube(size = 1); sphere(r = 1, $fn = 4); }\n}",
        "f");
    std::string said;
    std::size_t last = 0;
    CsgOptions options;
    options.on_progress = [&](const CsgProgress& p) {
        EXPECT_EQ(p.count, 6U);
        EXPECT_GE(p.done, last);
        last = p.done;
        said += p.node == nullptr ? "formula"
                                  : p.node->name + std::to_string(p.node->place.line) + ":" +
                                        std::to_string(p.done) + " ";
    };
    (void)evaluate_csg(tree, options);
    EXPECT_EQ(said,
              "difference1:0 hull2:0 cube2:0 hull2:1 difference1:2 minkowski4:2 cube4:2 "
              "minkowski4:3 sphere4:3 minkowski4:4 difference1:5 formula");
}

}  // namespace
}  // namespace trisect
