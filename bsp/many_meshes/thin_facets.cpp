// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/thin_facets.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

constexpr std::size_t looked_at = 8;

bool is_thin(const Source& source, std::uint32_t facet, double times) {
    const Vector3 a = source.corner(facet, 0).doubles();
    const Vector3 v = minus(source.corner(facet, 1).doubles(), a);
    const Vector3 w = minus(source.corner(facet, 2).doubles(), a);
    const Vector3 u = minus(w, v);
    const Vector3 n = cross(v, w);
    return std::max({dot(u, u), dot(v, v), dot(w, w)}) >= times * length(n);
}

}  // namespace

bool are_mostly_thin(std::span<const Source* const> sources, double times) {
    std::size_t thin_sources = 0;
    for (const Source* s : sources) {
        const std::size_t count = std::min<std::size_t>(looked_at, s->facet_count());
        std::size_t found = 0;
        for (std::size_t i = 0; i < count; ++i)
            if (is_thin(*s, static_cast<std::uint32_t>(i * s->facet_count() / count), times))
                ++found;
        if (2 * found > count) ++thin_sources;
    }
    return 2 * thin_sources > sources.size();
}

}  // namespace trisect::detail
