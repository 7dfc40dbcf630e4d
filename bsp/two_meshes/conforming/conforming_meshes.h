// SPDX-License-Identifier: Apache-2.0
//
// Two meshes that meet in corners, edges and facets of both alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/packed_box.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/two_meshes/conforming/corner_names.h>
#include <trisect/bsp/two_meshes/conforming/patches.h>

namespace trisect::detail {

/// How the facets of two embedded meshes lie to the other one, where nothing needs to be cut: two
/// facets, one of either, have in common corners of both, an edge of both, or nothing, unless
/// facets of both cover one part of a plane, whichever way that is cut into triangles.
struct ConformingMeshes {
    struct Mesh {
        /// By place in the list of facets that was given. Unknown are facets of parts that touch
        /// the other mesh in corners alone, or do not.
        std::vector<FacetRelation> relations;
        /// By the same places, where some are unknown: a corner of the facet, or of another one
        /// that is on the same side, that the other mesh does not have.
        std::vector<std::uint32_t> corners;
        /// By corner of the mesh, where some are unknown or not all facets were given: whether the
        /// other mesh has it, too. Of corners of the facets that were given.
        std::vector<bool> is_common;
    };
    std::array<Mesh, 2> meshes;
    bool are_some_unknown = false;
    std::shared_ptr<const EqualCorners> equal_corners;
};

/// Facets of either mesh that no other rule parts, by a box each: a call says of all pairs of one
/// of the first with one of the second list whose boxes meet that they are as they should be. May
/// be called by several threads at once.
using PairsCheck =
    std::function<bool(std::span<const PackedBox> first, std::span<const PackedBox> second)>;

/// Calls a check for facets of which each two whose boxes meet, one of either list of a pair of
/// lists, are together once at least, ids being those of facets; returns whether all calls were
/// true.
using FacetLists = std::array<std::vector<std::uint32_t>, 2>;
using PairsSearch = std::function<bool(const PairsCheck&, const std::vector<FacetLists>&)>;

/// Of meshes that have some corners in common; nothing where they meet in other ways, have no
/// corner in common or so few that a sample misses them, or doubt would cost too much. `facets`:
/// ascending; others do not meet the other mesh. `threads` as in ParallelParts. Exact. O(n log n)
/// for ordinary meshes.
[[nodiscard]] std::optional<ConformingMeshes> find_conforming(
    const std::array<const LatticeMesh*, 2>& meshes,
    const std::array<std::span<const std::uint32_t>, 2>& facets, const PairsSearch& search,
    std::uint32_t threads);

}  // namespace trisect::detail
