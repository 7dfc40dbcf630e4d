// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the readers of models. The first byte of an input chooses the format, unless
// TRISECT_FUZZ_FORMAT says its number: GLB, AMF, the model part of a 3MF package (put into one
// here, since checksums stop mutations of packed text), whole 3MF packages, STEP and DXF. Any model
// that is read must keep its invariants and come back from what is written of it: of polygons, as
// STEP, every coordinate. Writing and reading again takes ten times as long as reading: with
// TRISECT_FUZZ_WRITTEN=N it is done for one of N inputs, which their bytes choose.
#include "stored_zip.h"

#include <trisect/brep/io/read_model.h>
#include <trisect/brep/io/write_model.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace {

using trisect::MeshFormat;
using trisect::Model;
using trisect::ModelPart;

void require(bool condition) {
    if (!condition) std::abort();
}

void check_invariants(const Model& model, bool has_triangles = true) {
    for (const ModelPart& part : model.parts) {
        const auto& mesh = part.mesh;
        require(mesh.face_begin.front() == 0 && mesh.face_begin.back() == mesh.corners.size());
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            require(mesh.face(f).size() >= 3);
            require(!has_triangles || mesh.face(f).size() == 3);
        }
        for (const std::uint32_t corner : mesh.corners) require(corner < mesh.points.size());
        for (const auto& p : mesh.points)
            for (const double c : p) require(std::isfinite(c));
        require(part.materials.empty() || part.materials.size() == mesh.face_count());
        for (const std::uint32_t m : part.materials)
            require(m == trisect::no_material || m < model.materials.size());
    }
}

bool is_plain(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

void check(const Model& model, bool written) {
    check_invariants(model);
    if (!written) return;
    const auto file = trisect::format_model(model, {.format = MeshFormat::ThreeMf});
    Model again = trisect::read_model(file.bytes, MeshFormat::ThreeMf, "again");
    check_invariants(again);
    Model expected = model;
    std::erase_if(expected.parts, [](const ModelPart& p) { return p.mesh.face_count() == 0; });
    require(again.parts.size() == expected.parts.size());
    for (std::size_t i = 0; i < again.parts.size(); ++i) {
        require(again.parts[i].mesh == expected.parts[i].mesh);
        require(again.parts[i].materials == expected.parts[i].materials);
        if (is_plain(expected.parts[i].name))
            require(again.parts[i].name == expected.parts[i].name);
    }
    const auto glb = trisect::format_model(model, {.format = MeshFormat::Glb});
    Model from_glb = trisect::read_model(glb.bytes, MeshFormat::Glb, "again");
    check_invariants(from_glb);
    require(trisect::merged(from_glb).face_count() == trisect::merged(expected).face_count());
}

std::vector<trisect::Point3d> used_points(const Model& model) {
    std::vector<trisect::Point3d> out;
    for (const ModelPart& part : model.parts)
        for (const std::uint32_t c : part.mesh.corners) out.push_back(part.mesh.points[c]);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// What STEP cannot hold, or loops that bound nothing, may be refused; nothing may change.
void check_polygons(const Model& model, bool written) {
    check_invariants(model, false);
    if (!written) return;
    const auto file = trisect::format_model(model, {.format = MeshFormat::Step});
    const Model again = trisect::read_model(file.bytes, MeshFormat::Step, "again");
    check_invariants(again, false);
    require(used_points(again) == used_points(model));
}

constexpr const char* relations =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Id=\"a\" Target=\"/a\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

unsigned long written_one_of() {
    static const char* const text = std::getenv("TRISECT_FUZZ_WRITTEN");
    static const unsigned long count = text != nullptr ? std::strtoul(text, nullptr, 10) : 1;
    return std::max(count, 1UL);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const char* const only = std::getenv("TRISECT_FUZZ_FORMAT");
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const auto choice = (only != nullptr ? std::strtoul(only, nullptr, 10) : data[0]) % 6;
    trisect::ReadOptions options;
    // An input has a thousand bytes: more than these come from copies alone, which take their time.
    options.limits.vertices = 1'000;
    options.limits.faces = 1'000;
    options.limits.instances = 8;
    options.limits.nesting = 16;
    options.limits.unpacked_bytes = 1 << 16;
    const bool written = fuzz::zip_checksum(bytes) % written_one_of() == 0;
    try {
        if (choice == 0)
            check(trisect::read_model(bytes, MeshFormat::Glb, "fuzz", options), written);
        if (choice == 1)
            check(trisect::read_model(bytes, MeshFormat::Amf, "fuzz", options), written);
        if (choice == 2) {
            const std::string package =
                fuzz::stored_zip({{"_rels/.rels", relations}, {"a", bytes}});
            check(trisect::read_model(package, MeshFormat::ThreeMf, "fuzz", options), written);
        }
        if (choice == 3)
            check(trisect::read_model(bytes, MeshFormat::ThreeMf, "fuzz", options), written);
        if (choice == 4)
            check_polygons(trisect::read_model(bytes, MeshFormat::Step, "fuzz", options), written);
        if (choice == 5)
            check_polygons(trisect::read_model(bytes, MeshFormat::Dxf, "fuzz", options), written);
    } catch (const trisect::Error& e) {
        require(e.code() != trisect::ErrorCode::Internal);
    }
    return 0;
}
