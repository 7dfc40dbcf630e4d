// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/tree/exact_triangles.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace trisect::detail {

std::uint32_t ExactTriangles::number_of(const PolygonId& polygon) {
    const Key128 key{reinterpret_cast<std::uintptr_t>(polygon.leaf), polygon.number};
    const auto [number, is_new] = numbers_.insert(key, static_cast<std::int32_t>(polygons_.size()));
    if (is_new) polygons_.push_back({polygon, false, {}});
    return static_cast<std::uint32_t>(number);
}

ExactTriangles::Range ExactTriangles::triangles_of(std::uint32_t polygon) {
    if (!polygons_[polygon].is_made) make(polygons_[polygon], polygon);
    return polygons_[polygon].triangles;
}

void ExactTriangles::make(Polygon& polygon, std::uint32_t number) {
    const PolygonId& id = polygon.id;
    polygon.is_made = true;
    polygon.triangles.begin = static_cast<std::uint32_t>(triangles_.size());
    planes_.push_back(id.outward());
    if (id.is_triangle() && !id.reaches_out()) {
        const std::array<Point, 3> corners{Point(id.corner(0)), Point(id.corner(1)),
                                           Point(id.corner(2))};
        add(corners, id.is_flipped(), number);
    } else {
        const ConvexPolygon part = id.part();
        add(part.vertices(), id.is_flipped(), number);
    }
    polygon.triangles.end = static_cast<std::uint32_t>(triangles_.size());
}

// Equal points have equal nearest doubles; others may have, too.
std::uint32_t ExactTriangles::place_of(std::uint32_t triangle, std::size_t corner) {
    Triangle& t = triangles_[triangle];
    std::uint32_t& place = t.place[corner];
    if (place != no_place) return place;
    const Point& p = t.corner[corner];
    const Point3d at = p.nearest();
    std::uint64_t hash = 0;
    for (std::size_t k = 0; k < 3; ++k)
        hash = mix64(hash + std::bit_cast<std::uint64_t>(at[k] + 0.0));  // -0 is 0
    for (std::uint64_t attempt = 0;; ++attempt) {
        const auto [number, is_new] =
            places_.insert({hash, attempt}, static_cast<std::int32_t>(points_.size()));
        if (is_new) points_.push_back(&p);
        if (is_new || *points_[static_cast<std::size_t>(number)] == p)
            return place = static_cast<std::uint32_t>(number);
    }
}

// A fan. Corners are counter-clockwise seen from above the source's plane.
void ExactTriangles::add(std::span<const Point> corners, bool turned, std::uint32_t number) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        Triangle& t = triangles_.emplace_back();
        t.corner = {corners[0], corners[turned ? i : i - 1], corners[turned ? i - 1 : i]};
        t.plane = &planes_.back();
        t.polygon = number;
        t.lo.fill(HUGE_VAL);
        t.hi.fill(-HUGE_VAL);
        for (const Point& p : t.corner) {
            const Approximation& x = p.approximation();
            for (std::size_t k = 0; k < 3; ++k) {
                t.lo[k] = std::min(t.lo[k], x.c[k] - 1.001 * x.error);
                t.hi[k] = std::max(t.hi[k], x.c[k] + 1.001 * x.error);
            }
        }
    }
}

}  // namespace trisect::detail
