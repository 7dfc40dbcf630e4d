// SPDX-License-Identifier: Apache-2.0
//
// Mesh file formats: names, extensions and recognition by content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace trisect {

enum class MeshFormat : std::uint8_t {
    Obj,
    Stl,        ///< reading: ASCII or binary, whichever the bytes are; writing: binary
    StlAscii,   ///< reading: refuse anything but ASCII
    StlBinary,  ///< reading: refuse anything but binary
    Off,
    Ply,      ///< the encoding stands in the file; for writing see WriteOptions
    ThreeMf,  ///< 3MF
    Glb,      ///< glTF 2.0 in one binary file
    Amf,
    Step,  ///< STEP, planar faces
    Dxf    ///< reading only: faces and meshes in three dimensions
};

/// "obj", "stl", "stl-ascii", "stl-binary", "off", "ply", "3mf", "glb", "amf", "step", "dxf".
[[nodiscard]] std::string_view to_string(MeshFormat format) noexcept;

/// The inverse of to_string; nothing for another word. Letters of either case.
[[nodiscard]] std::optional<MeshFormat> mesh_format_from_name(std::string_view name) noexcept;

/// The format that goes with the extension of `path` (.obj .stl .off .ply .3mf .glb .amf .step
/// .stp .dxf, either case).
[[nodiscard]] std::optional<MeshFormat> mesh_format_of_extension(const std::filesystem::path& path);

/// The format that the bytes themselves show, for data without a name that decides. PLY, OFF and
/// GLB have a magic word, a binary STL has exactly the size its count demands, an ASCII STL begins
/// with `solid`, and an OBJ file is recognised by the keyword of its first statement. A zip archive
/// is taken for 3MF, XML with an element `amf` in its first kilobyte for AMF. STEP begins
/// with `ISO-10303-21`, DXF with the group 0 SECTION.
[[nodiscard]] std::optional<MeshFormat> detect_mesh_format(std::string_view data) noexcept;

/// Whether a format has no faces of more than three corners.
[[nodiscard]] bool holds_triangles_only(MeshFormat format) noexcept;
/// Whether a format has single precision (binary STL, GLB).
[[nodiscard]] bool holds_floats(MeshFormat format) noexcept;

/// Tells the two kinds of STL apart; always StlAscii or StlBinary.
///
/// The word `solid` proves nothing: many binary files have it in their header. So the size decides
/// first: 84 + 50 n bytes with n the count at byte 80 is binary. A text cannot pass for that by
/// chance, because four bytes of text there would mean more than 150 million triangles (7.5 GB).
/// Otherwise (truncated or padded files) it is ASCII when it begins with `solid` and has no zero
/// byte among its first 84: a binary count below 2^24 always contains one.
[[nodiscard]] MeshFormat detect_stl_kind(std::string_view data) noexcept;

}  // namespace trisect
