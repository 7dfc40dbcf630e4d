// SPDX-License-Identifier: Apache-2.0
//
// AMF: what is read, where it is put, and what is refused.
#include "model_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

constexpr MeshFormat amf_format = MeshFormat::Amf;

const std::string amf_vertices =
    "<vertices><vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>"
    "<vertex><coordinates><x>1.5</x><y>0</y><z>0</z></coordinates></vertex>"
    "<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex></vertices>";
const std::string amf_triangle = "<triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle>";

std::string amf_object(const std::string& id, const std::string& more = "") {
    return "<object id=\"" + id + "\">" + more + "<mesh>" + amf_vertices + "<volume>" +
           amf_triangle + "</volume></mesh></object>";
}

std::string amf_file(const std::string& content) {
    return "<amf unit=\"inch\">" + content + "</amf>";
}

TEST(Amf, Objects) {
    const Model model = model_in(
        amf_file(amf_object("1", "<metadata type=\"name\">first</metadata>") + amf_object("2")),
        amf_format);
    EXPECT_EQ(model.unit, "inch");
    ASSERT_EQ(model.parts.size(), 2U);
    EXPECT_EQ(model.parts[0].name, "first");
    EXPECT_EQ(model.parts[1].mesh.points[1], (Point3d{1.5, 0, 0}));
    EXPECT_EQ(model.parts[1].mesh.face_count(), 1U);
}

TEST(Amf, Packed) {
    const std::string text = amf_file(amf_object("1"));
    EXPECT_EQ(model_in(detail::zip_bytes({{"a.amf", text}}), amf_format),
              model_in(text, amf_format));
    expect_refused<InputError>(detail::zip_bytes({{"a", text}, {"b", text}}), amf_format,
                               "test: ", "one entry");
}

TEST(Amf, Materials) {
    const std::string text = amf_file(
        "<object id=\"1\"><mesh>" + amf_vertices + "<volume materialid=\"m\">" + amf_triangle +
        "</volume><volume>" + amf_triangle + "</volume></mesh></object>" +
        "<material id=\"m\"><metadata type=\"name\">stone</metadata><color><r>1</r><g>0.5</g>"
        "<b>0</b></color></material>");
    const Model model = model_in(text, amf_format);
    ASSERT_EQ(model.materials.size(), 1U);
    EXPECT_EQ(model.materials[0].name, "stone");
    EXPECT_EQ(model.materials[0].color, (ModelColor{255, 128, 0, 255}));
    EXPECT_EQ(model.parts[0].materials, (std::vector<std::uint32_t>{0, no_material}));
}

TEST(Amf, Constellations) {
    const std::string text =
        amf_file(amf_object("1") +
                 "<constellation id=\"2\"><instance objectid=\"1\"><deltax>10</deltax><rz>90</rz>"
                 "</instance><instance objectid=\"1\"/></constellation>");
    const Model model = model_in(text, amf_format);
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].mesh.points[1], (Point3d{10, 1.5, 0}));
    EXPECT_EQ(model.parts[0].mesh.points[4], (Point3d{1.5, 0, 0}));
}

TEST(Amf, Refused) {
    const auto refused = [](const std::string& text, const std::string& place,
                            const std::string& part) {
        expect_refused<InputError>(text, amf_format, "test:" + place + ": ", part);
    };
    refused("<x/>", "1:1", "no AMF");
    refused("<!DOCTYPE amf []>" + amf_file(amf_object("1")), "1:15", "document type");
    std::string text = amf_file(amf_object("1"));
    text.replace(text.find("<x>1.5"), 6, "\n<x>1,5");
    refused(text, "2:1", "'1,5'");
    refused(amf_file(amf_object("1") + "\n" + amf_object("1")), "2:1", "two objects");
    refused(amf_file("<constellation id=\"1\">\n<instance objectid=\"1\"/></constellation>"), "2:1",
            "contains itself");
    refused(amf_file("<constellation id=\"1\">\n<instance objectid=\"7\"/></constellation>"), "2:1",
            "no object '7'");
    std::string bent = amf_file(amf_object("1"));
    bent.insert(bent.find("</vertex>"), "\n<normal/>");
    expect_refused<UnsupportedError>(bent, amf_format, "test:2:1: ", "bends triangles");
}

TEST(Amf, DoublingConstellationsAreBounded) {
    std::string text = amf_object("0");
    for (int i = 1; i <= 60; ++i) {
        const std::string use = "<instance objectid=\"" + std::to_string(i - 1) + "\"/>";
        text += "<constellation id=\"" + std::to_string(i) + "\">" + use + use + "</constellation>";
    }
    expect_refused<LimitError>(amf_file(text), amf_format, "test:", "amount to more");
    std::string deep = amf_object("0");
    for (int i = 1; i <= 1000; ++i) {
        deep += "<constellation id=\"" + std::to_string(i) + "\"><instance objectid=\"" +
                std::to_string(i - 1) + "\"/></constellation>";
    }
    expect_refused<LimitError>(amf_file(deep), amf_format, "test:", "nest deeper");
}

}  // namespace
