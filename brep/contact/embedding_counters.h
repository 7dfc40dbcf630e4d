// SPDX-License-Identifier: Apache-2.0
//
// EmbeddingCounters: numbers of surfaces and pairs of triangles that each test decided.
#pragma once

#include <cstdint>

#include <trisect/kernel/diagnostics.h>

namespace trisect::detail {

struct EmbeddingCounters {
    std::uint64_t starlike = 0;       ///< surfaces that each direction from a point meets once
    std::uint64_t height_fields = 0;  ///< surfaces over a flat bottom
    std::uint64_t convex = 0;         ///< surfaces
    std::uint64_t compared = 0;       ///< surfaces whose triangles were compared in pairs
    std::uint64_t graph_corners = 0;  ///< pairs at a corner whose triangles are a graph
    std::uint64_t turned_lines = 0;   ///< pairs that an edge's line does along the part's own axes
    std::uint64_t edge_lines = 0;     ///< pairs that the line of an edge keeps apart
    std::uint64_t own_planes = 0;     ///< pairs that the plane of one of them keeps apart
    std::uint64_t intervals = 0;      ///< pairs that are apart on the line of their planes
    std::uint64_t other_planes = 0;   ///< pairs that some plane keeps apart
    std::uint64_t exact_pairs = 0;    ///< pairs that doubles did not decide

    EmbeddingCounters& operator-=(const EmbeddingCounters& o) {
        starlike -= o.starlike;
        height_fields -= o.height_fields;
        convex -= o.convex;
        compared -= o.compared;
        graph_corners -= o.graph_corners;
        turned_lines -= o.turned_lines;
        edge_lines -= o.edge_lines;
        own_planes -= o.own_planes;
        intervals -= o.intervals;
        other_planes -= o.other_planes;
        exact_pairs -= o.exact_pairs;
        return *this;
    }
};

[[nodiscard]] inline EmbeddingCounters& embedding_counters() {
    return counters_of_thread<EmbeddingCounters>;
}

}  // namespace trisect::detail
