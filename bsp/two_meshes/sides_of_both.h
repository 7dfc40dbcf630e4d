// SPDX-License-Identifier: Apache-2.0
//
// SidesOfBoth: facets of two meshes that nothing crosses, by their sides.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/two_meshes/equal_facets.h>
#include <trisect/bsp/two_meshes/facet_sides.h>
#include <trisect/bsp/two_meshes/pair_search.h>
#include <trisect/bsp/two_meshes/two_meshes.h>

namespace trisect::detail {

/// The sides of the facets of both meshes, for all operations with the same crossings.
class SidesOfBoth {
public:
    SidesOfBoth(const TwoMeshes& two, const CubesOfBoth& both, const TwoLists& near,
                const SolidStates& solids, bool parallel)
        : two_(two), both_(both), near_(near), solids_(solids), parallel_(parallel) {}

    // What bounds the result and is not crossed, of either mesh, and the first corners of all
    // others in special position; nothing when that is not known. `equal` outlives this.
    [[nodiscard]] std::optional<TwoLists> list(Crossings& crossings,
                                               const std::optional<EqualFacets>& equal) {
        std::array<std::optional<std::vector<std::uint32_t>>, 2> facets;
        std::array<std::vector<Crossings::Corner>, 2> corners;
        const auto find = [&](std::size_t i) {
            const bool below = crossings.operands[1 - i].is_open_below();
            const std::span<const EqualFacets::Fate> fates =
                equal ? std::span<const EqualFacets::Fate>(equal->fates[i])
                      : std::span<const EqualFacets::Fate>();
            facets[i] = list_of(i, crossings, fates, below);
            if (facets[i] && !crossings.special.empty())
                corners[i] = sides_[i]->first_corners(below);
        };
        do_both(
            parallel_, [&] { find(0); }, [&] { find(1); });
        if (!facets[0] || !facets[1]) return std::nullopt;
        crossings.first_corners.clear();
        for (const auto& c : corners)
            crossings.first_corners.insert(crossings.first_corners.end(), c.begin(), c.end());
        return TwoLists{*std::move(facets[0]), *std::move(facets[1])};
    }

private:
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> list_of(
        std::size_t i, const Crossings& crossings, std::span<const EqualFacets::Fate> fates,
        bool below) {
        if (sides_[i]) return sides_[i]->uncrossed_again(fates, below);
        sides_[i].emplace(*both_.grid, *two_.meshes[i], *both_.cubes[i],
                          both_.cubes[1 - i]->cubes(), near_[i], fates, threads_if(parallel_));
        return sides_[i]->uncrossed(crossings, i,
                                    is_below_far_out(*solids_[1 - i], crossings.operands[1 - i]),
                                    below, *two_.meshes[1 - i]);
    }

    const TwoMeshes& two_;
    const CubesOfBoth& both_;
    const TwoLists& near_;
    const SolidStates& solids_;
    bool parallel_;
    std::array<std::optional<FacetSides>, 2> sides_;
};

}  // namespace trisect::detail
