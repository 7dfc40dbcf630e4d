// SPDX-License-Identifier: Apache-2.0
//
// ConvexBody: a convex body, grown over triangles of a boundary.
//
// What keeps it on its side of the boundary: no triangle reaches into its interior, and it lies
// below the planes of the triangles that it has grown over. The interior is connected, so it is all
// on the side that is below the first one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/primitives/hull_facets.h>
#include <trisect/bsp/modelling/pieces/cover_boundary.h>

namespace trisect::detail {

class ConvexBody {
public:
    /// The flags say of each triangle whether it needs no body any more. Marks the boundary's
    /// triangles.
    ConvexBody(CoverBoundary& boundary, std::span<const std::uint8_t> covered, std::uint32_t seed);

    [[nodiscard]] const std::vector<std::uint32_t>& corners() const { return corners_; }
    /// Triangles in it: all of them near a solid one, those of a flat one.
    [[nodiscard]] std::vector<std::uint32_t> covered_triangles();
    [[nodiscard]] bool is_flat() const { return facets_.empty(); }
    /// Whether a plane of a facet has this body on one side and points on the other.
    [[nodiscard]] bool is_kept_apart_from(std::span<const std::uint32_t> points);

private:
    using Facets = std::vector<HullFacets::Facet>;

    void grow();
    void grow_in_plane();
    [[nodiscard]] bool may_grow_over(std::uint32_t triangle) const;
    [[nodiscard]] bool try_to_add(std::uint32_t triangle);
    [[nodiscard]] bool try_to_add_in_plane(std::uint32_t triangle, std::uint32_t from);
    [[nodiscard]] bool is_below_all(std::uint32_t triangle, std::span<const std::uint32_t> added);
    [[nodiscard]] bool is_free(const Facets& facets, std::span<const std::uint32_t> corners,
                               std::span<const std::uint32_t> added);
    [[nodiscard]] bool turns_left(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    [[nodiscard]] PointBox box_of(std::span<const std::uint32_t> corners) const;
    void add(std::uint32_t triangle);

    CoverBoundary* boundary_;
    std::span<const std::uint8_t> covered_;
    std::vector<std::uint32_t> triangles_;  // in the order in which they were added
    std::vector<std::uint32_t> corners_;    // extreme ones; of a flat one in order
    Facets facets_;  // by numbers of the boundary's points; none of a flat one
};

}  // namespace trisect::detail
