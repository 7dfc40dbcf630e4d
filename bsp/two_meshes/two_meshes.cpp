// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/two_meshes.h>

#include <cmath>

namespace trisect::detail {

namespace {

// About a facet in each cube that the surface meets.
int slabs_for(std::size_t facets) {
    return std::clamp(static_cast<int>(std::sqrt(static_cast<double>(facets) / 8)), 4, 62);
}

}  // namespace

CubesOfBoth::CubesOfBoth(const TwoMeshes& two, bool parallel) {
    for (int slabs = slabs_for(two.larger()); !are_useful(); slabs = std::max(slabs / 2, 4)) {
        grid.emplace(two.common, slabs);
        do_both(
            parallel, [&] { cubes[0].emplace(*grid, *two.meshes[0], threads_if(parallel)); },
            [&] { cubes[1].emplace(*grid, *two.meshes[1], threads_if(parallel)); });
    }
}

}  // namespace trisect::detail
