// SPDX-License-Identifier: Apache-2.0
//
// ConformingSides: the boundary of results of two meshes that conform.
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
#include <trisect/bsp/two_meshes/conforming/conforming_meshes.h>
#include <trisect/bsp/two_meshes/equal_facets.h>
#include <trisect/bsp/two_meshes/facet_sides.h>
#include <trisect/bsp/two_meshes/pair_search.h>
#include <trisect/bsp/two_meshes/two_meshes.h>

namespace trisect::detail {

/// Two meshes that nothing needs to cut, for all operations.
class ConformingSides {
public:
    ConformingSides(const TwoMeshes& two, const CubesOfBoth& both, const TwoLists& near,
                    const SolidStates& solids, bool parallel, ConformingMeshes found)
        : two_(two),
          both_(both),
          near_(near),
          solids_(solids),
          parallel_(parallel),
          found_(std::move(found)) {}

    // What bounds the result, of either mesh; nothing when that is not known. `is_part`: it is
    // beside another one, by which facets that face opposite ways vanish.
    [[nodiscard]] std::optional<TwoLists> list(const Crossings& crossings, bool is_part) {
        is_part_ = is_part;
        std::array<std::optional<std::vector<std::uint32_t>>, 2> facets;
        do_both(
            parallel_, [&] { facets[0] = list_of(0, crossings); },
            [&] { facets[1] = list_of(1, crossings); });
        if (!facets[0] || !facets[1]) return std::nullopt;
        return TwoLists{*std::move(facets[0]), *std::move(facets[1])};
    }
    [[nodiscard]] const ConformingMeshes& found() const { return found_; }

private:
    using Fate = EqualFacets::Fate;

    // The first mesh stands for both where they cover a part of a plane (equal_facets.cpp).
    [[nodiscard]] Fate fate_of(std::size_t i, FacetRelation relation,
                               const Crossings& crossings) const {
        const auto& operands = crossings.operands;
        bool is_kept = false;
        switch (relation) {
            case FacetRelation::Unknown:
                return Fate::Own;
            case FacetRelation::Above:
            case FacetRelation::Below:
                is_kept = (relation == FacetRelation::Below) == operands[1 - i].is_open_below();
                break;
            case FacetRelation::Same:
            case FacetRelation::Opposite: {
                const bool is_below =
                    (relation == FacetRelation::Same) == operands[0].is_open_below();
                is_kept = i == 0 && is_below == operands[1].is_open_below() &&
                          !(is_part_ && relation == FacetRelation::Opposite);
                break;
            }
        }
        return is_kept ? Fate::Kept : Fate::Dropped;
    }

    [[nodiscard]] std::optional<std::vector<std::uint32_t>> list_of(std::size_t i,
                                                                    const Crossings& crossings) {
        const ConformingMeshes::Mesh& mesh = found_.meshes[i];
        fates_[i].clear();
        for (const FacetRelation relation : mesh.relations)
            fates_[i].push_back(fate_of(i, relation, crossings));
        if (!found_.are_some_unknown && near_[i].size() == two_.meshes[i]->triangles.size())
            return list_kept(i);
        const bool below = crossings.operands[1 - i].is_open_below();
        if (sides_[i]) return sides_[i]->uncrossed_again(fates_[i], below);
        sides_[i].emplace(*both_.grid, *two_.meshes[i], *both_.cubes[i],
                          both_.cubes[1 - i]->cubes(), near_[i], fates_[i], threads_if(parallel_));
        sides_[i]->set_conforming(mesh);
        return sides_[i]->uncrossed(crossings, i,
                                    is_below_far_out(*solids_[1 - i], crossings.operands[1 - i]),
                                    below, *two_.meshes[1 - i]);
    }

    [[nodiscard]] std::vector<std::uint32_t> list_kept(std::size_t i) const {
        std::vector<std::uint32_t> out;
        out.reserve(static_cast<std::size_t>(std::ranges::count(fates_[i], Fate::Kept)));
        for (std::size_t k = 0; k < near_[i].size(); ++k)
            if (fates_[i][k] == Fate::Kept) out.push_back(near_[i][k]);
        return out;
    }

    const TwoMeshes& two_;
    const CubesOfBoth& both_;
    const TwoLists& near_;
    const SolidStates& solids_;
    bool parallel_;
    ConformingMeshes found_;
    std::array<std::vector<Fate>, 2> fates_;  // of the operation that is looked at
    bool is_part_ = false;                    // as that is
    std::array<std::optional<FacetSides>, 2> sides_;
};

}  // namespace trisect::detail
