// SPDX-License-Identifier: Apache-2.0
//
// StraightRuns: vertices at which a region only runs straight on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/assembly/parts/edge_chains.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Finds the vertices at which regions only run straight on. The names of most vertices say that
/// some region turns there: of one where an edge pierces a facet, in the facets of that edge. Only
/// where no region's name says so turns are computed. One for each part of the edges; they share
/// `keep`.
class StraightRuns {
public:
    /// Edges that follow each other.
    struct Passage {
        std::size_t in = 0;
        std::size_t out = 0;
    };

    /// `keep`: by point, not 0 where it is kept.
    StraightRuns(const BoundaryParts& parts, bool keep_corners, const BoundaryEdges& edges,
                 std::span<char> keep)
        : parts_(parts),
          bench_(parts.bench),
          keep_corners_(keep_corners),
          edges_(edges),
          keep_(keep) {}

    /// The turns of these edges, which are all those of some facets. `chains`: scratch memory, as
    /// long as there are points.
    void look_at(std::size_t first, std::size_t end, EdgeChains& chains);

    /// Computes turns of which no name says enough. Of those that run straight on the next edge is
    /// put down, by the edge before it.
    void compute(std::span<std::size_t> next);

    [[nodiscard]] std::span<const Passage> uncertain() const { return uncertain_; }

private:
    using Ends = PoolVector<std::pair<PointId, std::size_t>>;

    // Other threads may keep it at the same time. What is found here does not depend on that, only
    // how much is looked at.
    [[nodiscard]] bool is_kept(PointId p) const;
    void keep(PointId p);

    void look_at_facet(std::size_t first, std::size_t end, EdgeChains& chains);
    void look_at_any(std::size_t first, std::size_t end);
    void add_passage(std::size_t in, std::size_t out);
    void add_passages_of_slit(std::size_t k);
    [[nodiscard]] bool are_one_plane(PlaneId p, PlaneId q);
    [[nodiscard]] bool runs_straight(const BoundaryEdge& in, const BoundaryEdge& out);

    const BoundaryParts& parts_;
    const Workbench& bench_;
    bool keep_corners_;
    const BoundaryEdges& edges_;
    std::span<char> keep_;  // by point
    PoolVector<Passage> uncertain_;
    std::pair<PlaneId, PlaneId> last_planes_{-1, -1};
    bool last_are_one_ = false;
    Ends by_from_;
    Ends by_to_;
};

}  // namespace trisect::detail
