// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/equal_facets.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace trisect::detail {

namespace {

std::uint64_t mixed(std::uint64_t h) {
    h ^= h >> 32;
    h *= 0x9E3779B97F4A7C15U;
    return h ^ h >> 29;
}

// The same for all orders of the corners.
std::uint64_t hash_of(const LatticeMesh& mesh, std::uint32_t facet) {
    std::uint64_t sum = 0;
    for (const std::uint32_t v : mesh.triangles[facet]) {
        const LatticePoint& p = mesh.points[v];
        sum += mixed(mixed(mixed(p.x.bits()) + p.y.bits()) + p.z.bits());
    }
    return mixed(sum);
}

FacetCorners corners_of(const LatticeMesh& mesh, std::uint32_t facet) {
    const auto& t = mesh.triangles[facet];
    return {&mesh.points[t[0]], &mesh.points[t[1]], &mesh.points[t[2]]};
}

// Whether the corners of g are those of f, and in the same cyclic order.
struct Match {
    bool equal = false;
    bool same_side = false;

    Match(const FacetCorners& f, const FacetCorners& g) {
        for (std::size_t i = 0; i < 3 && !equal; ++i) {
            if (*f[0] != *g[i]) continue;
            const LatticePoint& next = *g[(i + 1) % 3];
            const LatticePoint& last = *g[(i + 2) % 3];
            same_side = *f[1] == next && *f[2] == last;
            equal = same_side || (*f[1] == last && *f[2] == next);
        }
    }
};

}  // namespace

// A facet of an embedded mesh has one equal at most.
EqualFacets::EqualFacets(const std::array<const LatticeMesh*, 2>& meshes,
                         const std::array<std::vector<std::uint32_t>, 2>& facets,
                         const std::array<Crossings::Operand, 2>& operands) {
    for (std::size_t i = 0; i < 2; ++i) fates[i].assign(facets[i].size(), Fate::Own);
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> table(std::bit_ceil(2 * facets[0].size() + 1), none);
    const std::size_t mask = table.size() - 1;
    for (std::uint32_t i = 0; i < facets[0].size(); ++i) {
        std::size_t slot = hash_of(*meshes[0], facets[0][i]) & mask;
        while (table[slot] != none) slot = (slot + 1) & mask;
        table[slot] = i;
    }
    for (std::size_t j = 0; j < facets[1].size(); ++j) {
        const FacetCorners g = corners_of(*meshes[1], facets[1][j]);
        for (std::size_t slot = hash_of(*meshes[1], facets[1][j]) & mask; table[slot] != none;
             slot = (slot + 1) & mask) {
            const std::uint32_t i = table[slot];
            const Match match(corners_of(*meshes[0], facets[0][i]), g);
            if (!match.equal) continue;
            // The first one stands for both: as if the second one lay where the first one leaves
            // it open, and hence bounds nothing.
            const bool is_below = match.same_side == operands[0].is_open_below();
            fates[0][i] = is_below == operands[1].is_open_below() ? Fate::Kept : Fate::Dropped;
            fates[1][j] = Fate::Dropped;
            break;
        }
    }
}

}  // namespace trisect::detail
