// SPDX-License-Identifier: Apache-2.0
//
// ObbParts: division of triangles into parts with oriented boxes.
// Trees of boxes are built with it, from the top.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// Triangles in an order in which each part is a range. Dividing a part changes the order within
/// it, and nothing else. In units of a power of two about an origin, such that the triangles are
/// within [-1, 1]^3.
class ObbParts {
public:
    struct Part {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        AreaFrame frame;
        [[nodiscard]] std::uint32_t size() const { return end - begin; }
    };

    ObbParts() = default;
    /// `triangles` index `positions`, which are within `error` of the exact points; not none.
    ObbParts(std::span<const std::array<double, 3>> positions, double error,
             std::vector<std::array<std::uint32_t, 3>> triangles);
    /// Other triangles, in memory that there is: `put` writes three corners for each, one after the
    /// other, in units already; halves of boxes grow by `slack`. Frames are those of some of the
    /// triangles, as any frame will do. There is no origin, unit or radius. \pre made without
    /// positions
    template <class Put>
    void assign(std::uint32_t triangles, double slack, const Put& put) {
        slack_ = slack;
        samples_ = few_samples;
        points_.resize(std::size_t{3} * triangles);
        put(std::span(points_));
        set_items();
    }
    /// What halves of boxes in such units must grow by.
    [[nodiscard]] static double slack_of(double error, double unit) {
        return 0x1p-48 + 2 * (0x1p-50 + error / unit);
    }

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(items_.size()); }
    [[nodiscard]] const std::array<double, 3>& origin() const { return origin_; }
    [[nodiscard]] double unit() const { return unit_; }
    /// All triangles are within this distance of the origin, in units.
    [[nodiscard]] double radius() const { return radius_; }

    [[nodiscard]] Part whole() const { return part(0, size()); }
    [[nodiscard]] Part part(std::uint32_t begin, std::uint32_t end) const;
    /// Four parts, or fewer where there are not as many with more than `leaf` triangles to divide:
    /// how many.
    [[nodiscard]] std::size_t divide(const Part& part, std::uint32_t leaf,
                                     std::array<Part, 4>& parts);
    /// Writes a part's box into a lane. A bound on the distance of the box from the origin.
    double put(const Part& part, ObbNode& node, std::uint32_t lane) const;

    /// By place in the order.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t place) const {
        return items_[place].triangle;
    }
    /// \pre not after assign().
    [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t triangle) const {
        return corners_[triangle];
    }
    [[nodiscard]] std::size_t bytes() const {
        return corners_.capacity() * sizeof(corners_[0]) + points_.capacity() * sizeof(points_[0]) +
               items_.capacity() * sizeof(items_[0]);
    }

private:
    static constexpr std::uint32_t few_samples = 24;

    struct Item {
        std::uint32_t triangle = 0;
        std::array<float, 3> center{};
    };

    void set_unit(std::span<const Vector3> positions);
    void set_items();
    [[nodiscard]] const Vector3& corner(std::uint32_t t, std::size_t i) const {
        return points_[corners_.empty() ? std::size_t{3} * t + i : corners_[t][i]];
    }
    [[nodiscard]] std::array<Part, 2> halves(const Part& part);
    [[nodiscard]] bool has_rough_frames() const { return samples_ == few_samples; }
    [[nodiscard]] static float along(const std::array<float, 3>& u, const Item& i) {
        return u[0] * i.center[0] + u[1] * i.center[1] + u[2] * i.center[2];
    }

    std::array<double, 3> origin_{};
    double unit_ = 1;
    double radius_ = 0;
    double slack_ = 0;
    std::uint32_t samples_ = 0xffffffffU;                // triangles that a frame is made of
    std::vector<std::array<std::uint32_t, 3>> corners_;  // if empty, three points for each
    std::vector<Vector3> points_;
    std::vector<Item> items_;
};

/// Marks all lanes of a node from one on as not used.
inline void close_lanes(ObbNode& node, std::size_t from) {
    for (std::size_t i = from; i < 4; ++i)
        for (Float4& h : node.half) h[i] = -1e30F;
}

}  // namespace trisect::detail
