// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/part_halves.h>

#include <cstddef>
#include <span>

#include <trisect/bsp/many_meshes/outlines/box_sum.h>

namespace trisect::detail {

namespace {

// Two loops have so many.
constexpr std::uint32_t least_edges = 6;

// Of the solid's length. Of shorter ones few boxes are met.
constexpr double long_part = 0.25;

}  // namespace

std::optional<std::array<OutlineBox, 2>> halves_of_part(const OutlinedSolid& solid,
                                                        const OutlinedSolid::Facet& facet,
                                                        const OutlineBox& box) {
    if (facet.whole || facet.count < least_edges) return std::nullopt;
    const auto along = [](const OutlineBox& b, std::size_t k) { return b.hi[k] - b.lo[k]; };
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (along(box, k) > along(box, axis)) axis = k;
    if (along(box, axis) < long_part * along(solid.box, axis)) return std::nullopt;
    const double middle = box.lo[axis] + along(box, axis) / 2;
    const auto is_above = [&](std::uint32_t v) { return solid.vertices[v].at.c[axis] > middle; };
    std::array<BoxSum, 2> halves;
    std::array<std::uint32_t, 2> counts{};
    for (const OutlinedSolid::Edge& e : solid.edges_of(facet)) {
        const bool above = is_above(e.from);
        if (above != is_above(e.to)) return std::nullopt;
        halves[above ? 1 : 0].add(solid.vertices[e.from].at);
        ++counts[above ? 1 : 0];
    }
    if (counts[0] == 0 || counts[1] == 0) return std::nullopt;
    return std::array{halves[0].box(), halves[1].box()};
}

}  // namespace trisect::detail
