// SPDX-License-Identifier: Apache-2.0
//
// Point: an exact point of a boundary.
// It is a lattice point or the common point of three planes (a PlanePoint).
#pragma once

#include <array>
#include <compare>
#include <memory>

#include <trisect/kernel/point3d.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

/// A point named by three planes that meet in exactly it.
struct PlanePoint {
    std::array<Plane, 3> planes;
    HomogeneousPoint exact;
};

/// A point in lattice units, exact.
///
/// Immutable value; copying shares the planes (72 bytes here, about 1250 bytes shared by all copies
/// of a plane point). A plane point with whole coordinates within the lattice's range is turned
/// into a lattice point, so for these `is_lattice` is a property of the point, not of its history.
/// One that falls on fractions stays a plane point; equality does not see the difference. Safe to
/// read from many threads.
class Point {
public:
    Point() = default;
    Point(const LatticePoint& p) : lattice_(p), approximation_(approximate(p)) {}  // NOLINT
    /// \pre the planes meet in exactly one point.
    Point(const Plane& p, const Plane& q, const Plane& r);

    [[nodiscard]] bool is_lattice() const { return planes_ == nullptr; }
    /// \pre is_lattice()
    [[nodiscard]] const LatticePoint& lattice() const { return lattice_; }
    /// Null for lattice points.
    [[nodiscard]] const PlanePoint* plane_point() const { return planes_.get(); }
    [[nodiscard]] const Approximation& approximation() const { return approximation_; }
    [[nodiscard]] HomogeneousPoint homogeneous() const;
    /// Correctly rounded coordinates in lattice units.
    [[nodiscard]] Point3d nearest() const;

    /// Exact equality of the points, however they are named.
    friend bool operator==(const Point& a, const Point& b);

private:
    LatticePoint lattice_;
    std::shared_ptr<const PlanePoint> planes_;
    Approximation approximation_;
};

[[nodiscard]] Side side_of(const Point& point, const Plane& plane);
/// Order of two points along a coordinate axis.
[[nodiscard]] std::strong_ordering compare_coordinate(const Point& a, const Point& b, int axis);
/// Lexicographic order by x, y, z; a total order of points.
[[nodiscard]] std::strong_ordering compare_lexicographic(const Point& a, const Point& b);

}  // namespace trisect
