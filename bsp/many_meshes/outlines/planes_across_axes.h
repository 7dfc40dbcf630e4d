// SPDX-License-Identifier: Apache-2.0
//
// PlanesAcrossAxes: common planes of axis-perpendicular facets.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// Caps and plates mostly have such planes. Which of them are the same is known without arithmetic,
/// by the axis and the coordinate.
class PlanesAcrossAxes {
public:
    struct Plane {
        std::uint32_t first = 0;  ///< number of the first facet in it
        std::int8_t way = 0;      ///< of a facet's normal along the axis; 0 where there is no plane
        std::uint8_t axis = 0;
    };

    /// For so many facets.
    void reserve(std::size_t facets) { planes_.reserve(facets); }
    /// The facets of one mesh after those of another one. O(n)
    void add(const LatticeMesh& mesh) {
        for (const auto& t : mesh.triangles)
            add(FacetCorners{&mesh.points[t[0]], &mesh.points[t[1]], &mesh.points[t[2]]});
    }
    /// Of a facet by its number.
    [[nodiscard]] const Plane& of(std::uint32_t facet) const { return planes_[facet]; }
    [[nodiscard]] bool are_same(std::uint32_t a, std::uint32_t b) const {
        return planes_[a].way != 0 && planes_[b].way != 0 && planes_[a].first == planes_[b].first;
    }

private:
    void add(const FacetCorners& c) {
        const auto number = static_cast<std::uint32_t>(planes_.size());
        planes_.emplace_back();
        int axis = 0;
        while (axis < 3 && ((*c[0])[axis] != (*c[1])[axis] || (*c[0])[axis] != (*c[2])[axis]))
            ++axis;
        if (axis == 3) return;
        const Key128 key{std::bit_cast<std::uint64_t>((*c[0])[axis].to_double()),
                         static_cast<std::uint64_t>(axis)};
        const auto first = firsts_.insert(key, static_cast<std::int32_t>(number)).first;
        planes_.back() = {static_cast<std::uint32_t>(first),
                          static_cast<std::int8_t>(normal_signs(c)[static_cast<std::size_t>(axis)]),
                          static_cast<std::uint8_t>(axis)};
    }

    std::vector<Plane> planes_;  // by facet
    FlatMap firsts_;
};

}  // namespace trisect::detail
