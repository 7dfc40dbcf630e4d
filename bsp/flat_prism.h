// SPDX-License-Identifier: Apache-2.0
//
// Prisms over regions of the plane that are given by outlines.
// Booleans of such prisms between the same two heights are booleans of the regions: an arrangement
// of segments, as exact as those of solids and much cheaper. All other operations take them as
// solids; what these need of a solid is made when they do.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// A closed polygon without a repeated last corner, as Outline of brep/primitives/point_2d.h.
using FlatOutline = std::vector<std::array<double, 2>>;

/// What is inside of outlines that overlap, cross or touch themselves and each other.
enum class OutlineRule : std::uint8_t {
    Odd,      ///< where an odd number of them go around
    Positive  ///< where more go around counter-clockwise than clockwise
};

/// The prism over the region between two heights; empty where it has no area. Corners are taken as
/// they are, as by an import. O(n), and O(n log n) when it is used.
/// \throw UsageError unless low < high; LimitError for corners that are not finite
[[nodiscard]] Solid flat_prism(std::span<const FlatOutline> outlines, OutlineRule rule, double low,
                               double high);

/// The prism over the region that directed sides go around, on their left more often than on their
/// right. \pre at each corner as many sides come as go
[[nodiscard]] Solid flat_prism(std::span<const std::array<double, 2>> corners,
                               std::span<const std::array<std::uint32_t, 2>> sides, double low,
                               double high);

/// Its corners under a map, rounded once. Nothing where the map tilts it, so that walls are not
/// along an axis of space any more.
[[nodiscard]] std::optional<Solid> flat_prism(std::span<const FlatOutline> outlines,
                                              OutlineRule rule, double low, double high,
                                              const AffineMap& map);

/// The region of such a prism along the z axis: outlines counter-clockwise, holes clockwise, each
/// without corners where it goes straight on. Corners that are crossings of others' sides, and no
/// doubles, are rounded, once.
struct FlatOutlines {
    std::vector<std::array<double, 2>> points;
    std::vector<std::vector<std::uint32_t>> loops;
    double low = 0;
    double high = 0;
    bool is_exact = true;  ///< nothing was rounded

    [[nodiscard]] std::vector<FlatOutline> outlines() const;
};
/// Nothing for any other solid, and for the empty set. O(n log n) where it was not resolved yet.
[[nodiscard]] std::optional<FlatOutlines> flat_outlines(const Solid& solid);

/// Triangles over the points of flat_outlines(), counter-clockwise. \pre it has such outlines
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> flat_triangles(const Solid& solid);

/// The value of a formula over such prisms along one axis between the same two heights, as
/// evaluate() finds it. Nothing for any other formula.
[[nodiscard]] std::optional<Solid> evaluate_flat_prisms(const Expression& expression,
                                                        const EvaluateOptions& options = {});

/// The prism over the same region between other heights, exact. Nothing for any other solid.
[[nodiscard]] std::optional<Solid> flat_prism_between(const Solid& solid, double low, double high);

}  // namespace trisect
