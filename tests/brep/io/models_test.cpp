// SPDX-License-Identifier: Apache-2.0
//
// Real files, from the folder that the environment variable TRISECT_MODELS names.
#include "support/mesh_files.h"

#include <iostream>

namespace {

using namespace trisect;
using namespace trisect::io_test;
namespace fs = std::filesystem;

TEST(Models, AllAreReadOrRefusedWithAPlace) {
    const char* folder = std::getenv("TRISECT_MODELS");
    if (folder == nullptr || !fs::is_directory(folder)) {
        std::cout << "TRISECT_MODELS names no folder: real files not tested\n";
        return;
    }
    int meshes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || !mesh_format_of_extension(entry.path())) continue;
        const std::string name = entry.path().filename().string();
        try {
            const PolygonMesh mesh = read_mesh(entry.path());
            EXPECT_NE(name, "notenoughindices.obj");
            EXPECT_EQ(mesh.face_count() == 0, name.starts_with("empty")) << name;
            const FormattedMesh again = format_mesh(mesh, {.format = MeshFormat::Obj});
            EXPECT_TRUE(same_bits(read(again.bytes, MeshFormat::Obj), mesh)) << name;
            ++meshes;
        } catch (const InputError& e) {
            EXPECT_EQ(name, "notenoughindices.obj") << e.what();
            EXPECT_EQ(e.place().line, 9U) << e.what();
        }
    }
    std::cout << meshes << " files read\n";
}

}  // namespace
