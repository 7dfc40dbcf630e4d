// SPDX-License-Identifier: Apache-2.0
//
// STEP: what is read, where it is put, and what is refused.
#include <array>
#include <cmath>

#include "model_files.h"
#include "step_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

constexpr MeshFormat step_format = MeshFormat::Step;

/// With the representation.
std::string whole_tetrahedron() { return tetrahedron_entities() + tetrahedron_representation(); }

Model step_model(const std::string& data, ModelReport* report = nullptr) {
    return model_in(step_file(data), step_format, {}, report);
}

TEST(Step, FacetedBrep) {
    ModelReport report;
    const Model model = step_model(whole_tetrahedron(), &report);
    EXPECT_EQ(model.unit, "millimeter");
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].name, "block");
    const PolygonMesh& mesh = model.parts[0].mesh;
    EXPECT_EQ(mesh.points, (std::vector<Point3d>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}));
    EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3}));
    EXPECT_EQ(report, ModelReport());
    // Without a representation all shapes are read.
    EXPECT_EQ(step_model(tetrahedron_entities()).parts, model.parts);
}

TEST(Step, NumbersAreNearestDoubles) {
    const std::string text =
        with_replaced(whole_tetrahedron(), "(1.,0.,0.));\n#3",
                      "(0.1000000000000000055511151231257827,+1.E-3,-0.));\n#3");
    const Point3d p = step_model(text).parts[0].mesh.points[2];
    EXPECT_EQ(p, (Point3d{0.1, 0.001, -0.0}));
    EXPECT_TRUE(std::signbit(p[2]));
}

TEST(Step, Units) {
    const auto unit_of = [](const std::string& unit) {
        return step_model(with_replaced(whole_tetrahedron(),
                                        "(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.))",
                                        unit))
            .unit;
    };
    EXPECT_EQ(unit_of("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.))"), "meter");
    const std::string inch =
        "(CONVERSION_BASED_UNIT('INCH',#80) LENGTH_UNIT() NAMED_UNIT(#82));\n"
        "#80=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(NUMBER),#81);\n"
        "#81=(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.));\n"
        "#82=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)";
    EXPECT_EQ(unit_of(with_replaced(inch, "NUMBER", "25.4")), "inch");
    EXPECT_EQ(unit_of(with_replaced(inch, "NUMBER", "304.8")), "foot");
    EXPECT_EQ(unit_of(with_replaced(inch, "NUMBER", "2.5")), "2.5 millimeter");
}

TEST(Step, OrientationFlags) {
    const PolygonMesh mesh = step_model(whole_tetrahedron()).parts[0].mesh;
    const auto same = [&](const std::string& from, const std::string& to) {
        const std::string text = with_replaced(whole_tetrahedron(), from, to);
        const PolygonMesh other = step_model(text).parts.at(0).mesh;
        EXPECT_EQ(other.corners, mesh.corners) << to;
    };
    // A loop the other way round, and its flag.
    same(
        "#24=POLY_LOOP('',(#1,#3,#2));\n#25=POLY_LOOP('',(#1,#2,#4));\n#26=POLY_LOOP('',(#2,#3,#4"
        "));\n#27=POLY_LOOP('',(#3,#1,#4));\n#30=FACE_OUTER_BOUND('',#24,.T.)",
        "#24=POLY_LOOP('',(#1,#2,#3));\n#25=POLY_LOOP('',(#1,#2,#4));\n#26=POLY_LOOP('',(#2,#3,#4"
        "));\n#27=POLY_LOOP('',(#3,#1,#4));\n#30=FACE_OUTER_BOUND('',#24,.F.)");
    // A plane that looks the other way.
    const std::string turned =
        with_replaced(with_replaced(whole_tetrahedron(), "(0.,0.,-1.)", "(0.,0.,1.)"),
                      "(#30),#20,.T.", "(#30),#20,.F.");
    EXPECT_EQ(step_model(turned).parts[0].mesh.corners, mesh.corners);
    // A shell the other way round is inside out.
    const std::string reversed =
        with_replaced(whole_tetrahedron(), "FACETED_BREP('block',#50)",
                      "FACETED_BREP('block',#51);\n#51=ORIENTED_CLOSED_SHELL('',*,#50,.F.)");
    EXPECT_EQ(step_model(reversed).parts[0].mesh.corners,
              (std::vector<std::uint32_t>{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0}));
}

/// A square plate's top with a square hole, by edges: vertices #101.., edges #201.., face #300.
std::string holed_face(int shift = 0) {
    const std::array<std::array<int, 2>, 8> corners{{{0, 0},
                                                     {4, 0},
                                                     {4, 4},
                                                     {0, 4},
                                                     {shift + 1, 1},
                                                     {shift + 1, 3},
                                                     {shift + 3, 3},
                                                     {shift + 3, 1}}};
    std::string out;
    std::array<std::string, 2> loops;
    for (int i = 0; i < 8; ++i) {
        const auto& c = corners[static_cast<std::size_t>(i)];
        const std::string n = std::to_string(i + 1);
        const int first = i / 4 * 4;
        const std::string next = std::to_string(first + (i + 1 - first) % 4 + 1);
        out += "#10" + n + "=VERTEX_POINT('',#11" + n + ");\n#11" + n + "=CARTESIAN_POINT('',(" +
               std::to_string(c[0]) + ".," + std::to_string(c[1]) + ".,1.));\n";
        // Every other edge is stored the other way round.
        const bool is_forward = i % 2 == 0;
        out += "#20" + n + "=EDGE_CURVE('',#10" + (is_forward ? n : next) + ",#10" +
               (is_forward ? next : n) + ",#900,.T.);\n#21" + n + "=ORIENTED_EDGE('',*,*,#20" + n +
               (is_forward ? ",.T.);\n" : ",.F.);\n");
        loops[static_cast<std::size_t>(i / 4)] += (i % 4 == 0 ? "#21" : ",#21") + n;
    }
    return out + "#250=EDGE_LOOP('',(" + loops[0] + "));\n#251=EDGE_LOOP('',(" + loops[1] +
           "));\n#260=FACE_OUTER_BOUND('',#250,.T.);\n#261=FACE_BOUND('',#251,.T.);\n"
           "#270=AXIS2_PLACEMENT_3D('',#111,$,$);\n#271=PLANE('',#270);\n"
           "#300=ADVANCED_FACE('',(#261,#260),#271,.T.);\n#310=OPEN_SHELL('',(#300));\n"
           "#320=SHELL_BASED_SURFACE_MODEL('plate',(#310));\n#900=LINE('',#111,#901);\n";
}

TEST(Step, EdgeLoopsAndHoles) {
    const Model model = step_model(holed_face());
    ASSERT_EQ(model.parts.size(), 1U);
    const PolygonMesh& mesh = model.parts[0].mesh;
    EXPECT_EQ(mesh.points.size(), 8U);
    ASSERT_EQ(mesh.face_count(), 1U);
    EXPECT_EQ(mesh.face(0).size(), 10U);  // a bridge is run along twice
}

TEST(Step, HolesThatBoundNothingAreRefused) {
    // The hole beside the plate.
    expect_refused<InputError>(step_file(holed_face(10)), step_format, "test:", "bound no region");
}

TEST(Step, ChainsOfEdgesMustMeet) {
    const std::string text = with_replaced(holed_face(), "#211=ORIENTED_EDGE('',*,*,#201,.T.)",
                                           "#211=ORIENTED_EDGE('',*,*,#201,.F.)");
    expect_refused<InputError>(step_file(text), step_format, "test:", "does not end where");
}

std::string assembly(const std::string& axis, const std::string& reference) {
    return whole_tetrahedron() +
           "#71=SHAPE_REPRESENTATION('',(#72),#66);\n#72=AXIS2_PLACEMENT_3D('',#1,$,$);\n"
           "#73=SHAPE_REPRESENTATION('',(#74),#66);\n#74=AXIS2_PLACEMENT_3D('',#75,#76,#77);\n"
           "#75=CARTESIAN_POINT('',(10.,0.,0.));\n#76=DIRECTION('',(" +
           axis + "));\n#77=DIRECTION('',(" + reference +
           "));\n"
           "#78=SHAPE_REPRESENTATION_RELATIONSHIP('','',#71,#70);\n"
           "#79=(REPRESENTATION_RELATIONSHIP('','',#71,#73) "
           "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#80) "
           "SHAPE_REPRESENTATION_RELATIONSHIP());\n"
           "#80=ITEM_DEFINED_TRANSFORMATION('','',#72,#74);\n"
           "#81=(REPRESENTATION_RELATIONSHIP('','',#71,#73) "
           "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#82) "
           "SHAPE_REPRESENTATION_RELATIONSHIP());\n"
           "#82=ITEM_DEFINED_TRANSFORMATION('','',#72,#72);\n";
}

TEST(Step, Assemblies) {
    ModelReport report;
    const Model model = step_model(assembly("0.,0.,2.", "0.,3.,0."), &report);
    ASSERT_EQ(model.parts.size(), 2U);
    // x to y, y to -x, then 10 along x.
    EXPECT_EQ(model.parts[0].mesh.points,
              (std::vector<Point3d>{{10, 0, 0}, {9, 0, 0}, {10, 1, 0}, {10, 0, 1}}));
    EXPECT_EQ(model.parts[1].mesh.points[2], (Point3d{1, 0, 0}));
    EXPECT_EQ(report.rounded_vertices, 0U);
    expect_refused<InputError>(step_file(assembly("0.,0.,0.", "0.,1.,0.")), step_format,
                               "test:", "without a direction");
    expect_refused<InputError>(step_file(assembly("0.,1.,0.", "0.,1.,0.")), step_format,
                               "test:", "parallel axes");
}

TEST(Step, ASurfaceModelOfAShellOfABrepIsNotAnotherPart) {
    const std::string all = tetrahedron_entities() + tetrahedron_representation();
    const std::string also =
        "#80=SHELL_BASED_SURFACE_MODEL('',(#50));\n"
        "#81=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#80),#66);\n";
    const std::string tied = "#82=SHAPE_REPRESENTATION_RELATIONSHIP('','',#70,#81);\n";
    EXPECT_EQ(step_model(all + also + tied).parts.size(), 1U);
    // Elsewhere, or of another shell, it is one.
    EXPECT_EQ(step_model(all + also).parts.size(), 2U);
    const std::string open = "#51=OPEN_SHELL('',(#40,#41));\n";
    EXPECT_EQ(step_model(all + open + with_replaced(also, "(#50)", "(#51)") + tied).parts.size(),
              2U);
}

TEST(Step, MappedItems) {
    const std::string text = whole_tetrahedron() +
                             "#80=REPRESENTATION_MAP(#14,#70);\n#81=MAPPED_ITEM('',#80,#14);\n"
                             "#82=SHAPE_REPRESENTATION('',(#81,#81),#66);\n";
    const Model model = step_model(text);
    ASSERT_EQ(model.parts.size(), 2U);
    EXPECT_EQ(model.parts[0].mesh, step_model(whole_tetrahedron()).parts[0].mesh);
}

TEST(Step, Cycles) {
    const std::string text = whole_tetrahedron() +
                             "#80=REPRESENTATION_MAP(#14,#82);\n#81=MAPPED_ITEM('',#80,#14);\n"
                             "#82=SHAPE_REPRESENTATION('',(#81),#66);\n";
    expect_refused<InputError>(step_file(text), step_format, "test:", "contains itself");
    const std::string shells =
        with_replaced(whole_tetrahedron(), "FACETED_BREP('block',#50)",
                      "FACETED_BREP('block',#51);\n#51=ORIENTED_CLOSED_SHELL('',*,#51,.T.)");
    expect_refused<InputError>(step_file(shells), step_format, "test:", "oriented, too");
}

TEST(Step, CurvedIsRefusedByName) {
    const auto refused = [](const std::string& from, const std::string& to,
                            const std::string& part) {
        expect_refused<UnsupportedError>(step_file(with_replaced(whole_tetrahedron(), from, to)),
                                         step_format, "test:", part);
    };
    refused("#22=PLANE('',#16)", "#22=CYLINDRICAL_SURFACE('',#16,1.)",
            ": #22 CYLINDRICAL_SURFACE: faces are read where they are planar; this is the surface "
            "of #42 FACE_SURFACE");
    refused("#50=CLOSED_SHELL", "#50=VERTEX_SHELL", "#50 VERTEX_SHELL");
    refused("#26=POLY_LOOP('',(#2,#3,#4))", "#26=VERTEX_LOOP('',#2)", "#26 VERTEX_LOOP");
    expect_refused<UnsupportedError>(
        step_file(
            with_replaced(holed_face(), "#900=LINE('',#111,#901)", "#900=CIRCLE('',#270,1.)")),
        step_format, "test:", "#900 CIRCLE: edges are read where they are straight");
}

TEST(Step, OtherSolidsAreRefused) {
    const std::string text = with_replaced(whole_tetrahedron(), "REPRESENTATION('',(#60)",
                                           "REPRESENTATION('',(#60,#99)") +
                             "#99=SPHERE('',1.,#1);\n";
    expect_refused<UnsupportedError>(step_file(text), step_format, "test:", "#99 SPHERE");
    expect_refused<UnsupportedError>(step_file("#1=CARTESIAN_POINT('',(0.,0.,0.));\n"), step_format,
                                     "test:1:1", "no B-rep");
}

TEST(Step, ContradictionsAreErrors) {
    const auto refused = [](const std::string& from, const std::string& to,
                            const std::string& part) {
        expect_refused<InputError>(step_file(with_replaced(whole_tetrahedron(), from, to)),
                                   step_format, "test:", part);
    };
    refused("#10=DIRECTION('',(0.,0.,-1.))", "#10=DIRECTION('',(0.,0.,1.))",
            "#40 FACE_SURFACE: its loops run against the normal of its plane");
    refused("(#40,#41,#42,#43)", "(#40,#41,#42,#42)", "#50 CLOSED_SHELL: has #42 twice");
    refused("(#2,#3,#4)", "(#2,#3)", "#26 POLY_LOOP: has 2 corners");
    refused("(#2,#3,#4)", "(#2,#3,#404)", "there is no entity #404");
    refused("#2=CARTESIAN_POINT", "#1=CARTESIAN_POINT", "a second entity with the number #1");
    refused("(1.,0.,0.)", "(1.,0.)", "has not three numbers");
    refused("(1.,0.,0.)", "(1.,0.,x)", "expected");
    refused("(1.,0.,0.)", "(1.,0.,1.E999)", "too large");
    refused("(1.,0.,0.));", "(1.,0.,0.);", "before all brackets");
    refused("#2=CARTESIAN_POINT('',(1.", "#2=CARTESIAN_POINT('(1.", "test:");
}

TEST(Step, CornersOffTheirPlanesAreReported) {
    const std::string text = with_replaced(whole_tetrahedron(), "#12=DIRECTION('',(1.,1.,1.))",
                                           "#12=DIRECTION('',(1.,1.,1.1))");
    ModelReport report;
    const Model model = step_model(text, &report);
    EXPECT_EQ(report.off_plane_corners, 1U);
    EXPECT_NEAR(report.largest_plane_distance, 0.1 / std::sqrt(3.21), 1e-12);
    EXPECT_EQ(model.parts[0].mesh, step_model(whole_tetrahedron()).parts[0].mesh);
}

TEST(Step, Limits) {
    ReadOptions options;
    options.limits.entities = 10;
    expect_refused<LimitError>(step_file(whole_tetrahedron()), step_format, "test:", "entities",
                               options);
    options = {};
    options.limits.faces = 3;
    expect_refused<LimitError>(step_file(whole_tetrahedron()), step_format, "test:", "faces",
                               options);
    options = {};
    options.limits.nesting = 8;
    expect_refused<LimitError>(step_file("#1=A" + std::string(9, '(') + std::string(9, ')') + ";"),
                               step_format, "test:", "nest deeper", options);
    // A thousand solids that share one shell of many corners.
    std::string text = tetrahedron_entities();
    for (int i = 1000; i < 2000; ++i) text += "#" + std::to_string(i) + "=FACETED_BREP('',#50);\n";
    EXPECT_EQ(step_model(text).parts.size(), 1001U);
    std::string loop = "(#2,#3,#4";
    for (int i = 0; i < 3000; ++i) loop += ",#2,#3,#4";
    text = with_replaced(text, "(#2,#3,#4", loop);
    expect_refused<LimitError>(step_file(text), step_format, "test:", "again and again");
}

TEST(Step, Text) {
    const Model model = step_model(whole_tetrahedron());
    const std::string text = "/* a comment; */ " + step_file(whole_tetrahedron());
    EXPECT_EQ(model_in(text, step_format), model);
    const std::string name = with_replaced(whole_tetrahedron(), "'block'",
                                           "'d''\\X2\\00E9\\X0\\\\X4\\0001F600\\X0\\\\X\\E9\\\\'");
    EXPECT_EQ(step_model(name).parts[0].name, "d'\xC3\xA9\xF0\x9F\x98\x80\xC3\xA9\\");
    expect_refused<InputError>("ISO-10303-22;", step_format, "test:1:1", "ISO-10303-21");
    expect_refused<InputError>(step_file(whole_tetrahedron()) + "x", step_format,
                               "test:", "after the end");
    expect_refused<UnsupportedError>("ISO-10303-21;HEADER;ENDSEC;REFERENCE;#1=<a>;ENDSEC;",
                                     step_format, "test:1:", "REFERENCE");
    EXPECT_EQ(detect_mesh_format(step_file("")), step_format);
    EXPECT_EQ(mesh_format_of_extension("a.STP"), step_format);
    EXPECT_EQ(mesh_format_of_extension("a.step"), step_format);
}

}  // namespace
