// SPDX-License-Identifier: Apache-2.0
//
// PLY with materials and properties: what is read, what is written, what is refused.
#include <trisect/brep/io/read_model.h>
#include <trisect/brep/io/write_model.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {

using namespace trisect;

Model ply(const std::string& text) {
    ReadOptions options;
    options.properties = true;
    return read_model(text, MeshFormat::Ply, "a.ply", options);
}

/// A triangle whose vertices and face have these properties and values.
std::string triangle(const std::string& properties, const std::array<std::string, 3>& values,
                     const std::string& of_face = "", const std::string& face_values = "",
                     const std::string& more = "", const std::string& more_values = "") {
    return "ply\nformat ascii 1.0\ncomment TextureFile wood.png\nelement vertex 3\n"
           "property float x\nproperty float y\nproperty float z\n" +
           properties + "element face 1\nproperty list uchar int vertex_indices\n" + of_face +
           more + "end_header\n0 0 0 " + values[0] + "\n1 0 0 " + values[1] + "\n0 1 0 " +
           values[2] + "\n3 0 1 2 " + face_values + "\n" + more_values;
}

std::vector<double> ply_row(const Model& model, std::size_t corner) {
    const auto row = model.parts[0].properties.at(corner);
    return {row.begin(), row.end()};
}

void expect_ply_error(const std::string& text, const std::string& message) {
    try {
        (void)ply(text);
        ADD_FAILURE() << "read";
    } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()).substr(0, message.size()), message);
    }
}

TEST(PlyProperties, NamesOfTextureCoordinates) {
    for (const auto& [u, v] :
         {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v")}) {
        const Model model =
            ply(triangle("property float " + std::string(u) + "\nproperty float " + v + "\n",
                         {"0.1 0.2", "0.3 0.4", "nan nan"}));
        EXPECT_EQ(ply_row(model, 1), (std::vector<double>{0.3, 0.4}));
        EXPECT_TRUE(std::isnan(ply_row(model, 2)[0]));
        EXPECT_EQ(model.textures.at(0).file, "wood.png");
        EXPECT_EQ(model.parts[0].materials, (std::vector<std::uint32_t>{0}));
    }
}

TEST(PlyProperties, ColoursCountFromTheLargestOfTheirType) {
    const Model model =
        ply(triangle("property uchar red\nproperty ushort green\nproperty float blue\n",
                     {"255 65535 1", "51 0 0.5", "0 0 0"}));
    EXPECT_EQ(ply_row(model, 0), (std::vector<double>{1, 1, 1, 1}));
    EXPECT_EQ(ply_row(model, 1), (std::vector<double>{0.2, 0, 0.5, 1}));
}

TEST(PlyProperties, OtherScalarsHaveTheirNames) {
    const Model model =
        ply(triangle("property int tag\nproperty double nx\nproperty double ny\n"
                     "property double nz\n",
                     {"7 0 0 1", "-3 0 1 0", "0 1 0 0"}));
    const CornerProperties& p = model.parts[0].properties;
    ASSERT_EQ(p.channels.size(), 2U);
    EXPECT_EQ(p.channels[0], (PropertyChannel{"tag", PropertyMeaning::Any, 1}));
    EXPECT_EQ(ply_row(model, 1), (std::vector<double>{-3, 0, 1, 0}));
}

TEST(PlyProperties, FacesSpeakOfTheirCorners) {
    const Model model = ply(
        triangle("property float s\nproperty float t\n", {"9 9", "9 9", "9 9"},
                 "property list uchar float texcoord\nproperty int texnumber\nproperty uchar red\n"
                 "property uchar green\nproperty uchar blue\n",
                 "6 0 0.5 1 0 0 1 0 255 0 51"));
    EXPECT_EQ(ply_row(model, 0), (std::vector<double>{0, 0.5, 1, 0, 0.2, 1}));
    EXPECT_EQ(ply_row(model, 1), (std::vector<double>{1, 0, 1, 0, 0.2, 1}));
    EXPECT_EQ(model.materials.at(0).texture, 0U);
}

TEST(PlyProperties, RefusedWithTheirPlaces) {
    expect_ply_error(
        triangle("", {"", "", ""}, "property list uchar float texcoord\n", "4 0 0 1 1"),
        "a.ply:15:9: 4 texture coordinates of a face with 3 corners");
    expect_ply_error(triangle("", {"", "", ""}, "property int texnumber\n", "1"),
                     "a.ply:15:9: texture 1 of a face; there are 1");
    expect_ply_error(triangle("", {"", "", ""}, "property int material_index\n", "0"),
                     "a.ply:15:9: material 0 of a face; there are 0");
    expect_ply_error(triangle("", {"", "", ""}, "property float material_index\n", "0.5"),
                     "a.ply:15:9: a value of 'material_index' that is no index");
    expect_ply_error(triangle("property float s\nproperty float t\n", {"0 0", "inf 0", "0 0"}),
                     "a.ply:14:7: a value of 's' that is not finite");
}

// Few vertices with many scalars, and many corners.
TEST(PlyProperties, ManyScalarsTimesManyCornersAreLimited) {
    std::string names;
    std::string zeros;
    for (int i = 0; i < 50; ++i) {
        names += "property float q" + std::to_string(i) + "\n";
        zeros += "0 ";
    }
    ReadOptions options;
    options.properties = true;
    options.limits.property_numbers = 299;
    const std::string text = triangle(names, {zeros, zeros, zeros});
    EXPECT_NO_THROW((void)read_model(text, MeshFormat::Ply, "a.ply", options));
    options.limits.property_numbers = 149;
    EXPECT_THROW((void)read_model(text, MeshFormat::Ply, "a.ply", options), LimitError);
}

Model sample() {
    Model model;
    ModelPart part;
    part.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}};
    part.mesh.add_triangle(0, 2, 1);
    part.mesh.add_triangle(0, 1, 3);
    part.mesh.add_triangle(1, 2, 3);
    part.mesh.add_triangle(2, 0, 3);
    model.materials = {{"plain", ModelColor{10, 20, 30, 255}, no_texture},
                       {"wood", ModelColor{255, 255, 255, 255}, 0}};
    model.textures = {{"wood.png", "image/png", "", {}}};
    part.materials = {0, 1, 1, no_material};
    part.properties.width = 6;
    part.properties.channels = {{"uv", PropertyMeaning::TextureCoordinates, 2},
                                {"color", PropertyMeaning::Color, 4}};
    for (int c = 0; c < 12; ++c) {
        part.properties.values.insert(part.properties.values.end(), {0.1 * c, 1 - 0.07 * c});
        for (int k = 0; k < 4; ++k) part.properties.values.push_back((20 * c + k) / 255.0);
    }
    part.properties.values[0] = part.properties.values[1] = absent_number;
    model.parts.push_back(std::move(part));
    return model;
}

TEST(PlyProperties, ComeBackFromEachEncoding) {
    const Model model = sample();
    for (const PlyEncoding encoding :
         {PlyEncoding::Ascii, PlyEncoding::BinaryLittleEndian, PlyEncoding::BinaryBigEndian}) {
        WriteOptions options;
        options.format = MeshFormat::Ply;
        options.properties = true;
        options.ply_encoding = encoding;
        const Model back = ply(format_model(model, options, "b.ply").bytes);
        EXPECT_EQ(back.materials, model.materials);
        EXPECT_EQ(back.parts[0].materials, model.parts[0].materials);
        EXPECT_EQ(back.parts[0].properties, model.parts[0].properties);
        ASSERT_EQ(back.parts[0].mesh.corners.size(), 12U);
        for (std::size_t c = 0; c < 12; ++c)
            EXPECT_EQ(back.parts[0].mesh.points[back.parts[0].mesh.corners[c]],
                      model.parts[0].mesh.points[model.parts[0].mesh.corners[c]]);
    }
}

TEST(PlyProperties, CornersWithoutAColourHaveThatOfTheirMaterial) {
    Model model = sample();
    for (std::size_t i = 2; i < 6; ++i) model.parts[0].properties.values[i] = absent_number;
    WriteOptions options;
    options.format = MeshFormat::Ply;
    options.properties = true;
    const Model back = ply(format_model(model, options, "b.ply").bytes);
    EXPECT_EQ(ply_row(back, 0)[2], 10 / 255.0);
}

}  // namespace
