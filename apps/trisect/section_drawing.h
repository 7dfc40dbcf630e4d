// SPDX-License-Identifier: Apache-2.0
//
// Sections in the coordinates of their plane, for drawings and measures.
#pragma once

#include <trisect/bsp/brep_index.h>

#include <array>
#include <string>
#include <vector>

#include "svg.h"

namespace trisect::app {

/// Coordinates in a plane seen from above: u to the right, v up. In a plane perpendicular to an
/// axis they are coordinates of space (but for the sign); otherwise they are rounded.
class PlaneFrame {
public:
    /// \pre a, b, c are not all 0.
    explicit PlaneFrame(const std::array<double, 4>& coefficients);

    [[nodiscard]] const std::array<double, 3>& right() const { return right_; }
    [[nodiscard]] const std::array<double, 3>& up() const { return up_; }
    [[nodiscard]] DrawingPoint point(const std::array<double, 3>& p) const;
    [[nodiscard]] std::vector<DrawingPoint> loop(const SectionLoop& loop) const;
    /// The outline and the holes.
    [[nodiscard]] std::vector<std::vector<DrawingPoint>> loops(const SectionRegion& region) const;
    /// Computed in doubles from the rounded corners.
    [[nodiscard]] double area(const SectionRegion& region) const;

private:
    std::array<double, 3> right_{};
    std::array<double, 3> up_{};
};

}  // namespace trisect::app
