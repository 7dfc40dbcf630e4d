// SPDX-License-Identifier: Apache-2.0
//
// SolidState: the shared state of the copies of a Solid.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/flat/flat_region.h>
#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// A facet of a source, by the source's serial.
struct FacetName {
    std::uint64_t serial = 0;
    std::uint32_t facet = 0;
    friend auto operator<=>(const FacetName&, const FacetName&) = default;
};

class LazyTree;

/// A set as a tree of cells that list its boundary.
struct CellTree {
    CellRef root;
    /// Facets that reach into several cells and are missing in one of them because a coincident
    /// facet of another operand spoke for them there. Sorted. Elsewhere that operand may have
    /// dropped out of the formula, so such a facet may be listed whole without being whole. Rare.
    std::vector<FacetName> incomplete;
    /// Of the result of imported meshes; else null. It says nothing about what is made of the
    /// result in turn.
    std::shared_ptr<const Crossings> crossings;
    /// Whether parts of one facet that have a common edge may go straight across other faces there.
    /// Then the assembly must find these lines before it joins the parts. Conservative; false for
    /// imported meshes, whose facets end at their edges.
    bool may_have_straight_crossings = false;
    /// Whether all splitting planes have the usual offset (cell.h): only such a tree may meet
    /// coordinates with fractions.
    bool has_usual_offsets = true;
};

/// Facets of a source that bound a result as they are.
struct UncrossedFacets {
    const Source* source = nullptr;
    bool flipped = false;
    std::vector<std::uint32_t> facets;  ///< ascending
};

/// Corners with the coordinates of a corner of the first one of two meshes, which stands for them.
struct EqualCorners {
    struct Pair {
        std::uint32_t corner = 0;  ///< of mesh `mesh`
        std::uint32_t first = 0;   ///< of the first mesh
        std::uint8_t mesh = 1;     ///< 0 where that has its own corner twice
    };
    std::vector<Pair> pairs;  ///< each corner once
};

/// A set of meshes, or of one and half-spaces, by their facets, without a tree: those that nothing
/// crosses, and the crossings or the outlines of all others. Enough for to_mesh() and to_brep().
struct UndividedMeshes {
    std::vector<UncrossedFacets> uncrossed;      ///< of each operand; of a half-space none
    std::shared_ptr<const Crossings> crossings;  ///< not null; where there are outlines, no pairs
    std::shared_ptr<const LazyTree> tree;        ///< not null
    std::shared_ptr<const OutlinedFacets> outlined = nullptr;  ///< of many meshes; else null
    /// As that of a CellTree, whose outlines may lack such lines.
    bool may_have_straight_crossings = false;
    /// Whether outlines may lie in each other and face opposite ways, with nothing between them.
    bool may_have_sheets = false;
    /// Of an exclusive or of two meshes: what the second one has outside the first one. The rest
    /// of this is what the first one has outside the second one, and they touch in curves alone.
    /// Its tree is this one's.
    std::shared_ptr<const UndividedMeshes> beside = nullptr;
    /// Of two meshes that nothing needs to cut: corners of facets that pass through beside facets
    /// of the other mesh. Else null.
    std::shared_ptr<const EqualCorners> equal_corners = nullptr;
};

/// A set of prisms along one axis, without a tree: facets that are whole, and the rest of the
/// boundary by name. Enough for to_mesh(), and for to_brep() unless faces need names of their own.
struct PrismOutlines {
    std::shared_ptr<const CellNode> whole;  ///< a leaf that lists them; all of space is its cell
    std::shared_ptr<const NamedOutlines> outlines;
    std::shared_ptr<const LazyTree> tree;  ///< not null
};

struct FlatPrisms;

/// A prism over a region of the plane, along an axis; the directions of the region are the next
/// axes.
struct FlatPrism {
    std::shared_ptr<const FlatOperand> operand;  ///< not null; its region lies on the lattice
    int axis = 2;
    Coordinate low;  ///< along the axis
    Coordinate high;
    std::shared_ptr<const LazyTree> tree;  ///< not null
    /// What it was made of, if its region has vertices that are no corners: else null. Prisms over
    /// regions without such vertices are meshes.
    std::shared_ptr<const FlatPrisms> made_of = nullptr;
};

/// A formula of prisms at one place.
struct FlatPrisms {
    Residual::Ref formula;
    std::vector<Solid> slots;
};

using SolidForm = std::variant<CellTree, UndividedMeshes, PrismOutlines, FlatPrism>;

struct SolidState {
    Lattice lattice;
    SolidForm form;
    bool embedded = true;      ///< free of self-intersection, winding numbers 0 and 1 only
    bool whole = true;         ///< corners of meshes have whole coordinates
    std::uint64_t source = 0;  ///< serial of the one source of an imported solid
    /// Whether the set contains what is far away: 0 or 1; -1 where that depends on the direction,
    /// or may, because half-spaces alone decide it.
    std::int8_t far_out = 0;
    bool lattice_matters = true;  ///< false for the empty set and whole space

    /// \pre the form is a tree
    [[nodiscard]] const CellTree& tree() const { return std::get<CellTree>(form); }
    [[nodiscard]] const CellRef& root() const { return tree().root; }
    /// The tree that is still to be evaluated, or was when it was needed; null where the form is a
    /// tree from the beginning.
    [[nodiscard]] std::shared_ptr<const LazyTree> lazy_tree() const;
};

using SolidStates = std::vector<std::shared_ptr<const SolidState>>;

/// SolidState::far_out of the value of a formula over these.
[[nodiscard]] std::int8_t far_out_of(const Residual& formula,
                                     std::span<const std::shared_ptr<const SolidState>> solids);

/// The way from a Solid to its state and back.
struct SolidAccess {
    [[nodiscard]] static const std::shared_ptr<const SolidState>& state(const Solid& solid) {
        return solid.state();
    }
    /// Null is the empty set.
    [[nodiscard]] static Solid make(std::shared_ptr<const SolidState> state) {
        return Solid(std::move(state));
    }
};

/// Never null.
[[nodiscard]] inline const std::shared_ptr<const SolidState>& state_of(const Solid& solid) {
    return SolidAccess::state(solid);
}
[[nodiscard]] inline Solid solid_of(std::shared_ptr<const SolidState> state) {
    return SolidAccess::make(std::move(state));
}

}  // namespace trisect::detail
