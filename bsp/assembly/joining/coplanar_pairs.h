// SPDX-License-Identifier: Apache-2.0
//
// CoplanarPairs: opposite edges of facets in one plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/assembly/parts/crossing_faces.h>
#include <trisect/kernel/number/triangle_normal.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Finds for every edge the one that runs the other way between the same ends, bounds the region on
/// its other side, and is joined with it. Both are gone then, unless facets of another plane go
/// straight across there. `within_faces` as in join_coplanar_facets.
class CoplanarPairs {
public:
    CoplanarPairs(const BoundaryParts& parts, bool within_faces, const BoundaryEdges& edges)
        : parts_(parts), within_faces_(within_faces), edges_(edges), gone_(edges.size(), 0) {}

    /// `threads` as in ParallelParts; if not 1 the bench of the parts has to be shared.
    void find(std::uint32_t threads);

    /// Calls join(f, g) for the facets of every pair that is gone.
    template <class Join>
    void for_each_joined(Join&& join) const {
        for (const auto& [e, f] : pairs_)
            if (gone_[e] != 0) join(edges_[e].facet, edges_[f].facet);
    }
    [[nodiscard]] bool any_gone() const { return !pairs_.empty(); }
    [[nodiscard]] bool is_gone(std::size_t edge) const { return gone_[edge] != 0; }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    static constexpr std::uint32_t gone = std::uint32_t{1} << 31U;  // beside an edge in a table
    using PairOfEdges = std::pair<std::uint32_t, std::uint32_t>;
    struct Table;
    struct Listed {
        std::uint64_t ends = 0;
        std::uint32_t edge = 0;
    };
    using Lists = std::vector<PoolVector<Listed>>;

    void list_candidates();
    void make_normals(std::uint32_t threads);
    void find_pairs(std::uint32_t threads);
    void find_whole_facets(std::uint32_t threads);
    void keep_crossings();

    [[nodiscard]] Lists listed_by_table(std::size_t count, std::uint32_t threads) const;
    void list_part(std::size_t part, std::size_t count, Lists& lists) const;
    void fill(Table& own, std::span<const PoolVector<Listed>> lists);
    template <class At>
    void enter_all(Table& own, std::size_t count, const At& at);
    void enter(Table& own, const Listed& listed, std::size_t slot);
    void note_gone();

    [[nodiscard]] bool are_pair(const BoundaryEdge& e, const BoundaryEdge& f) const;
    [[nodiscard]] bool belong_together(const BoundaryEdge& e, const BoundaryEdge& f) const;
    // Of a half-space: 0, which is askew to nothing.
    [[nodiscard]] const TriangleNormal& normal_of(std::int32_t facet) const;

    const BoundaryParts& parts_;
    bool within_faces_;
    const BoundaryEdges& edges_;
    PoolVector<std::uint32_t> candidates_;  // edges that may have such a one
    PoolVector<TriangleNormal> normals_;    // by facet
    PoolVector<std::uint8_t> gone_;
    PoolVector<PairOfEdges> pairs_;
    PoolVector<std::uint64_t> crowded_;  // ends of more than two edges
    PoolVector<WholeFacetEdge> whole_;
};

}  // namespace trisect::detail
