// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the mesh readers with libFuzzer; not part of the normal build. The first byte of an
// input chooses the format. Any mesh that is read must be consistent and must come back bit for bit
// from what is written of it. From the root of the repository, with an include folder INC in which
// `trisect/kernel` and `trisect/brep` are the source folders:
//
//   clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -IINC
//       tests/fuzz/fuzz_readers.cpp brep/io/*.cpp -o fuzz_readers
//   ./fuzz_readers -max_len=4096 -timeout=10 -rss_limit_mb=2048 CORPUS_FOLDER
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/kernel/error.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace {

using trisect::MeshFormat;

void require(bool condition) {
    if (!condition) std::abort();
}

void check(const trisect::PolygonMesh& mesh) {
    require(mesh.face_begin.front() == 0 && mesh.face_begin.back() == mesh.corners.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) require(mesh.face(f).size() >= 3);
    for (const std::uint32_t corner : mesh.corners) require(corner < mesh.points.size());
    const MeshFormat formats[] = {MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply};
    for (const MeshFormat format : formats) {
        const auto file = trisect::format_mesh(mesh, {.format = format});
        require(trisect::read_mesh(file.bytes, format, "again") == mesh);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::array formats{MeshFormat::Obj,      MeshFormat::Off,       MeshFormat::Ply,
                                 MeshFormat::StlAscii, MeshFormat::StlBinary, MeshFormat::Stl};
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        check(trisect::read_mesh(bytes, formats[data[0] % formats.size()], "fuzz"));
    } catch (const trisect::Error&) {
    }
    (void)trisect::detect_mesh_format(bytes);
    return 0;
}
