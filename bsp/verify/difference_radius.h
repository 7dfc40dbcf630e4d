// SPDX-License-Identifier: Apache-2.0
//
// Certified radius of a set about two surfaces, for verify.h.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include <trisect/brep/brep.h>
#include <trisect/brep/measure/grid_distance.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/verify/corner_match.h>

namespace trisect::detail {

struct RadiusOptions {
    std::optional<double> within;  ///< lattice units
    EvaluateOptions evaluate;
    std::size_t piece_limit = 0;
    /// Corners of the second surface that are at most `reach` from the first one, matched.
    std::function<CornerBound(double reach)> match_corners;
};

/// All lengths in lattice units.
struct DifferenceRadius {
    double lower = 0;
    double upper = 0;  ///< NaN when the search ended with lower > within
    /// A vertex of a piece, and the piece, where `lower` was found.
    std::shared_ptr<const Brep> piece;
    VertexId vertex;
    std::size_t pieces = 0;
    std::size_t components = 0;
    std::size_t failed_cuts = 0;  ///< parts whose boundary could not be assembled
};

/// \pre neither surface is empty, `difference` is bounded and not empty.
[[nodiscard]] DifferenceRadius difference_radius(const Solid& difference,
                                                 const GridTriangles& first,
                                                 const GridTriangles& second,
                                                 const RadiusOptions& options);

}  // namespace trisect::detail
