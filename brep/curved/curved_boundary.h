// SPDX-License-Identifier: Apache-2.0
//
// CurvedBoundary: Bézier patches that together bound a solid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/curved/bezier_patch.h>

namespace trisect {

/// Patches whose sides close: each side is a curve that exactly one other side runs through in the
/// other direction, with bit for bit the same control points, and weights that are the same up to
/// one power of two. A side whose control points are all equal is a point, as at the poles of a
/// sphere, and has no partner.
///
/// That makes a closed surface by combinatorics alone; that it does not pass through itself is up
/// to the caller, and `validate` checks its tessellations.
///
/// Immutable value.
class CurvedBoundary {
public:
    /// Sides of a patch in counter-clockwise order: v = 0, u = 1, v = 1, u = 0.
    struct Side {
        std::uint32_t patch = 0;
        std::uint32_t number = 0;
        friend bool operator==(const Side&, const Side&) = default;
    };

    /// \throw UsageError naming patch and side when a side has no partner, more than one, or is a
    /// curve that comes back the way it went.
    explicit CurvedBoundary(std::vector<BezierPatch> patches);

    [[nodiscard]] std::span<const BezierPatch> patches() const { return patches_; }
    /// Whether a side is a point.
    [[nodiscard]] bool is_point(Side side) const;
    /// The other side along the same curve. \pre the side is not a point
    [[nodiscard]] Side partner(Side side) const;

private:
    std::vector<BezierPatch> patches_;
    std::vector<std::array<Side, 4>> partners_;  // itself for a point
};

namespace detail {

/// The control points of a side in counter-clockwise order around its patch. Weights are divided by
/// a power of two so that the largest is at least 1/2 and below 1.
struct SideCurve {
    std::vector<Point3d> points;
    std::vector<double> weights;
    [[nodiscard]] SideCurve reversed() const;
    [[nodiscard]] bool is_point() const;
    friend auto operator<=>(const SideCurve&, const SideCurve&) = default;
};
[[nodiscard]] SideCurve side_curve(const BezierPatch& patch, std::uint32_t number);

}  // namespace detail

}  // namespace trisect
