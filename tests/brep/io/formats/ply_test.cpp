// SPDX-License-Identifier: Apache-2.0
//
// PLY in its three encodings: any types, foreign elements, and headers that lie.
#include <trisect/brep/io/formats/binary.h>

#include "support/mesh_files.h"

#include <limits>

namespace ply_test {
namespace {

using namespace trisect;
using namespace trisect::io_test;
using detail::store;

PolygonMesh ply(const std::string& text) { return read(text, MeshFormat::Ply); }

void expect_ply_error(const std::string& text, const std::string& place, const std::string& part) {
    expect_error_at(text, MeshFormat::Ply, place, part);
}

const std::string vertex_element =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string face_element = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string ascii_header =
    "ply\nformat ascii 1.0\n" + vertex_element + face_element + "end_header\n";
const std::string points = "0 0 0\n1 0 0\n0 0.1 0\n";

TEST(Ply, Ascii) {
    const PolygonMesh m = ply(ascii_header + points + "3 0 1 2\n");
    EXPECT_EQ(m.points[2], (Point3d{0, 0.1, 0}));
    EXPECT_EQ(loops(m), (Loops{{0, 1, 2}}));
}

TEST(Ply, LineEndsCommentsAndBlankLines) {
    const PolygonMesh expected = ply(ascii_header + points + "3 0 1 2\n");
    EXPECT_EQ(ply("ply\ncomment a\nobj_info b\nformat ascii 1.0\n\n" + vertex_element +
                  face_element + "end_header\n\n" + points + "\n3 0 1 2\n\n \n"),
              expected);
    for (const std::string eol : {"\r\n", "\r"}) {
        std::string text;
        for (const char c : ascii_header + points + "3 0 1 2\n") {
            text += c == '\n' ? eol : std::string(1, c);
        }
        EXPECT_EQ(ply(text), expected);
    }
}

std::string binary_file(bool big, const std::string& eol) {
    std::string s = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                    "_endian 1.0\nelement extra 2\nproperty list short double a\nproperty int8 b\n"
                    "element face 1\nproperty uint16 flags\nproperty list uint64 uint16 "
                    "vertex_index\nproperty list uint8 float texcoord\n"
                    "element vertex 3\nproperty double nx\nproperty int16 z\nproperty double x\n"
                    "property list ushort uchar tags\nproperty int64 y\nelement none 99\n"
                    "end_header\n";
    std::string text;
    for (const char c : s) text += c == '\n' ? eol : std::string(1, c);
    store(text, std::int16_t{1}, big), store(text, 5.0, big), text += '\x01';
    store(text, std::int16_t{0}, big), text += '\x02';
    store(text, std::uint16_t{7}, big), store(text, std::uint64_t{3}, big);
    for (const int i : {2, 1, 0}) store(text, static_cast<std::uint16_t>(i), big);
    text += '\x01', store(text, 0.5F, big);
    for (int i = 0; i < 3; ++i) {
        store(text, std::numeric_limits<double>::quiet_NaN(), big);
        store(text, static_cast<std::int16_t>(-i), big), store(text, 0.1 * i, big);
        store(text, std::uint16_t{2}, big), text += "ab";
        store(text, std::int64_t{1000} * i, big);
    }
    return text;
}

TEST(Ply, BinaryWithAnyTypesAndElementsInAnyOrder) {
    for (const bool big : {false, true}) {
        for (const std::string eol : {"\n", "\r\n", "\r"}) {
            const PolygonMesh m = ply(binary_file(big, eol));
            EXPECT_EQ(m.points,
                      (std::vector<Point3d>{{0, 0, 0}, {0.1, 1000, -1}, {0.2, 2000, -2}}));
            EXPECT_EQ(loops(m), (Loops{{2, 1, 0}}));
        }
    }
}

TEST(Ply, NoFaces) {
    EXPECT_EQ(
        ply("ply\nformat ascii 1.0\n" + vertex_element + "end_header\n" + points).points.size(),
        3U);
    EXPECT_EQ(ply("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 0\nend_header"),
              PolygonMesh{});
}

TEST(Ply, BadHeaders) {
    const std::string start = "ply\nformat ascii 1.0\n";
    expect_ply_error("", ":1:1", "empty");
    expect_ply_error("plyx\n", ":1:1", "'ply'");
    expect_ply_error("ply\n", ":2:1", "ends inside the header");
    expect_ply_error("ply\nformat asci 1.0\n", ":2:8", "no PLY encoding");
    expect_ply_error("ply\nformat ascii 2.0\n", ":2:14", "version");
    expect_ply_error("ply\n" + vertex_element + "end_header\n", ":6:11", "no 'format'");
    expect_ply_error(start + "element vertex x\n", ":3:16", "not an integer");
    expect_ply_error(start + "element vertex -1\n", ":3:16", "negative");
    expect_ply_error(start + "element vertex 18446744073709551616\n", ":3:16", "too large");
    expect_ply_error(start + "property int a\n", ":3:1", "before the first element");
    expect_ply_error(start + "element a 1\nproperty foo a\n", ":4:10", "no PLY type");
    expect_ply_error(start + "element a 1\nproperty int\n", ":4:13", "missing");
    expect_ply_error(start + "element a 1\nproperty list float int b\n", ":4:15", "integer");
    expect_ply_error(start + "element a 1\nelement a 1\n", ":4:1", "second element");
    expect_ply_error(start + "element a 1 2\n", ":3:13", "unexpected");
    expect_ply_error(start + "nonsense\n", ":3:1", "in a PLY header");
    expect_ply_error(start + "end_header\n", ":4:1", "no element 'vertex'");
    expect_ply_error(start + "element vertex 1\nproperty float x\nend_header\n1\n", ":3:1",
                     "without x, y and z");
    expect_ply_error(start + vertex_element + "property float x\nend_header\n", ":7:1", "second");
    expect_ply_error(start + vertex_element + "element face 1\nproperty int a\nend_header\n",
                     ":7:1", "vertex_indices");
    expect_ply_error(start + vertex_element +
                         "element face 1\nproperty list uchar float "
                         "vertex_indices\nend_header\n",
                     ":8:1", "list of integers");
    expect_ply_error(start + vertex_element +
                         "element tristrips 1\nproperty list int int "
                         "vertex_indices\nend_header\n",
                     ":7:1", "strips");
    expect_ply_error(start + "element vertex 1\nproperty list int float x\nend_header\n", ":4:1",
                     "a list");
}

TEST(Ply, BadAsciiBodies) {
    expect_ply_error(ascii_header + "0 0 0\n1 0 0\n\n\n                    ", ":14:21",
                     "ends inside");
    expect_ply_error(ascii_header + "0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":10:4", "line ends");
    expect_ply_error(ascii_header + "0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":10:7", "unexpected");
    expect_ply_error(ascii_header + points + "3 0 1 3\n", ":13:7", "vertex 3 (counted from 0)");
    expect_ply_error(ascii_header + points + "3 0 1 -1\n", ":13:7", "negative");
    expect_ply_error(ascii_header + points + "3 0 1 1.5\n", ":13:7", "not a number");
    expect_ply_error(ascii_header + points + "2 0 1\n", ":13:1", "2 corners");
    expect_ply_error(ascii_header + points + "3 0 1 2\n0\n", ":14:1", "after the last entry");
    expect_ply_error(ascii_header + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", ":10:5", "not finite");
}

TEST(Ply, CountsAreHints) {
    for (const std::string format : {"ascii", "binary_little_endian"}) {
        for (const std::string n : {"4294967301", "9223372036854775807", "1000"}) {
            const std::string message =
                input_error("ply\nformat " + format + " 1.0\nelement vertex " + n +
                                "\nproperty uchar x\n"
                                "property uchar y\nproperty uchar z\nend_header\n0 0 0\n",
                            MeshFormat::Ply);
            EXPECT_NE(message.find("can hold"), std::string::npos) << message;
        }
    }
    const std::string endless =
        "ply\nformat binary_little_endian 1.0\n"
        "element nothing 9223372036854775807\n" +
        vertex_element + "end_header\n" + std::string(36, '\0');
    EXPECT_EQ(ply(endless).points.size(), 3U);
}

TEST(Ply, BinaryErrorsNameTheByte) {
    const std::string head = "ply\nformat binary_big_endian 1.0\n" + vertex_element +
                             "element face 1\nproperty list int64 int vertex_indices\n"
                             "end_header\n" +
                             std::string(36, '\0');
    const auto with_list = [&](std::int64_t n, std::int32_t last) {
        std::string s = head;
        store(s, n, true), store(s, 0, true), store(s, 1, true), store(s, last, true);
        return s;
    };
    const std::string count_at = ": byte " + std::to_string(head.size());
    const std::string last_at = ": byte " + std::to_string(head.size() + 16);
    const std::string end_at = ": byte " + std::to_string(head.size() + 20);
    EXPECT_EQ(ply(with_list(3, 2)).face_count(), 1U);
    EXPECT_EQ(ply(with_list(3, 2) + std::string("\0\n", 2)).face_count(), 1U);
    expect_ply_error(with_list(-1, 2), count_at, "negative");
    expect_ply_error(with_list(0, 2), count_at, "0 corners");
    expect_ply_error(with_list(3, 3), last_at, "vertex 3");
    expect_ply_error(with_list(3, -1), last_at, "negative");
    expect_ply_error(with_list(INT64_MAX, 2), end_at, "ends inside");
    expect_ply_error(with_list(3, 2) + "x", end_at, "more data");
    std::string nan = head;
    nan.replace(nan.size() - 32, 2, "\x7F\x80");
    expect_ply_error(nan + with_list(3, 2).substr(head.size()),
                     ": byte " + std::to_string(head.size() - 32), "not finite");
}

}  // namespace
}  // namespace ply_test
