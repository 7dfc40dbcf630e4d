// SPDX-License-Identifier: Apache-2.0
//
// Settled parts of outlined solids, out of reach of all others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/many_meshes/outlines/boundary_sides.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/outlines/settled_part.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A box that the boxes of all operands still to come do not meet; at first all of space.
class ClearBox {
public:
    ClearBox();
    /// With others to come. \pre none of `those` is empty
    [[nodiscard]] ClearBox without(std::span<const Box> boxes, std::span<const std::uint32_t> those,
                                   std::span<const std::uint32_t> own) const;
    [[nodiscard]] bool has(const OutlineBox& box) const;
    /// Whether nothing is to come.
    [[nodiscard]] bool is_all() const;

private:
    std::array<double, 3> lo_{};
    std::array<double, 3> hi_{};
};

/// The same for all copies of a vertex, and for no other one.
[[nodiscard]] Key128 name_of(const OutlineVertex& v);

/// Makes a solid of parts of one, behind all others of a store: each shared vertex once.
class JoinedParts {
public:
    explicit JoinedParts(OutlineStore& store) : store_(store), solid_(store.empty_solid(true)) {}
    /// For so many more. `threads` as for ParallelParts.
    void reserve(std::size_t facets, std::size_t edges, std::size_t vertices, std::size_t lines,
                 std::uint32_t threads);
    /// The part of which facets follow.
    void begin(const SettledPart& part);
    void add(const SettledPart& part, std::size_t place);
    /// What was made.
    [[nodiscard]] const OutlineStore::Solid& solid() const { return solid_; }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    [[nodiscard]] std::uint32_t number(const SettledPart& part, std::uint32_t vertex);
    [[nodiscard]] EdgeOrigin origin(const SettledPart& part, const EdgeOrigin& origin);

    OutlineStore& store_;
    OutlineStore::Solid solid_;
    FlatMap shared_;
    PoolVector<std::uint32_t> numbers_;  // by vertex of the part
    PoolVector<std::uint32_t> lines_;    // numbers of these, by line of the part
};

/// What becomes of facets that settle.
struct Settling {
    /// Of a boundary that the solid will be intersected with; else nothing is known of any. Facets
    /// that are not beside it come first in their part, and those that it does not leave open go
    /// (OutlinedSolid::united). Vertices that those beside it have with others are shared.
    const BoundarySides* sides = nullptr;
    /// Not null where nothing joins the parts again: then facets that are not beside the boundary
    /// are kept as assembly takes them. \pre `sides`
    const ManyMeshes* for_assembly = nullptr;
};

/// Moves facets of the last solid that are within a box out of the way, to its settled parts,
/// unless they are few. All operands that are still to come leave open what is far out; so these
/// facets stay as they are. Vertices that others share with them become shared ones. O(n)
void settle(OutlineStore& store, OutlineStore::Solid& solid, const ClearBox& clear,
            const Settling& how = {});
/// All that is left, however few: nothing is to come.
void settle_rest(OutlineStore& store, OutlineStore::Solid& solid, const Settling& how);

/// Puts all parts of the last solid back, each vertex once. O(n) \pre all are in `facets`
void join_settled(OutlineStore& store, OutlineStore::Solid& solid);

}  // namespace trisect::detail
