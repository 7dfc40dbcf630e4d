// SPDX-License-Identifier: Apache-2.0
//
// Measures of solids: volume, area, centroid, bounds and counts.
//
// They are sums over the facets of the boundary; no B-rep is made. A boundary that may meet itself
// is resolved first, so all of them are measures of the set. The functions of brep/measure.h
// measure boundaries, as they are.
#pragma once

#include <cstddef>
#include <optional>

#include <trisect/brep/exact_point.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// Exact, and correctly rounded. 0 for the empty set. The double takes at most about as long as
/// to_mesh() on one thread, area() and bounds() too; the exact fraction a microsecond more for each
/// triangle whose corners booleans have made, and with n such corners it has about n times their
/// bits.
/// \throw UnsupportedError for an unbounded set; what evaluate() throws, for a boundary that must
/// be resolved.
[[nodiscard]] ExactRational exact_volume(const Solid& solid);
[[nodiscard]] double volume(const Solid& solid);

/// Of the boundary, for a complement as well. \throw UnsupportedError when the boundary is
/// unbounded
[[nodiscard]] Area area(const Solid& solid);

/// The centre of mass; nothing for the empty set. \throw as exact_volume
[[nodiscard]] std::optional<ExactPoint> exact_centroid(const Solid& solid);
[[nodiscard]] std::optional<Point3d> centroid(const Solid& solid);

/// Nothing for the empty set and whole space. \throw UnsupportedError for other unbounded sets
[[nodiscard]] std::optional<Bounds> bounds(const Solid& solid);

/// What to_mesh() has once a boundary that may meet itself is resolved. One that touches itself has
/// its vertices once.
struct SolidCounts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    friend bool operator==(const SolidCounts&, const SolidCounts&) = default;
};
/// \throw UnsupportedError when the boundary is unbounded
[[nodiscard]] SolidCounts counts(const Solid& solid);

}  // namespace trisect
