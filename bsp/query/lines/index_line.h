// SPDX-License-Identifier: Apache-2.0
//
// IndexLine: a query ray or segment of an index.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/index_polygons.h>

namespace trisect::detail {

/// The points origin + t · direction, 0 <= t <= limit, in lattice units.
class IndexLine {
public:
    /// \throw UsageError when a coordinate is not finite or the direction is 0.
    IndexLine(const Ray& ray, Lattice lattice);
    IndexLine(const Segment& segment, Lattice lattice);

    [[nodiscard]] const IndexPoint& origin() const { return origin_; }
    [[nodiscard]] const std::array<double, 3>& direction() const { return direction_; }
    /// Every component of the direction is within this of its exact value.
    [[nodiscard]] double direction_error() const { return direction_error_; }
    /// Exactly 0.
    [[nodiscard]] bool is_parallel(std::size_t axis) const { return parallel_[axis]; }
    /// Whether doubles locate the line: errors are finite, and nothing is near overflow.
    [[nodiscard]] bool is_moderate() const { return moderate_; }
    /// 1 for segments, infinite for rays.
    [[nodiscard]] double limit() const { return limit_; }
    [[nodiscard]] bool is_segment() const { return segment_.has_value(); }

    [[nodiscard]] const IndexPoint::Rational& exact_direction() const;
    [[nodiscard]] RayParameter meet(const Plane& plane) const;
    [[nodiscard]] RayParameter begin() const { return RayParameter(0); }
    /// \pre is_segment()
    [[nodiscard]] RayParameter end() const { return RayParameter(1); }
    [[nodiscard]] IndexPoint at(const RayParameter& t) const { return at(t.exact()); }
    [[nodiscard]] IndexPoint at(const ExactRational& t) const;

private:
    void find_moderate();

    Lattice lattice_;
    std::optional<Segment> segment_;
    Ray ray_;
    IndexPoint origin_;
    std::array<double, 3> direction_{};
    double direction_error_ = 0;
    std::array<bool, 3> parallel_{};
    double limit_ = 0;
    bool moderate_ = false;
    mutable std::optional<IndexPoint::Rational> exact_direction_;
};

/// How a line meets a polygon. Bounds of the parameter contain the exact one.
struct LineContact {
    enum class Kind : std::uint8_t {
        None,
        Crossing,  ///< in one point of the open polygon
        Point,     ///< in one point, perhaps of an edge or corner
        Interval   ///< the line lies in the polygon's plane; part of it, or a point
    };
    Kind kind = Kind::None;
    double lo = 0;
    double hi = 0;
};

/// The contact within 0 <= t <= limit, exactly.
[[nodiscard]] LineContact meet(const IndexPolygons& polygons, IndexPolygons::Id id,
                               const IndexLine& line);

/// The exact ends of a contact that `meet` found.
struct ContactEnds {
    RayParameter enter;
    RayParameter leave;
};
[[nodiscard]] ContactEnds ends_of(const IndexPolygons& polygons, IndexPolygons::Id id,
                                  const IndexLine& line, const LineContact& contact);

}  // namespace trisect::detail
