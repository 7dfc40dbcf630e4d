// SPDX-License-Identifier: Apache-2.0
//
// SegmentMeetings: points where three facets of different meshes meet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/shifted_points.h>
#include <trisect/bsp/many_meshes/special_position.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Of all pairs of facets that cross, sorted by their facets, with the vertices of their ends.
class SegmentMeetings {
public:
    /// On the segment of a pair, where another facet crosses it.
    struct Stop {
        std::uint32_t vertex = 0;
        std::uint32_t cutter = 0;
        double along = 0;
    };

    /// Pairs, and what is behind `ends`, by pair, outlive this.
    SegmentMeetings(const ManyMeshes& meshes, std::span<const FacetCrossing> pairs,
                    std::span<const std::array<std::uint32_t, 2>> ends)
        : meshes_(meshes), pairs_(pairs), ends_(ends) {}

    /// Adds the points to the vertices. False where something is not known. The outcome does not
    /// depend on the number of threads. O(n^2) for n segments of a facet at one place.
    [[nodiscard]] bool find(PoolVector<OutlineVertex>& vertices, std::uint32_t threads);

    /// From the first end of a pair to the second one.
    [[nodiscard]] std::span<const Stop> of(std::size_t pair) const {
        return std::span(stops_).subspan(first_[pair], first_[pair + 1] - first_[pair]);
    }
    /// What touches; in no order.
    template <class Each>
    void for_each_special(const Each& each) {
        special_.for_each(each);
    }

private:
    struct Meeting {
        std::array<std::uint32_t, 3> pairs{};  // of the first two facets, first and third, last two
        OutlineVertex vertex;
    };
    class OnFacet;
    [[nodiscard]] std::optional<std::uint32_t> pair_of(std::uint32_t first,
                                                       std::uint32_t second) const;
    void make_planes(std::uint32_t threads);
    [[nodiscard]] bool find_points(PoolVector<OutlineVertex>& vertices, std::uint32_t threads);
    [[nodiscard]] bool sort(std::span<const OutlineVertex> vertices, std::uint32_t threads);
    [[nodiscard]] bool sort_stops(std::size_t pair, std::span<const OutlineVertex> vertices,
                                  const ShiftedPoints& exact);
    [[nodiscard]] SpecialPosition& special() {
        return special_.local(
            [&] { return std::make_unique<SpecialPosition>(meshes_.facet_count()); });
    }

    const ManyMeshes& meshes_;
    std::span<const FacetCrossing> pairs_;
    std::span<const std::array<std::uint32_t, 2>> ends_;
    PoolVector<std::uint32_t> first_of_facet_;  // pairs with it as the first one
    PoolVector<FilteredPlane> planes_;          // of facets of pairs
    PoolVector<Meeting> meetings_;
    PoolVector<std::uint32_t> first_;  // stops by pair
    PoolVector<Stop> stops_;
    PerThread<SpecialPosition> special_;
};

}  // namespace trisect::detail
