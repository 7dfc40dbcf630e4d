// SPDX-License-Identifier: Apache-2.0
//
// Records of native files, as they are read.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/native/native_view.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

struct SourceRecord {
    bool has_planes = false;
    bool same_serial = false;
    std::array<std::uint8_t, 3> axes{};
    std::uint32_t operand = 0;
    // How many of each, and the number of the first one.
    struct Part {
        std::uint64_t first = 0;
        std::uint64_t count = 0;
    };
    Part points, triangles, faces, planes, names;
    Box box;

    [[nodiscard]] bool is_half_space() const {
        return has_planes && planes.count == 1 && box.hi[0] == coordinate_limit;
    }
    [[nodiscard]] std::uint64_t facets() const {
        return has_planes ? planes.count : triangles.count;
    }
};

/// All of a file, with the sums of their counts compared with the header's.
[[nodiscard]] std::vector<SourceRecord> source_records(const NativeView& view);

struct NodeRecord {
    unsigned axis = 0;
    unsigned flags = 0;
    std::int32_t winding = 0;
    std::uint64_t above = 0;
    std::int64_t position = 0;
    std::uint64_t leaf = 0;

    [[nodiscard]] bool is_leaf() const { return axis == native_leaf_axis; }
};
/// Checked by itself, not against its neighbours.
[[nodiscard]] NodeRecord node_record(const NativeView& view, std::uint64_t number);

struct CellRecord {
    FinePoint reference;
    NativeList kind = NativeList::None;
    bool flipped = false;
    std::uint32_t source = 0;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    std::uint64_t contained = 0;
};
[[nodiscard]] CellRecord cell_record(const NativeView& view, std::uint64_t number);

struct PolygonRecord {
    std::uint32_t source = 0;
    std::uint32_t facet = 0;
    std::uint32_t fragment = 0;  ///< plus one; 0: the whole facet
    bool flipped = false;
    bool touched = false;
};
[[nodiscard]] PolygonRecord polygon_record(const NativeView& view, std::uint64_t number,
                                           std::span<const SourceRecord> sources);

struct FragmentRecord {
    Box box;
    std::uint64_t first = 0;
    std::uint32_t count = 0;
};
[[nodiscard]] FragmentRecord fragment_record(const NativeView& view, std::uint64_t number);

/// \throw InputError unless it is a coordinate
[[nodiscard]] LatticePoint point_record(const NativeView& view, std::uint64_t number);
/// \throw InputError unless all are numbers of points of the source
[[nodiscard]] std::array<std::uint32_t, 3> triangle_record(const NativeView& view,
                                                           const SourceRecord& source,
                                                           std::uint64_t number);

}  // namespace trisect::detail
