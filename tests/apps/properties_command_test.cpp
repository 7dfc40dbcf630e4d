// SPDX-License-Identifier: Apache-2.0
//
// --properties of booleans, split, mend and convert: what goes through files, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <trisect/brep/io/read_model.h>

#include "process.h"
#include "scratch.h"

namespace {

using trisect::CornerProperties;
using trisect::Model;
using trisect::PropertyMeaning;
using trisect::test::Finished;
using trisect::test::trisect;

class PropertiesCommand : public trisect::test::Scratch {
protected:
    /// A cube of side 2 at the origin whose uv are x + 10 and y + z, with a picture.
    std::string textured(const std::string& name) {
        std::ofstream(path(name + ".png"), std::ios::binary) << "\x89PNG";
        std::ofstream(path(name + ".mtl")) << "newmtl wood\nKd 1 1 1\nmap_Kd " << name << ".png\n";
        std::ofstream out(path(name + ".obj"));
        out << "mtllib " << name << ".mtl\n";
        for (int i = 0; i < 8; ++i)
            out << "v " << (i & 1) * 2 << ' ' << (i >> 1 & 1) * 2 << ' ' << (i >> 2) * 2 << '\n';
        for (int i = 0; i < 8; ++i)
            out << "vt " << (i & 1) * 2 + 10 << ' ' << (i >> 1 & 1) * 2 + (i >> 2) * 2 << '\n';
        out << "usemtl wood\n";
        for (const char* face :
             {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) {
            out << 'f';
            for (const char* c = face; *c != '\0'; c += 2) {
                out << ' ' << *c << '/' << *c;
                if (c[1] == '\0') break;
            }
            out << '\n';
        }
        out.close();
        return path(name + ".obj");
    }

    [[nodiscard]] Model model(const std::string& name) const {
        trisect::ReadOptions options;
        options.properties = true;
        return trisect::read_model(path(name), options);
    }

    /// Faces with the picture have x + 10 and y + z at their corners; others have no uv.
    static void expect_linear(const Model& model, std::size_t least) {
        std::size_t with = 0;
        for (const trisect::ModelPart& part : model.parts) {
            const CornerProperties& p = part.properties;
            const auto uv = p.column_of(PropertyMeaning::TextureCoordinates);
            ASSERT_TRUE(uv.has_value());
            for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
                const std::uint32_t material = part.materials[f];
                const bool is_wood = material != trisect::no_material &&
                                     model.materials[material].texture != trisect::no_texture;
                with += is_wood ? 1 : 0;
                for (std::size_t c = part.mesh.face_begin[f]; c < part.mesh.face_begin[f + 1];
                     ++c) {
                    const auto& point = part.mesh.points[part.mesh.corners[c]];
                    const auto row = p.at(c);
                    EXPECT_EQ(std::isnan(row[*uv]), !is_wood);
                    if (!is_wood) continue;
                    EXPECT_EQ(row[*uv], point[0] + 10);
                    EXPECT_EQ(row[*uv + 1], point[1] + point[2]);
                }
            }
        }
        EXPECT_GE(with, least);
    }

    std::string a_ = textured("a");
    std::string b_ = box("b.obj", {1, 1, 1}, {3, 3, 3});
};

TEST_F(PropertiesCommand, GoThroughBooleansIntoEachFormat) {
    for (const std::string name : {"c.obj", "c.ply", "c.glb", "c.3mf"}) {
        const Finished result =
            trisect({"difference", a_, b_, "-o", path(name), "--properties", "--json"});
        ASSERT_EQ(result.code, 0) << result.err;
        const auto properties = result.json()["output"]["properties"];
        EXPECT_EQ(properties["channels"], std::vector<std::string>{"uv"}) << name;
        EXPECT_EQ(properties["textures"], 1) << name;
        const Model made = model(name);
        expect_linear(made, 15);
        EXPECT_EQ(trisect({"info", path(name), "--json"}).json()["volume"], 7) << name;
    }
    EXPECT_EQ(model("c.obj").textures.at(0).file, "a.png");  // beside it already
}

TEST_F(PropertiesCommand, ResultsAreOperandsAgain) {
    ASSERT_EQ(trisect({"difference", a_, b_, "-o", path("c.glb"), "--properties"}).code, 0);
    const std::string d = box("d.obj", {-1, -1, -1}, {1, 1, 1});
    const Finished result =
        trisect({"union", path("c.glb"), d, "-o", path("e.obj"), "--properties"});
    ASSERT_EQ(result.code, 0) << result.err;
    expect_linear(model("e.obj"), 15);
    EXPECT_EQ(read(path("e_1.png")), "\x89PNG");  // that was in the file
}

TEST_F(PropertiesCommand, ConvertKeepsThem) {
    for (const std::string name : {"c.ply", "c.glb", "c.3mf", "c.obj"}) {
        const Finished result = trisect({"convert", a_, "-o", path(name), "--properties"});
        ASSERT_EQ(result.code, 0) << result.err;
        expect_linear(model(name), 6);
    }
}

TEST_F(PropertiesCommand, SplitsHaveThemInEachPart) {
    for (const std::string type : {".obj", ".ply", ".glb", ".3mf"}) {
        const Finished result = trisect({"split", a_, "--plane", "x=0.5", "-o", path("l" + type),
                                         path("r" + type), "--properties", "--json"});
        ASSERT_EQ(result.code, 0) << result.err;
        for (const char* part : {"l", "r"}) expect_linear(model(part + type), 9);
        EXPECT_EQ(trisect({"info", path("l" + type), "--json"}).json()["volume"], 2) << type;
    }
    ASSERT_EQ(trisect({"split", a_, b_, "-o", path("i.obj"), path("o.obj"), "--properties"}).code,
              0);
    expect_linear(model("i.obj"), 6);
    expect_linear(model("o.obj"), 15);
}

TEST_F(PropertiesCommand, PicturesOfPartsDoNotReplaceEachOther) {
    const std::string other = textured("d");
    std::ofstream(path("d.png"), std::ios::binary) << "\x89PNG, another";
    ASSERT_EQ(
        trisect({"convert", other, "--translate", "5,0,0", "-o", path("e.obj"), "--properties"})
            .code,
        0);
    ASSERT_EQ(trisect({"union", a_, path("e.obj"), "-o", path("u.glb"), "--properties"}).code, 0);
    const auto split = [&](const char* first, const char* second) {
        return trisect({"split", path("u.glb"), "--plane", "x=3", "-o", path(first), path(second),
                        "--properties"});
    };
    const Finished refused = split("p.obj", "p.ply");
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("p_1.png"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::ifstream(path("p.obj")).good());
    ASSERT_EQ(split("p.obj", "q.ply").code, 0);
    EXPECT_EQ(read(path("p_1.png")), "\x89PNG");
    EXPECT_EQ(read(path("q_1.png")), "\x89PNG, another");
}

/// Corners of the only part: place, normal, and the material of the face.
struct ReadCorner {
    trisect::Point3d place{};
    trisect::Point3d normal{};
    std::string material;
};
std::vector<ReadCorner> corners_of(const Model& model) {
    std::vector<ReadCorner> out;
    const trisect::ModelPart& part = model.parts.at(0);
    const auto normal = part.properties.column_of(PropertyMeaning::Normal);
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f)
        for (std::size_t c = part.mesh.face_begin[f]; c < part.mesh.face_begin[f + 1]; ++c) {
            ReadCorner corner;
            corner.place = part.mesh.points[part.mesh.corners[c]];
            for (std::size_t k = 0; normal && k < 3; ++k)
                corner.normal[k] = part.properties.at(c)[*normal + k];
            const std::uint32_t material = part.materials.at(f);
            if (material != trisect::no_material) corner.material = model.materials[material].name;
            out.push_back(corner);
        }
    return out;
}

/// A corner of a cube in four triangles with normals: one is turned over, and one corner is apart.
constexpr const char* broken_corner =
    "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 1.001\n"
    "vn 0 0 -1\nvn 0 -1 0\nvn 1 1 1\nvn -1 0 0\n"
    "usemtl red\nf 1//1 2//1 3//1\nusemtl blue\nf 1//2 2//2 4//2\nf 2//3 3//3 5//3\n"
    "f 3//4 1//4 4//4\n";

TEST_F(PropertiesCommand, MendedFacesHaveThem) {
    std::ofstream(path("t.mtl")) << "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
    const std::string broken = write("t.obj", broken_corner);
    const Finished result =
        trisect({"mend", broken, "--all", "0.01", "-o", path("m.obj"), "--properties"});
    ASSERT_EQ(result.code, 0) << result.err;
    const std::vector<ReadCorner> all = corners_of(model("m.obj"));
    ASSERT_EQ(all.size(), 12U);
    for (const ReadCorner& corner : all) {
        const bool is_bottom = corner.normal == trisect::Point3d{0, 0, -1};
        EXPECT_EQ(corner.material, is_bottom ? "red" : "blue");
        EXPECT_TRUE(!is_bottom || corner.place[2] == 0);
        EXPECT_TRUE(is_bottom || corner.normal == (trisect::Point3d{0, -1, 0}) ||
                    corner.normal == (trisect::Point3d{1, 1, 1}) ||
                    corner.normal == (trisect::Point3d{-1, 0, 0}));
    }
}

TEST_F(PropertiesCommand, AnInwardNormalOfATurnedFaceIsTurned) {
    std::string text = broken_corner;
    text.replace(text.find("vn 0 0 -1"), 9, "vn 0 0 1 ");
    std::ofstream(path("t.mtl")) << "newmtl red\nnewmtl blue\n";
    const std::string broken = write("t.obj", text);
    ASSERT_EQ(trisect({"mend", broken, "--orient", "-o", path("m.obj"), "--properties"}).code, 1);
    std::size_t downward = 0;
    for (const ReadCorner& corner : corners_of(model("m.obj")))
        downward += corner.normal == trisect::Point3d{0, 0, -1} ? 1 : 0;
    EXPECT_EQ(downward, 3U);
}

TEST_F(PropertiesCommand, AddedFacesHaveNone) {
    const std::string open =
        write("t.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0.5 0.25\nf 1/1 2/1 4/1\n"
              "f 2/1 3/1 4/1\nf 3/1 1/1 4/1\n");
    ASSERT_EQ(trisect({"mend", open, "--fill", "-o", path("m.ply"), "--properties"}).code, 0);
    const trisect::ModelPart part = model("m.ply").parts.at(0);
    const auto uv = part.properties.column_of(PropertyMeaning::TextureCoordinates);
    ASSERT_TRUE(uv && part.mesh.corners.size() == 12);
    std::size_t absent = 0;
    for (std::size_t c = 0; c < 12; ++c) absent += std::isnan(part.properties.at(c)[*uv]) ? 1 : 0;
    EXPECT_EQ(absent, 3U);
}

/// A mirror, and a scale that differs by axis: normals stay across their faces, and numbers stay at
/// their corners.
TEST_F(PropertiesCommand, TransformsTurnNormals) {
    const std::string input =
        write("t.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -1\nvn 0 -1 0\nvn 1 1 1\n"
              "vn -1 0 0\nf 1//1 3//1 2//1\nf 1//2 2//2 4//2\nf 2//3 3//3 4//3\n"
              "f 3//4 1//4 4//4\n");
    const std::string matrix = write("m.txt", "-2 0 0 5\n0 1 0 0\n0 0 4 0\n");
    ASSERT_EQ(
        trisect({"convert", input, "--matrix", matrix, "-o", path("c.obj"), "--properties"}).code,
        0);
    const Model made = model("c.obj");
    const trisect::ModelPart& part = made.parts.at(0);
    const auto normal = part.properties.column_of(PropertyMeaning::Normal);
    ASSERT_TRUE(normal.has_value());
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
        const auto corner = [&](std::size_t i) { return part.mesh.points[part.mesh.face(f)[i]]; };
        const auto row = part.properties.at(part.mesh.face_begin[f]);
        double lengths = 0;
        for (std::size_t i = 1; i < 3; ++i) {
            double across = 0;
            for (std::size_t k = 0; k < 3; ++k)
                across += row[*normal + k] * (corner(i)[k] - corner(0)[k]);
            EXPECT_NEAR(across, 0, 1e-15);
        }
        for (std::size_t k = 0; k < 3; ++k) lengths += row[*normal + k] * row[*normal + k];
        EXPECT_NEAR(lengths, f == 2 ? 3 : 1, 1e-14);
        // Outward, where the image of the inside is.
        const trisect::Point3d inside{4.75, 0.125, 0.5};
        double outward = 0;
        for (std::size_t k = 0; k < 3; ++k)
            outward += row[*normal + k] * (corner(0)[k] - inside[k]);
        EXPECT_GT(outward, 0);
    }
    ASSERT_EQ(trisect({"convert", a_, "--scale", "-1", "-o", path("n.obj"), "--properties"}).code,
              0);
    ASSERT_EQ(
        trisect({"convert", path("n.obj"), "--scale", "-1", "-o", path("o.obj"), "--properties"})
            .code,
        0);
    expect_linear(model("o.obj"), 6);
}

TEST_F(PropertiesCommand, WithoutTheOptionNothingIsKept) {
    ASSERT_EQ(trisect({"difference", a_, b_, "-o", path("c.obj")}).code, 0);
    EXPECT_EQ(read(path("c.obj")).find("vt"), std::string::npos);
    EXPECT_FALSE(std::ifstream(path("c.mtl")).good());
}

TEST_F(PropertiesCommand, Refused) {
    const auto code = [&](const std::vector<std::string>& words) { return trisect(words).code; };
    for (const char* name : {"c.stl", "c.off", "c.amf", "c.step"}) {
        const Finished result = trisect({"union", a_, b_, "-o", path(name), "--properties"});
        EXPECT_EQ(result.code, 7) << name;
        EXPECT_NE(result.err.find("holds no properties"), std::string::npos) << result.err;
        EXPECT_FALSE(std::ifstream(path(name)).good());
    }
    EXPECT_EQ(code({"union", a_, b_, "-o", path("c.obj"), "--properties", "--repair"}), 2);
    EXPECT_EQ(code({"union", a_, b_, "-o", path("c.obj"), "--properties", "--faces"}), 2);
    EXPECT_EQ(code({"union", a_, b_, "-o", path("c.trisect"), "--properties"}), 2);
    EXPECT_EQ(code({"union", a_, b_, "-o", path("c.ply"), "--properties", "--slabs", "2"}), 2);
    EXPECT_EQ(code({"union", a_, b_, "-o", "-", "--format", "obj", "--properties"}), 2);
    EXPECT_EQ(code({"mend", a_, "--orient", "-o", path("c.off"), "--properties"}), 7);
    const auto split = [&](const char* first, const char* second) {
        return code(
            {"split", a_, "--plane", "z=1", "-o", path(first), path(second), "--properties"});
    };
    EXPECT_EQ(split("c.obj", "d.stl"), 7);
    EXPECT_EQ(split("c.obj", "d.trisect"), 2);
    EXPECT_FALSE(std::ifstream(path("c.obj")).good());
}

}  // namespace
