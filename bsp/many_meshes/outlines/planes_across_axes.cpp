// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/planes_across_axes.h>

#include <algorithm>

#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

void PlanesAcrossAxes::add_all(std::span<const LatticeMesh* const> meshes, std::uint32_t threads) {
    constexpr std::size_t least_meshes = 64;
    PoolVector<std::uint8_t> have_planes(meshes.size(), 0);
    ParallelParts(meshes.size(), threads, least_meshes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t m = begin; m < end; ++m)
                for (std::size_t f = 0; f < meshes[m]->triangles.size() && have_planes[m] == 0; ++f)
                    have_planes[m] = axis_of(corners(*meshes[m], f)) != 3 ? 1 : 0;
        });
    if (std::ranges::count(have_planes, 1) == 0) return;
    std::size_t count = 0;
    for (const LatticeMesh* m : meshes) count += m->triangles.size();
    planes_.resize(count);
    std::size_t first = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        if (have_planes[m] != 0) find(*meshes[m], first);
        first += meshes[m]->triangles.size();
    }
}

}  // namespace trisect::detail
