// SPDX-License-Identifier: Apache-2.0
//
// Pairs of facets of many meshes that doubles leave open.
#pragma once

#include <cstdint>
#include <optional>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/many_meshes/outlined_solid.h>
#include <trisect/bsp/many_meshes/special_position.h>

namespace trisect::detail {

/// Decides whole facets of different operands, by their numbers, as if operands were moved. Notes
/// those that touch, and what is wanted where they cover a part of a plane together.
class SpecialPairs {
public:
    SpecialPairs(const ManyMeshes& meshes, SpecialPosition& special)
        : meshes_(meshes), special_(special) {}

    /// Where they cross. \pre first < second
    [[nodiscard]] std::optional<FacetCrossing> crossing(std::uint32_t first, std::uint32_t second);

private:
    void look_at_plane(std::uint32_t first, std::uint32_t second, bool same_side, bool are_equal);
    [[nodiscard]] int growth_along(std::uint32_t slot, std::uint32_t facet) const;

    const ManyMeshes& meshes_;
    SpecialPosition& special_;
};

}  // namespace trisect::detail
