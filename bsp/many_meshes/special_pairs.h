// SPDX-License-Identifier: Apache-2.0
//
// Pairs of facets of many meshes that doubles leave open.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/leaf/doubles/single_box.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/special_position.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// Decides whole facets of different operands, by their numbers, as if operands were moved. Notes
/// those that touch, and what is wanted where they cover a part of a plane together.
class SpecialPairs {
public:
    SpecialPairs(const ManyMeshes& meshes, SpecialPosition& special)
        : meshes_(meshes), special_(special) {}

    /// Where they cross. \pre first < second
    [[nodiscard]] std::optional<FacetCrossing> crossing(std::uint32_t first, std::uint32_t second);

    /// A number above 0 for the plane of a facet across an axis; else 0.
    [[nodiscard]] std::uint32_t plane_across_axis(std::uint32_t facet) const {
        const PlanesAcrossAxes::Plane& plane = meshes_.planes.of(facet);
        return plane.way == 0 ? 0 : plane.first + 1;
    }
    struct InCell {
        std::uint32_t plane = 0;  ///< above 0
        std::uint32_t facet = 0;
        std::uint32_t slot = 0;
        SingleBox box;  ///< of its part there
    };
    /// What crossing() does for all pairs of facets of a plane across an axis at once: one of the
    /// first and one of the second list, which are sorted by that. Without arithmetic for most
    /// pairs: each facet looks for one that it touches, and two operands for one pair of facets
    /// that cover a part of the plane.
    void look_at_planes(std::span<const InCell> first, std::span<const InCell> second);

private:
    /// Facets that have been found to lie in the plane of another one.
    struct InPlane {
        std::uint32_t of = none;  ///< that one
        bool turned = false;      ///< they face opposite ways
    };
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    [[nodiscard]] InPlane in_plane(std::uint32_t facet) const {
        const PlanesAcrossAxes::Plane& plane = meshes_.planes.of(facet);
        if (plane.way != 0) return {plane.first, plane.way != meshes_.planes.of(plane.first).way};
        return planes_.empty() ? InPlane() : planes_[facet];
    }
    void look_at_plane(std::span<const InCell> first, std::span<const InCell> second);
    void note_plane(std::uint32_t first, std::uint32_t second, bool same_side);
    // Whether nothing more can be wanted of their operands there.
    bool look_at_plane(std::uint32_t first, std::uint32_t second, bool same_side, bool are_equal);
    [[nodiscard]] int growth_along(std::uint32_t slot, std::uint32_t facet) const;

    const ManyMeshes& meshes_;
    SpecialPosition& special_;
    std::vector<InPlane> planes_;  // by facet across no axis, once there are some
    FlatMap settled_;              // planes and operands of which it is known what is wanted
};

}  // namespace trisect::detail
