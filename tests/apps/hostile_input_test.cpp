// SPDX-License-Identifier: Apache-2.0
//
// Files made to break readers, one for each mistake that has broken one before: counts that lie,
// indices out of range, numbers that are none, sizes at the edge of a header, endless lines. Every
// command must end by itself, with a documented code and one document.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "process.h"
#include "scratch.h"

namespace {

using trisect::test::Finished;
using trisect::test::trisect;

struct HostileFile {
    std::string name;
    std::string bytes;
};

std::string binary_stl_header(unsigned char count) {
    std::string bytes(80, ' ');
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(count);
    return bytes;
}

std::vector<HostileFile> malformed_files() {
    const std::string long_name(1U << 21, 'a');
    return {
        {"empty.obj", ""},
        {"empty.stl", ""},
        {"empty.off", ""},
        {"empty.ply", ""},
        {"negative.obj", "f -4 -3 -2\n"},
        {"zero.obj", "v 0 0 0\nf 0 0 0\n"},
        {"huge_index.obj", "v 0 0 0\nf 1 1 18446744073709551617\n"},
        {"nan.obj", "v nan 0 0\n"},
        {"inf.obj", "v 0 inf 0\n"},
        {"half_number.obj", "v 1.5e 0 0\n"},
        {"bomb_number.obj", "v 1e999999999999 0 0\n"},
        {"long_line.obj", "v 0 0 " + long_name + "\n"},
        {"79.stl", std::string(79, 'x')},
        {"83.stl", std::string(83, '\0')},
        {"count.stl", binary_stl_header(0xff)},
        {"cut.stl", binary_stl_header(0) + "x"},
        {"long_name.stl", "solid " + long_name + "\nfacet normal 0 0 0\n"},
        {"no_end.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"},
        {"counts.off", "OFF\n4294967295 4294967295 0\n0 0 0\n"},
        {"sign.off", "OFF\n-1 -1 0\n"},
        {"range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"},
        {"corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"},
        {"count.ply",
         "ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n"
         "property double x\nproperty double y\nproperty double z\nend_header\n"},
        {"list.ply",
         "ply\nformat ascii 1.0\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n3 0 1 2\n"},
        {"no_end.ply", "ply\nformat ascii 1.0\nelement vertex 1\n"},
        {"name.xyz", "no format known to anybody"},
    };
}

/// Well-formed, but nothing that a solid should be made of.
std::vector<HostileFile> odd_files() {
    return {
        {"only_points.obj", "v 0 0 0\nv 1 1 1\n"},
        {"flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n"},
        {"one_point.obj", "v 0 0 0\nf 1 1 1\n"},
        {"wide.obj", "v 1e300 0 0\nv 0 1e-300 0\nv 0 0 1\nf 1 2 3\n"},
        {"subnormal.obj", "v 4.9e-324 0 0\nv 0 4.9e-324 0\nv 0 0 4.9e-324\nf 1 2 3\n"},
        {"none.stl", binary_stl_header(0)},
        {"none.off", "OFF\n0 0 0\n"},
    };
}

class HostileInput : public trisect::test::Scratch {
protected:
    /// Code and document of all commands that read the file.
    void expect_codes(const HostileFile& file, const std::set<int>& allowed) {
        const std::string name = write(file.name, file.bytes);
        const std::string cube = box("cube.obj", {0, 0, 0}, {1, 1, 1});
        const std::vector<std::vector<std::string>> runs{
            {"info", name},
            {"check", name},
            {"convert", name, "-o", path("out.ply")},
            {"union", cube, name, "-o", path("out.obj")},
            {"diff", name, cube}};
        for (std::vector<std::string> arguments : runs) {
            arguments.insert(arguments.end(), {"--json", "--max-seconds", "60"});
            const Finished result = trisect(arguments);
            EXPECT_EQ(result.signal, 0) << arguments[0] << ' ' << file.name;
            EXPECT_EQ(allowed.count(result.code), 1U)
                << arguments[0] << ' ' << file.name << ' ' << result.code << result.err;
            EXPECT_TRUE(result.json().is_object());
        }
    }
};

TEST_F(HostileInput, MalformedFilesAreRefused) {
    for (const HostileFile& file : malformed_files()) expect_codes(file, {3, 5});
}

TEST_F(HostileInput, OddFilesEndInDocumentedCodes) {
    for (const HostileFile& file : odd_files()) expect_codes(file, {0, 1, 4, 5, 7});
}

TEST_F(HostileInput, FolderIsNoFile) { expect_codes({"", ""}, {3}); }

}  // namespace
