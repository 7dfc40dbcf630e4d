// SPDX-License-Identifier: Apache-2.0
//
// Mesh readers: OBJ, STL, OFF and PLY into PolygonMesh.
// STL may be ASCII or binary; PLY has all three encodings. 3MF, GLB, AMF, STEP and DXF are read,
// too, as one mesh of all their parts (read_model.h).
//
// What is kept: every coordinate as the double nearest to its text, or the exact value of its
// float; every polygon with its loop as written, also when corners repeat or the polygon has no
// area (validation reports those, a reader does not repair); every vertex, also unused ones, in
// the order of the file. STL has no indices: corners with equal coordinates become one vertex
// (-0.0 equals 0.0; the first one's spelling stays), numbered by first appearance.
//
// What is ignored: normals, texture coordinates, colours and materials (read_model keeps them where
// asked), groups, lines, points and, in PLY, every other element and property.
//
// What is refused, with its place: a number that is not finite or does not end where its word ends;
// an index out of range; a face with fewer than three corners; a file that ends early; anything but
// white space (and, in binary files, zero bytes) after the end of the data, since dropping what may
// be a part of the model is worse than an error. Counts in headers never cause an allocation that
// the size of the file does not justify.
//
// Byte order marks, CR LF, and files with bare CR line ends are read. The leniencies of one format
// are listed at the top of its source file (obj.cpp, stl.cpp, off.cpp, ply.cpp).
#pragma once

#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/polygon_mesh.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace trisect {

/// Limits for one file. Going beyond is a LimitError that names the place.
struct ReadLimits {
    std::uint64_t bytes = std::uint64_t{2} << 30;
    std::uint64_t vertices = 50'000'000;  ///< at most 2^32 - 2 in any case
    std::uint64_t faces = 100'000'000;
    std::uint64_t loop_corners = 1'000'000;    ///< corners of one face
    std::uint64_t line_bytes = 1U << 20;       ///< one line of text
    std::uint64_t literal_characters = 4'096;  ///< one number in text
    std::uint64_t nesting = 64;                ///< of elements, components, nodes
    std::uint64_t entities = 100'000'000;      ///< of a STEP file
    std::uint64_t instances = 100'000;         ///< of meshes, where files place them
    std::uint64_t archive_entries = 10'000;
    std::uint64_t unpacked_bytes = std::uint64_t{2} << 30;    ///< of an archive's read entries
    std::uint64_t property_numbers = std::uint64_t{1} << 28;  ///< at corners, in all
    std::uint64_t unpacked_ratio = 250;  ///< to the packed size, of entries beyond a megabyte
};

struct ReadOptions {
    std::optional<MeshFormat> format;  ///< default: by extension, else by content
    ReadLimits limits;
    /// read_model: also materials of OBJ and PLY, textures, and properties of corners (OBJ, PLY,
    /// GLB, 3MF). Costs another pass over the file, and the memory.
    bool properties = false;
    /// Where files are that the file names (material libraries, pictures); without it they are not
    /// looked for. read_model takes that of its path.
    std::optional<std::filesystem::path> folder = {};
};

/// Reads a file. Errors: InputError (unreadable, unknown format, malformed), LimitError.
/// Cost: linear in the size of the file; holds the file and the mesh in memory.
[[nodiscard]] PolygonMesh read_mesh(const std::filesystem::path& path,
                                    const ReadOptions& options = {});

/// The format in which read_mesh(path, options) reads a file that holds `data`.
/// \throw InputError when it is not recognised.
[[nodiscard]] MeshFormat mesh_format_of(const std::filesystem::path& path, std::string_view data,
                                        const ReadOptions& options = {});

/// Reads bytes that are already in memory; `name` stands for the file in messages and
/// `options.format` is not looked at.
[[nodiscard]] PolygonMesh read_mesh(std::string_view data, MeshFormat format,
                                    const std::string& name, const ReadOptions& options = {});
[[nodiscard]] PolygonMesh read_mesh(std::span<const std::byte> data, MeshFormat format,
                                    const std::string& name, const ReadOptions& options = {});

/// Takes a mesh that is larger than memory.
class MeshSink {
public:
    virtual ~MeshSink() = default;
    /// What follows in the file: points, and faces whose corners count the points of all pieces and
    /// may be of pieces that come later.
    virtual void take(const PolygonMesh& piece) = 0;
};

/// Whether read_mesh_in_pieces() reads a format: OBJ, OFF, PLY and STL.
[[nodiscard]] bool is_read_in_pieces(MeshFormat format) noexcept;

/// The same mesh as read_mesh(), and the same errors, but no more than some thousand points and
/// faces of it in memory at a time. Corners of STL are not connected: each is a point.
/// `data` may be a mapped file.
/// \throw as read_mesh(); UnsupportedError for another format
void read_mesh_in_pieces(std::string_view data, MeshFormat format, const std::string& name,
                         MeshSink& sink, const ReadOptions& options = {});

}  // namespace trisect
