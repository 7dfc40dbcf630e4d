// SPDX-License-Identifier: Apache-2.0
//
// Unions of many triangles of the plane, as one boundary.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// Collects triangles, whichever way they run. Corners of equal coordinates are one.
class PlaneTriangles {
public:
    /// Left out when it is flat. \throw LimitError for corners that are not finite
    void add(const Point2d& a, const Point2d& b, const Point2d& c);
    /// From its first corner. The union is that of the triangles, whatever the outline.
    void add_fan(const Outline& outline);

    /// An outline of a region with the region on its left, or of its holes. The union is that of
    /// the triangles and what all of these together go around.
    void add_loop(const Outline& outline);

    /// The union as a prism between z = 0 and z = 1, exact. Sides that two triangles pass in
    /// opposite directions are gone. O(n log n).
    [[nodiscard]] Solid prism() const;

private:
    using Corners = std::array<std::uint32_t, 3>;
    using Side = std::array<std::uint32_t, 2>;
    [[nodiscard]] std::uint32_t number(const Point2d& p);
    /// Those that are not flat, counter-clockwise.
    [[nodiscard]] std::vector<Corners> turned_alike() const;
    [[nodiscard]] std::vector<Side> outline(const std::vector<Corners>& triangles) const;

    std::map<Point2d, std::uint32_t> numbers_;
    std::vector<Point2d> points_;
    std::vector<Corners> triangles_;
    std::vector<Side> sides_;  ///< of loops
};

}  // namespace trisect::detail
