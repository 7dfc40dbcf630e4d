// SPDX-License-Identifier: Apache-2.0
//
// OFF: the many headers seen in the wild, each documented leniency and each refusal.
#include "support/mesh_files.h"

namespace {

using namespace trisect;
using namespace trisect::io_test;

const std::string points = "0 0 0\n1 0 0\n0 1 0\n";

PolygonMesh off(const std::string& text) { return read(text, MeshFormat::Off); }

void expect_off_error(const std::string& text, const std::string& place, const std::string& part) {
    expect_error_at(text, MeshFormat::Off, place, part);
}

TEST(Off, Headers) {
    const PolygonMesh expected = off("OFF\n3 1 0\n" + points + "3 0 1 2\n");
    EXPECT_EQ(loops(expected), (Loops{{0, 1, 2}}));
    for (const std::string header :
         {"OFF 3 1 0\n", "OFF3 1 0\n", "OFF\n# c\n\n3 1 0\n", "3 1 0\n", "# c\nOFF\r\n3 1\r\n",
          "OFF\n3\n1 0\n", "\xEF\xBB\xBFOFF\n3 1 0\n", "OFF # c\n3 1 3 # c\n"}) {
        EXPECT_EQ(off(header + points + "3 0 1 2"), expected) << header;
    }
}

TEST(Off, NormalsColoursAndTextures) {
    for (const std::string header : {"COFF", "NOFF", "STOFF", "STCNOFF", "OFF"}) {
        for (const std::string extra : {"", " 255 0 0", " 1 0 0 1", " 0.5 0.5"}) {
            std::string text = header + "\n3 1 0\n";
            for (const std::string p : {"0 0 0", "1 0 0", "0 1 0"}) text += p + extra + "\n";
            const PolygonMesh m = off(text + "3 0 1 2 255 0 0\n");
            EXPECT_EQ(m.points[1], (Point3d{1, 0, 0}));
            EXPECT_EQ(loops(m), (Loops{{0, 1, 2}}));
        }
    }
}

TEST(Off, CommentGluedToANumber) {
    EXPECT_EQ(off("OFF\n3 1 0# counts\n0 0 0#red\n1 0 0\n0 1 0\n3 0 1 2#last\n"),
              off("OFF\n3 1 0\n" + points + "3 0 1 2\n"));
}

TEST(Off, TwoVerticesOnOneLineAreNotDropped) {
    expect_off_error("OFF\n3 1 0\n0 0 0 1 0 0\n0 1 0\n3 0 1 2\n", ":4:1", "the first one has 6");
    expect_off_error("OFF\n2 1 0\n0 0 0 1 0 0\n3 0 1 0\n", ":4:1", "the first one has 6");
}

TEST(Off, BadHeaders) {
    expect_off_error("", ":1:1", "empty");
    expect_off_error("# only\n", ":2:1", "no OFF header");
    expect_off_error("FOO\n3 1 0\n", ":1:1", "no OFF header");
    expect_off_error("OFFX\n", ":1:1", "no OFF header");
    expect_off_error("4OFF\n3 1 0\n", ":1:1", "three dimensions");
    expect_off_error("nOFF\n3\n3 1 0\n", ":1:1", "three dimensions");
    expect_off_error("OFF BINARY\n", ":1:5", "binary OFF");
    expect_off_error("OFF\n3\n", ":3:1", "number of faces");
    expect_off_error("OFF\n-3 1 0\n", ":2:1", "negative");
    expect_off_error("OFF\n3 1 0 0 0\n", ":2:7", "unexpected");
}

TEST(Off, CountsAreHints) {
    for (const std::string n : {"4294967296", "9223372036854775807", "2305843009213693952", "60"}) {
        expect_off_error("OFF\n" + n + " 1 0\n" + points + "3 0 1 2\n", ":2:1", "can hold");
        expect_off_error("OFF\n3 " + n + " 0\n" + points + "3 0 1 2\n", ":2:1", "can hold");
    }
    expect_off_error("OFF\n99999999999999999999 1 0\n", ":2:1", "too large");
    expect_off_error("OFF\n3 1 0\n" + points + "1000000 0 1 2\n", ":6:14", "ends where");
    expect_off_error("OFF\n3 2 0\n" + points + "3 0 1 2           \n", ":7:1", "face 2 of 2");
}

TEST(Off, FacesOfSeveralLines) {
    const std::string two = "OFF\n3 2 0\n" + points;
    EXPECT_EQ(loops(off(two + "3 0\n1 # one\n\n2\n3 2\n1 0 255 0 0\n")),
              (Loops{{0, 1, 2}, {2, 1, 0}}));
    // Lines with too few or too many indices are not taken for others.
    expect_off_error(two + "3 0 1\n3 2 1 0\n", ":8:1", "face 2 of 2");
    expect_off_error(two + "3 0 1\n2 1 2 0\n", ":8:1", "face 2 of 2");
    expect_off_error(two + "3 0 1 2\n3 0 1\n", ":7:6", "ends where");
}

TEST(Off, BadBodies) {
    expect_off_error("OFF\n3 1 0\n" + points + "3 0 1 3\n", ":6:7", "vertex 3 (counted from 0)");
    expect_off_error("OFF\n3 1 0\n" + points + "3 0 1 -1\n", ":6:7", "negative");
    expect_off_error("OFF\n3 1 0\n" + points + "2 0 1 2 3 4\n", ":6:1", "2 corners");
    expect_off_error("OFF\n3 1 0\n" + points + "3 0 1 2\n3 0 1 2\n", ":7:1", "after the last");
    expect_off_error("OFF\n3 1 0\n" + points + "3 0 1 2 red\n", ":6:9", "'red'");
    expect_off_error("OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", ":3:5", "not finite");
    EXPECT_EQ(loops(off("OFF\n3 1 0\n" + points + "4 0 0 1 1\n# end\n\n")), (Loops{{0, 0, 1, 1}}));
}

}  // namespace
