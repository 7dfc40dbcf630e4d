// SPDX-License-Identifier: Apache-2.0
//
// Native files: solids with their trees, exactly, in binary form.
// A file has all that a solid is: its lattice, the tree of cells, the facets and planes that its
// cells list, and the names of faces. What is read is the solid that was written, and writing it
// again gives the same bytes. docs/native.md describes the format.
//
// A result that has no tree yet is evaluated first, and leaves that were put off are arranged:
// files have no lazy parts. Of what was derived from a tree (grids, boxes, refinements) nothing is
// written.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

struct NativeWriteOptions {
    /// Large cells are divided as by Solid::refine(), and the file has those. For readers of single
    /// cells: an import is one cell otherwise. The set and the names of its faces do not change;
    /// Solid::source_id() of what is read is 0.
    bool divided = false;
    std::uint32_t threads = 0;  ///< 0: one for every processor; the bytes do not depend on it
};

/// The file is complete or not there: it is written under another name, flushed to the disk and
/// renamed. \throw Error (Input) when it cannot be written
void write_native(const Solid& solid, const std::filesystem::path& path,
                  const NativeWriteOptions& options = {});
/// The same bytes in memory.
[[nodiscard]] std::string native_bytes(const Solid& solid, const NativeWriteOptions& options = {});

/// What FaceSource::operand of the faces will be.
enum class NativeNames : std::uint8_t {
    /// What it was. Meshes that this process imports later get higher numbers; those that it
    /// imported before, and solids of other files, may have the same ones.
    Kept,
    /// A number that nothing else in this process has, for each number of the file, in the same
    /// order.
    Fresh
};

struct NativeReadOptions {
    NativeNames names = NativeNames::Kept;
    std::uint32_t threads = 0;         ///< 0: one for every processor
    std::uint64_t depth = 1ULL << 20;  ///< of the tree; deeper ones are refused
};

/// What the header says. Of a file that was opened, not yet of one that was read: only the header's
/// own checksum has been compared.
struct NativeInfo {
    std::uint32_t version = 0;
    Lattice lattice;
    /// Contain the boundary, in the user's units; infinite where it has no end, empty (lo > hi)
    /// where there is none.
    Bounds bounds;
    bool is_unbounded = false;  ///< the set contains what is far away, or half-spaces decide it
    std::uint64_t bytes = 0;
    std::uint64_t cells = 0;      ///< leaves of the tree
    std::uint64_t polygons = 0;   ///< listed in all cells
    std::uint64_t fragments = 0;  ///< of these, parts of facets, each once
    std::uint64_t sources = 0;    ///< imports and half-spaces that are listed
    std::uint64_t triangles = 0;  ///< of all sources
    std::uint64_t points = 0;
    std::uint64_t depth = 0;  ///< of the tree; 1: one cell
};

/// A polygon that is listed in a cell.
struct NativePolygon {
    FaceSource source;
    bool flipped = false;  ///< the solid is above it
    bool whole = false;    ///< a facet; it may reach out of the cell, or even miss it
    /// Counter-clockwise seen from above the facet; rounded, in the user's units. Empty for the
    /// facet of a half-space.
    std::vector<Point3d> corners;
};

struct NativeCell {
    Bounds bounds;            ///< rounded outwards; infinite at the ends of space
    Point3d reference{};      ///< in the cell, on no polygon
    int winding = 0;          ///< at the reference; without polygons, of the whole cell
    bool complement = false;  ///< inside is where the winding number is 0 or less
    std::vector<NativePolygon> polygons;
};

/// A native file, mapped into memory. Cheap to copy; safe to read from many threads.
///
/// Bytes are compared with their checksums block by block when they are first needed, so a cell
/// costs what is in it. A file that another program shortens in place while it is mapped ends this
/// process; write_native() replaces files and never does that.
class NativeFile {
public:
    /// \throw InputError with the place of what is wrong: no native file, another version, another
    /// size than the header says, a damaged header
    [[nodiscard]] static NativeFile open(const std::filesystem::path& path);
    /// The same of bytes in memory, which are copied; `name` stands for them in messages.
    [[nodiscard]] static NativeFile of_bytes(std::string bytes, const std::string& name);

    [[nodiscard]] const NativeInfo& info() const;
    /// Reads one of info().cells. \throw InputError where it is damaged; UsageError beyond the last
    [[nodiscard]] NativeCell cell(std::uint64_t number) const;
    /// Reads all. \throw InputError with the place of what is damaged or impossible; LimitError for
    /// a tree that is too deep
    [[nodiscard]] Solid solid(const NativeReadOptions& options = {}) const;

private:
    struct Data;
    explicit NativeFile(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

    std::shared_ptr<const Data> data_;
};

/// NativeFile::open(path).solid(options).
[[nodiscard]] Solid read_native(const std::filesystem::path& path,
                                const NativeReadOptions& options = {});

/// Whether bytes begin as a native file does.
[[nodiscard]] bool is_native(std::string_view bytes) noexcept;

}  // namespace trisect
