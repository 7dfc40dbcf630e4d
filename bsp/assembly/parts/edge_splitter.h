// SPDX-License-Identifier: Apache-2.0
//
// EdgeSplitter: insertion of vertices that lie inside edges (T-vertices).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_facet.h>
#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// Splits edges at the candidate vertices that lie inside them. Holds scratch memory.
///
/// Edges and candidates should belong to one leaf or one facet: the cost is near linear in the
/// candidates whose range along the longest axis meets an edge's.
class EdgeSplitter {
public:
    EdgeSplitter(const Workbench& bench, const std::vector<BoundaryFacet>& facets)
        : bench_(bench), facets_(facets) {}
    void clear();
    void add_candidate(PointId p);
    /// Appends the parts of the edges to `out`, each edge's parts in order. \pre the ends of the
    /// edges are candidates.
    void split(std::span<const BoundaryEdge> edges, std::vector<BoundaryEdge>& out);

private:
    struct Candidate {
        std::array<double, 3> c{};  // approximate
        PointId point = -1;
    };
    void sort_candidates();
    void find_inside(const BoundaryEdge& e);
    void sort_inside(const BoundaryEdge& e, int axis);

    const Workbench& bench_;
    const std::vector<BoundaryFacet>& facets_;
    std::vector<Candidate> candidates_;
    std::vector<std::int32_t> rank_;  // by point: its place among the candidates, -1 is none
    std::size_t axis_ = 0;            // that they are sorted along
    double widest_ = 0;               // error of a candidate
    std::vector<PointId> inside_;
};

}  // namespace trisect::detail
