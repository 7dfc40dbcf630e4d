// SPDX-License-Identifier: Apache-2.0
//
// PointInLeaf: location of a point in a mixed cell.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/query/index/index_signs.h>
#include <trisect/bsp/query/index/polygon_id.h>

namespace trisect::detail {

/// Steps of locating one point, apart from each other so that many points can go together: each
/// needs other memory. The first ones use only what is kept with the leaf, in single precision with
/// proved bounds; the last one decides exactly what these left open.
class PointInLeaf {
public:
    using Id = IndexedLeaf::Id;
    /// As if the leaf were not turned.
    enum class Answer : std::uint8_t { Outside, Inside, Open };

    /// \pre the cell is mixed, and the place is known to 2^-23 of it where `precise`.
    /// `turned`: for the names of polygons.
    void begin(const IndexedLeaf& index, bool turned, const IndexedLeaf::Cell& cell,
               const IndexGrid::Position& at, bool precise);
    /// From the leaf alone. When it is open, `wanted` are the polygons that will be looked at,
    /// of the first 64.
    [[nodiscard]] Answer decide();
    [[nodiscard]] std::uint64_t wanted() const { return near_ != 0 ? near_ : unsure_; }
    /// After an open answer. When polygons contain the point they are added to `on`, and what is
    /// returned has no meaning.
    [[nodiscard]] bool finish(const IndexPoint& p, std::vector<PolygonId>& on);
    /// The rank of the normals of the polygons found, or 0 where single precision does not decide.
    [[nodiscard]] int rank() const;

private:
    enum class Kind : std::uint8_t { List, Few, Many };
    static constexpr unsigned no_corner = 8;

    [[nodiscard]] Answer trace();
    [[nodiscard]] std::uint64_t narrowed(std::uint64_t open) const;
    [[nodiscard]] int passed(Id id, const IndexPoint& p, const Reference& reference,
                             std::vector<PolygonId>& on) const;
    [[nodiscard]] int winding_past(std::uint64_t polygons, const IndexPoint& p,
                                   std::vector<PolygonId>& on) const;
    [[nodiscard]] FinePoint corner_point() const;
    [[nodiscard]] bool finish_many(const IndexPoint& p, std::vector<PolygonId>& on);
    [[nodiscard]] bool trace_to_reference(const IndexPoint& p, std::vector<PolygonId>& on) const;

    const IndexedLeaf* index_ = nullptr;
    bool turned_ = false;
    const IndexLeaf* leaf_ = nullptr;
    IndexedLeaf::Cell cell_;
    IndexGrid::Position at_;
    std::array<float, 3> place_{};
    Kind kind_ = Kind::List;
    unsigned corner_ = no_corner;  // that a segment is traced to
    int winding_ = 0;              // of what is known of the segment
    std::uint64_t all_ = 0;
    std::uint64_t above_ = 0;  // planes that have the point surely below them, and so on
    std::uint64_t below_ = 0;
    std::uint64_t opposite_ = 0;  // surely between the point and the corner
    std::uint64_t near_ = 0;      // polygons that may contain the point
    std::uint64_t unsure_ = 0;    // that the segment may meet
    std::uint64_t on_ = 0;        // that contain the point
};

}  // namespace trisect::detail
