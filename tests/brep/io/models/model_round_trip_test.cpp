// SPDX-License-Identifier: Apache-2.0
//
// What is written as a model comes back: names, materials and coordinates, bit for bit in 3MF, as
// floats in GLB.
#include <trisect/brep/io/write_model.h>

#include <cmath>
#include <random>

#include "model_files.h"
#include "support/mesh_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

Model sample() {
    Model model;
    model.unit = "inch";
    model.materials = {{"a & <b>", ModelColor{1, 2, 3, 255}},
                       {"second", ModelColor{200, 100, 0, 64}}};
    PolygonMesh first = tetrahedron();
    first.points[3][2] = 0.1;
    model.parts.push_back({"part \"1\"", first, {1, 1, 0, no_material}});
    model.parts.push_back({"", tetrahedron(), {}});
    return model;
}

TEST(ModelRoundTrip, ThreeMf) {
    const Model model = sample();
    const FormattedMesh file = format_model(model, {.format = MeshFormat::ThreeMf});
    EXPECT_TRUE(file.report.lossless);
    EXPECT_EQ(model_in(file.bytes, MeshFormat::ThreeMf), model);
    EXPECT_EQ(file.bytes, format_model(model, {.format = MeshFormat::ThreeMf}).bytes);
}

TEST(ModelRoundTrip, AnyDoublesInThreeMf) {
    std::mt19937_64 random(11);
    PolygonMesh mesh;
    while (mesh.points.size() < 3000) {
        Point3d p;
        for (double& c : p) {
            do c = std::bit_cast<double>(random());
            while (!std::isfinite(c));
        }
        mesh.points.push_back(p);
    }
    for (std::uint32_t v = 0; v < 3000; v += 3) mesh.add_triangle(v, v + 1, v + 2);
    const FormattedMesh file = format_mesh(mesh, {.format = MeshFormat::ThreeMf});
    ReadOptions options;
    options.limits.literal_characters = 400;
    EXPECT_TRUE(same_bits(read(file.bytes, MeshFormat::ThreeMf, options), mesh));
}

TEST(ModelRoundTrip, Glb) {
    Model model = sample();
    const FormattedMesh file = format_model(model, {.format = MeshFormat::Glb});
    EXPECT_FALSE(file.report.lossless);
    EXPECT_EQ(file.report.rounded_vertices, 1U);
    EXPECT_EQ(file.report.largest_move, std::fabs(static_cast<double>(0.1F) - 0.1));
    EXPECT_NE(file.bytes.find("EXT_mesh_manifold"), std::string::npos);
    // Faces come back by their materials, coordinates as floats, without a unit.
    const Model back = model_in(file.bytes, MeshFormat::Glb);
    EXPECT_EQ(back.materials, model.materials);
    ASSERT_EQ(back.parts.size(), 2U);
    EXPECT_EQ(back.parts[0].name, model.parts[0].name);
    EXPECT_EQ(back.parts[0].materials, (std::vector<std::uint32_t>{0, 1, 1, no_material}));
    EXPECT_EQ(back.parts[0].mesh.points[3][2], static_cast<double>(0.1F));
    EXPECT_EQ(back.parts[1], model.parts[1]);
    const FormattedMesh again = format_model(back, {.format = MeshFormat::Glb});
    EXPECT_TRUE(again.report.lossless);
    EXPECT_EQ(model_in(again.bytes, MeshFormat::Glb), back);
}

TEST(ModelRoundTrip, EdgesOfFourFacesAreNoManifold) {
    PolygonMesh mesh = tetrahedron();
    mesh.corners.insert(mesh.corners.end(), mesh.corners.begin(), mesh.corners.end());
    for (int f = 0; f < 4; ++f) mesh.face_begin.push_back(mesh.face_begin.back() + 3);
    const FormattedMesh file = format_mesh(mesh, {.format = MeshFormat::Glb});
    EXPECT_EQ(file.bytes.find("EXT_mesh_manifold"), std::string::npos);
    EXPECT_EQ(read(file.bytes, MeshFormat::Glb).face_count(), 8U);
}

TEST(ModelRoundTrip, EmptySets) {
    for (const MeshFormat f : {MeshFormat::ThreeMf, MeshFormat::Glb})
        EXPECT_EQ(read(format_mesh(PolygonMesh{}, {.format = f}).bytes, f), PolygonMesh{});
}

TEST(ModelRoundTrip, OtherFormatsHaveOnePart) {
    const Model model = sample();
    const FormattedMesh file = format_model(model, {.format = MeshFormat::Off});
    EXPECT_EQ(read(file.bytes, MeshFormat::Off), merged(model));
    EXPECT_EQ(model_in(file.bytes, MeshFormat::Off), model_of(merged(model)));
}

TEST(ModelRoundTrip, WritersRefuse) {
    Model model = sample();
    model.parts[0].materials[0] = 2;
    EXPECT_THROW((void)format_model(model, {.format = MeshFormat::ThreeMf}), UsageError);
    model.parts[0].materials.pop_back();
    EXPECT_THROW((void)format_model(model, {.format = MeshFormat::Glb}), UsageError);
    PolygonMesh square;
    square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    square.add_face(std::vector<std::uint32_t>{0, 1, 2, 3});
    EXPECT_THROW((void)format_mesh(square, {.format = MeshFormat::ThreeMf}), UnsupportedError);
}

TEST(ModelRoundTrip, ContentShowsTheFormat) {
    EXPECT_EQ(detect_mesh_format(format_model(sample(), {.format = MeshFormat::ThreeMf}).bytes),
              MeshFormat::ThreeMf);
    EXPECT_EQ(detect_mesh_format(format_model(sample(), {.format = MeshFormat::Glb}).bytes),
              MeshFormat::Glb);
    EXPECT_EQ(detect_mesh_format("<?xml version=\"1.0\"?>\n<amf>"), MeshFormat::Amf);
}

}  // namespace
