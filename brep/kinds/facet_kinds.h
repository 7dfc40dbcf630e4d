// SPDX-License-Identifier: Apache-2.0
//
// Kinds of facets of a boundary that meets itself in places.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/lattice_mesh.h>

namespace trisect::detail {

/// Of a facet of a closed mesh, where inside is a positive winding number.
enum class FacetKind : std::uint8_t {
    Plain,   ///< 0 above and 1 below; meets others in corners and edges only, as neighbours do
    Hidden,  ///< likewise, but both sides are inside, or neither is
    Meets    ///< may meet other facets in another way
};

/// By triangle; nothing when more than half of them meet others, or too many pairs would have to be
/// compared. Exact. Also `Meets` are the triangles of an edge that not just two have, and those of
/// a corner with several fans. O(n log n) for ordinary meshes.
/// \throw CancelledError, LimitError by the StopScope
[[nodiscard]] std::optional<std::vector<FacetKind>> facet_kinds(const LatticeMesh& mesh);

}  // namespace trisect::detail
