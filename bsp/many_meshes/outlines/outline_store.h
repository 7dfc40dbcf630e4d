// SPDX-License-Identifier: Apache-2.0
//
// OutlineStore: outlined solids of one thread, one behind the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/outlines/settled_part.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Solids come and go as on a stack, since a balanced tree is evaluated so: what two of them, the
/// last ones, have in common takes their place, and most of it lies where it was. Numbers of
/// vertices, edges and lines are those of the whole store.
class OutlineStore {
public:
    /// Where one begins; it ends where the next one does, or with the store.
    struct Solid {
        std::size_t facets = 0;
        std::size_t edges = 0;
        std::size_t vertices = 0;
        std::size_t lines = 0;
        std::size_t settled = 0;
        std::size_t unused_edges = 0;  ///< those that no facet has
        OutlineBox box = OutlineBox::none();
        bool open_far_out = false;
        std::span<const std::uint32_t> united;  ///< as of an OutlinedSolid
    };
    using Facet = OutlinedSolid::Facet;
    using Edge = OutlinedSolid::Edge;

    /// Room for all operands, where there is none yet.
    void reserve(const ManyMeshes& meshes);

    [[nodiscard]] Solid empty_solid(bool open_far_out) const;
    [[nodiscard]] Solid add_operand(const ManyMeshes& meshes, std::uint32_t slot,
                                    bool open_far_out);
    [[nodiscard]] OutlinedSolid view(const Solid& solid) const {
        return view(solid, empty_solid(true));
    }
    /// Of one that ends where the next one begins.
    [[nodiscard]] OutlinedSolid view(const Solid& solid, const Solid& next) const;

    /// Takes the last solid out: its settled parts, and behind them what is not settled.
    [[nodiscard]] SettledParts take_out(const Solid& solid);
    /// Takes away the solid and all behind it.
    void cut_off(const Solid& solid);
    /// Adds such a one.
    [[nodiscard]] Solid put(SettledParts parts, const Solid& solid);
    /// To the last solid, from whose facets it is gone.
    void add_settled(std::unique_ptr<SettledPart> part) { settled_.push_back(std::move(part)); }
    /// Of a solid. \pre the last one
    [[nodiscard]] std::span<const std::unique_ptr<SettledPart>> settled(const Solid& solid) const {
        return std::span(settled_).subspan(solid.settled);
    }

    // Of the last two solids. One is left.
    [[nodiscard]] Solid united_apart(const Solid& first, const Solid& second) const;
    [[nodiscard]] Solid first_only(const Solid& first, const Solid& second);
    /// Of one that is alone: nothing is left of it.
    [[nodiscard]] Solid none_of(const Solid& solid);
    [[nodiscard]] Solid second_only(const Solid& first, const Solid& second);

    // For what makes one of two:
    [[nodiscard]] PoolVector<Facet>& facets() { return facets_; }
    [[nodiscard]] PoolVector<OutlineBox>& boxes() { return boxes_; }
    [[nodiscard]] PoolVector<Edge>& edges() { return edges_; }
    [[nodiscard]] const Edge& edge(std::size_t i) const { return edges_[i]; }
    [[nodiscard]] PoolVector<OutlineVertex>& vertices() { return vertices_; }
    /// Lines that edges lie in.
    [[nodiscard]] PoolVector<FacetCrossing>& lines() { return lines_; }
    /// Takes out edges that no facet has, and vertices and lines that no edge has, where they are
    /// many. Their order stays. \pre the last solid
    void tidy(Solid& solid);

private:
    void tidy_vertices(const Solid& solid);
    void tidy_lines(const Solid& solid);

    PoolVector<Facet> facets_;
    PoolVector<OutlineBox> boxes_;
    PoolVector<Edge> edges_;
    PoolVector<OutlineVertex> vertices_;
    SettledParts settled_;
    PoolVector<FacetCrossing> lines_;
    PoolVector<Edge> tidy_edges_;
    PoolVector<std::uint32_t> numbers_;  // of vertices or lines, when they are tidied up
};

}  // namespace trisect::detail
