// SPDX-License-Identifier: Apache-2.0
//
// Areas of outlines and drawings, rounded.
#pragma once

#include <trisect/bsp/csg/drawing/drawing.h>

#include <cmath>

namespace trisect::testing {

inline double signed_area(const Outline& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point2d& p = outline[i];
        const Point2d& q = outline[(i + 1) % outline.size()];
        twice += p[0] * q[1] - p[1] * q[0];
    }
    return twice / 2;
}

/// The sum over outlines that do not overlap.
inline double area_of(const detail::Drawing& drawing) {
    double out = 0;
    for (const detail::DrawingShape& shape : drawing.shapes)
        for (const Outline& outline : shape.outlines) out += std::fabs(signed_area(outline));
    return out;
}

}  // namespace trisect::testing
