// SPDX-License-Identifier: Apache-2.0
//
// ClippedPolygon: the part of a leaf's polygon in the leaf's cell, in doubles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/query/index/index_polygons.h>
#include <trisect/kernel/support/spares.h>

namespace trisect::detail {

/// Corners of a convex polygon, seen from above the support of its source counter-clockwise. Every
/// coordinate is within `error` of the exact one.
struct ClippedPolygon {
    std::vector<std::array<double, 3>> corners;
    double error = 0;
    /// Nothing was cut off: the corners are those that the polygon has in IndexPolygons.
    bool is_all = false;

    [[nodiscard]] bool is_empty() const { return corners.empty(); }
};

/// Errors of corners of clipped polygons, relative to the largest coordinate of the polygons that a
/// leaf lists. Corners that doubles put less well are rounded from exact ones.
inline constexpr double clipped_error = 0x1p-44;

/// Clips polygons of one leaf, one after the other.
class PolygonClipper {
public:
    /// \pre `most_error` > 0, if any coordinate is not 0
    PolygonClipper(const IndexPolygons& polygons, double most_error)
        : polygons_(polygons), most_error_(most_error) {}

    /// Empty when the polygon misses the open cell. Valid until the next call.
    [[nodiscard]] const ClippedPolygon& clip(IndexPolygons::Id id);

private:
    struct Corner {
        std::array<double, 3> c{};
        double error = 0;
    };

    struct Arrays {
        std::vector<Corner> corners;
        std::vector<Corner> next;
        ClippedPolygon result;
        [[nodiscard]] std::size_t bytes() const {
            return (corners.capacity() + next.capacity() + result.corners.capacity()) *
                   sizeof(Corner);
        }
    };

    void begin(IndexPolygons::Id id);
    [[nodiscard]] bool ends_at(std::size_t axis, std::int64_t wall) const;
    [[nodiscard]] bool clip_by_walls();
    [[nodiscard]] bool clip_by_wall(std::size_t axis, std::int64_t wall, double sign);
    [[nodiscard]] bool clip_by(std::size_t axis, double wall, double sign);
    void take_exact(IndexPolygons::Id id);

    const IndexPolygons& polygons_;
    double most_error_;
    std::span<const EdgeName> edges_;  // of a fragment
    Spare<Arrays> arrays_;
    std::vector<Corner>& corners_ = arrays_->corners;
    std::vector<Corner>& next_ = arrays_->next;
    ClippedPolygon& result_ = arrays_->result;
    bool is_all_ = false;
};

}  // namespace trisect::detail
