// SPDX-License-Identifier: Apache-2.0
//
// EqualFacets: facets that two meshes have in common.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/crossings.h>

namespace trisect::detail {

/// Facets with the same three corners bound the result together or not at all, whatever lies around
/// them: on both sides of such a facet both operands are the same, or one the complement of the
/// other.
struct EqualFacets {
    enum class Fate : std::uint8_t {
        Own,      ///< the facet has no equal
        Kept,     ///< it stands for both
        Dropped,  ///< the other one does, or neither bounds the result
    };
    /// By the places in both lists.
    std::array<std::vector<Fate>, 2> fates;

    /// Of some facets of two meshes. O(n).
    EqualFacets(const std::array<const LatticeMesh*, 2>& meshes,
                const std::array<std::vector<std::uint32_t>, 2>& facets,
                const std::array<Crossings::Operand, 2>& operands);
};

}  // namespace trisect::detail
