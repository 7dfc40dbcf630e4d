// SPDX-License-Identifier: Apache-2.0
//
// STEP and AMF as they are written, and read again.
#include <trisect/brep/io/write_model.h>

#include <algorithm>

#include "model_files.h"
#include "support/mesh_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

constexpr MeshFormat written_format = MeshFormat::Step;

std::string step_of(const Model& model) {
    return format_model(model, {.format = written_format}).bytes;
}

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++n;
    return n;
}

/// A box in quadrilaterals, outward or inward.
PolygonMesh box(const Point3d& low, const Point3d& high, bool outward = true) {
    PolygonMesh mesh;
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.points.push_back({(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1],
                               (i & 4U) != 0 ? high[2] : low[2]});
    const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (std::vector<std::uint32_t> f : faces) {
        if (!outward) std::swap(f[1], f[3]);
        mesh.add_face(f);
    }
    return mesh;
}

/// A square frame: its top and bottom have a hole, joined by a bridge.
PolygonMesh frame() {
    PolygonMesh mesh;
    for (const double z : {0.0, 1.0})
        for (const double r : {3.0, 1.0})
            for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
                mesh.points.push_back({r * x, r * y, z});
    const auto add = [&](std::vector<std::uint32_t> f) { mesh.add_face(f); };
    add({8, 9, 10, 11, 8, 12, 15, 14, 13, 12});
    add({0, 3, 2, 1, 0, 4, 5, 6, 7, 4});
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t j = (i + 1) % 4;
        add({i, j, 8 + j, 8 + i});
        add({4 + j, 4 + i, 12 + i, 12 + j});
    }
    return mesh;
}

TEST(StepWrite, Box) {
    Model model = model_of(box({0, 0, 0}, {0.1, 2, 1e-7}));
    model.unit = "inch";
    model.parts[0].name = "it's a \xC3\xA9 box";
    const std::string text = step_of(model);
    EXPECT_EQ(count_of(text, "ADVANCED_FACE("), 6U);
    EXPECT_EQ(count_of(text, "EDGE_CURVE("), 12U);
    EXPECT_EQ(count_of(text, "VERTEX_POINT("), 8U);
    EXPECT_EQ(count_of(text, "MANIFOLD_SOLID_BREP("), 1U);
    const Model back = model_in(text, written_format);
    EXPECT_EQ(back.unit, "inch");
    ASSERT_EQ(back.parts.size(), 1U);
    EXPECT_EQ(back.parts[0].name, model.parts[0].name);
    EXPECT_EQ(back.parts[0].mesh.face_count(), 6U);
    EXPECT_EQ(step_of(model_in(step_of(back), written_format)), step_of(back));
    EXPECT_EQ(text, step_of(model));
}

TEST(StepWrite, EveryCoordinateComesBack) {
    const std::vector<double> numbers{0.1,   -0.0,     5e-324, 1.7976931348623157e308,
                                      -1e22, 123456.7, 1e-7,   3};
    for (std::size_t i = 0; i + 4 < numbers.size(); ++i) {
        PolygonMesh mesh = tetrahedron();
        for (std::size_t v = 0; v < 4; ++v) mesh.points[v][v % 3] = numbers[i + v];
        Model changed = model_of(mesh);
        std::string text;
        try {
            text = step_of(changed);
        } catch (const UnsupportedError&) {
            continue;  // no area left
        }
        const PolygonMesh back = model_in(text, written_format).parts.at(0).mesh;
        for (const Point3d& p : mesh.points)
            EXPECT_NE(std::find(back.points.begin(), back.points.end(), p), back.points.end());
    }
}

TEST(StepWrite, Holes) {
    const std::string text = step_of(model_of(frame()));
    EXPECT_EQ(count_of(text, "ADVANCED_FACE("), 10U);
    EXPECT_EQ(count_of(text, "FACE_BOUND("), 2U);
    EXPECT_EQ(count_of(text, "FACE_OUTER_BOUND("), 10U);
    EXPECT_EQ(count_of(text, "EDGE_CURVE("), 24U);
    const Model back = model_in(text, written_format);
    EXPECT_EQ(back.parts[0].mesh.face_count(), 10U);
    EXPECT_EQ(count_of(step_of(back), "FACE_BOUND("), 2U);
}

TEST(StepWrite, Voids) {
    PolygonMesh mesh = box({0, 0, 0}, {9, 9, 9});
    append(mesh, box({1, 1, 1}, {8, 8, 8}, false));
    append(mesh, box({2, 2, 2}, {7, 7, 7}));
    append(mesh, box({3, 3, 3}, {4, 4, 4}, false));
    append(mesh, box({5, 5, 5}, {6, 6, 6}, false));
    append(mesh, box({20, 0, 0}, {21, 1, 1}));
    const std::string text = step_of(model_of(mesh));
    EXPECT_EQ(count_of(text, "BREP_WITH_VOIDS("), 2U);
    EXPECT_EQ(count_of(text, "MANIFOLD_SOLID_BREP("), 1U);
    EXPECT_EQ(count_of(text, "ORIENTED_CLOSED_SHELL("), 3U);
    const Model back = model_in(text, written_format);
    ASSERT_EQ(back.parts.size(), 3U);
    EXPECT_EQ(back.parts[0].mesh.face_count(), 12U);
    EXPECT_EQ(back.parts[1].mesh.face_count(), 18U);
    EXPECT_EQ(step_of(model_in(step_of(back), written_format)), step_of(back));
}

TEST(StepWrite, OpenMeshesAndSoups) {
    PolygonMesh open = box({0, 0, 0}, {1, 1, 1});
    open.face_begin.pop_back();
    open.corners.resize(20);
    EXPECT_EQ(count_of(step_of(model_of(open)), "SHELL_BASED_SURFACE_MODEL("), 1U);
    // Each face with points of its own.
    PolygonMesh soup;
    const PolygonMesh whole = box({0, 0, 0}, {1, 1, 1});
    for (std::size_t f = 0; f < whole.face_count(); ++f) {
        std::vector<std::uint32_t> face;
        for (const std::uint32_t c : whole.face(f)) {
            face.push_back(static_cast<std::uint32_t>(soup.points.size()));
            soup.points.push_back(whole.points[c]);
        }
        soup.add_face(face);
    }
    EXPECT_EQ(count_of(step_of(model_of(soup)), "MANIFOLD_SOLID_BREP("), 1U);
}

TEST(StepWrite, Refused) {
    PolygonMesh mesh = box({0, 0, 0}, {1, 1, 1});
    mesh.points[7][2] = 1.01;
    EXPECT_THROW((void)step_of(model_of(mesh)), UnsupportedError);
    const auto uneven = faces_off_planes(model_of(mesh));
    // The top; the sides keep their planes.
    EXPECT_EQ(uneven, (std::vector<std::vector<std::uint32_t>>{{1}}));
    mesh = tetrahedron();
    mesh.points[1] = mesh.points[0];
    EXPECT_THROW((void)step_of(model_of(mesh)), UnsupportedError);
    mesh.points[1] = {0, 0.5, 0};
    mesh.points[2] = {0, 1, 0};
    EXPECT_THROW((void)step_of(model_of(mesh)), UnsupportedError);
    Model model = model_of(tetrahedron());
    model.unit = "furlong";
    EXPECT_THROW((void)step_of(model), UnsupportedError);
    EXPECT_THROW((void)format_mesh(tetrahedron(), {.format = MeshFormat::Dxf}), UnsupportedError);
}

TEST(AmfWrite, RoundTrip) {
    Model model = model_of(tetrahedron());
    model.unit = "foot";
    model.parts[0].name = "a <b>";
    model.parts[0].materials = {0, 0, 1, no_material};
    model.materials = {{"red & blue", ModelColor{255, 1, 2, 128}}, {"none", {}}};
    model.parts.push_back({"second", tetrahedron(), {}});
    const std::string text = format_model(model, {.format = MeshFormat::Amf}).bytes;
    Model back = model_in(text, MeshFormat::Amf);
    EXPECT_EQ(back.unit, "feet");
    back.unit = model.unit;
    EXPECT_EQ(back.materials, model.materials);
    EXPECT_EQ(back.parts, model.parts);
    model.unit = "kilometer";
    EXPECT_THROW((void)format_model(model, {.format = MeshFormat::Amf}), UnsupportedError);
}

}  // namespace
