// SPDX-License-Identifier: Apache-2.0
//
// PartHalves: boxes of the two halves of a part of a facet.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

namespace trisect::detail {

/// Of parts of a solid whose middle, along the axis that they are longest along, no edge goes
/// through: what others have cut out of a long facet may leave both of its ends.
class PartHalves {
public:
    PartHalves() = default;
    explicit PartHalves(const OutlinedSolid& solid)
        : solid_(&solid), least_length_(long_part * length_of(solid.box)) {}

    /// Nothing where an edge goes through the middle, where the facet is whole, and where the part
    /// is short beside the solid. O(edges of the facet)
    [[nodiscard]] std::optional<std::array<OutlineBox, 2>> of(const OutlinedSolid::Facet& facet,
                                                              const OutlineBox& box) const {
        if (facet.whole || facet.count < least_edges || length_of(box) < least_length_)
            return std::nullopt;
        return of_long(facet, box);
    }

private:
    static constexpr std::uint32_t least_edges = 6;  // of two loops
    static constexpr double long_part = 0.25;        // of the solid; of others few boxes are met

    [[nodiscard]] static double length_of(const OutlineBox& b) {
        return std::max(std::max(b.hi[0] - b.lo[0], b.hi[1] - b.lo[1]), b.hi[2] - b.lo[2]);
    }
    [[nodiscard]] std::optional<std::array<OutlineBox, 2>> of_long(
        const OutlinedSolid::Facet& facet, const OutlineBox& box) const;

    const OutlinedSolid* solid_ = nullptr;
    double least_length_ = 0;
};

}  // namespace trisect::detail
