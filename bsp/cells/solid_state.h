// SPDX-License-Identifier: Apache-2.0
//
// SolidState: the shared state of the copies of a Solid.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/crossings.h>

namespace trisect::detail {

/// A facet of a source, by the source's serial.
struct FacetName {
    std::uint64_t serial = 0;
    std::uint32_t facet = 0;
    friend auto operator<=>(const FacetName&, const FacetName&) = default;
};

class OutlinedSolid;

struct SolidState {
    Lattice lattice;
    CellRef root;
    bool embedded = true;      ///< free of self-intersection, winding numbers 0 and 1 only
    std::uint64_t source = 0;  ///< serial of the one source of an imported solid
    /// Facets that reach into several cells and are missing in one of them because a coincident
    /// facet of another operand spoke for them there. Sorted. Elsewhere that operand may have
    /// dropped out of the formula, so such a facet may be listed whole without being whole. Rare.
    std::vector<FacetName> incomplete;
    /// Of the result of two imported meshes; else null. It says nothing about what is made of the
    /// result in turn.
    std::shared_ptr<const Crossings> crossings;
    /// Of a result that has not been cut; else null. Then the tree lists only facets that are
    /// whole, or nothing, and users of more than to_mesh() take OutlinedSolid::cut() instead of
    /// this.
    std::shared_ptr<const OutlinedSolid> outlined;
    /// Whether the set contains what is far away: 0 or 1; -1 where that depends on the direction,
    /// or may, because half-spaces alone decide it.
    std::int8_t far_out = 0;
    bool lattice_matters = true;  ///< false for the empty set and whole space
};

}  // namespace trisect::detail
