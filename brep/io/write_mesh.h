// SPDX-License-Identifier: Apache-2.0
//
// Mesh writers: OBJ, STL, OFF and PLY.
// STL may be ASCII or binary; PLY has all three encodings.
//
// Text holds the shortest digits that read back as the same double, PLY holds doubles, so every
// format except binary STL gives each coordinate back bit for bit (-0.0 and subnormals included).
// Binary STL has floats only; what that changes is in the report. STL has no indices either: when
// such a file is read again, equal vertices are one, unused ones are gone and numbers follow first
// appearance.
//
// Lines are as long as their face: reading a text with a face of some 100,000 corners back takes a
// higher ReadLimits::line_bytes.
#pragma once

#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/polygon_mesh.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trisect {

enum class PlyEncoding : std::uint8_t { Ascii, BinaryLittleEndian, BinaryBigEndian };

struct WriteOptions {
    std::optional<MeshFormat> format;  ///< default: by extension
    PlyEncoding ply_encoding = PlyEncoding::BinaryLittleEndian;
    /// Write textures and properties of corners, in OBJ and PLY also materials. Refused for formats
    /// other than OBJ, PLY, GLB and 3MF.
    bool properties = false;
};

/// What writing did to the coordinates. Only binary STL ever does anything.
struct WriteReport {
    bool lossless = true;              ///< no coordinate changed
    std::size_t rounded_vertices = 0;  ///< vertices with a changed coordinate
    double largest_move = 0;          ///< largest change of one coordinate, in the unit of the mesh
    std::size_t merged_vertices = 0;  ///< how many fewer distinct vertices there are by rounding
    std::vector<std::string> left_out = {};  ///< properties that the format does not hold
    friend bool operator==(const WriteReport&, const WriteReport&) = default;
};

/// A file that belongs beside another one.
struct SideFile {
    std::string name;  ///< without a folder
    std::string bytes;
};

struct FormattedMesh {
    std::string bytes;
    WriteReport report;
    std::vector<SideFile> files = {};  ///< with properties: a material library, pictures
};

/// The bytes of a file. Deterministic; `name` stands for the file in messages.
///
/// Errors: UsageError for a mesh that breaks the invariants of PolygonMesh, has a face with fewer
/// than three corners or a coordinate that is not finite, and for WriteOptions without a format;
/// UnsupportedError for a face with more than three corners in STL; LimitError for a coordinate
/// beyond the range of float or more than 2^32 - 1 faces in binary STL.
[[nodiscard]] FormattedMesh format_mesh(const PolygonMesh& mesh, const WriteOptions& options,
                                        const std::string& name = "mesh");

/// Writes a file: under a temporary name in the same folder, renamed when complete (see
/// output_file.h). Errors: as format_mesh, and Error with ErrorCode::Input naming the file when the
/// system refuses; then the folder is as it was.
WriteReport write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh,
                       const WriteOptions& options = {});

}  // namespace trisect
