// SPDX-License-Identifier: Apache-2.0
//
// Assembly: construction of a connected boundary from the leaves of a tree.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/bsp/assembly/parts/assembly_stats.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// The boundary as a B-rep. With maximal faces it is a function of the set alone: it does not
/// depend on the tree, on the operands' triangulation or on how they were combined.
[[nodiscard]] Brep assemble_brep(const SolidState& solid, const AssembleOptions& options,
                                 AssemblyStats* stats = nullptr);

/// The boundary as triangles; facets that nothing touched are copied. Without `by_planes` all
/// others go the general path (gather_parts()); the set, the vertices and the number of triangles
/// are the same. `threads` as in ParallelParts. `names`: for each triangle the face that it is part
/// of; where coplanar neighbours were joined, the first of them.
[[nodiscard]] PolygonMesh assemble_mesh(const SolidState& solid, AssemblyStats* stats = nullptr,
                                        bool by_planes = true, std::uint32_t threads = 1,
                                        std::vector<FaceSource>* names = nullptr);

/// The same mesh before its coordinates are rounded.
[[nodiscard]] ExactMesh assemble_exact_mesh(const SolidState& solid, std::uint32_t threads = 1);

}  // namespace trisect::detail
