// SPDX-License-Identifier: Apache-2.0
//
// Sinks for the answers of batches of points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

/// What is wanted of points: where they are.
struct ToLocations {
    std::span<Location> results;

    void off(std::uint32_t number, bool inside) const {
        results[number] = inside ? Location::Inside : Location::Outside;
    }
    // `rank` of the normals of the polygons, or 0 when it is not known.
    void on(std::uint32_t number, const IndexPoint&, std::vector<PolygonId>& on, int rank) const {
        results[number] = rank == 1   ? Location::OnFace
                          : rank == 2 ? Location::OnEdge
                          : rank == 3 ? Location::OnVertex
                                      : location_on(on);
    }
};

/// Or also what they are on.
struct ToPlaces {
    const FoundPoint& found;

    void off(std::uint32_t number, bool inside) const {
        found(number, inside ? Location::Inside : Location::Outside, nullptr, none);
    }
    void on(std::uint32_t number, const IndexPoint& p, std::vector<PolygonId>& on, int) const {
        found(number, Location::OnFace, &p, on);
    }
    static inline thread_local std::vector<PolygonId> none;
};

}  // namespace trisect::detail
