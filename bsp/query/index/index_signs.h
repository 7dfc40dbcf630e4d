// SPDX-License-Identifier: Apache-2.0
//
// Exact signs of point location.
// On which side of a polygon is a point, is it on the polygon, does the segment to a reference
// point cross it?
#pragma once

#include <array>
#include <cstdint>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/index_polygons.h>
#include <trisect/bsp/query/index/line_through.h>

namespace trisect::detail {

/// A point off the boundary whose membership is known. References that an index makes are doubles
/// exactly.
struct Reference {
    explicit Reference(const FinePoint& p) : fine(p) {
        for (std::size_t k = 0; k < 3; ++k) {
            c[k] = rounded_position(p.c[k]);
            if (!is_double(p.c[k])) error = std::max(error, std::fabs(c[k]) * last_place);
        }
    }

    FinePoint fine;
    std::array<double, 3> c{};  // lattice units
    double error = 0;
};

/// What a segment from a reference to a point does at a polygon.
enum class Passing : std::int8_t {
    Entering = 1,  ///< from above the source's facet to below it
    Leaving = -1,
    None = 0,
    On = 2  ///< the point lies on the polygon
};

/// Exact. The reference counts as moved by (e, e^2, e^3) for an infinitely small e > 0: it is on no
/// polygon, so this changes no winding number, and the segment never runs through an edge or a
/// vertex (symbolic perturbation of one end; Edelsbrunner and Mücke 1990 perturb everything).
/// \pre the reference is not on the polygon.
[[nodiscard]] Passing passing(const IndexPolygons& polygons, IndexPolygons::Id id,
                              const IndexPoint& point, const Reference& reference);

/// The line from a point to a reference.
[[nodiscard]] LineThrough line_between(const IndexPoint& point, const Reference& reference);

/// Whether a point lies on a closed polygon.
[[nodiscard]] bool is_on(const IndexPolygons& polygons, IndexPolygons::Id id,
                         const IndexPoint& point);

}  // namespace trisect::detail
