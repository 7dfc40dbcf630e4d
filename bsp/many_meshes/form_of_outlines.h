// SPDX-License-Identifier: Apache-2.0
//
// Form of a set that is left of outlined facets.
#pragma once

#include <cstdint>
#include <memory>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

namespace trisect::detail {

/// Facets by what assembly needs: whole ones with their operands, others with outlines. All of the
/// store. O(n) where operands left theirs in order
[[nodiscard]] UndividedMeshes form_of(const OutlineStore& store, const ManyMeshes& meshes,
                                      const Crossings& operands,
                                      std::shared_ptr<const LazyTree> tree, std::uint32_t threads);

}  // namespace trisect::detail
