// SPDX-License-Identifier: Apache-2.0
//
// Parts of a plane that patches of two meshes have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/two_meshes/conforming/corner_names.h>
#include <trisect/bsp/two_meshes/conforming/patches.h>

namespace trisect::detail {

struct CoveringPatches {
    std::vector<std::uint32_t> opposite;  ///< items that face another way than those they cover
};

/// Of all sets that are covered. Nothing where one does not lie in a plane, or facets of one mesh
/// cover another part of it than those of the other mesh. Exact. O(n log n)
[[nodiscard]] std::optional<CoveringPatches> find_covering(const CornerNames& names,
                                                           const Patches& patches);

}  // namespace trisect::detail
