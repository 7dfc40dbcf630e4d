// SPDX-License-Identifier: Apache-2.0
//
// Pairs of facets of many meshes that doubles leave open.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/many_meshes/outlined_solid.h>
#include <trisect/bsp/many_meshes/special_position.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// Decides whole facets of different operands, by their numbers, as if operands were moved. Notes
/// those that touch, and what is wanted where they cover a part of a plane together.
class SpecialPairs {
public:
    SpecialPairs(const ManyMeshes& meshes, SpecialPosition& special)
        : meshes_(meshes), special_(special) {}

    /// Where they cross. \pre first < second
    [[nodiscard]] std::optional<FacetCrossing> crossing(std::uint32_t first, std::uint32_t second);

private:
    /// Facets that have been found to lie in the plane of another one.
    struct InPlane {
        std::uint32_t of = none;  ///< that one
        bool turned = false;      ///< they face opposite ways
    };
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    [[nodiscard]] bool are_known_in_plane(std::uint32_t first, std::uint32_t second) const {
        return !planes_.empty() && planes_[first].of != none &&
               planes_[first].of == planes_[second].of;
    }
    void note_plane(std::uint32_t first, std::uint32_t second, bool same_side);
    void look_at_plane(std::uint32_t first, std::uint32_t second, bool same_side, bool are_equal);
    [[nodiscard]] int growth_along(std::uint32_t slot, std::uint32_t facet) const;

    const ManyMeshes& meshes_;
    SpecialPosition& special_;
    std::vector<InPlane> planes_;  // by facet, once there are some
    FlatMap settled_;              // planes and operands of which it is known what is wanted
};

}  // namespace trisect::detail
