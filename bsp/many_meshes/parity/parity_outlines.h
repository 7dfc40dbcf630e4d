// SPDX-License-Identifier: Apache-2.0
//
// ParityOutlines: outlines of what meshes cut each other into.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/parity/corner_parities.h>
#include <trisect/bsp/many_meshes/parity/pierced_edges.h>
#include <trisect/bsp/many_meshes/parity/segment_meetings.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// All facets bound an exclusive or all over, those of even parity on one side and those of odd
/// parity on the other one.
class ParityOutlines {
public:
    /// Pairs are sorted by their facets.
    ParityOutlines(const OutlinedSolid& all, std::span<const FacetCrossing> pairs,
                   const PiercedEdges& pierced, const SegmentMeetings& meetings,
                   const CornerParities& parities)
        : all_(all), pairs_(pairs), pierced_(pierced), meetings_(meetings), parities_(parities) {}

    /// Of facets that are crossed; of n facets in all, parts of facet f that have odd parity are
    /// those of facet n + f. False where both ends of a segment disagree.
    [[nodiscard]] bool find(std::span<const std::uint8_t> is_crossed);
    [[nodiscard]] std::shared_ptr<const OutlinedFacets> take() { return std::move(out_); }

private:
    using Edge = OutlinedFacets::Edge;
    [[nodiscard]] bool find_starts();
    void list_by_second();
    void add_own_edges(const OutlinedSolid::Facet& facet);
    void add_own_edge(std::uint32_t facet, std::int8_t i);
    void add_segments(std::uint32_t pair, std::size_t side);
    void end_facet(std::uint32_t facet);
    void append_odd();
    void take_vertices();

    const OutlinedSolid& all_;
    std::span<const FacetCrossing> pairs_;
    const PiercedEdges& pierced_;
    const SegmentMeetings& meetings_;
    const CornerParities& parities_;
    PoolVector<std::uint8_t> starts_;    // parities below the other facet at first ends, by pair
    PoolVector<std::uint32_t> seconds_;  // pairs by their second facets
    std::array<std::vector<Edge>, 2> edges_;  // of one facet, by parity
    std::shared_ptr<OutlinedFacets> out_;
    OutlinedFacets odd_;
};

}  // namespace trisect::detail
