// SPDX-License-Identifier: Apache-2.0
//
// convex_parts: a face as convex polygons, without a new plane.
// Corners of the face may be computed points.
#pragma once

#include <vector>

#include <trisect/bsp/msp/msp_geometry.h>

namespace trisect::detail::msp {

/// An edge of a face; the face lies to its left.
struct FaceEdge {
    PlaneIndex plane = 0;  ///< meets the support in the edge's line
    Label label;
    PointIndex from = 0;
    PointIndex to = 0;
    Label from_label;
    Label to_label;
};

/// Cuts the plane region that the edges bound by the lines of edges until all parts are convex, and
/// appends them. O(n log n) for ordinary outlines, O(n²) at worst.
void convex_parts(MspGeometry& geometry, PlaneIndex support, Label face,
                  std::vector<FaceEdge> edges, std::vector<Fragment>& parts);

}  // namespace trisect::detail::msp
