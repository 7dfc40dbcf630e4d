// SPDX-License-Identifier: Apache-2.0
//
// Every truncation of a small file of every format, through the command. A prefix that a reader
// refuses must end in exit code 3 with the place; a prefix that is a file of its own (text formats
// without counts have those) must be the whole mesh or have findings. Nothing crashes, and no
// output appears where there is no result. Under the sanitizers their findings show as exit codes
// that no command has. Prints a table: see scripts/campaign-truncation.
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using trisect::InputError;
using trisect::MeshFormat;
using trisect::PlyEncoding;
using trisect::PolygonMesh;
using trisect::test::Finished;
using trisect::test::trisect;

struct Format {
    const char* name;
    const char* file;
    MeshFormat format;
    PlyEncoding encoding = PlyEncoding::Ascii;

    friend std::ostream& operator<<(std::ostream& out, const Format& f) { return out << f.name; }
};

PolygonMesh tetrahedron() {
    PolygonMesh mesh;
    mesh.points = {{0.5, -1.25, 0}, {10, 0, 0}, {0, 12.5, 0}, {0, 0, 20}};
    mesh.add_triangle(0, 2, 1);
    mesh.add_triangle(0, 1, 3);
    mesh.add_triangle(1, 2, 3);
    mesh.add_triangle(2, 0, 3);
    return mesh;
}

/// What became of all prefixes of one file.
struct Tally {
    int prefixes = 0;
    int refused = 0;
    int whole = 0;
    int defective = 0;
};

class Truncation : public trisect::test::Scratch {
protected:
    Finished run(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        trisect::test::Surroundings surroundings;
        surroundings.environment = {
            {"ASAN_OPTIONS", "exitcode=99"},
            {"LSAN_OPTIONS", "exitcode=99"},
            {"UBSAN_OPTIONS", "halt_on_error=1:exitcode=99:print_stacktrace=1"}};
        return trisect(arguments, surroundings);
    }

    std::vector<Finished> run_all(const std::string& name, const std::string& other) const {
        return {run({"info", name}), run({"check", name}),
                run({"union", name, other, "-o", path("out.off"), "--no-certificate"})};
    }

    void expect_refused(const std::vector<Finished>& results, const InputError& error) const {
        for (const Finished& r : results) {
            EXPECT_EQ(r.code, 3) << r.err;
            const auto document = r.json()["error"];
            EXPECT_EQ(document["kind"], "input");
            EXPECT_EQ(document["file"], error.place().file);
            if (error.place().line != 0) {
                EXPECT_EQ(document["line"], error.place().line);
                EXPECT_EQ(document["column"], error.place().column);
            } else {
                EXPECT_EQ(document["offset"], error.place().offset);
            }
        }
        EXPECT_FALSE(exists("out.off"));
    }

    void expect_whole(const std::vector<Finished>& results) const {
        for (const Finished& r : results) EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_TRUE(exists("out.off"));
    }

    void expect_defects(const std::vector<Finished>& results, bool has_faces) const {
        EXPECT_EQ(results[0].code, 0) << results[0].err;
        EXPECT_EQ(results[1].code, 1) << results[1].err;
        EXPECT_FALSE(results[1].json()["defects"].empty());
        EXPECT_EQ(results[2].code, has_faces ? 4 : 0) << results[2].err;
        EXPECT_EQ(exists("out.off"), !has_faces);
    }

    Tally cut_everywhere(const Format& format, const std::string& bytes) {
        const std::string other = box("other.obj", {30, 30, 30}, {31, 31, 31});
        // The command does not know which kind of STL was cut.
        const MeshFormat known = *trisect::mesh_format_of_extension(format.file);
        const PolygonMesh full = trisect::read_mesh(bytes, known, format.file);
        Tally tally;
        for (std::size_t n = 0; n < bytes.size(); ++n) {
            SCOPED_TRACE(std::string(format.name) + " cut to " + std::to_string(n) + " bytes");
            const std::string prefix = bytes.substr(0, n);
            const std::string name = write(format.file, prefix);
            const std::vector<Finished> results = run_all(name, other);
            ++tally.prefixes;
            try {
                const PolygonMesh mesh = trisect::read_mesh(prefix, known, name);
                if (mesh == full) {
                    ++tally.whole;
                    expect_whole(results);
                } else {
                    ++tally.defective;
                    expect_defects(results, mesh.face_count() != 0);
                }
            } catch (const InputError& e) {
                ++tally.refused;
                expect_refused(results, e);
            }
            std::remove(path("out.off").c_str());
            EXPECT_EQ(entry_count(), 2U);
            if (HasFailure()) break;  // one is enough to look at
        }
        return tally;
    }
};

std::string bytes_of(const PolygonMesh& mesh, const Format& format) {
    trisect::WriteOptions options;
    options.format = format.format;
    options.ply_encoding = format.encoding;
    return trisect::format_mesh(mesh, options, format.file).bytes;
}

class TruncationOf : public Truncation, public testing::WithParamInterface<Format> {};

TEST_P(TruncationOf, EndsInAnErrorWithItsPlaceOrInDefects) {
    const Format& format = GetParam();
    const std::string bytes = bytes_of(tetrahedron(), format);
    const Tally t = cut_everywhere(format, bytes);
    std::printf("| %s | %d | %d | %d | %d |\n", format.name, t.prefixes, t.refused, t.defective,
                t.whole);
    EXPECT_EQ(t.prefixes, static_cast<int>(bytes.size()));
    EXPECT_GT(t.refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, TruncationOf,
                         testing::Values(Format{"OBJ", "cut.obj", MeshFormat::Obj},
                                         Format{"STL, ASCII", "cut.stl", MeshFormat::StlAscii},
                                         Format{"STL, binary", "cut.stl", MeshFormat::StlBinary},
                                         Format{"OFF", "cut.off", MeshFormat::Off},
                                         Format{"PLY, ASCII", "cut.ply", MeshFormat::Ply},
                                         Format{"PLY, little-endian", "cut.ply", MeshFormat::Ply,
                                                PlyEncoding::BinaryLittleEndian},
                                         Format{"PLY, big-endian", "cut.ply", MeshFormat::Ply,
                                                PlyEncoding::BinaryBigEndian}));

}  // namespace
