// SPDX-License-Identifier: Apache-2.0
//
// Boxes of the two halves of a part of a facet.
#pragma once

#include <array>
#include <optional>

#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

namespace trisect::detail {

/// Of a part whose middle, along the axis that it is longest along, no edge goes through: what
/// others have cut out of a long facet may leave both of its ends. Nothing where an edge does,
/// where the facet is whole, and where the part is short beside the solid. O(its edges)
[[nodiscard]] std::optional<std::array<OutlineBox, 2>> halves_of_part(
    const OutlinedSolid& solid, const OutlinedSolid::Facet& facet, const OutlineBox& box);

}  // namespace trisect::detail
