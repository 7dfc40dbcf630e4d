// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/part_halves.h>

#include <cstddef>
#include <cstdint>

#include <trisect/bsp/many_meshes/outlines/box_sum.h>

namespace trisect::detail {

std::optional<std::array<OutlineBox, 2>> PartHalves::of_long(const OutlinedSolid::Facet& facet,
                                                             const OutlineBox& box) const {
    const auto along = [&](std::size_t k) { return box.hi[k] - box.lo[k]; };
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (along(k) > along(axis)) axis = k;
    const double middle = box.lo[axis] + along(axis) / 2;
    const auto is_above = [&](std::uint32_t v) { return solid_->vertices[v].at.c[axis] > middle; };
    std::array<BoxSum, 2> halves;
    std::array<std::uint32_t, 2> counts{};
    for (const OutlinedSolid::Edge& e : solid_->edges_of(facet)) {
        const bool above = is_above(e.from);
        if (above != is_above(e.to)) return std::nullopt;
        halves[above ? 1 : 0].add(solid_->vertices[e.from].at);
        ++counts[above ? 1 : 0];
    }
    if (counts[0] == 0 || counts[1] == 0) return std::nullopt;
    return std::array{halves[0].box(), halves[1].box()};
}

}  // namespace trisect::detail
