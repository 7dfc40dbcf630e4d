// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/manifold_counts.h>

#include <algorithm>
#include <vector>

#include <trisect/brep/validate/twins.h>

namespace trisect {

std::optional<ManifoldCounts> manifold_counts(
    std::size_t point_count, std::span<const std::array<std::uint32_t, 3>> triangles) {
    const auto twins = detail::Twins::of(point_count, triangles);
    if (!twins) return std::nullopt;
    std::vector<bool> used(point_count, false);
    for (const auto& t : triangles)
        for (const std::uint32_t v : t) used[v] = true;
    ManifoldCounts out;
    out.vertices = static_cast<std::size_t>(std::ranges::count(used, true));
    out.edges = 3 * triangles.size() / 2;
    out.shells = twins->shells().count;
    // Euler: the sum of 2 - 2g over the shells.
    const auto signed_count = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
    const std::ptrdiff_t euler =
        signed_count(out.vertices) - signed_count(out.edges) + signed_count(triangles.size());
    out.genus = signed_count(out.shells) - euler / 2;
    return out;
}

}  // namespace trisect
