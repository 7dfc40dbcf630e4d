// SPDX-License-Identifier: Apache-2.0
//
// EmbeddingFindings: self-intersection of a boundary, and its places.
#pragma once

#include <optional>
#include <vector>

#include <trisect/brep/kinds/facet_kinds.h>
#include <trisect/brep/lattice_mesh.h>

namespace trisect {

/// What a solid needs to know about its mesh. A value; costs a byte a triangle.
struct EmbeddingFindings {
    bool is_embedded = false;  ///< see brep/validate/embedding.h
    /// Of a mesh that is not: its facets by triangle; nothing where most of them meet others, or
    /// too many pairs would have to be compared.
    std::optional<std::vector<detail::FacetKind>> kinds;
};

/// Exact. O(n log n) for ordinary meshes, some microseconds a triangle. \pre the mesh is closed and
/// oriented, corner by corner. \throw CancelledError, LimitError by the StopScope
[[nodiscard]] EmbeddingFindings find_embedding(const LatticeMesh& mesh);

}  // namespace trisect
