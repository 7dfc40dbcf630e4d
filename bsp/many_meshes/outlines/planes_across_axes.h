// SPDX-License-Identifier: Apache-2.0
//
// PlanesAcrossAxes: common planes of axis-perpendicular facets.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

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

    /// The facets of one mesh after those of another one. O(n)
    void add(const LatticeMesh& mesh) {
        const std::size_t first = planes_.size();
        planes_.resize(first + mesh.triangles.size());
        find(mesh, first);
    }
    /// Of all meshes, one after the other; whether any has such facets is found on threads (as for
    /// ParallelParts). \pre nothing was added
    void add_all(std::span<const LatticeMesh* const> meshes, std::uint32_t threads);
    /// Of a facet by its number.
    [[nodiscard]] const Plane& of(std::uint32_t facet) const {
        return planes_.empty() ? none_ : planes_[facet];
    }
    [[nodiscard]] bool are_same(std::uint32_t a, std::uint32_t b) const {
        return of(a).way != 0 && of(b).way != 0 && of(a).first == of(b).first;
    }

private:
    static FacetCorners corners(const LatticeMesh& mesh, std::size_t facet) {
        const auto& t = mesh.triangles[facet];
        return {&mesh.points[t[0]], &mesh.points[t[1]], &mesh.points[t[2]]};
    }
    // Across which it is; 3 where it is across none.
    static int axis_of(const FacetCorners& c) {
        int axis = 0;
        while (axis < 3 && ((*c[0])[axis] != (*c[1])[axis] || (*c[0])[axis] != (*c[2])[axis]))
            ++axis;
        return axis;
    }
    // Facets of a mesh, of which the first one has that number.
    void find(const LatticeMesh& mesh, std::size_t first) {
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
            const FacetCorners c = corners(mesh, f);
            const int axis = axis_of(c);
            if (axis == 3) continue;
            const Key128 key{std::bit_cast<std::uint64_t>((*c[0])[axis].to_double()),
                             static_cast<std::uint64_t>(axis)};
            const auto same = firsts_.insert(key, static_cast<std::int32_t>(first + f)).first;
            planes_[first + f] = {
                static_cast<std::uint32_t>(same),
                static_cast<std::int8_t>(normal_signs(c)[static_cast<std::size_t>(axis)]),
                static_cast<std::uint8_t>(axis)};
        }
    }

    Plane none_;
    PoolVector<Plane> planes_;  // by facet; none where no facet has one
    FlatMap firsts_;
};

}  // namespace trisect::detail
