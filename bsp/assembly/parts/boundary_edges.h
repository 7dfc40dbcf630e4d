// SPDX-License-Identifier: Apache-2.0
//
// Order of the edges of a boundary: by facet, and of a facet by loop.
#pragma once

#include <span>

#include <trisect/bsp/assembly/parts/boundary_parts.h>

namespace trisect::detail {

/// Puts the edges into the order of their facets; those of one facet stay in theirs.
void sort_by_facet(const BoundaryParts& parts, BoundaryEdges& edges);

/// Arranges the edges of every facet (EdgeChains). \pre sorted by facet
void arrange_loops(std::span<BoundaryEdge> edges);

}  // namespace trisect::detail
