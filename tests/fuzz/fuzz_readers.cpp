// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the readers. The first byte of an input chooses the format, unless TRISECT_FUZZ_FORMAT
// says its number. Any mesh that is read must be consistent and must come back bit for bit from
// what is written of it; so must exact boundaries and patches.
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/read_patches.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/kernel/error.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

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

// Which of `count` formats an input that begins with this byte is read as.
std::size_t format_of(std::uint8_t first, std::size_t count) {
    static const char* const only = std::getenv("TRISECT_FUZZ_FORMAT");
    return (only != nullptr ? std::strtoul(only, nullptr, 10) : first) % count;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::array formats{MeshFormat::Obj,      MeshFormat::Off,       MeshFormat::Ply,
                                 MeshFormat::StlAscii, MeshFormat::StlBinary, MeshFormat::Stl};
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::size_t choice = format_of(data[0], formats.size() + 2);
    try {
        if (choice == formats.size()) {
            const std::string text = trisect::exact_text(trisect::read_exact(bytes, "fuzz"));
            require(trisect::exact_text(trisect::read_exact(text, "again")) == text);
            return 0;
        }
        if (choice == formats.size() + 1) {
            const std::string text = trisect::patches_text(trisect::read_patches(bytes, "fuzz"));
            require(trisect::patches_text(trisect::read_patches(text, "again")) == text);
            return 0;
        }
        check(trisect::read_mesh(bytes, formats[choice], "fuzz"));
    } catch (const trisect::Error&) {
    }
    (void)trisect::detect_mesh_format(bytes);
    return 0;
}
