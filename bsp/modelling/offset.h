// SPDX-License-Identifier: Apache-2.0
//
// Offsets of regions of the plane.
#pragma once

#include <cstdint>
#include <limits>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

struct OffsetOptions {
    enum class Corners : std::uint8_t {
        Round,    ///< arcs of segments
        Miter,    ///< edges go on until they meet
        Chamfer,  ///< a straight cut that is as far from the corner as the edges are
        Bevel     ///< a straight cut between the ends of the edges
    } corners = Corners::Round;
    /// Where edges would meet farther from the corner than so many times the distance, the miter is
    /// a chamfer.
    double miter_limit = std::numeric_limits<double>::infinity();
    /// Of a whole circle. An arc begins where the edge before it ends; its last segment may be
    /// shorter or longer than the others.
    std::uint32_t segments = 32;
    EvaluateOptions evaluate = {};
};

/// A region, as a prism between z = 0 and z = 1, grown by a distance, or shrunk by a negative one.
///
/// It is the region with a strip along each edge and a corner piece at each corner that looks
/// outward, or without them: one formula, exact over the corners of strips and corner pieces, which
/// are rounded once.
/// \throw UsageError for a distance that is not finite, fewer than three segments or a limit below
/// 1, what evaluate() throws
[[nodiscard]] Solid offset_of_region(const Solid& prism, double distance,
                                     const OffsetOptions& options = {});

}  // namespace trisect
