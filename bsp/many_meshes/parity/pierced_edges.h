// SPDX-License-Identifier: Apache-2.0
//
// PiercedEdges: points where edges of many meshes pierce facets of other ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/shifted_points.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Facets are whole, and have the numbers of Crossings; edge i of facet f is edge 3 f + i of `all`.
class PiercedEdges {
public:
    /// Where an edge pierces a facet.
    struct Stop {
        std::uint32_t vertex = 0;
        std::uint32_t cutter = 0;
        bool rises = false;  ///< from below the facet to above it, along the edge
        double along = 0;
    };

    PiercedEdges(const OutlinedSolid& all, const ShiftedPoints& exact) : all_(all), exact_(exact) {}

    /// Adds the points to the vertices. False where an order is not known, or points are lacking.
    [[nodiscard]] bool find(std::span<const FacetCrossing> pairs,
                            PoolVector<OutlineVertex>& vertices);

    /// Vertices of the ends of a pair.
    [[nodiscard]] const std::array<std::uint32_t, 2>& ends(std::size_t pair) const {
        return ends_[pair];
    }
    [[nodiscard]] std::span<const std::array<std::uint32_t, 2>> ends() const { return ends_; }
    [[nodiscard]] std::uint32_t first_vertex() const { return first_vertex_; }
    /// In their order from the vertex with the lesser number to the other one.
    [[nodiscard]] std::span<const Stop> stops(const OutlinedSolid::Edge& edge) const {
        const std::int32_t number = edges_.find(name_of(edge));
        return number < 0 ? std::span<const Stop>() : stops_of(static_cast<std::size_t>(number));
    }
    [[nodiscard]] std::size_t edge_count() const { return pierced_.size(); }
    [[nodiscard]] std::span<const Stop> stops_of(std::size_t number) const {
        return std::span(stops_).subspan(first_[number], first_[number + 1] - first_[number]);
    }
    /// The edge, as some facet has it.
    [[nodiscard]] std::uint32_t edge(std::size_t number) const { return pierced_[number]; }

private:
    struct Found {
        Stop stop;
        std::uint32_t edge = 0;  // number among those that are pierced
    };
    [[nodiscard]] static Key128 name_of(const OutlinedSolid::Edge& e) {
        return {
            e.from < e.to ? std::uint64_t{e.from} << 32 | e.to : std::uint64_t{e.to} << 32 | e.from,
            0};
    }
    [[nodiscard]] std::uint32_t vertex_at(const FacetCrossing& crossing, std::size_t k,
                                          PoolVector<OutlineVertex>& vertices);
    [[nodiscard]] bool sort(std::span<Stop> stops, std::uint32_t edge,
                            std::span<const OutlineVertex> vertices) const;

    const OutlinedSolid& all_;
    const ShiftedPoints& exact_;
    std::uint32_t first_vertex_ = 0;
    FlatMap points_;  // by edge and facet
    FlatMap edges_;
    PoolVector<std::uint8_t> times_;  // by point, how often it was found, up to 2
    PoolVector<std::array<std::uint32_t, 2>> ends_;
    PoolVector<std::uint32_t> pierced_;
    PoolVector<Found> found_;
    PoolVector<std::uint32_t> first_;  // stops by edge
    PoolVector<Stop> stops_;
};

}  // namespace trisect::detail
