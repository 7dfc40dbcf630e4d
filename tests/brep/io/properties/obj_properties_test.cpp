// SPDX-License-Identifier: Apache-2.0
//
// OBJ with materials and properties of corners: what is read, what is written, what is refused.
#include "support/mesh_files.h"

#include <trisect/brep/io/read_model.h>
#include <trisect/brep/io/write_model.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace trisect;

Model obj(const std::string& text, ModelReport* report = nullptr) {
    ReadOptions options;
    options.properties = true;
    return read_model(text, MeshFormat::Obj, "a.obj", options, report);
}

std::vector<double> obj_row(const CornerProperties& properties, std::size_t corner) {
    const auto row = properties.at(corner);
    return {row.begin(), row.end()};
}

void expect_obj_error(const std::string& text, const std::string& message) {
    try {
        (void)obj(text);
        ADD_FAILURE() << "read";
    } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()).substr(0, message.size()), message);
    }
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

/// A folder that is gone afterwards.
struct Folder {
    trisect::io_test::TemporaryFolder own;  // tests run at the same time
    std::filesystem::path path = own.path();
    Folder() { std::filesystem::create_directories(path / "below"); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
    }
    [[nodiscard]] std::string read(const std::string& name) const {
        std::ifstream in(path / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    [[nodiscard]] Model model(const std::string& name, ModelReport* report = nullptr) const {
        ReadOptions options;
        options.properties = true;
        return read_model(path / name, options, report);
    }
};

TEST(ObjProperties, CornersHaveWhatTheyName) {
    const Model model = obj(corners +
                            "vt 0.25 0.5\nvt 1 2 3\nvt 0.125\nvn 0 0 -1\n"
                            "f 1/1/1 3/2/1 2/-1/-1\nf 1 2//1 4/2\n");
    const CornerProperties& p = model.parts[0].properties;
    ASSERT_EQ(p.width, 5U);
    EXPECT_EQ(p.channels[0], (PropertyChannel{"uv", PropertyMeaning::TextureCoordinates, 2}));
    EXPECT_EQ(p.channels[1], (PropertyChannel{"normal", PropertyMeaning::Normal, 3}));
    EXPECT_EQ(obj_row(p, 0), (std::vector<double>{0.25, 0.5, 0, 0, -1}));
    EXPECT_EQ(obj_row(p, 2), (std::vector<double>{0.125, 0, 0, 0, -1}));
    EXPECT_TRUE(std::isnan(obj_row(p, 3)[0]));  // absent, not zero
    EXPECT_TRUE(std::isnan(obj_row(p, 4)[1]));
    EXPECT_EQ(obj_row(p, 4)[4], -1);
    EXPECT_EQ(obj_row(p, 5)[0], 1);
    EXPECT_TRUE(std::isnan(obj_row(p, 5)[2]));
    EXPECT_TRUE(model.parts[0].materials.empty());
}

TEST(ObjProperties, ColoursOfVertices) {
    const Model model = obj("v 0 0 0 1 0.5 0.25\nv 1 0 0 1\nv 0 1 0 1 0 0.5 1\nf 1 2 3\n");
    const CornerProperties& p = model.parts[0].properties;
    ASSERT_EQ(p.width, 4U);
    EXPECT_EQ(obj_row(p, 0), (std::vector<double>{1, 0.5, 0.25, 1}));
    EXPECT_TRUE(std::isnan(obj_row(p, 1)[0]));
    EXPECT_EQ(obj_row(p, 2), (std::vector<double>{0, 0.5, 1, 1}));
}

TEST(ObjProperties, WithoutAnyThereIsNone) {
    const Model model = obj(corners + "f 1 2 3\n");
    EXPECT_EQ(model.parts[0].properties, CornerProperties());
    EXPECT_TRUE(model.materials.empty());
}

TEST(ObjProperties, AreNotReadUnlessAsked) {
    const Model model =
        read_model(corners + "vt 1 1\nusemtl m\nf 1/1 2/1 3/1\n", MeshFormat::Obj, "a.obj", {});
    EXPECT_EQ(model.parts[0].properties.width, 0U);
    EXPECT_TRUE(model.materials.empty());
}

TEST(ObjProperties, MaterialsAndPicturesOfLibraries) {
    const Folder folder;
    folder.write("a b.mtl",
                 "newmtl red one\nKd 1 0 0\nd 0.5\nTr 1\nillum 2\nnewmtl pic\nKd 1 1 1\n"
                 "map_Kd -clamp on below/wood grain.png\n");
    folder.write("below/wood grain.png", "\x89PNG picture");
    folder.write("a.obj", "mtllib a b.mtl\n" + corners +
                              "f 1 3 2\nusemtl red one\nf 1 2 4\nusemtl pic\nf 2 3 4\nusemtl gone\n"
                              "f 3 1 4\n");
    const Model model = folder.model("a.obj");
    ASSERT_EQ(model.materials.size(), 3U);
    EXPECT_EQ(model.materials[0],
              (ModelMaterial{"red one", ModelColor{255, 0, 0, 128}, no_texture}));
    EXPECT_EQ(model.materials[1].texture, 0U);
    EXPECT_EQ(model.materials[2], (ModelMaterial{"gone", std::nullopt, no_texture}));
    EXPECT_EQ(model.parts[0].materials, (std::vector<std::uint32_t>{no_material, 0, 1, 2}));
    ASSERT_EQ(model.textures.size(), 1U);
    EXPECT_EQ(model.textures[0].bytes, "\x89PNG picture");
    EXPECT_EQ(model.textures[0].media_type, "image/png");
    EXPECT_EQ(model.textures[0].wrap[0], TextureWrap::Clamp);
}

TEST(ObjProperties, FilesOutsideTheFolderAreNotRead) {
    const Folder folder;
    folder.write("secret.mtl", "newmtl m\nKd 1 0 0\n");
    for (const std::string& name :
         {std::string("../secret.mtl"), (folder.path / "secret.mtl").string(),
          std::string("no.mtl"), std::string("below")}) {
        folder.write("below/a.obj", "mtllib " + name + "\n" + corners + "usemtl m\nf 1 2 3\n");
        ModelReport report;
        const Model model = folder.model("below/a.obj", &report);
        EXPECT_EQ(model.materials[0].color, std::nullopt) << name;
        EXPECT_EQ(report.remarks.size(), 1U) << name;
    }
}

TEST(ObjProperties, RefusedWithTheirPlaces) {
    expect_obj_error(corners + "vt 0 0\nf 1/1 2/2 3/1\n",
                     "a.obj:6:9: index 2 of 'vt'; the file has 1");
    expect_obj_error(corners + "vn 0 0 1\nf 1//1 2//-2 3//1\n",
                     "a.obj:6:11: index -2 of 'vn'; there are 1 so far");
    expect_obj_error(corners + "f 1/0 2/0 3/0\n", "a.obj:5:5: index 0 of 'vt'");
    expect_obj_error(corners + "f 1/99999999999 2 3\n", "a.obj:5:5: index 99999999999 of 'vt'");
    expect_obj_error(corners + "vt 0 nan\nf 1 2 3\n",
                     "a.obj:5:6: 'nan', read as a texture coordinate");
    expect_obj_error(corners + "vn 0 1\nf 1 2 3\n", "a.obj:5:7: the line ends where a normal");
}

TEST(ObjProperties, LimitOfNumbers) {
    ReadOptions options;
    options.properties = true;
    options.limits.property_numbers = 5;
    const std::string text = corners + "vt 0 0\nf 1/1 2/1 3/1\n";
    EXPECT_THROW((void)read_model(text, MeshFormat::Obj, "a.obj", options), LimitError);
    options.limits.property_numbers = 6;
    EXPECT_NO_THROW((void)read_model(text, MeshFormat::Obj, "a.obj", options));
}

TEST(ObjProperties, ComesBackFromItsFile) {
    const Folder folder;
    folder.write("wood.png", "\x89PNG wood");
    folder.write("a.mtl", "newmtl m\nKd 0.2 0.4 0.6\nmap_Kd wood.png\nnewmtl n\nKd 1 0 0\n");
    folder.write("a.obj",
                 "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 0.1\n"
                 "vt 0.1 0.2\nvt 0.3 0.7\nvn 0 0 1\nusemtl m\nf 1/1/1 3/2/1 2/1/1\nf 1/2 2/1 4/1\n"
                 "usemtl n\nf 2 3 4\nf 3 1 4\n");
    const Model model = folder.model("a.obj");
    WriteOptions options;
    options.properties = true;
    const WriteReport written = write_model(folder.path / "b.obj", model, options);
    EXPECT_TRUE(written.left_out.empty());
    EXPECT_FALSE(std::filesystem::exists(folder.path / "b_1.png"));  // it is there already
    EXPECT_EQ(folder.model("b.obj"), model);
    write_model(folder.path / "below" / "c.obj", model, options);
    EXPECT_EQ(folder.read("below/c_1.png"), "\x89PNG wood");
    Model other = folder.model("below/c.obj");
    EXPECT_EQ(other.textures[0].file, "c_1.png");
    other.textures[0].file = "wood.png";
    EXPECT_EQ(other, model);
}

TEST(ObjProperties, VerticesWithTwoColoursAreTwo) {
    Model model =
        obj("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 1 1 0 0\n"
            "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    CornerProperties& p = model.parts[0].properties;
    for (std::size_t c = 3; c < 6; ++c) p.values[4 * c + 2] = 1;  // one face is magenta
    WriteOptions options;
    options.format = MeshFormat::Obj;
    options.properties = true;
    const Model back = obj(format_model(model, options, "b.obj").bytes);
    EXPECT_EQ(back.parts[0].mesh.points.size(), 7U);
    EXPECT_EQ(back.parts[0].properties, p);
    for (std::size_t c = 0; c < 12; ++c)
        EXPECT_EQ(back.parts[0].mesh.points[back.parts[0].mesh.corners[c]],
                  model.parts[0].mesh.points[model.parts[0].mesh.corners[c]]);
}

TEST(ObjProperties, NamesOfMaterialsBecomeDistinctLines) {
    Model model = obj(corners + "f 1 2 3\nf 1 2 4\nf 1 3 4\n");
    model.materials = {{"a", std::nullopt}, {"a", std::nullopt}, {"#x\n", std::nullopt}};
    model.parts[0].materials = {0, 1, 2};
    WriteOptions options;
    options.format = MeshFormat::Obj;
    options.properties = true;
    const FormattedMesh out = format_model(model, options, "b.obj");
    const Model back = obj(out.bytes);
    ASSERT_EQ(back.materials.size(), 3U);
    EXPECT_EQ(back.materials[1].name, "a_2");
    EXPECT_EQ(back.materials[2].name, "_x_");
    ASSERT_EQ(out.files.size(), 1U);
    EXPECT_EQ(out.files[0].name, "b.mtl");
}

TEST(ObjProperties, OtherFormatsRefuse) {
    const Model model = obj(corners + "f 1 2 3\n");
    WriteOptions options;
    options.properties = true;
    for (const MeshFormat format : {MeshFormat::Off, MeshFormat::StlBinary, MeshFormat::Step}) {
        options.format = format;
        EXPECT_THROW((void)format_model(model, options, "b"), UnsupportedError);
    }
}

}  // namespace
