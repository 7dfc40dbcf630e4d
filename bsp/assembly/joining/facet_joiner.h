// SPDX-License-Identifier: Apache-2.0
//
// FacetJoiner: the parts of each facet made one region.
#pragma once

#include <cstddef>
#include <span>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/assembly/parts/edge_chains.h>
#include <trisect/bsp/assembly/parts/edge_splitter.h>

namespace trisect::detail {

/// Joins the parts of some facets: edges that two parts traverse in opposite directions vanish.
/// Where parts of neighbouring cells subdivide a common line differently, their ends are inserted
/// first. One for each thread.
class FacetJoiner {
public:
    explicit FacetJoiner(const BoundaryParts& parts)
        : parts_(parts), splitter_(parts.bench, parts.facets) {}

    /// What is left of these edges, which are all those of some facets: in their own place, or in
    /// `room`. `cancelled` takes what vanishes, if it is wanted.
    std::span<const BoundaryEdge> join(std::span<BoundaryEdge> edges, BoundaryEdges& room,
                                       BoundaryEdges* cancelled);

private:
    void join_facet(std::span<BoundaryEdge> edges, BoundaryEdges& out, BoundaryEdges* cancelled);

    const BoundaryParts& parts_;
    EdgeSplitter splitter_;
    EdgeChains chains_;
};

}  // namespace trisect::detail
