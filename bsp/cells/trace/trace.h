// SPDX-License-Identifier: Apache-2.0
//
// Exact changes of the winding number along a straight segment.
// The segment goes from a reference point to a target.
//
// The target is either a reference point of another cell or the barycentre of three vertices of a
// polygon. All signs come from doubles with proved bounds first and from wide integers when those
// cannot decide; when the segment runs through an edge, a vertex or along a face the trace reports
// it and the caller takes another target or another reference: nothing is perturbed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/number/bounded_int.h>

namespace trisect::detail {

/// The end of a segment: certified doubles, and the exact point on demand.
class TraceTarget {
public:
    explicit TraceTarget(const FinePoint& p);
    /// (w0 a + w1 b + w2 c) / (w0 + w1 + w2) for small positive weights: a point in the interior of
    /// the triangle a b c.
    TraceTarget(const Workbench& bench, const std::array<PointId, 3>& points,
                const std::array<std::int64_t, 3>& weights);

    [[nodiscard]] const Approximation& approximation() const { return approximation_; }

    // Coordinates xyz/w with |w| < 2^2984, |xyz| < 2^3040: three plane points of 988 and 1044 bits
    // over their common denominator. A value at an edge of where a segment to it crosses a plane
    // is below 2^4000.
    struct Exact {
        std::array<BoundedInt, 3> xyz;
        BoundedInt w;
    };
    [[nodiscard]] const Exact& exact() const;

private:
    Approximation approximation_;
    FinePoint fine_;
    const Workbench* bench_ = nullptr;
    std::array<PointId, 3> points_{};
    std::array<std::int64_t, 3> weights_{};
    mutable std::optional<Exact> exact_;
};

enum class Crossing : std::int8_t {
    Entering = 1,  ///< from above the support to below it
    Leaving = -1,
    None = 0,
    Degenerate = 2  ///< through an edge or vertex, along the polygon, or ending on it
};

/// Approximation of a reference point in lattice units.
[[nodiscard]] Approximation approximate(const FinePoint& p);
/// Side of a reference point.
[[nodiscard]] int side(const FinePoint& p, const Approximation& approximation, const Plane& plane);
/// Side of a target.
[[nodiscard]] int side(const TraceTarget& target, const Plane& plane);

/// Where a segment crosses a plane, in doubles. Nothing when they cannot decide that it does.
[[nodiscard]] std::optional<Approximation> approximate_crossing(const Approximation& from,
                                                                const Approximation& to,
                                                                const Plane& plane);

/// Where a segment crosses the support of a polygon. \pre its ends lie strictly on different sides.
class SupportCrossing {
public:
    SupportCrossing(const FinePoint& reference, const Approximation& approximation,
                    const TraceTarget& target, const Plane& support);
    /// -1 when the crossing lies below the plane, 1 above it, 0 on it.
    [[nodiscard]] int side_of(const Plane& edge) const;

private:
    const FinePoint& reference_;
    const TraceTarget& target_;
    const Plane& support_;
    std::optional<Approximation> approximation_;
};

}  // namespace trisect::detail
