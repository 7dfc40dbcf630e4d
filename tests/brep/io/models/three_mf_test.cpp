// SPDX-License-Identifier: Apache-2.0
//
// 3MF: what is read, where it is put, and what is refused.
#include "model_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

constexpr MeshFormat mf = MeshFormat::ThreeMf;

std::string object(int id, const std::string& content, const std::string& attributes = "") {
    return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + content + "</object>";
}

std::string item(int id, const std::string& attributes = "") {
    return "<item objectid=\"" + std::to_string(id) + "\" " + attributes + "/>";
}

std::string components(const std::string& content) {
    return "<components>" + content + "</components>";
}

std::string component(int id, const std::string& transform = "") {
    return "<component objectid=\"" + std::to_string(id) + "\"" +
           (transform.empty() ? "" : " transform=\"" + transform + "\"") + "/>";
}

TEST(ThreeMf, OneObject) {
    const std::string text =
        model_text(object(7, tetrahedron_mesh, "name=\"a &amp; b\""), item(7), "unit=\"inch\"");
    const Model model = model_in(package(text), mf);
    EXPECT_EQ(model.unit, "inch");
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].name, "a & b");
    EXPECT_EQ(model.parts[0].mesh.points.size(), 4U);
    EXPECT_EQ(model.parts[0].mesh.face_count(), 4U);
    EXPECT_TRUE(model.parts[0].materials.empty());
    EXPECT_EQ(read_mesh(package(text), mf, "test"), model.parts[0].mesh);
}

TEST(ThreeMf, NumbersAreTheNearestDoubles) {
    std::string mesh = tetrahedron_mesh;
    mesh.replace(mesh.find("x=\"1\""), 5, "x=\" +0.1000000000000000055511151231257827 \"");
    const Model model = model_in(package(model_text(object(1, mesh), item(1))), mf);
    EXPECT_EQ(model.parts[0].mesh.points[1][0], 0.1);
}

TEST(ThreeMf, ComponentsArePlaced) {
    // A quarter turn about z, then a translation: (x, y) -> (-y, x), as rows of (x y z 1).
    const std::string turned = "0 1 0 -1 0 0 0 0 1 10 20 30";
    const std::string text = model_text(
        object(1, tetrahedron_mesh) + object(2, components(component(1, turned) + component(1))),
        item(2, "transform=\"1 0 0 0 1 0 0 0 1 0.5 0 0\""));
    ModelReport report;
    const Model model = model_in(package(text), mf, {}, &report);
    ASSERT_EQ(model.parts.size(), 1U);
    const PolygonMesh& mesh = model.parts[0].mesh;
    ASSERT_EQ(mesh.points.size(), 8U);
    EXPECT_EQ(mesh.points[1], (Point3d{10.5, 21, 30}));
    EXPECT_EQ(mesh.points[2], (Point3d{9.5, 20, 30}));
    EXPECT_EQ(mesh.points[5], (Point3d{1.5, 0, 0}));
    EXPECT_EQ(report, ModelReport());
}

TEST(ThreeMf, RoundingIsReported) {
    const std::string text = model_text(object(1, tetrahedron_mesh),
                                        item(1, "transform=\"0.1 0 0 0 1 0 0 0 1 1e17 0 0\""));
    ModelReport report;
    const Model model = model_in(package(text), mf, {}, &report);
    EXPECT_EQ(report.rounded_vertices, 1U);
    EXPECT_EQ(report.largest_move, 0.1);
    EXPECT_EQ(model.parts[0].mesh.points[1][0], 1e17);
}

TEST(ThreeMf, MirrorsTurnFacesOver) {
    const std::string text =
        model_text(object(1, tetrahedron_mesh), item(1, "transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\""));
    const Model model = model_in(package(text), mf);
    const auto face = model.parts[0].mesh.face(0);
    EXPECT_EQ((std::vector<std::uint32_t>{face.begin(), face.end()}),
              (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(ThreeMf, Materials) {
    const std::string resources =
        "<basematerials id=\"1\"><base name=\"red\" displaycolor=\"#FF0000\"/>"
        "<base name=\"blue\" displaycolor=\"#0000ff80\"/></basematerials>"
        "<m:colorgroup xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
        "id=\"2\"><m:color color=\"#010203\"/></m:colorgroup>";
    std::string mesh = tetrahedron_mesh;
    mesh.replace(mesh.find("v3=\"1\""), 6, "v3=\"1\" p1=\"1\"");
    mesh.replace(mesh.find("v3=\"3\""), 6, "v3=\"3\" pid=\"2\" p1=\"0\"");
    const Model model = model_in(
        package(model_text(resources + object(3, mesh, "pid=\"1\" pindex=\"0\""), item(3))), mf);
    ASSERT_EQ(model.materials.size(), 3U);
    EXPECT_EQ(model.materials[0].name, "red");
    EXPECT_EQ(model.materials[1].color, (ModelColor{0, 0, 255, 128}));
    EXPECT_EQ(model.materials[2].color, (ModelColor{1, 2, 3, 255}));
    EXPECT_EQ(model.parts[0].materials, (std::vector<std::uint32_t>{1, 2, 0, 0}));
}

TEST(ThreeMf, PartsOfAPackage) {
    const std::string production =
        "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
        "requiredextensions=\"p\"";
    const std::string other = model_text(object(5, tetrahedron_mesh), "");
    const std::string root = model_text(
        object(1, components("<component p:path=\"/3D/Objects/b.model\" objectid=\"5\"/>")),
        item(1), production);
    const Model model = model_in(package(root, {{"3D/Objects/b.model", other}}), mf);
    EXPECT_EQ(model.parts[0].mesh.face_count(), 4U);
    expect_refused<InputError>(package(root), mf, "test/3D/a.model:1:", "there is no entry");
}

TEST(ThreeMf, SupportIsNoPart) {
    const std::string text =
        model_text(object(1, tetrahedron_mesh, "type=\"support\"") + object(2, tetrahedron_mesh),
                   item(1) + item(2));
    EXPECT_EQ(model_in(package(text), mf).parts.size(), 1U);
}

TEST(ThreeMf, ErrorsHavePlaces) {
    const auto refused = [](const std::string& text, const std::string& place,
                            const std::string& part) {
        expect_refused<InputError>(package(text), mf, "test/3D/a.model:" + place + ": ", part);
    };
    refused("<model", "1:1", "no XML");
    refused("<a/>", "1:1", "no model");
    refused("\n<model " + core_space + "/>", "2:75", "without a build");
    const std::string good = model_text(object(1, tetrahedron_mesh), item(1));
    const auto spoiled = [&](const std::string& what, const std::string& by) {
        std::string text = good;
        text.replace(text.find(what), what.size(), "\n" + by);
        return text;
    };
    refused(spoiled("<vertex x=\"1\"", "<vertex x=\"1x\""), "2:1", "'1x'");
    refused(spoiled("<vertex x=\"1\"", "<vertex x=\"inf\""), "2:1", "is not finite");
    refused(spoiled("<vertex x=\"1\"", "<vertex"), "2:1", "without the attribute x");
    refused(spoiled("<triangle v1=\"0\"", "<triangle v1=\"4\""), "2:1", "does not exist");
    refused(spoiled("<triangle v1=\"0\"", "<triangle v1=\"-1\""), "2:1", "is not an index");
    refused(spoiled("<item objectid=\"1\"", "<item objectid=\"2\""), "2:1", "no object 2");
    refused(spoiled("<item", "<item transform=\"1 2 3\""), "2:1", "fewer than twelve");
    refused(spoiled("<item", "<item transform=\"1 0 0 0 0 0 0 0 1 0 0 0\""), "2:1", "flat");
    refused(spoiled("<object", "<object id=\"1\"/><object"), "2:17", "two resources");
}

TEST(ThreeMf, RequiredExtensionsAreRefusedByName) {
    expect_refused<UnsupportedError>(
        package(model_text("", "", "xmlns:b=\"http://x/beamlattice\" requiredextensions=\"b\"")),
        mf, "test/3D/a.model:1:1: ", "http://x/beamlattice");
}

TEST(ThreeMf, DocumentTypesAreRefused) {
    const std::string text = "<!DOCTYPE model [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]>" +
                             model_text(object(1, tetrahedron_mesh), item(1));
    expect_refused<InputError>(package(text), mf, "test/3D/a.model:1:", "document type");
    const std::string outside =
        "<!DOCTYPE model SYSTEM \"file:///etc/passwd\">" + model_text("", "");
    expect_refused<InputError>(package(outside), mf, "test/3D/a.model:1:", "document type");
}

TEST(ThreeMf, Cycles) {
    const std::string self = model_text(object(1, components(component(1))), item(1));
    expect_refused<InputError>(package(self), mf, "test/3D/a.model:", "contains itself");
    const std::string two = model_text(
        object(1, components(component(2))) + object(2, components(component(1))), item(1));
    expect_refused<InputError>(package(two), mf, "test/3D/a.model:", "contains itself");
}

/// Objects each of which has the one before it `times` times.
std::string nested(int depth, int times) {
    std::string resources = object(1, tetrahedron_mesh);
    for (int i = 2; i <= depth; ++i) {
        std::string uses;
        for (int k = 0; k < times; ++k) uses += component(i - 1);
        resources += object(i, components(uses));
    }
    return package(model_text(resources, item(depth)));
}

TEST(ThreeMf, DeepComponentsAreBounded) {
    EXPECT_EQ(model_in(nested(64, 1), mf).parts[0].mesh.face_count(), 4U);
    expect_refused<LimitError>(nested(65, 1), mf, "test/3D/a.model:", "nest deeper than 64");
    expect_refused<LimitError>(nested(1000, 1), mf, "test/3D/a.model:", "nest deeper than 64");
    ReadOptions deep;
    deep.limits.nesting = 1000;
    EXPECT_EQ(model_in(nested(1000, 1), mf, deep).parts[0].mesh.face_count(), 4U);
}

TEST(ThreeMf, DoublingComponentsAreBounded) {
    EXPECT_EQ(model_in(nested(9, 2), mf).parts[0].mesh.face_count(), 1024U);
    expect_refused<LimitError>(nested(60, 2), mf, "test/3D/a.model:", "amount to more than");
    const std::string empty = model_text(
        object(1, components("")) + object(2, components(component(1) + component(1))), item(2));
    ReadOptions few;
    few.limits.instances = 2;
    expect_refused<LimitError>(package(empty), mf, "test/3D/a.model:", "instances", few);
}

TEST(ThreeMf, PathsThatLeaveThePackageAreRefused) {
    for (const char* target :
         {"/../a.model", "3D/../a.model", "//3D/a.model", "3D\\a.model", "file:///3D/a.model"}) {
        std::string relation = one_relation;
        relation.replace(relation.find("/3D/a.model"), 11, target);
        const std::string bytes = detail::zip_bytes({{"_rels/.rels", relation}});
        expect_refused<InputError>(bytes, mf, "test/_rels/.rels:1:", "is refused");
    }
    std::string outside = one_relation;
    outside.replace(outside.find("Id="), 3, "TargetMode=\"External\" Id=");
    expect_refused<InputError>(detail::zip_bytes({{"_rels/.rels", outside}}), mf,
                               "test/_rels/.rels:1:", "outside the package");
}

TEST(ThreeMf, OtherArchivesAreNone) {
    expect_refused<InputError>(detail::zip_bytes({{"a", "b"}}), mf, "test: ", "_rels/.rels");
    expect_refused<InputError>("PK\3\4 and no more", mf, "test: ", "no zip archive");
    expect_refused<InputError>(detail::zip_bytes({{"_rels/.rels", one_relation}}), mf,
                               "test: ", "there is no entry");
}

}  // namespace
