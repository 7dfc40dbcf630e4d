// SPDX-License-Identifier: Apache-2.0
//
// FlatFigure: lines and vertices of the plane, and what is exact about them.
// Doubles with proved bounds decide first; else planes across the figure do, as of solids.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <trisect/bsp/cells/flat/flat_region.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

/// The plane through a line across the plane of u and v. It is above it on the line's right.
[[nodiscard]] Plane flat_plane(const FlatRegion::Line& line);
/// Where two lines cross. \pre they are not parallel
[[nodiscard]] Approximation flat_approximation(const FlatRegion::Line& p,
                                               const FlatRegion::Line& q);
/// The exact point.
[[nodiscard]] Point flat_point(const FlatRegion& region, const FlatRegion::Vertex& vertex);

/// Mutable, for one thread.
class FlatFigure {
public:
    using Index = std::uint32_t;
    using Line = FlatRegion::Line;
    using Vertex = FlatRegion::Vertex;

    std::vector<Line> lines;
    std::vector<Vertex> vertices;

    /// The same number for equal corners.
    [[nodiscard]] Index corner(const FlatCorner& at);
    /// A vertex where two lines cross; a corner where both are along axes.
    [[nodiscard]] Index crossing(Index p, Index q);

    /// 1: the vertex is to the left of the line, 0: on it.
    [[nodiscard]] int side(Index line, Index vertex) const;
    /// Of the directions of two lines: 1 where the second one is to the left of the first.
    [[nodiscard]] int cross(Index p, Index q) const;
    /// Whether u comes after v along a line that both lie on.
    [[nodiscard]] int compare_along(Index line, Index u, Index v) const;
    /// Order by one coordinate, and lexicographic.
    [[nodiscard]] int compare_u(Index p, Index q) const;
    [[nodiscard]] int compare(Index p, Index q) const;

private:
    [[nodiscard]] const Plane& plane(Index line) const;
    [[nodiscard]] int exact_side(Index line, const Vertex& v) const;
    [[nodiscard]] int exact_compare(Index p, Index q, int axis) const;
    [[nodiscard]] Point point(Index v) const;
    void grow_table();

    std::vector<Index> table_;  // of corners by value, open addressing
    std::size_t corners_ = 0;
    mutable std::unordered_map<Index, Plane> planes_;
};

}  // namespace trisect::detail
