// SPDX-License-Identifier: Apache-2.0
//
// Files made to break the readers of models: every truncation and many mutations of small files.
#include <trisect/brep/io/write_model.h>

#include <random>

#include "model_files.h"
#include "support/mesh_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

struct Sample {
    MeshFormat format;
    std::string bytes;
};

std::vector<Sample> samples() {
    Model model = model_of(tetrahedron());
    model.materials = {{"m", ModelColor{1, 2, 3, 4}}, {"n", {}}};
    model.parts[0].materials = {0, 1, 0, 1};
    const std::string amf_text =
        "<amf><object id=\"1\"><mesh><vertices><vertex><coordinates><x>0</x><y>0</y><z>0</z>"
        "</coordinates></vertex></vertices><volume materialid=\"2\"><triangle><v1>0</v1><v2>0</v2>"
        "<v3>0</v3></triangle></volume></mesh></object><constellation id=\"3\"><instance "
        "objectid=\"1\"><rx>3</rx></instance></constellation></amf>";
    const std::string dxf_text =
        "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n0\nPOLYLINE\n70\n64\n0\nVERTEX\n70\n192\n10\n1\n0\n"
        "VERTEX\n70\n192\n10\n2\n0\nVERTEX\n70\n192\n20\n2\n0\nVERTEX\n70\n128\n71\n1\n72\n2\n73\n3"
        "\n"
        "0\nSEQEND\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nb\n50\n30\n"
        "0\n3DFACE\n10\n0\n20\n0\n11\n1\n21\n0\n12\n0\n22\n1\n0\nENDSEC\n0\nEOF";
    std::string step_text =
        format_model(model_of(tetrahedron()), {.format = MeshFormat::Step}).bytes;
    step_text.pop_back();  // the last line end may be missing
    return {{MeshFormat::Glb, format_model(model, {.format = MeshFormat::Glb}).bytes},
            {MeshFormat::ThreeMf, format_model(model, {.format = MeshFormat::ThreeMf}).bytes},
            {MeshFormat::Amf, amf_text},
            {MeshFormat::Step, step_text},
            {MeshFormat::Dxf, dxf_text}};
}

/// Whether it was a model; anything but a model or an error of ours is a failure.
bool survives(std::string_view bytes, MeshFormat format) {
    const std::vector<char> exact(bytes.begin(), bytes.end());
    ReadOptions options;
    options.limits.vertices = 1000;
    try {
        const Model model =
            read_model(std::string_view(exact.data(), exact.size()), format, "test", options);
        for (const ModelPart& part : model.parts) {
            for (const std::uint32_t c : part.mesh.corners) EXPECT_LT(c, part.mesh.points.size());
            EXPECT_TRUE(part.materials.empty() || part.materials.size() == part.mesh.face_count());
        }
        return true;
    } catch (const Error& e) {
        EXPECT_NE(e.code(), ErrorCode::Internal) << e.what();
    }
    return false;
}

TEST(HostileModels, EveryTruncation) {
    for (const Sample& s : samples()) {
        for (std::size_t n = 0; n < s.bytes.size(); ++n)
            EXPECT_FALSE(survives(std::string_view(s.bytes).substr(0, n), s.format)) << n;
        EXPECT_TRUE(survives(s.bytes, s.format));
    }
}

TEST(HostileModels, Mutations) {
    std::mt19937_64 random(5);
    for (const Sample& s : samples()) {
        for (int i = 0; i < 3000; ++i) {
            std::string bytes = s.bytes;
            for (std::uint64_t n = 1 + random() % 3; n > 0; --n)
                bytes[random() % bytes.size()] = static_cast<char>(random());
            (void)survives(bytes, s.format);
        }
    }
}

}  // namespace
