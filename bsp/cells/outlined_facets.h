// SPDX-License-Identifier: Apache-2.0
//
// OutlinedFacets: parts of facets that bound a result, by their outlines.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A vertex of a result of imported meshes in general position. Facets have the numbers of
/// Crossings.
struct OutlineVertex {
    enum class Kind : std::uint8_t {
        Corner,  ///< `which` of facets[0]
        Pierce,  ///< where edge `which` of facets[0] pierces facets[1]
        Meeting  ///< of three facets
    };
    Approximation at;  ///< in lattice units
    std::array<std::uint32_t, 3> facets{};
    std::int8_t which = 0;
    Kind kind = Kind::Corner;
    bool is_shared = false;  ///< with a part of its solid that has been set aside
};

/// The part of a facet that bounds a result, for any number of facets.
struct OutlinedFacets {
    struct Edge {
        std::uint32_t from = 0;  ///< vertices; the part is to the left, seen from above the facet
        std::uint32_t to = 0;
        std::uint32_t cutter = 0;  ///< the facet whose plane the edge lies in, where `edge` is -1
        std::int8_t edge = -1;     ///< of the facet
        bool open_below = false;   ///< what is below the cutter is open
    };
    struct Facet {
        std::uint32_t number = 0;
        std::uint32_t first = 0;  ///< of its edges, which follow each other in no order
        std::uint32_t count = 0;
    };
    PoolVector<OutlineVertex> vertices;
    PoolVector<Edge> edges;
    PoolVector<Facet> facets;  ///< ascending
};

}  // namespace trisect::detail
