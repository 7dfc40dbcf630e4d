// SPDX-License-Identifier: Apache-2.0
//
// ExactTriangles: the exact triangles of a solid's polygons, on demand.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>
#include <trisect/bsp/query/index/polygon_id.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// For one question. Triangles are those of polygons' parts in their cells; numbers count up.
class ExactTriangles {
public:
    static constexpr std::uint32_t no_place = 0xffffffffU;
    struct Triangle {
        std::array<Point, 3> corner;   ///< counter-clockwise seen from outside
        const Plane* plane = nullptr;  ///< outward
        std::uint32_t polygon = 0;     ///< a number of this
        std::array<double, 3> lo{};    ///< bounds, outward
        std::array<double, 3> hi{};
        std::array<std::uint32_t, 3> place{no_place, no_place, no_place};  ///< see place_of()
        [[nodiscard]] PosedTriangle posed() const {
            return {{&corner[0], &corner[1], &corner[2]}, plane};
        }
    };
    /// Numbers of triangles.
    struct Range {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
    };

    /// Of a polygon, the number that it has from now on.
    [[nodiscard]] std::uint32_t number_of(const PolygonId& polygon);
    [[nodiscard]] const PolygonId& polygon(std::uint32_t number) const {
        return polygons_[number].id;
    }
    /// Made at the first call for a polygon.
    [[nodiscard]] Range triangles_of(std::uint32_t polygon);
    /// Stays where it is.
    [[nodiscard]] const Triangle& operator[](std::uint32_t triangle) const {
        return triangles_[triangle];
    }
    /// The same number for all corners of these triangles that are one point, exactly. Made when
    /// first asked for, since it rounds the point to the nearest doubles.
    [[nodiscard]] std::uint32_t place_of(std::uint32_t triangle, std::size_t corner);

private:
    struct Polygon {
        PolygonId id;
        bool is_made = false;
        Range triangles;
    };
    void make(Polygon& polygon, std::uint32_t number);
    void add(std::span<const Point> corners, bool turned, std::uint32_t number);

    std::vector<Polygon> polygons_;
    std::deque<Triangle> triangles_;
    std::deque<Plane> planes_;
    FlatMap numbers_;
    FlatMap places_;
    std::vector<const Point*> points_;  // of places
};

}  // namespace trisect::detail
