// SPDX-License-Identifier: Apache-2.0
//
// --properties of booleans and of convert: what goes through files, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
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
                const auto& material = model.materials[part.materials[f]];
                const bool is_wood = material.texture != trisect::no_texture;
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
    EXPECT_EQ(code({"convert", a_, "-o", path("c.obj"), "--properties", "--scale", "2"}), 2);
}

}  // namespace
