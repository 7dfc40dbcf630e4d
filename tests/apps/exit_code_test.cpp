// SPDX-License-Identifier: Apache-2.0
//
// The exit codes, each of them at least once. 70 stands for a mistake of ours; it has no input.
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <string>
#include <vector>

#include <unistd.h>

#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/sphere.h>

#include "process.h"
#include "scratch.h"

namespace {

using trisect::test::Finished;
using trisect::test::trisect;
using trisect::test::Waiting;

class ExitCode : public trisect::test::Scratch {
protected:
    std::string cube_ = box("cube.obj", {0, 0, 0}, {1, 1, 1});
    std::string other_ = box("other.obj", {0, 0, 0}, {1, 1, 2});
    std::string open_ = open_box("open.obj");
    std::string out_ = path("out.obj");
};

TEST_F(ExitCode, DoneIsZero) {
    EXPECT_EQ(trisect({"info", cube_}).code, 0);
    EXPECT_EQ(trisect({"check", cube_}).code, 0);
    EXPECT_EQ(trisect({"convert", cube_, "-o", out_}).code, 0);
    EXPECT_EQ(trisect({"union", cube_, other_, "-o", out_}).code, 0);
    EXPECT_EQ(trisect({"diff", cube_, cube_}).code, 0);
    EXPECT_EQ(trisect({"--help"}).code, 0);
    EXPECT_EQ(trisect({"--version"}).code, 0);
    EXPECT_EQ(trisect({"union", "--help"}).code, 0);
}

TEST_F(ExitCode, FindingsAreOne) {
    EXPECT_EQ(trisect({"check", open_}).code, 1);
    EXPECT_EQ(trisect({"diff", cube_, other_}).code, 1);
}

TEST_F(ExitCode, AWordThatNoOptionKnowsIsAnsweredByThoseItKnows) {
    EXPECT_EQ(trisect({"union", cube_, other_, "-o", out_, "--winding", "odd"}).err,
              "trisect: error: --winding: 'odd' is none of positive, nonzero\n");
    EXPECT_EQ(trisect({"verify", "subtract", cube_, other_, out_}).err,
              "trisect: error: OP: 'subtract' is none of union, intersection, difference, xor\n");
    // No enumerator is printed as a character.
    for (const char* command : {"union", "sweep", "render", "compare-hierarchies"}) {
        const std::string help = trisect({command, "--help"}).out;
        EXPECT_EQ(help.find('\0'), std::string::npos) << command;
    }
}

TEST_F(ExitCode, UsageIsTwo) {
    const std::vector<std::vector<std::string>> mistakes{
        {},
        {"unite", cube_, cube_, "-o", out_},
        {"info"},
        {"info", cube_, "--colour"},
        {"info", cube_, cube_},
        {"union", cube_, "-o", out_},
        {"union", cube_, cube_},
        {"union", cube_, cube_, "-o", path("out.xyz")},
        {"union", "-", "-", "-o", out_},
        {"union", cube_, cube_, "-o", "-"},
        {"union", cube_, cube_, "-o", "-", "--format", "obj", "--json"},
        {"union", cube_, cube_, "-o", out_, "--winding", "odd"},
        {"info", cube_, "--threads", "0"},
        {"info", cube_, "--threads", "two"},
        {"info", cube_, "--lattice", "3"},
        {"info", cube_, "--max-memory", "lots"},
        {"info", cube_, "--max-memory", "99999999T"},
        {"info", cube_, "--max-seconds", "-1"},
        {"info", cube_, "--max-seconds", "nan"},
        {"info", cube_, "--max-work", "0"},
        {"info", cube_, "--format", "igs"},
        {"info", cube_, "--progress", "dots"},
        {"check", cube_, "--places", "-1"},
        {"convert", cube_, "-o", out_, "--translate", "1,2"},
        {"convert", cube_, "-o", out_, "--translate", "1,2,3,"},
        {"convert", cube_, "-o", out_, "--rotate", "0,0,0,90"},
        {"convert", cube_, "-o", out_, "--scale", "0"},
    };
    for (const auto& arguments : mistakes) {
        const Finished result = trisect(arguments);
        EXPECT_EQ(result.code, 2) << testing::PrintToString(arguments) << result.err;
        EXPECT_FALSE(result.err.empty());
    }
    EXPECT_FALSE(exists("out.obj"));
}

TEST_F(ExitCode, BadInputIsThree) {
    EXPECT_EQ(trisect({"info", path("missing.obj")}).code, 3);
    EXPECT_EQ(trisect({"info", path("")}).code, 3);
    const Finished result = trisect({"info", write("bad.obj", "v 0 0 0\nf 1 2 3\n"), "--json"});
    EXPECT_EQ(result.code, 3);
    const auto error = result.json()["error"];
    EXPECT_EQ(error["code"], 3);
    EXPECT_EQ(error["file"], path("bad.obj"));
    EXPECT_EQ(error["line"], 2);
}

TEST_F(ExitCode, UnwritableOutputIsThree) {
    const std::string target = path("no/such/folder/out.obj");
    EXPECT_EQ(trisect({"convert", cube_, "-o", target}).code, 3);
    EXPECT_EQ(trisect({"union", cube_, other_, "-o", target}).code, 3);
    EXPECT_EQ(trisect({"convert", cube_, "-o", "/dev/full", "--format", "obj"}).code, 3);
}

TEST_F(ExitCode, InvalidOperandIsFour) {
    for (const char* operation : {"union", "intersection", "difference", "xor"}) {
        const Finished result = trisect({operation, cube_, open_, "-o", out_});
        EXPECT_EQ(result.code, 4) << result.err;
        EXPECT_NE(result.err.find("open.obj"), std::string::npos) << result.err;
    }
    EXPECT_EQ(trisect({"diff", cube_, open_}).code, 4);
    EXPECT_FALSE(exists("out.obj"));
}

TEST_F(ExitCode, InsideOutOperandIsFourUnlessNonzero) {
    const std::string mirrored = box("mirrored.obj", {0, 0, 0}, {-1, 1, 1});
    EXPECT_EQ(trisect({"union", cube_, mirrored, "-o", out_}).code, 4);
    EXPECT_EQ(trisect({"union", cube_, mirrored, "-o", out_, "--winding", "nonzero"}).code, 0);
}

TEST_F(ExitCode, TimeLimitIsFive) {
    Waiting waiting({"info", "-", "--max-seconds", "0.2", "--json"});
    const Finished result = waiting.finish();
    EXPECT_EQ(result.code, 5) << result.err;
    EXPECT_EQ(result.json()["error"]["code"], 5);
}

TEST_F(ExitCode, MemoryLimitIsFive) {
    std::string text;
    for (int i = 0; i < 400'000; ++i) text += "v 0 0 " + std::to_string(i) + "\n";
    const std::string many = write("many.obj", text + "f 1 2 3\n");
    EXPECT_EQ(trisect({"info", many}).code, 0);
    const Finished result = trisect({"info", many, "--max-memory", "12M", "--json"});
    EXPECT_EQ(result.code, 5) << result.err;
    EXPECT_EQ(result.json()["error"]["kind"], "limit");
}

// Threads and their stacks are memory too: there are fewer of them, or the limit is said to be hit.
TEST_F(ExitCode, MemoryLimitOfWorkOnSeveralThreadsIsFive) {
    std::array<std::string, 2> balls;
    for (std::size_t i = 0; i < 2; ++i) {
        trisect::PolygonMesh mesh = trisect::make_icosphere(1, 5);
        for (auto& p : mesh.points) p[0] += 0.375 * static_cast<double>(i);
        trisect::WriteOptions options;
        options.format = trisect::MeshFormat::Off;
        balls[i] =
            write("ball" + std::to_string(i) + ".off", trisect::format_mesh(mesh, options).bytes);
    }
    int hit = 0;
    for (int megabytes = 12; megabytes <= 60; megabytes += 4) {
        const Finished result = trisect({"union", balls[0], balls[1], "-o", out_, "--threads", "8",
                                         "--max-memory", std::to_string(megabytes) + "M"});
        EXPECT_TRUE(result.code == 0 || result.code == 5) << megabytes << " " << result.err;
        if (result.code == 5) ++hit;
    }
    EXPECT_GT(hit, 0);
}

TEST_F(ExitCode, InterruptIsSix) {
    for (const int signal : {SIGINT, SIGTERM}) {
        Waiting waiting({"union", "-", cube_, "-o", out_, "--json"});
        ::usleep(200'000);
        waiting.send_signal(signal);
        const Finished result = waiting.finish();
        EXPECT_EQ(result.code, 6) << result.err;
        EXPECT_EQ(result.json()["error"]["kind"], "cancelled");
    }
    EXPECT_EQ(entry_count(), 3U);  // the inputs
}

// Tetrahedra all over each other: an evaluation that takes far longer than any limit here.
std::string tangle() {
    std::string text;
    std::uint32_t state = 1;
    const auto next = [&] {
        state = state * 1664525U + 1013904223U;
        return std::to_string(state >> 20);
    };
    for (int i = 0; i < 400; ++i) {
        const std::string x = next();
        const std::string y = next();
        const std::string z = next();
        const auto vertex = [&](const std::string& a, const std::string& b, const std::string& c) {
            text += "v " + a + " " + b + " " + c + "\n";
        };
        vertex(x, y, z);
        vertex(x + "9", y, z);
        vertex(x, y + "7", z);
        vertex(x, y, z + "8");
    }
    for (int i = 0; i < 400; ++i) {
        const auto corner = [&](int k) { return " " + std::to_string(4 * i + k); };
        text += "f" + corner(1) + corner(3) + corner(2) + "\n";
        text += "f" + corner(1) + corner(2) + corner(4) + "\n";
        text += "f" + corner(2) + corner(3) + corner(4) + "\n";
        text += "f" + corner(3) + corner(1) + corner(4) + "\n";
    }
    return text;
}

TEST_F(ExitCode, AnEvaluationThatTakesTooLongIsFive) {
    const std::string slow = write("slow.obj", tangle());
    const Finished time =
        trisect({"union", slow, cube_, "-o", out_, "--max-seconds", "0.3", "--json"});
    EXPECT_EQ(time.code, 5) << time.err;
    EXPECT_NE(time.err.find("--max-seconds"), std::string::npos) << time.err;
    const Finished work = trisect({"union", slow, cube_, "-o", out_, "--max-work", "100"});
    EXPECT_EQ(work.code, 5) << work.err;
    EXPECT_NE(work.err.find("work budget"), std::string::npos) << work.err;
    // Enough to read and to check the inputs, and to find the facets that meet others.
    const Finished evaluation =
        trisect({"union", slow, cube_, "-o", out_, "--max-work", "165000", "--verbose"});
    EXPECT_EQ(evaluation.code, 5) << evaluation.err;
    EXPECT_NE(evaluation.err.find("work budget"), std::string::npos) << evaluation.err;
    EXPECT_NE(evaluation.err.find("evaluate"), std::string::npos) << evaluation.err;
    EXPECT_FALSE(exists("out.obj"));
}

TEST_F(ExitCode, AnInterruptedEvaluationIsSix) {
    const std::string slow = write("slow.obj", tangle());
    Waiting waiting({"union", slow, cube_, "-o", out_, "--json"});
    ::usleep(500'000);
    waiting.send_signal(SIGTERM);
    const Finished result = waiting.finish();
    EXPECT_EQ(result.code, 6) << result.err;
    EXPECT_EQ(result.json()["error"]["kind"], "cancelled");
    EXPECT_FALSE(exists("out.obj"));
}

TEST_F(ExitCode, UnsupportedIsSeven) {
    const std::string wide = write("wide.off",
                                   "OFF\n4 1 0\n"
                                   "0 0 0\n1e300 0 0\n1e300 1e-300 0\n0 1e-300 0\n"
                                   "4 0 1 2 3\n");
    const Finished result =
        trisect({"convert", wide, "-o", path("o.stl"), "--format", "stl-ascii"});
    EXPECT_EQ(result.code, 7) << result.err;
    EXPECT_FALSE(exists("o.stl"));
}

}  // namespace
