// SPDX-License-Identifier: Apache-2.0
//
// AssemblyStats: operation counts of one assembly.
#pragma once

#include <cstdint>

namespace trisect::detail {

struct AssemblyStats {
    std::uint64_t leaves = 0;          ///< with polygons
    std::uint64_t whole_facets = 0;    ///< passed through as they are
    std::uint64_t worked_facets = 0;   ///< cut, touched or incomplete
    std::uint64_t traced_facets = 0;   ///< of these: outlined by their crossings (traced_facets.h)
    std::uint64_t axis_facets = 0;     ///< of these: outlined with their planes (axis_faces.h)
    std::uint64_t axis_leaves = 0;     ///< read to find the planes that are outlined
    std::uint64_t parts = 0;           ///< convex parts of these, one or more for each cell
    std::uint64_t named_by_edges = 0;  ///< planes through points found by edges (named_edges.h)
    std::uint64_t edges = 0;           ///< of these parts, after vertices were inserted
    std::uint64_t joined_facets =
        0;  ///< that became part of a larger face (to_brep: of the whole ones)
};

}  // namespace trisect::detail
