// SPDX-License-Identifier: Apache-2.0
//
// Boundary: triangles of a solid in oriented boxes.
// It is what walks and filters of pairs see of a solid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/kernel/lattice.h>

namespace trisect::detail {

class InsideBalls;

/// Triangles that fill the boundary and have at most points of their sides in common. All numbers
/// are in lattice units.
class Boundary {
public:
    Boundary() = default;
    Boundary(const Boundary&) = delete;
    Boundary& operator=(const Boundary&) = delete;
    virtual ~Boundary() = default;

    /// Oriented boxes around the triangles; named by their numbers.
    ObbTree boxes;
    /// The exact points are within `position_error` of these.
    std::vector<std::array<double, 3>> positions;
    double position_error = 0;
    /// The largest magnitude of a coordinate of a position.
    double largest = 0;
    /// Bounds of the solid, outward. Of an empty one lo = hi = 0.
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};
    Lattice lattice;

    /// For walks. \pre not empty
    [[nodiscard]] BoxedTriangles boxed() const {
        return {&boxes, &positions, position_error, largest};
    }
    /// By the triangle's number.
    [[nodiscard]] virtual TriangleCorners corners_of(std::uint32_t triangle) const = 0;
    /// Whether a triangle is known to meet others in common corners and sides only: where two such
    /// triangles of two solids cross, the solids overlap.
    [[nodiscard]] virtual bool is_clear(std::uint32_t triangle) const = 0;
    /// Whether a triangle is certainly all that there is of the boundary within `reach` of a point,
    /// in each coordinate, and the boundary's points there are in it.
    [[nodiscard]] virtual bool is_alone_at(std::uint32_t /*triangle*/,
                                           const std::array<double, 3>& /*point*/,
                                           double /*reach*/) const {
        return false;
    }
    /// Balls inside, made after some questions; or null.
    [[nodiscard]] virtual const InsideBalls* balls_in_time() const { return nullptr; }
};

}  // namespace trisect::detail
