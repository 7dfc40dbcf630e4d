// SPDX-License-Identifier: Apache-2.0
//
// GLB: what is read, where it is put, and what is refused.
#include <trisect/brep/io/models/srgb.h>

#include "model_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

constexpr MeshFormat glb_format = MeshFormat::Glb;

/// Three floats for each corner of one triangle, and three indices of a byte.
std::string triangle_data() {
    std::string data;
    for (const float c : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 0.1F, 0.F}) append_float(data, c);
    return data + std::string("\0\1\2\0", 4);
}

/// A document with that triangle; `nodes` and `more` are JSON.
std::string triangle(const std::string& nodes = R"([{"mesh":0}])", const std::string& more = "",
                     const std::string& primitive = R"("indices":1)") {
    return glb_file(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
                        R"(,"meshes":[{"name":"t","primitives":[{"attributes":{"POSITION":0},)" +
                        primitive +
                        R"(}]}],"buffers":[{"byteLength":40}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
                     {"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}])" +
                        more + "}",
                    triangle_data());
}

TEST(Glb, FloatsAreExact) {
    const Model model = model_in(triangle(), glb_format);
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].name, "t");
    EXPECT_EQ(model.parts[0].mesh.points[2], (Point3d{0, static_cast<double>(0.1F), 0}));
    EXPECT_EQ(model.unit, "");
}

TEST(Glb, NodesPlaceMeshes) {
    const std::string nodes =
        R"([{"translation":[0,0,5],"children":[1,2]},
            {"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476]},
            {"mesh":0,"name":"b","matrix":[2,0,0,0, 0,-1,0,0, 0,0,1,0, 7,8,9,1]}])";
    ModelReport report;
    const Model model = model_in(triangle(nodes), glb_format, {}, &report);
    ASSERT_EQ(model.parts.size(), 2U);
    EXPECT_EQ(model.parts[0].mesh.points[1], (Point3d{0, 1, 5}));
    EXPECT_EQ(report, ModelReport());  // equal numbers make a quarter turn, whatever their length
    EXPECT_EQ(model.parts[1].name, "b");
    EXPECT_EQ(model.parts[1].mesh.points[1], (Point3d{9, 8, 14}));
    const auto face = model.parts[1].mesh.face(0);  // mirrored
    EXPECT_EQ(face[1], 2U);
}

TEST(Glb, WithoutIndices) {
    EXPECT_EQ(model_in(triangle(R"([{"mesh":0}])", "", R"("mode":4)"), glb_format)
                  .parts[0]
                  .mesh.face_count(),
              1U);
}

TEST(Glb, Materials) {
    const std::string bytes = triangle(
        R"([{"mesh":0}])",
        R"(,"materials":[{},{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[1,0,0.5,0.5]}}])",
        R"("indices":1,"material":1)");
    const Model model = model_in(bytes, glb_format);
    ASSERT_EQ(model.materials.size(), 2U);
    EXPECT_EQ(model.materials[1].name, "m");
    EXPECT_EQ(model.materials[1].color, (ModelColor{255, 0, 188, 128}));
    EXPECT_EQ(model.parts[0].materials, (std::vector<std::uint32_t>{1}));
}

TEST(Glb, LevelsOfColourComeBack) {
    for (unsigned level = 0; level < 256; ++level) {
        const auto c = static_cast<std::uint8_t>(level);
        EXPECT_EQ(detail::srgb_of_light(detail::light_of_srgb(c)), c);
    }
}

TEST(Glb, LinesAndPointsAreIgnored) {
    EXPECT_TRUE(model_in(triangle(R"([{"mesh":0}])", "", R"("mode":1)"), glb_format).parts.empty());
}

TEST(Glb, RefusedByName) {
    const auto refused = [](const std::string& bytes, const std::string& part) {
        expect_refused<UnsupportedError>(bytes, glb_format, "test: byte ", part);
    };
    const std::string plain = R"([{"mesh":0}])";
    refused(triangle(plain, "", R"("mode":5)"), "strips and fans");
    refused(triangle(plain, R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"), "draco");
    refused(triangle(plain, R"(,"extensionsRequired":["EXT_meshopt_compression"])"), "meshopt");
    refused(triangle(R"([{"mesh":0,"skin":0}])"), "skins");
    refused(triangle(R"([{"mesh":0,"weights":[0.5]}])"), "morphs");
    std::string bytes = triangle();
    const auto replaced = [&](const std::string& what, const std::string& by) {
        std::string out = bytes;
        out.replace(out.find(what), what.size(), by);
        return out;
    };
    refused(replaced(R"([{"byteLength":40}])", R"([{"uri":"elsewhe"}])"), "outside the file");
    refused(replaced(R"("bufferView":0)", R"("bufferless":0)"), "without data");
    refused(replaced(R"("bufferView":0,"componentType":5126)",
                     R"("bufferView":0,"componentType":5123)"),
            "KHR_mesh_quantization");
    refused(glb_file(R"({"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":
                 [{"attributes":{"POSITION":0}}]}],"accessors":[{"type":"VEC3","sparse":{}}]})"),
            "sparse");
    std::string old = bytes;
    old[4] = 1;
    refused(old, "version 1");
}

TEST(Glb, ErrorsHavePlaces) {
    const auto refused = [](const std::string& bytes, const std::string& place,
                            const std::string& part) {
        expect_refused<InputError>(bytes, glb_format, "test: byte " + place + ": ", part);
    };
    std::string bytes = triangle();
    refused("glTF", "4", "ends in its header");
    refused("glTX" + bytes.substr(4), "0", "glTF");
    refused(bytes + "    ", "8", "the header states");
    refused(glb_file("{\"a\":}"), "25", "malformed");
    refused(glb_file("[]"), "20", "no object");
    refused(glb_file(R"({"a":1e525})"), "20", "larger than a double");
    const auto spoiled = [&](const std::string& what, const std::string& by) {
        std::string out = bytes;
        out.replace(out.find(what), what.size(), by);
        return out;
    };
    refused(spoiled(R"("nodes":[0])", R"("nodes":[1])"), "20", "no nodes[1]");
    refused(spoiled(R"("byteLength":36})", R"("byteLength":35})"), "20", "beyond its bufferView");
    refused(spoiled(R"("byteOffset":36,"byteLength":4)", R"("byteOffset":38,"byteLength":4)"), "20",
            "beyond the binary chunk");
    refused(spoiled(R"("count":3,"type":"SCALAR")", R"("count":2,"type":"SCALAR")"), "20",
            "no triangles have");
    std::string far = bytes;
    far[far.size() - 2] = 3;
    refused(far, "20", "no vertex 3");
    std::string infinite = bytes;
    const std::size_t at = infinite.size() - 40;
    infinite.replace(at + 4, 4, std::string("\0\0\x80\x7f", 4));
    refused(infinite, std::to_string(at + 4), "not finite");
    refused(triangle(R"([{"children":[1]},{"children":[0]}])"), "20", "met twice");
    refused(triangle(R"([{"mesh":0,"scale":[0,1,1]}])"), "20", "flat");
    refused(triangle(R"([{"mesh":0,"rotation":[0,0,0,0]}])"), "20", "quaternion 0");
}

TEST(Glb, DepthIsBounded) {
    std::string nodes = "[";
    for (int i = 1; i < 1000; ++i) nodes += "{\"children\":[" + std::to_string(i) + "]},";
    expect_refused<LimitError>(triangle(nodes + "{\"mesh\":0}]"), glb_format, "test: byte ",
                               "nest deeper");
    expect_refused<LimitError>(glb_file(std::string(100000, '[')), glb_format, "test: byte ",
                               "nests deeper");
}

/// A tetrahedron whose faces have corners of their own, hung together by the extension.
TEST(Glb, ManifoldsAreReadAsTheyHangTogether) {
    std::string data;
    // A corner in one place twice, which are different vertices of the manifold.
    const float corners[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    for (const auto& p : corners)
        for (const float c : p) append_float(data, c);
    const auto word = [&](unsigned v) {
        data += std::string(1, static_cast<char>(v)) + std::string(3, '\0');
    };
    for (const unsigned v : {4U, 2U, 1U, 0U, 1U, 3U, 1U, 2U, 3U, 2U, 0U, 3U}) word(v);
    word(0);  // merge index 0
    word(0);  // with vertex 0
    const std::string json = R"({"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "materials":[{"name":"a"},{"name":"b"}],"buffers":[{"byteLength":116}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1},
                               {"attributes":{"POSITION":0},"indices":2,"material":0}],
        "extensions":{"EXT_mesh_manifold":{"manifoldPrimitive":
          {"attributes":{"POSITION":0},"indices":3},"mergeIndices":4,"mergeValues":5}}}],
      "bufferViews":[{"buffer":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":48},
                     {"buffer":0,"byteOffset":108,"byteLength":8}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},
        {"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"},
        {"bufferView":1,"byteOffset":12,"componentType":5125,"count":9,"type":"SCALAR"},
        {"bufferView":1,"componentType":5125,"count":12,"type":"SCALAR",
         "sparse":{"count":1,"indices":{"bufferView":2,"componentType":5125},
                   "values":{"bufferView":2,"byteOffset":4}}},
        {"bufferView":2,"componentType":5125,"count":1,"type":"SCALAR"},
        {"bufferView":2,"byteOffset":4,"componentType":5125,"count":1,"type":"SCALAR"}]})";
    const Model model = model_in(glb_file(json, data), glb_format);
    ASSERT_EQ(model.parts.size(), 1U);
    EXPECT_EQ(model.parts[0].mesh.points.size(), 5U);
    EXPECT_EQ(model.parts[0].mesh.corners,
              (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
    EXPECT_EQ(model.parts[0].materials, (std::vector<std::uint32_t>{1, 0, 0, 0}));
}

}  // namespace
