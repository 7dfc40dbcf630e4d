// SPDX-License-Identifier: Apache-2.0
//
// Certified distances between points and triangles in the maximum norm.
//
// Exact points of results are fractions of hundreds of bits. Here they are rounded down to a grid
// 2^40 times as fine as the lattice, so that all arithmetic has a fixed width; what that can change
// is less than 2^-38 units of the lattice and is part of every bound. All lengths are in lattice
// units.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <trisect/brep/winding_number.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// Coordinates in units of 2^-grid_bits of the lattice, at most one of them below the exact ones.
using GridPoint = std::array<Int128, 3>;
inline constexpr int grid_bits = 40;
/// More than two points on the grid can be nearer or farther than the exact ones.
inline constexpr double grid_error = 0x1p-38;

[[nodiscard]] GridPoint to_grid(const Point& p);
[[nodiscard]] GridPoint to_grid(const LatticePoint& p);
/// Of a point in the user's units. \pre not outside the lattice's range
[[nodiscard]] GridPoint to_grid(const ExactPoint& p, Lattice lattice);

/// A triangle, prepared for distance queries. About 800 bytes.
///
/// The points within r of it in the maximum norm are its sum with the cube of radius r, a convex
/// polytope. Its faces are parallel to the triangle, to the cube's faces, or to an edge of each; so
/// the distance is the largest excess over the triangle's extent along one of these thirteen
/// normals n, divided by |n_x| + |n_y| + |n_z|. A degenerate triangle has fewer normals, and the
/// same holds.
class GridTriangle {
public:
    GridTriangle(const GridPoint& a, const GridPoint& b, const GridPoint& c);

    /// Not less than the distance of the exact point from the exact triangle; at most about
    /// 2·grid_error more, and 2^-48 of it. Stops early with some bound above `enough`.
    [[nodiscard]] double upper_distance(
        const GridPoint& p, double enough = std::numeric_limits<double>::infinity()) const;
    [[nodiscard]] const std::array<GridPoint, 3>& corners() const { return corner_; }

private:
    struct Slab {  // along an edge's normal e × e_axis, whose component at axis is 0
        int u = 0, v = 0;
        Int128 nu = 0, nv = 0;
        WideInt<3> low, high;
        double length = 0;  // |nu| + |nv|; 0: none
    };

    std::array<GridPoint, 3> corner_;
    GridPoint low_{}, high_{};
    std::array<Slab, 9> slabs_;
    std::array<WideInt<3>, 3> normal_;
    double normal_length_ = 0;
};

/// Triangles that can be searched for the nearest one. Immutable.
class GridTriangles {
public:
    /// O(n log n).
    explicit GridTriangles(std::vector<GridTriangle> triangles);

    [[nodiscard]] bool empty() const { return triangles_.empty(); }
    [[nodiscard]] const GridTriangle& operator[](std::uint32_t i) const { return triangles_[i]; }

    struct Nearest {
        std::uint32_t triangle = 0;
        double upper = std::numeric_limits<double>::infinity();  ///< certified
        double lower = 0;                                        ///< certified
    };
    /// \pre !empty()
    [[nodiscard]] Nearest nearest(const GridPoint& p) const;
    /// Triangles that may be within `radius` of the point, and some others; at most `limit`.
    void near(const GridPoint& p, double radius, std::size_t limit,
              std::vector<std::uint32_t>& out) const;

private:
    struct Box {
        std::array<double, 3> low{}, high{};  // contains the triangles, rounding included
        [[nodiscard]] double distance(const std::array<double, 3>& p) const;
    };
    struct Node {
        Box box;
        std::uint32_t begin = 0, end = 0;  // into order_
        std::uint32_t right = 0;           // 0: leaf; the left child follows its parent
    };
    [[nodiscard]] static Box box_of(const GridTriangle& t);
    std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::vector<Box>& boxes);

    std::vector<GridTriangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace trisect::detail
