// SPDX-License-Identifier: Apache-2.0
//
// Files made to break readers: every truncation and many mutations of small files, limits, long
// lines and words. Meant to be run under the address and undefined behaviour sanitizers too.
#include "support/mesh_files.h"

#include <random>

namespace {

using namespace trisect;
using namespace trisect::io_test;

struct Sample {
    MeshFormat format;
    std::string bytes;
};

PolygonMesh sample_mesh(bool polygons) {
    PolygonMesh mesh = tetrahedron();
    mesh.points[3][2] = 0.125;
    const std::vector<std::uint32_t> loop{0, 1, 2, 3};
    if (polygons) mesh.add_face(loop);
    return mesh;
}

std::vector<Sample> samples() {
    std::vector<Sample> all;
    for (const MeshFormat f : {MeshFormat::Obj, MeshFormat::Off}) {
        all.push_back({f, format_mesh(sample_mesh(true), {.format = f}).bytes});
    }
    for (const PlyEncoding e :
         {PlyEncoding::Ascii, PlyEncoding::BinaryLittleEndian, PlyEncoding::BinaryBigEndian}) {
        const WriteOptions options{.format = MeshFormat::Ply, .ply_encoding = e};
        all.push_back({MeshFormat::Ply, format_mesh(sample_mesh(true), options).bytes});
    }
    for (const MeshFormat f : {MeshFormat::StlAscii, MeshFormat::StlBinary}) {
        all.push_back({f, format_mesh(sample_mesh(false), {.format = f}).bytes});
    }
    all.push_back({MeshFormat::Obj,
                   "\xEF\xBB\xBFo a\r\nv 1 2 3 0.5 1 1\r\nv 1e5 -2.5E-3 +3\r\n"
                   "v 0 \\\r\n0 0\r\nvt 0 0\r\nf 1/1 2//1 \\\r\n -1/1/1\r\n"});
    all.push_back({MeshFormat::Off,
                   "STCNOFF 3 1 0\n#c\n0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n"
                   "3 0 1 2 255 0 0\n"});
    return all;
}

/// Reads a copy that ends exactly at the end of its allocation, so that a sanitizer sees any read
/// beyond. Returns whether it was a mesh; anything but a mesh or an error of ours is a failure.
bool survives(std::string_view bytes, MeshFormat format) {
    const std::vector<char> exact(bytes.begin(), bytes.end());
    ReadOptions options;
    options.limits.vertices = 1000;
    try {
        const PolygonMesh mesh =
            read_mesh(std::string_view(exact.data(), exact.size()), format, "test", options);
        for (const std::uint32_t corner : mesh.corners) EXPECT_LT(corner, mesh.points.size());
        EXPECT_EQ(mesh.face_begin.back(), mesh.corners.size());
        return true;
    } catch (const InputError& e) {
        EXPECT_EQ(e.place().file, "test");
        EXPECT_LE(e.place().offset, bytes.size());
    } catch (const LimitError&) {
    }
    return false;
}

TEST(Hostile, EveryTruncation) {
    for (const Sample& s : samples()) {
        const PolygonMesh whole = read(s.bytes, s.format);
        EXPECT_FALSE(survives({}, s.format));
        for (std::size_t n = 0; n < s.bytes.size(); ++n) {
            const bool mesh = survives(std::string_view(s.bytes).substr(0, n), s.format);
            // OBJ has no end mark, so many prefixes are files; elsewhere only white space and the
            // last digits of the last number (or name) may be missing.
            if (s.format == MeshFormat::Obj || n + 20 > s.bytes.size()) continue;
            EXPECT_FALSE(mesh) << to_string(s.format) << " cut at " << n;
        }
        EXPECT_TRUE(survives(s.bytes, s.format));
    }
}

TEST(Hostile, Mutations) {
    std::mt19937 random(1);
    const std::string_view spice = "0123456789-+.eE/\\#\n\r \t\0nifv\xFF\x80\x7F";
    for (const Sample& s : samples()) {
        for (int round = 0; round < 3000; ++round) {
            std::string bytes = s.bytes;
            const unsigned changes = 1 + static_cast<unsigned>(random() % 3);
            for (unsigned i = 0; i < changes; ++i) {
                const std::size_t at = random() % bytes.size();
                const char c = spice[random() % spice.size()];
                const auto kind = random() % 4;
                if (kind == 0)
                    bytes.insert(at, 1, c);
                else if (kind == 1)
                    bytes.erase(at, 1 + random() % 4);
                else if (kind == 2)
                    bytes[at] = static_cast<char>(random());
                else
                    bytes[at] = c;
                if (bytes.empty()) bytes = " ";
            }
            (void)survives(bytes, s.format);
            if (s.format == MeshFormat::StlAscii) (void)survives(bytes, MeshFormat::Stl);
        }
    }
}

TEST(Hostile, EveryFormatReadsEverySample) {
    for (const Sample& s : samples()) {
        for (const MeshFormat f : {MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply,
                                   MeshFormat::StlAscii, MeshFormat::StlBinary, MeshFormat::Stl}) {
            (void)survives(s.bytes, f);
        }
        (void)detect_mesh_format(s.bytes);
    }
}

TEST(Hostile, LongLinesAndWords) {
    const std::string tetra = format_mesh(tetrahedron(), {.format = MeshFormat::Obj}).bytes;
    const std::string comment = "# " + std::string(70'000, 'x') + "\n";
    EXPECT_EQ(read(comment + tetra, MeshFormat::Obj).face_count(), 4U);
    EXPECT_THROW((void)read(std::string(10U << 20, 'v') + "\n" + tetra, MeshFormat::Obj),
                 LimitError);
    EXPECT_THROW((void)read("solid\nfacet " + std::string(10U << 20, 'v'), MeshFormat::Stl),
                 LimitError);
    EXPECT_THROW((void)read("v 0 0 1" + std::string(5000, '0') + "e-5000\n", MeshFormat::Obj),
                 LimitError);
    EXPECT_EQ(read("v 0 0 0." + std::string(4000, '3') + "\n", MeshFormat::Obj).points[0][2],
              1.0 / 3.0);
    const std::string message =
        input_error("v 0 0 " + std::string(100'000, 'x') + "\n", MeshFormat::Obj);
    EXPECT_LT(message.size(), 200U);
}

void expect_limit(const std::string& bytes, MeshFormat format, const ReadLimits& limits,
                  const std::string& part) {
    try {
        (void)read(bytes, format, {.format = {}, .limits = limits});
        ADD_FAILURE() << "read without an error: " << part;
    } catch (const LimitError& e) {
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
}

TEST(Hostile, Limits) {
    for (const Sample& s : samples()) {
        const bool stl = s.format == MeshFormat::StlAscii || s.format == MeshFormat::StlBinary;
        ReadLimits limits;
        limits.bytes = s.bytes.size() - 1;
        expect_limit(s.bytes, s.format, limits, "bytes");
        limits = {};
        limits.vertices = 2;
        expect_limit(s.bytes, s.format, limits, "2 vertices");
        limits = {};
        limits.faces = 0;
        expect_limit(s.bytes, s.format, limits, "0 faces");
        limits = {};
        limits.loop_corners = 2;
        expect_limit(s.bytes, s.format, limits, "2 corners");
        if (stl) continue;
        limits = {};
        limits.vertices = 4;
        limits.faces = 5;
        limits.loop_corners = 4;
        EXPECT_NO_THROW((void)read(s.bytes, s.format, {.format = {}, .limits = limits}));
    }
}

TEST(Hostile, LimitErrorsNameThePlace) {
    ReadLimits limits;
    limits.vertices = 1;
    expect_limit("v 0 0 0\nv 0 0 1\n", MeshFormat::Obj, limits, "test:2:1: more than 1 vertices");
}

}  // namespace
