// SPDX-License-Identifier: Apache-2.0
//
// Native layout: header, sections and record sizes of native files.
//
// All numbers are little-endian. A header of 512 bytes; sections of records of one size each, every
// section at the next multiple of eight; then checksums of blocks of 64 KiB of all that, and one of
// these checksums. So the counts of records in the header determine each place and the size of the
// file. Padding is zero.
//
//     header: 0 magic, 8 version u32, 12 size of the header u32, 16 size of the file u64,
//             24 exponent of the lattice i32, 28 flags u32, 32 far out i32, 36 source u32,
//             40 box of positions: lo, hi 6 × i64, 88 listed polygons u64, 96 depth u64,
//             104 counts 13 × u64, 208 zeros, 504 checksum u64
//     source: 0 kind u8 (0 mesh, 1 planes), 1 same serial as the one before u8, 2 axes 3 × u8,
//             8 operand u32, 16 counts of points, triangles, faces, planes, names 5 × u64,
//             56 box of planes 6 × i64
//     point: 3 × f64, in lattice units. triangle: 3 × u32, points of its source
//     face: u32, of each triangle. plane: 4 integers of 384 bits. name: operand, face 2 × u32
//     node: in preorder; 0 axis u8 (3: a cell), 1 flags u8 (below, above complemented; mixed),
//           4 winding number i32, 8 number of the node above the splitting plane u64,
//           16 position i64, 24 the first cell of that node, or of a cell its own number u64
//     cell: 0 reference 3 × i64, 24 kind of list u32, 28 flipped u32, 32 source u32,
//           40 first u64, 48 count u64, 56 lie in the cell u64
//     facet: u32. polygon: source u32, facet u32, fragment + 1 u32, flags u32 (flipped, touched)
//     fragment: box 6 × i64, 48 first edge u64, 56 count u32
//     edge: 0 source or position i64, 8 facet or axis u32, 12 kind u8, 13 above u8,
//           16 where it begins 3 × f64, 40 its error f64
//     incomplete: source u32, facet u32
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <trisect/bsp/cells/cell.h>

namespace trisect::detail {

inline constexpr std::string_view native_magic{"\x89TRI\r\n\x1a\n", 8};
inline constexpr std::uint32_t native_version = 1;
inline constexpr std::size_t native_header_bytes = 512;
inline constexpr std::size_t native_block_bytes = std::size_t{1} << 16;

enum class NativeSection : std::uint8_t {
    Sources,
    Points,
    Triangles,
    Faces,
    Planes,
    Names,
    Nodes,
    Cells,
    Facets,
    Polygons,
    Fragments,
    Edges,
    Incomplete
};
inline constexpr std::size_t native_sections = 13;
inline constexpr std::array<std::size_t, native_sections> native_record_bytes{
    104, 24, 12, 4, 192, 8, 32, 64, 4, 16, 64, 48, 8};

namespace native_place {
// In the header.
inline constexpr std::size_t version = 8;
inline constexpr std::size_t header_bytes = 12;
inline constexpr std::size_t file_bytes = 16;
inline constexpr std::size_t exponent = 24;
inline constexpr std::size_t flags = 28;
inline constexpr std::size_t far_out = 32;
inline constexpr std::size_t source = 36;
inline constexpr std::size_t box = 40;
inline constexpr std::size_t polygons = 88;
inline constexpr std::size_t depth = 96;
inline constexpr std::size_t counts = 104;
inline constexpr std::size_t zeros = 208;
inline constexpr std::size_t checksum = 504;
}  // namespace native_place

/// Flags of the header.
struct NativeFlag {
    static constexpr std::uint32_t embedded = 1;
    static constexpr std::uint32_t whole = 2;
    static constexpr std::uint32_t lattice_matters = 4;
    static constexpr std::uint32_t complemented = 8;
    static constexpr std::uint32_t straight_crossings = 16;
    static constexpr std::uint32_t usual_offsets = 32;
    static constexpr std::uint32_t all = 63;
};

/// Flags of a node.
struct NativeNodeFlag {
    static constexpr unsigned below_complemented = 1;
    static constexpr unsigned above_complemented = 2;
    static constexpr unsigned mixed = 4;
};
inline constexpr unsigned native_leaf_axis = 3;

/// How a cell lists its polygons.
enum class NativeList : std::uint32_t {
    None,
    AllFacets,    ///< of a source
    WholeFacets,  ///< some of a source, by number
    Polygons
};

/// The numbers of a header, and where everything is.
struct NativeHeader {
    std::uint32_t version = native_version;
    std::int32_t exponent = 0;
    std::uint32_t flags = 0;
    std::int32_t far_out = 0;
    std::uint32_t source = 0;  ///< SolidState::source
    Box box;                   ///< of what is listed
    std::uint64_t polygons = 0;
    std::uint64_t depth = 0;
    std::array<std::uint64_t, native_sections> counts{};

    [[nodiscard]] std::uint64_t count(NativeSection s) const {
        return counts[static_cast<std::size_t>(s)];
    }
    [[nodiscard]] std::uint64_t& count(NativeSection s) {
        return counts[static_cast<std::size_t>(s)];
    }
    /// Where a section begins; where the checksums begin for native_sections.
    [[nodiscard]] std::uint64_t offset(std::size_t section) const {
        std::uint64_t at = native_header_bytes;
        for (std::size_t i = 0; i < section; ++i)
            at += (counts[i] * native_record_bytes[i] + 7) / 8 * 8;
        return at;
    }
    [[nodiscard]] std::uint64_t offset(NativeSection s) const {
        return offset(static_cast<std::size_t>(s));
    }
    [[nodiscard]] std::uint64_t checksums() const { return offset(native_sections); }
    [[nodiscard]] std::uint64_t blocks() const {
        return (checksums() + native_block_bytes - 1) / native_block_bytes;
    }
    [[nodiscard]] std::uint64_t file_bytes() const { return checksums() + 8 * (blocks() + 1); }
};

}  // namespace trisect::detail
