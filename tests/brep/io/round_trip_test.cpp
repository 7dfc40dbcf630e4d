// SPDX-License-Identifier: Apache-2.0
//
// What is written comes back bit for bit, in every format.
#include "support/mesh_files.h"

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace trisect;
using namespace trisect::io_test;

/// Doubles of any finite bit pattern: every exponent, subnormals, both signs.
double any_double(std::mt19937_64& random) {
    for (;;) {
        const auto value = std::bit_cast<double>(random());
        if (std::isfinite(value)) return value;
    }
}

PolygonMesh random_points(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    PolygonMesh mesh;
    const double least = std::numeric_limits<double>::denorm_min();
    const double most = std::numeric_limits<double>::max();
    mesh.points = {{-0.0, least, 1e300}, {0.1, -most, -least}, {1.0 / 3.0, 1e-310, 5e-324}};
    for (int i = 0; i < 2000; ++i) {
        mesh.points.push_back({any_double(random), any_double(random), any_double(random)});
    }
    return mesh;
}

PolygonMesh random_polygons(std::uint64_t seed) {
    PolygonMesh mesh = random_points(seed);
    std::mt19937_64 random(seed + 1);
    for (int f = 0; f < 500; ++f) {
        std::vector<std::uint32_t> loop(3 + random() % 7);
        for (auto& corner : loop) {
            corner = static_cast<std::uint32_t>(random() % mesh.points.size());
        }
        mesh.add_face(loop);
    }
    return mesh;
}

/// Triangles whose vertices are numbered by first appearance, as STL demands.
PolygonMesh random_triangles(std::uint64_t seed) {
    PolygonMesh mesh = random_points(seed);
    mesh.points.resize(2001);
    for (std::uint32_t v = 0; v < 2001; v += 3) {
        mesh.add_triangle(v, v + 1, v + 2);
        if (v >= 3) mesh.add_triangle(v, v - 1, v - 2);
    }
    return mesh;
}

PolygonMesh back(const PolygonMesh& mesh, const WriteOptions& options) {
    const FormattedMesh formatted = format_mesh(mesh, options);
    EXPECT_TRUE(formatted.report.lossless);
    return read(formatted.bytes, *options.format);
}

TEST(RoundTrip, Polygons) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const PolygonMesh mesh = random_polygons(seed);
        EXPECT_TRUE(same_bits(back(mesh, {.format = MeshFormat::Obj}), mesh));
        EXPECT_TRUE(same_bits(back(mesh, {.format = MeshFormat::Off}), mesh));
        for (const PlyEncoding e :
             {PlyEncoding::Ascii, PlyEncoding::BinaryLittleEndian, PlyEncoding::BinaryBigEndian}) {
            EXPECT_TRUE(
                same_bits(back(mesh, {.format = MeshFormat::Ply, .ply_encoding = e}), mesh));
        }
    }
}

TEST(RoundTrip, AsciiStlKeepsDoubles) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const PolygonMesh mesh = random_triangles(seed);
        EXPECT_TRUE(same_bits(back(mesh, {.format = MeshFormat::StlAscii}), mesh));
    }
}

TEST(RoundTrip, BinaryStlKeepsFloats) {
    std::mt19937_64 random(7);
    PolygonMesh mesh;
    while (mesh.points.size() < 3000) {
        Point3d p;
        for (double& c : p) {
            float value = 0;
            do value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
            while (!std::isfinite(value));
            c = static_cast<double>(value);
        }
        mesh.points.push_back(p);
    }
    for (std::uint32_t v = 0; v < 3000; v += 3) mesh.add_triangle(v, v + 1, v + 2);
    EXPECT_TRUE(same_bits(back(mesh, {.format = MeshFormat::StlBinary}), mesh));
    EXPECT_TRUE(same_bits(back(mesh, {.format = MeshFormat::Stl}), mesh));
}

TEST(RoundTrip, FacesBeyondOneByte) {
    PolygonMesh mesh;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        mesh.points.push_back({static_cast<double>(i), 0, 1});
        loop.push_back(i);
    }
    mesh.add_face(loop);
    mesh.add_triangle(0, 1, 2);
    for (const MeshFormat f : {MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply}) {
        EXPECT_EQ(back(mesh, {.format = f}), mesh);
    }
    for (const PlyEncoding e : {PlyEncoding::Ascii, PlyEncoding::BinaryBigEndian}) {
        EXPECT_EQ(back(mesh, {.format = MeshFormat::Ply, .ply_encoding = e}), mesh);
    }
}

TEST(RoundTrip, EmptyMesh) {
    for (const MeshFormat f : {MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply, MeshFormat::Stl,
                               MeshFormat::StlAscii}) {
        EXPECT_EQ(back(PolygonMesh{}, {.format = f}), PolygonMesh{});
    }
}

TEST(RoundTrip, WritersRefuseBrokenMeshes) {
    const WriteOptions obj{.format = MeshFormat::Obj};
    const auto refuses = [&](const PolygonMesh& mesh) {
        EXPECT_THROW((void)format_mesh(mesh, obj), UsageError);
    };
    EXPECT_THROW((void)format_mesh(tetrahedron(), WriteOptions{}), UsageError);
    PolygonMesh mesh = tetrahedron();
    mesh.points[1][2] = std::numeric_limits<double>::quiet_NaN();
    refuses(mesh);
    mesh = tetrahedron();
    mesh.corners[0] = 4;
    refuses(mesh);
    mesh = tetrahedron();
    mesh.face_begin = {0, 15, 12};
    refuses(mesh);
    mesh.face_begin = {0, 12, 9, 12};
    refuses(mesh);
    mesh.face_begin = {0, 2, 12};
    refuses(mesh);
    mesh.face_begin = {};
    refuses(mesh);
}

TEST(RoundTrip, OutputIsDeterministic) {
    const PolygonMesh mesh = random_triangles(3);
    for (const MeshFormat f : {MeshFormat::Obj, MeshFormat::StlAscii, MeshFormat::Ply}) {
        EXPECT_EQ(format_mesh(mesh, {.format = f}).bytes, format_mesh(mesh, {.format = f}).bytes);
    }
}

}  // namespace
