// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers at the corners of a block of cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/query/index/index_polygons.h>

namespace trisect::detail {

/// A polygon in the coordinates of a block: its first corner is 0, the edges of its cells are 1.
/// Coordinates are within 2^-50 of the largest one involved.
struct BlockItem {
    std::array<std::array<double, 3>, 3> corner{};  ///< of triangles
    std::array<double, 3> lo{};                     ///< contains the polygon, up to rounding
    std::array<double, 3> hi{};
    IndexPolygons::Id id = 0;
    bool is_triangle = false;
};

/// All corners are connected by straight lines along the axes: along x everywhere, along y where x
/// = 0, along z where x = y = 0. A polygon changes the winding number where it crosses a line. That
/// is found polygon by polygon, in doubles: a triangle seen along the axis contains the line's
/// point or does not, and few lines meet the box of a small triangle at all. What doubles cannot
/// decide is decided exactly, segment by segment (`passing`, which moves one end symbolically);
/// where doubles can, that would have the same answer.
class IndexWindings {
public:
    using Vector = std::array<double, 3>;

    explicit IndexWindings(const IndexPolygons& polygons) : polygons_(&polygons) {}

    /// Begins anew; n corners along each axis, at origin + i · step, all of them doubles.
    void reset(const Vector& origin, const Vector& step, const std::array<std::uint32_t, 3>& n);
    /// Counts the crossings of a polygon. False when a corner lies on it.
    [[nodiscard]] bool add(const BlockItem& item);
    /// Sums up, given the winding number at the first corner.
    void finish(std::int32_t start);
    /// x fastest.
    [[nodiscard]] const std::vector<std::int32_t>& windings() const { return winding_; }
    [[nodiscard]] std::int32_t at(std::size_t x, std::size_t y, std::size_t z) const {
        return winding_[(z * n_[1] + y) * n_[0] + x];
    }

private:
    template <std::size_t Axis>
    [[nodiscard]] bool add_along(const BlockItem& item, double margin, double largest);
    template <std::size_t Axis>
    [[nodiscard]] bool add_quickly(const BlockItem& item, std::array<std::uint32_t, 3> line,
                                   double largest);
    [[nodiscard]] bool add_exactly(const BlockItem& item, std::size_t axis,
                                   std::array<std::uint32_t, 3> line);
    [[nodiscard]] FinePoint corner(const std::array<std::uint32_t, 3>& at) const;
    [[nodiscard]] std::size_t number(const std::array<std::uint32_t, 3>& at) const {
        return (std::size_t{at[2]} * n_[1] + at[1]) * n_[0] + at[0];
    }

    const IndexPolygons* polygons_;
    Vector origin_{};
    Vector step_{};
    std::array<std::uint32_t, 3> n_{};
    std::vector<std::int32_t> winding_;  // at first the change on the way to a corner
};

/// The exact position of a double in 1/192 units. \pre it is a multiple of 1/64.
[[nodiscard]] std::int64_t fine_position(double v);

}  // namespace trisect::detail
