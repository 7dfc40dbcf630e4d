// SPDX-License-Identifier: Apache-2.0
//
// Facets of one plane, by their corners.
// No plane is made, which takes several times as long as one sign, and memory that threads share.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/bsp/assembly/parts/boundary_facet.h>
#include <trisect/kernel/number/orientation.h>
#include <trisect/kernel/number/triangle_normal.h>

namespace trisect::detail {

using FacetPoints = std::array<Vector3, 3>;

[[nodiscard]] inline FacetPoints facet_points(const Source& source, std::uint32_t facet) {
    return {source.corner(facet, 0).doubles(), source.corner(facet, 1).doubles(),
            source.corner(facet, 2).doubles()};
}

/// Whether a facet and a point lie in one plane across an axis, as those of caps mostly do.
[[nodiscard]] inline bool are_across_one_axis(const FacetPoints& facet, const Vector3& point) {
    for (std::size_t k = 0; k < 3; ++k)
        if (facet[0][k] == point[k] && facet[1][k] == point[k] && facet[2][k] == point[k])
            return true;
    return false;
}

/// The side of a facet's plane on which a point is; nothing where digits are too many for that.
[[nodiscard]] inline std::optional<int> side_of_facet(const FacetPoints& facet,
                                                      const Vector3& point) {
    for (const Vector3& corner : facet)
        if (corner == point) return 0;
    if (are_across_one_axis(facet, point)) return 0;
    if (const int side = filtered_orientation(facet[0], facet[1], facet[2], point); side != 0)
        return side;
    return exact_orientation_of_fractions(facet[0], facet[1], facet[2], point);
}

/// Whether normals along one line point the same way; nothing where one may be 0 along the axis
/// where the first is longest.
[[nodiscard]] inline std::optional<bool> point_alike(const TriangleNormal& a,
                                                     const TriangleNormal& b) {
    const std::size_t k = a.longest_axis();
    if (std::fabs(a.n[k]) <= a.error[k] || std::fabs(b.n[k]) <= b.error[k]) return std::nullopt;
    return (a.n[k] > 0) == (b.n[k] > 0);
}

/// Whether two facets, each with its normal, lie in one plane and face the same way in the result.
/// Exact; mostly they have an edge in common, and one sign decides. Nothing where neither corners
/// nor normals do. \pre neither is of a half-space
[[nodiscard]] inline std::optional<bool> face_alike(const BoundaryFacet& a,
                                                    const TriangleNormal& of_a,
                                                    const BoundaryFacet& b,
                                                    const TriangleNormal& of_b) {
    const FacetPoints facet = facet_points(*a.source, a.facet);
    for (const Vector3& corner : facet_points(*b.source, b.facet)) {
        const std::optional<int> side = side_of_facet(facet, corner);
        if (!side) return std::nullopt;
        if (*side != 0) return false;
    }
    const std::optional<bool> alike = point_alike(of_a, of_b);
    if (!alike) return std::nullopt;
    return *alike == (a.flipped == b.flipped);
}

}  // namespace trisect::detail
