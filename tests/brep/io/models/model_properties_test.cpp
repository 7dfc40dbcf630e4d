// SPDX-License-Identifier: Apache-2.0
//
// Textures and properties of corners in GLB and 3MF.
#include <trisect/brep/io/property_colors.h>
#include <trisect/brep/io/write_model.h>
#include <trisect/kernel/error.h>

#include <cmath>

#include "model_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

ReadOptions with_all() {
    ReadOptions options;
    options.properties = true;
    return options;
}

/// A tetrahedron: one face with a picture, one with colours, one with both, one without anything.
Model textured_sample(PropertyMeaning color) {
    Model model;
    ModelPart part;
    part.name = "part";
    part.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};
    part.mesh.add_triangle(0, 2, 1);
    part.mesh.add_triangle(0, 1, 3);
    part.mesh.add_triangle(1, 2, 3);
    part.mesh.add_triangle(2, 0, 3);
    model.materials = {{"wood", ModelColor{255, 255, 255, 255}, 0},
                       {"plain", ModelColor{10, 20, 30, 255}, no_texture}};
    model.textures = {
        {"", "image/png", "\x89PNG of no size", {TextureWrap::Clamp, TextureWrap::Mirror}}};
    part.materials = {0, 1, 0, 1};
    part.properties.width = 6;
    part.properties.channels = {{"uv", PropertyMeaning::TextureCoordinates, 2},
                                {"color", color, 4}};
    for (int c = 0; c < 12; ++c) {
        const bool has_uv = c / 3 == 0 || c / 3 == 2;
        const bool has_color = c / 3 == 1 || c / 3 == 2;
        for (const double x : {c / 16.0, 1 - c / 32.0})
            part.properties.values.push_back(has_uv ? x : absent_number);
        for (int k = 0; k < 4; ++k)
            part.properties.values.push_back(
                !has_color
                    ? absent_number
                    : (color == PropertyMeaning::Color ? (20 * c + k) / 255.0 : (c + k) / 16.0));
    }
    model.parts.push_back(std::move(part));
    return model;
}

Model written_and_read(const Model& model, MeshFormat format) {
    WriteOptions options;
    options.format = format;
    options.properties = true;
    return model_in(format_model(model, options).bytes, format, with_all());
}

/// Faces are listed by their materials in GLB, so they are looked for by their points.
void expect_same_corners(const Model& a, const Model& b) {
    ASSERT_EQ(a.parts.size(), b.parts.size());
    const ModelPart& x = a.parts[0];
    const ModelPart& y = b.parts[0];
    ASSERT_EQ(x.mesh.face_count(), y.mesh.face_count());
    ASSERT_EQ(x.properties.channels, y.properties.channels);
    const auto corner = [](const ModelPart& p, std::size_t c) {
        return p.mesh.points[p.mesh.corners[c]];
    };
    std::size_t found = 0;
    for (std::size_t f = 0; f < x.mesh.face_count(); ++f)
        for (std::size_t g = 0; g < y.mesh.face_count(); ++g) {
            bool same = true;
            for (std::size_t k = 0; k < 3; ++k)
                same = same && corner(x, 3 * f + k) == corner(y, 3 * g + k);
            if (!same) continue;
            ++found;
            EXPECT_EQ(x.materials[f] == no_material, y.materials[g] == no_material);
            const auto& m = a.materials[x.materials[f]];
            const auto& n = b.materials[y.materials[g]];
            EXPECT_EQ(m.name, n.name);
            EXPECT_EQ(m.color, n.color);
            EXPECT_EQ(m.texture, n.texture);
            for (std::size_t i = 0; i < 3 * x.properties.width; ++i) {
                const double p = x.properties.values[3 * f * x.properties.width + i];
                const double q = y.properties.values[3 * g * y.properties.width + i];
                EXPECT_TRUE(p == q || (std::isnan(p) && std::isnan(q))) << f << " " << i;
            }
        }
    EXPECT_EQ(found, x.mesh.face_count());
}

TEST(ModelProperties, GlbKeepsThem) {
    const Model model = textured_sample(PropertyMeaning::LinearColor);
    const Model back = written_and_read(model, MeshFormat::Glb);
    expect_same_corners(model, back);
    EXPECT_EQ(back.textures, model.textures);
    EXPECT_EQ(back.parts[0].mesh.points.size(), 12U);  // merged again by the extension
}

TEST(ModelProperties, ThreeMfKeepsThem) {
    Model model = textured_sample(PropertyMeaning::Color);
    const Model back = written_and_read(model, MeshFormat::ThreeMf);
    model.materials[0].texture = 0;
    // A face with uv and a plain material has nothing to put them on.
    expect_same_corners(model, back);
    EXPECT_EQ(back.textures[0].bytes, model.textures[0].bytes);
    EXPECT_EQ(back.textures[0].wrap, model.textures[0].wrap);
}

// Names of OBJ files may be in any encoding.
TEST(ModelProperties, NamesThatAreNoTextAreMadeOne) {
    Model model = textured_sample(PropertyMeaning::Color);
    model.materials[1].name = "a\xFFz\xC3\xA9\xED\xA0\x80";
    EXPECT_EQ(written_and_read(model, MeshFormat::ThreeMf).materials[1].name, "a?z\xC3\xA9???");
}

TEST(ModelProperties, AreLeftOutUnlessAsked) {
    const Model model = textured_sample(PropertyMeaning::Color);
    WriteOptions options;
    for (const MeshFormat format : {MeshFormat::Glb, MeshFormat::ThreeMf}) {
        options.format = format;
        Model bare = model;
        bare.parts[0].properties = {};
        bare.textures.clear();
        for (ModelMaterial& material : bare.materials) material.texture = no_texture;
        EXPECT_EQ(format_model(model, options).bytes, format_model(bare, options).bytes);
        options.properties = true;
        const Model read = model_in(format_model(model, options).bytes, format);
        EXPECT_EQ(read.parts[0].properties.width, 0U);
        options.properties = false;
    }
}

TEST(ModelProperties, WhatThreeMfLacksIsListed) {
    Model model = textured_sample(PropertyMeaning::Color);
    model.textures[0].bytes.clear();
    WriteOptions options;
    options.format = MeshFormat::ThreeMf;
    options.properties = true;
    EXPECT_EQ(
        format_model(model, options).report.left_out,
        (std::vector<std::string>{"3MF has no texture coordinates where there is no picture"}));
}

TEST(ModelProperties, ColoursAreAmountsOfLightInGlb) {
    Model model = textured_sample(PropertyMeaning::Color);
    Model back = written_and_read(model, MeshFormat::Glb);
    EXPECT_TRUE(back.parts[0].properties.column_of(PropertyMeaning::LinearColor).has_value());
    convert_colors(back.parts[0].properties, false);
    // Corner 3 of the second face, whose stretch comes wherever it comes: by its level of opacity.
    const CornerProperties& p = back.parts[0].properties;
    bool found = false;
    for (std::size_t c = 0; c < 12; ++c)
        if (std::fabs(p.at(c)[5] - 63 / 255.0) < 1e-7) {
            found = true;
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(p.at(c)[2 + k], (60 + static_cast<double>(k)) / 255.0, 1e-6);
        }
    EXPECT_TRUE(found);
}

/// A triangle with attributes of these accessors, behind the positions.
std::string glb_triangle(const std::string& attributes, const std::string& accessors,
                         const std::string& views, const std::string& data,
                         const std::string& node = R"({"mesh":0})") {
    std::string binary;
    for (const float c : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) append_float(binary, c);
    binary += data;
    return glb_file(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[)" + node +
                        R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0,)" + attributes +
                        R"(}}]}],"buffers":[{"byteLength":)" + std::to_string(binary.size()) +
                        R"(}],"bufferViews":[{"buffer":0,"byteLength":36},)" + views +
                        R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":3,)" +
                        R"("type":"VEC3"},)" + accessors + "]}",
                    binary);
}

TEST(GlbProperties, BytesAreSharesOfTheLargest) {
    const Model model =
        model_in(glb_triangle(R"("COLOR_0":1)",
                              R"({"bufferView":1,"componentType":5121,"normalized":true,"count":3,)"
                              R"("type":"VEC4"})",
                              R"({"buffer":0,"byteOffset":36,"byteLength":12})",
                              std::string("\xFF\x33\x00\xFF\x00\x00\x00\xFF\x00\x00\x00\xFF", 12)),
                 MeshFormat::Glb, with_all());
    EXPECT_EQ(model.parts[0].properties.at(0)[1], 0.2);
}

TEST(GlbProperties, CountsMustMatch) {
    const std::string bytes = glb_triangle(
        R"("TEXCOORD_0":1)", R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC2"})",
        R"({"buffer":0,"byteOffset":36,"byteLength":16})", std::string(16, '\0'));
    try {
        (void)model_in(bytes, MeshFormat::Glb, with_all());
        FAIL();
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find(
                      "meshes[0].primitives[0]: TEXCOORD_0 has 2 entries for 3 vertices"),
                  std::string::npos)
            << e.what();
    }
    EXPECT_NO_THROW((void)model_in(bytes, MeshFormat::Glb));  // as before
}

TEST(GlbProperties, HostileAccessorsAreRefused) {
    const auto with = [](const std::string& accessor) {
        return glb_triangle(R"("TEXCOORD_0":1)", accessor,
                            R"({"buffer":0,"byteOffset":36,"byteLength":24})",
                            std::string(24, '\0'));
    };
    for (const char* accessor :
         {R"({"bufferView":1,"componentType":5126,"count":4294967295,"type":"VEC2"})",
          R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC2","byteOffset":4})",
          R"({"bufferView":7,"componentType":5126,"count":3,"type":"VEC2"})",
          R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"})",
          R"({"bufferView":1,"componentType":5125,"count":3,"type":"VEC2"})"})
        EXPECT_THROW((void)model_in(with(accessor), MeshFormat::Glb, with_all()), InputError)
            << accessor;
}

TEST(GlbProperties, NormalsTurnWithTheirNode) {
    std::string data;
    for (int i = 0; i < 3; ++i)
        for (const float c : {0.F, 0.F, 1.F}) append_float(data, c);
    const Model model =
        model_in(glb_triangle(R"("NORMAL":1)",
                              R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"})",
                              R"({"buffer":0,"byteOffset":36,"byteLength":36})", data,
                              R"({"mesh":0,"scale":[2,1,-1]})"),
                 MeshFormat::Glb, with_all());
    EXPECT_EQ(model.parts[0].properties.at(0)[2], -1);
}

const std::string materials_space =
    "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\"";

std::string three_mf_with(const std::string& resources, const std::string& triangle) {
    return package(
        model_text(
            resources +
                "<object id=\"9\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
                "<vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices>"
                "<triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\" " +
                triangle + "/></triangles></mesh></object>",
            "<item objectid=\"9\"/>", materials_space),
        {{"3D/t.png", "\x89PNG"}});
}

TEST(ThreeMfProperties, ColourGroupsAreOfCorners) {
    const Model model = model_in(three_mf_with("<m:colorgroup id=\"1\"><m:color color=\"#FF0000\"/>"
                                               "<m:color color=\"#0000FF33\"/></m:colorgroup>",
                                               "pid=\"1\" p1=\"0\" p2=\"1\" p3=\"0\""),
                                 MeshFormat::ThreeMf, with_all());
    EXPECT_TRUE(model.materials.empty());
    const CornerProperties& p = model.parts[0].properties;
    EXPECT_EQ(p.at(0)[0], 1);
    EXPECT_EQ(p.at(1)[3], 0.2);
    EXPECT_EQ(p.at(2)[0], 1);
}

TEST(ThreeMfProperties, RefusedWithTheirPlaces) {
    const std::string texture =
        "<m:texture2d id=\"1\" path=\"/3D/t.png\" contenttype=\"image/png\"/>";
    const std::string group =
        "<m:texture2dgroup id=\"2\" texid=\"1\"><m:tex2coord u=\"0\" v=\"1\"/>"
        "</m:texture2dgroup>";
    EXPECT_NO_THROW((void)model_in(three_mf_with(texture + group, "pid=\"2\" p1=\"0\""),
                                   MeshFormat::ThreeMf, with_all()));
    const std::vector<std::pair<std::string, std::string>> bad{
        {texture + group, "pid=\"2\" p1=\"0\" p2=\"1\" p3=\"0\""},
        {group, "pid=\"2\" p1=\"0\""},
        {"<m:texture2d id=\"1\" path=\"/3D/no.png\" contenttype=\"image/png\"/>", ""},
        {"<m:texture2d id=\"1\" path=\"/../t.png\" contenttype=\"image/png\"/>", ""},
        {texture + group +
             "<m:multiproperties id=\"3\" pids=\"2\"><m:multi pindices=\"5\"/></m:multiproperties>",
         "pid=\"3\" p1=\"0\""},
        {"<m:multiproperties id=\"3\" pids=\"3\"><m:multi pindices=\"0\"/></m:multiproperties>",
         "pid=\"3\" p1=\"0\""}};
    for (const auto& [resources, triangle] : bad) {
        try {
            (void)model_in(three_mf_with(resources, triangle), MeshFormat::ThreeMf, with_all());
            ADD_FAILURE() << resources;
        } catch (const InputError& e) {
            EXPECT_NE(std::string(e.what()).find("test/3D/a.model:1:"), std::string::npos)
                << e.what();
        }
    }
}

}  // namespace
