// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>

#include "process.h"
#include "scratch.h"

namespace {

using nlohmann::json;
using trisect::test::Finished;
using trisect::test::trisect;

class BooleanCommand : public trisect::test::Scratch {
protected:
    json run(const std::string& operation, std::vector<std::string> rest) {
        rest.insert(rest.begin(), operation);
        rest.insert(rest.end(), {"-o", out_, "--json"});
        const Finished result = trisect(rest);
        EXPECT_EQ(result.code, 0) << result.err;
        return result.json();
    }
    std::string a_ = box("a.obj", {0, 0, 0}, {2, 2, 2});
    std::string b_ = box("b.obj", {1, 1, 1}, {3, 3, 3});
    std::string c_ = box("c.obj", {10, 0, 0}, {11, 1, 1});
    std::string out_ = path("out.obj");
};

TEST_F(BooleanCommand, VolumesOfTwoBoxes) {
    const std::vector<std::pair<std::string, int>> expected{
        {"union", 15}, {"intersection", 1}, {"difference", 7}, {"xor", 14}};
    for (const auto& [operation, volume] : expected) {
        EXPECT_EQ(run(operation, {a_, b_})["output"]["volume"], volume) << operation;
        EXPECT_EQ(trisect({"info", out_, "--json"}).json()["volume"], volume) << operation;
    }
}

// The parts of an exclusive or share edges; what is counted is what was written.
TEST_F(BooleanCommand, CountsAreThoseOfTheFileWhereTheResultTouchesItself) {
    const json written = run("xor", {a_, b_})["output"];
    const json read = trisect({"info", out_, "--json"}).json();
    for (const char* key : {"triangles", "faces", "vertices", "edges", "shells", "genus", "volume"})
        EXPECT_EQ(written[key], read[key]) << key;
}

TEST_F(BooleanCommand, OperandsAreMaterials) {
    const Finished result = trisect({"difference", a_, b_, "-o", path("out.glb")});
    ASSERT_EQ(result.code, 0) << result.err;
    const std::string bytes = read(path("out.glb"));
    const json document = json::parse(bytes.substr(20, bytes.find("BIN") - 24));
    ASSERT_EQ(document["materials"].size(), 2U);
    EXPECT_EQ(document["materials"][0]["name"], "a.obj");
    EXPECT_EQ(document["materials"][1]["name"], "b.obj");
    const json& primitives = document["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 2U);
    // Three faces of the corner that is taken away, of two triangles each.
    EXPECT_EQ(document["accessors"][primitives[1]["indices"].get<std::size_t>()]["count"], 18);
    EXPECT_EQ(trisect({"difference", a_, b_, "-o", path("out.off")}).code, 0);
    EXPECT_EQ(trisect({"diff", path("out.off"), path("out.glb")}).code, 0);
}

// A limit that is far above what small files take changes nothing, in pieces or not.
TEST_F(BooleanCommand, MemoryIsLimitedWhateverTheEncoding) {
    const trisect::PolygonMesh mesh = trisect::read_mesh(a_);
    for (const trisect::PlyEncoding encoding :
         {trisect::PlyEncoding::Ascii, trisect::PlyEncoding::BinaryLittleEndian,
          trisect::PlyEncoding::BinaryBigEndian}) {
        trisect::WriteOptions options;
        options.format = trisect::MeshFormat::Ply;
        options.ply_encoding = encoding;
        const std::string in = write("in.ply", trisect::format_mesh(mesh, options).bytes);
        for (const char* out : {"out.ply", "out.stl"}) {
            const Finished result =
                trisect({"union", in, b_, "-o", path(out), "--max-memory", "2G"});
            EXPECT_EQ(result.code, 0) << result.err;
            const Finished same = trisect({"union", in, in, "-o", path(out), "--max-memory", "2G"});
            EXPECT_EQ(same.code, 0) << same.err;
        }
    }
}

TEST_F(BooleanCommand, StepHasWholeFaces) {
    const Finished result = trisect({"difference", a_, b_, "-o", path("out.step"), "--json"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.json()["certificate"]["certified"], true);
    const json read = trisect({"info", path("out.step"), "--json"}).json();
    EXPECT_EQ(read["faces"], 9);  // a box without a corner
    EXPECT_EQ(trisect({"difference", a_, b_, "-o", path("out.off")}).code, 0);
    EXPECT_EQ(trisect({"diff", path("out.off"), path("out.step")}).code, 0);
}

TEST_F(BooleanCommand, FirstBadInputIsReported) {
    const std::string open = open_box("open.obj");
    const Finished missing = trisect({"union", a_, path("none.obj"), open, "-o", out_});
    EXPECT_NE(missing.err.find("none.obj"), std::string::npos) << missing.err;
    EXPECT_EQ(missing.err.find("open.obj"), std::string::npos) << missing.err;
    const Finished other = trisect({"union", a_, open, path("none.obj"), "-o", out_});
    EXPECT_NE(other.err.find("open.obj"), std::string::npos) << other.err;
    EXPECT_FALSE(exists("out.obj"));
}

TEST_F(BooleanCommand, DocumentHasItsKeys) {
    const json document = run("difference", {a_, b_});
    EXPECT_EQ(document["schema"], "trisect.boolean/1");
    EXPECT_EQ(document["op"], "difference");
    ASSERT_EQ(document["inputs"].size(), 2U);
    EXPECT_EQ(document["inputs"][0]["file"], a_);
    EXPECT_EQ(document["embedding"], "checked");
    for (const char* key : {"read", "evaluate", "assemble", "write"}) {
        EXPECT_TRUE(document["seconds"].contains(key)) << key;
    }
    for (const char* key : {"vertices", "edges", "faces", "triangles", "shells", "genus", "closed",
                            "volume", "area", "bounds", "lattice"}) {
        EXPECT_TRUE(document["output"].contains(key)) << key;
    }
    EXPECT_EQ(document["certificate"]["closed"], true);
    EXPECT_EQ(document["certificate"]["oriented"], true);
    EXPECT_EQ(document["certificate"]["self_intersecting_pairs"], 0);
    EXPECT_EQ(document["certificate"]["max_move"], 0);
    EXPECT_EQ(document["certificate"]["rounded_vertices"], 0);
}

TEST_F(BooleanCommand, CertificateMayBeSkipped) {
    EXPECT_TRUE(run("union", {a_, b_, "--no-certificate"})["certificate"].is_null());
}

TEST_F(BooleanCommand, CertificateTellsTheRounding) {
    const std::string tetrahedron = write("t.obj",
                                          "v 0 0 0\nv 7 0 0\nv 0 5 0\nv 0 0 3\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const json certificate =
        run("intersection", {tetrahedron, box("d.obj", {-1, -1, 1}, {9, 9, 9})})["certificate"];
    EXPECT_EQ(certificate["rounded_vertices"], 2);  // 14/3 and 10/3
    EXPECT_GT(certificate["max_move"], 0);
    EXPECT_LT(certificate["max_move"], 1e-15);
}

TEST_F(BooleanCommand, ExactBoundariesAreOperands) {
    const std::string tetrahedron = write("t.obj",
                                          "v 0 0 0\nv 7 0 0\nv 0 5 0\nv 0 0 3\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string block = box("d.obj", {-1, -1, 1}, {9, 9, 9});
    const std::string kept = path("kept.exact");
    const std::string rest = path("rest.exact");
    (void)run("intersection", {tetrahedron, block, "--boundary", kept});
    (void)run("difference", {tetrahedron, block, "--boundary", rest});
    // Corners at thirds: together again it is the tetrahedron, and nothing is left between them.
    EXPECT_EQ(run("union", {kept, rest})["output"]["volume"], 17.5);
    EXPECT_EQ(run("xor", {kept, rest})["output"]["volume"], 17.5);
    EXPECT_EQ(run("union", {kept, rest})["output"]["vertices"], 4);
    EXPECT_EQ(run("intersection", {kept, rest})["output"]["faces"], 0);
    EXPECT_EQ(run("difference", {tetrahedron, rest, kept})["output"]["faces"], 0);
    EXPECT_EQ(run("difference", {kept, a_})["inputs"][0]["file"], kept);
    EXPECT_EQ(trisect({"union", kept, path("none.exact"), "-o", out_}).code, 3);
}

TEST_F(BooleanCommand, RepairCertifiesWhatIsWritten) {
    const std::string tetrahedron = write("t.obj",
                                          "v 0 0 0\nv 7 0 0\nv 0 5 0\nv 0 0 3\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const json document =
        run("intersection", {tetrahedron, box("d.obj", {-1, -1, 1}, {9, 9, 9}), "--repair"});
    EXPECT_EQ(document["certificate"]["self_intersecting_pairs"], 0);
    EXPECT_NE(document["repair"]["outcome"], "failed");
    EXPECT_LT(document["repair"]["radius"], 1e-9);
    EXPECT_EQ(trisect({"check", out_}).code, 0);
    EXPECT_TRUE(run("union", {a_, b_})["repair"].is_null());
}

TEST_F(BooleanCommand, AFaceIsDividedWhereAnEdgeLiesInIt) {
    // A roof that stands on its ridge, inside the top of a box.
    const std::string roof = write("roof.obj",
                                   "v 1 1 2\nv 0 1 4\nv 2 1 4\nv 1 3 2\nv 0 3 4\nv 2 3 4\n"
                                   "f 1 3 2\nf 4 5 6\nf 1 5 4\nf 1 2 5\nf 2 6 5\nf 2 3 6\n"
                                   "f 3 4 6\nf 3 1 4\n");
    const std::string below = box("below.obj", {0, 0, 0}, {4, 4, 2});
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--faces"}}) {
        std::vector<std::string> words{below, roof};
        words.insert(words.end(), more.begin(), more.end());
        const json document = run("union", words);
        EXPECT_TRUE(document["certificate"]["certified"]) << document["certificate"];
        EXPECT_EQ(document["divided"], 4);
        EXPECT_EQ(trisect({"check", out_, "--json"}).json()["errors"], 0);
    }
    EXPECT_EQ(run("difference", {below, roof})["divided"], 0);
}

TEST_F(BooleanCommand, UndecidedIsNotCertified) {
    // 2^-75: thirds of it have bits far below it.
    const std::string tetrahedron = write("t.obj",
                                          "v 0 0 0\nv 7 0 0\n"
                                          "v 2.6469779601696886e-23 5 0\nv 0 0 3\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string block = box("d.obj", {-1, -1, 1}, {9, 9, 9});
    const json certificate = run("intersection", {tetrahedron, block})["certificate"];
    EXPECT_EQ(certificate.value("certified", true), false);
    EXPECT_TRUE(certificate["self_intersecting_pairs"].is_null());
    EXPECT_TRUE(certificate.value("undecided", json()).is_string());
    const Finished spoken = trisect({"intersection", tetrahedron, block, "-o", out_});
    EXPECT_NE(spoken.err.find("certified    NO: "), std::string::npos) << spoken.err;
    EXPECT_NE(spoken.err.find("too many bits"), std::string::npos) << spoken.err;
    EXPECT_NE(spoken.err.find("--repair"), std::string::npos) << spoken.err;

    const json whole = run("union", {a_, b_})["certificate"];
    EXPECT_EQ(whole.value("certified", false), true);
    EXPECT_TRUE(whole.value("undecided", json("?")).is_null());
    EXPECT_EQ(trisect({"union", a_, b_, "-o", out_}).err.find("NO: "), std::string::npos);
}

TEST_F(BooleanCommand, OutputsInOneFileAreRefused) {
    namespace fs = std::filesystem;
    const std::string x = path("x.off");
    const auto refused = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"union", a_, b_};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Finished result = trisect(arguments);
        EXPECT_EQ(result.code, 2) << result.err;
        return result.code == 2;
    };
    const std::size_t before = entry_count();
    EXPECT_TRUE(refused({"-o", x, "--boundary", x}));
    EXPECT_TRUE(refused({"-o", x, "--boundary", path("./x.off")}));
    EXPECT_TRUE(refused({"-o", x, "--boundary", path("none/../x.off")}));
    EXPECT_EQ(entry_count(), before);
    fs::create_symlink("x.off", path("link.off"));
    EXPECT_TRUE(refused({"-o", path("link.off"), "--boundary", x}));
    EXPECT_TRUE(refused({"-o", x, "--boundary", path("link.off")}));
    (void)write("x.off", "old");
    EXPECT_TRUE(refused({"-o", path("link.off"), "--boundary", x}));
    fs::create_hard_link(x, path("hard.off"));
    EXPECT_TRUE(refused({"-o", path("hard.off"), "--boundary", x}));
    EXPECT_EQ(read(x), "old");
    fs::create_directory_symlink(".", path("here"));
    EXPECT_TRUE(refused({"-o", path("here/y.off"), "--boundary", path("y.off")}));
}

TEST_F(BooleanCommand, TheStandardOutputHoldsOneThing) {
    const auto code = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"union", a_, b_, "--format", "off"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return trisect(arguments).code;
    };
    EXPECT_EQ(code({"-o", "-", "--boundary", "-"}), 2);
    EXPECT_EQ(code({"-o", "-", "--boundary", "/dev/stdout"}), 2);
    EXPECT_EQ(code({"-o", out_, "--boundary", "-", "--json"}), 2);
    EXPECT_EQ(code({"-o", out_, "--boundary", "/dev/stdout", "--json"}), 2);
    EXPECT_EQ(code({"-o", "/dev/stdout", "--json"}), 2);
    // Nobody reads what is written there.
    EXPECT_EQ(code({"-o", "/dev/null", "--boundary", "/dev/null"}), 0);
    const std::string exact = path("alone.exact");
    EXPECT_EQ(code({"-o", out_, "--boundary", exact}), 0);
    const Finished alone = trisect({"union", a_, b_, "-o", out_, "--boundary", "-"});
    EXPECT_EQ(alone.code, 0) << alone.err;
    EXPECT_EQ(alone.out, read(exact));
}

TEST_F(BooleanCommand, TheOutputMayBeAnOperand) {
    const std::string both = write("both.obj", read(a_));
    EXPECT_EQ(trisect({"union", both, b_, "-o", both}).code, 0);
    EXPECT_EQ(trisect({"union", a_, b_, "-o", out_}).code, 0);
    EXPECT_EQ(trisect({"xor", both, out_, "-o", path("z.off"), "--json"}).json()["output"]["faces"],
              0);
}

TEST_F(BooleanCommand, ManyOperands) {
    EXPECT_EQ(run("union", {a_, b_, c_})["output"]["volume"], 16);
    EXPECT_EQ(run("difference", {a_, b_, c_})["output"]["volume"], 7);
    EXPECT_EQ(run("xor", {a_, b_, c_})["output"]["volume"], 15);
    EXPECT_EQ(run("intersection", {a_, b_, c_})["output"]["volume"], 0);
}

TEST_F(BooleanCommand, EmptyResultIsWritten) {
    const json document = run("intersection", {a_, c_});
    EXPECT_EQ(document["output"]["faces"], 0);
    EXPECT_TRUE(document["output"]["bounds"].is_null());
    EXPECT_TRUE(exists("out.obj"));
}

// What is written by triangles alone has the same measures; its faces are its triangles. Two boxes
// that touch in an edge have the shells of the B-rep.
TEST_F(BooleanCommand, TrianglesAloneDescribeTheSameSet) {
    const std::string beside = box("n.obj", {2, 2, 0}, {3, 3, 2});
    for (const std::string& other : {b_, beside}) {
        for (const char* operation : {"union", "difference", "xor"}) {
            const json quick = run(operation, {a_, other, "--exact"})["output"];
            const json faces = run(operation, {a_, other, "--exact", "--faces"})["output"];
            for (const char* key :
                 {"volume", "volume_exact", "area", "bounds", "shells", "genus", "closed"})
                EXPECT_EQ(quick[key], faces[key]) << operation << ' ' << other << ' ' << key;
        }
    }
    const json quick = run("union", {a_, b_})["output"];
    EXPECT_EQ(quick["faces"], quick["triangles"]);
}

TEST_F(BooleanCommand, AnOptionIsNoValue) {
    const Finished result = trisect({"union", a_, b_, "-o", out_, "--boundary", "--json"});
    EXPECT_EQ(result.code, 2);
    EXPECT_FALSE(exists("--json"));
}

TEST_F(BooleanCommand, CoplanarFacesJoinUnlessAskedNotTo) {
    const std::string next = box("n.obj", {2, 0, 0}, {3, 2, 2});
    EXPECT_EQ(run("union", {a_, next, "--faces"})["output"]["faces"], 6);
    EXPECT_GE(run("union", {a_, next, "--source-faces"})["output"]["faces"], 10);
}

TEST_F(BooleanCommand, ThreadsDoNotChangeTheBytes) {
    (void)run("union", {a_, b_, "--threads", "1"});
    const std::string one = read(out_);
    (void)run("union", {a_, b_, "--threads", "4"});
    EXPECT_EQ(read(out_), one);
}

TEST_F(BooleanCommand, DiffComparesSets) {
    (void)run("union", {a_, b_});
    EXPECT_EQ(trisect({"diff", out_, out_}).code, 0);
    const Finished result = trisect({"diff", out_, a_, "--json", "--exact"});
    EXPECT_EQ(result.code, 1);
    const json document = result.json();
    EXPECT_EQ(document["schema"], "trisect.diff/1");
    EXPECT_EQ(document["equal"], false);
    EXPECT_EQ(document["symmetric_difference"]["volume"], 7);
    EXPECT_EQ(document["symmetric_difference"]["volume_exact"], "7");
    EXPECT_EQ(document["only_first"]["volume"], 7);
    EXPECT_EQ(document["only_second"]["volume"], 0);
}

TEST_F(BooleanCommand, SelfIntersectionsAreResolved) {
    // Two boxes in one file, overlapping.
    const std::string text = trisect::test::box_text({0, 0, 0}, {2, 2, 2}) +
                             trisect::test::box_text({1, 1, 1}, {3, 3, 3}, 9);
    const std::string both = write("both.obj", text);
    EXPECT_EQ(run("union", {both, c_})["output"]["volume"], 16);
}

// A box of edge 2^44 and one whose corners need the unit 2^-16.
TEST_F(BooleanCommand, LatticesThatDoNotFitAreRoundedWithAReport) {
    const std::string huge =
        write("huge.off",
              "OFF\n4 4 0\n0 0 0\n17592186044416 0 0\n0 17592186044416 0\n0 0 17592186044416\n"
              "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    const std::string fine = write("fine.off",
                                   "OFF\n4 4 0\n-1 -1 -1\n3 7.888609052210118e-31 -1\n-1 3 -1\n"
                                   "-1 -1 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    const Finished result = trisect({"intersection", huge, fine, "-o", path("o.off"), "--json"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.err.find("rounded to the lattice"), std::string::npos) << result.err;
    const json lattice = result.json()["output"]["lattice"];
    EXPECT_EQ(lattice["lossless"], false);
    EXPECT_EQ(lattice["moved"], 1);
    EXPECT_EQ(lattice["max_move"], 0x1p-100);
    const Finished refused =
        trisect({"union", huge, fine, "-o", path("o.off"), "--mixed-lattices", "refuse", "--json"});
    EXPECT_EQ(refused.code, 5);
    EXPECT_NE(refused.err.find("no common lattice"), std::string::npos) << refused.err;
}

}  // namespace
