// SPDX-License-Identifier: Apache-2.0
//
// Points on a segment, from one end to the other.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/many_meshes/sort_few.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

/// Sorts stops, each with a `vertex` and a place to keep how far it is `along`, by doubles where
/// these decide, and else by order(s, t): -1 where s comes first, 1, or 0 where that is not known.
/// False where it was not.
template <class Stop, class Order>
[[nodiscard]] bool sort_along(std::span<Stop> stops, const Approximation& from,
                              const Approximation& to, std::span<const OutlineVertex> vertices,
                              const Order& order) {
    if (stops.size() < 2) return true;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(to.c[k] - from.c[k]) > std::fabs(to.c[axis] - from.c[axis])) axis = k;
    const double length = to.c[axis] - from.c[axis];
    const bool has_way = std::fabs(length) > bound_slack * (from.error + to.error);
    const double way = length > 0 ? 1 : -1;
    for (Stop& s : stops) s.along = way * vertices[s.vertex].at.c[axis];
    bool known = true;
    sort_few(stops, [&](const Stop& s, const Stop& t) {
        const double error =
            bound_slack * (vertices[s.vertex].at.error + vertices[t.vertex].at.error);
        if (has_way && std::fabs(t.along - s.along) > error) return s.along < t.along;
        if (s.vertex == t.vertex) return false;
        const int found = order(s, t);
        known = known && found != 0;
        return found < 0;
    });
    return known;
}

}  // namespace trisect::detail
