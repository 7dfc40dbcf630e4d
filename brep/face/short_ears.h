// SPDX-License-Identifier: Apache-2.0
//
// Triangulation of a large simple polygon by ears with short diagonals.
//
// The order in which ears are cut decides the shape of the triangles. Cutting along the outline
// gives fans of needles around single corners: the boxes of all of them overlap, and no division
// of space separates them. Cutting the ear with the shortest diagonal first halves smooth stretches
// again and again, so that a corner has few triangles, which get smaller towards the outline.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/number/flat_corner.h>

namespace trisect::detail {

/// Triangles of a polygon with the corners 0 .. size - 1, as triples of them. Holds scratch memory.
///
/// Every corner is used, no triangle has area zero, and no corner lies on a side of a triangle.
/// Simple loops are always triangulated. Cost: O(n log n) and the corners that do not turn left and
/// lie near the ears, a few for each ear in all shapes tried; at most O(n^2).
class ShortEars {
public:
    /// Below this, the order in which ears are cut matters little.
    static constexpr std::size_t least_corners = 64;

    /// Appends triangles, counter-clockwise. False, with nothing appended, when some part is left
    /// in which no corner is an ear. \pre size >= 3
    bool triangulate(std::span<const FlatCorner> corners,
                     std::vector<std::array<std::uint32_t, 3>>& out);

    /// Corners compared with ears by the last call.
    [[nodiscard]] std::uint64_t comparisons() const { return comparisons_; }

private:
    using Index = std::uint32_t;
    // A corner and its neighbours at the time when it was queued.
    struct Ear {
        double length;  // of the diagonal, squared and rounded: decides the order only
        Index at, prev, next;
    };
    struct LaterInQueue {
        bool operator()(const Ear& a, const Ear& b) const {
            return a.length != b.length ? a.length > b.length : a.at > b.at;
        }
    };
    // Corners that do not turn left, by cells of a grid over the polygon.
    struct Grid {
        double u = 0, v = 0;          // its lower corner
        double per_u = 0, per_v = 0;  // cells in a unit
        std::size_t columns = 1, rows = 1;
        std::vector<std::uint32_t> begin;  // of each cell, in `corners`
        std::vector<Index> corners;

        [[nodiscard]] std::size_t column_of(double at) const;
        [[nodiscard]] std::size_t row_of(double at) const;
    };

    void make_grid();
    void queue(Index at);
    [[nodiscard]] bool is_current(const Ear& ear) const;
    [[nodiscard]] bool is_clear(const Ear& ear);
    [[nodiscard]] bool is_clear_of_cell(std::size_t cell, const Ear& ear);

    std::span<const FlatCorner> corners_;
    std::vector<Index> prev_, next_;
    std::vector<std::uint8_t> cut_;
    std::vector<Ear> queue_;
    Grid grid_;
    std::uint64_t comparisons_ = 0;
};

}  // namespace trisect::detail
