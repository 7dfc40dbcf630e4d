// SPDX-License-Identifier: Apache-2.0
//
// Unions of many triangles of the plane, as one boundary.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// Collects triangles, whichever way they run. Corners of equal coordinates are one.
class PlaneTriangles {
public:
    /// Left out when it is flat. \throw LimitError for corners that are not finite
    void add(const Point2d& a, const Point2d& b, const Point2d& c);
    /// From its first corner. The union is that of the triangles, whatever the outline.
    void add_fan(const Outline& outline);

    /// The union as prisms between z = 0 and z = 1, exact: for triangles that hang together by
    /// sides a mesh whose caps they are and whose walls are below their outline alone. It may
    /// overlap itself: evaluate() resolves it. O(n log n).
    [[nodiscard]] Expression prisms() const;

private:
    using Corners = std::array<std::uint32_t, 3>;
    using Side = std::array<std::uint32_t, 2>;
    [[nodiscard]] std::uint32_t number(const Point2d& p);
    /// Those that are not flat, counter-clockwise.
    [[nodiscard]] std::vector<Corners> turned_alike() const;
    [[nodiscard]] static std::vector<std::vector<Corners>> connected_parts(
        const std::vector<Corners>& triangles);
    [[nodiscard]] static std::vector<Side> outline(const std::vector<Corners>& triangles);
    [[nodiscard]] Solid prism(const std::vector<Corners>& triangles) const;

    std::map<Point2d, std::uint32_t> numbers_;
    std::vector<Point3d> points_;  ///< at z = 0
    std::vector<Corners> triangles_;
};

}  // namespace trisect::detail
