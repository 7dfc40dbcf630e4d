// SPDX-License-Identifier: Apache-2.0
//
// SliceFrame: parallel planes, and coordinates in them.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/brep/primitives/point_2d.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// The planes normal . x = height, exactly as the doubles are.
///
/// Coordinates in a plane are two of space: all but that in which the normal is largest, in the
/// order in which the figure is seen from where the normal points. So they are (x, y) across z, (y,
/// z) across x and (z, x) across y, and nothing is rounded or stretched; across -z they are (y, x).
/// A figure in a slanted plane is seen along an axis: space() gives its points back, and measures
/// of slices allow for it.
class SliceFrame {
public:
    /// Across z.
    SliceFrame() : SliceFrame(Point3d{0, 0, 1}) {}
    /// \throw UsageError for a normal of length 0, or with a coordinate that is not finite
    explicit SliceFrame(const Point3d& normal);
    /// 0 is x, 1 is y, 2 is z. \throw UsageError for any other
    [[nodiscard]] static SliceFrame across(int axis);

    [[nodiscard]] const Point3d& normal() const { return normal_; }
    /// Whether it is a unit vector along an axis: then heights are coordinates, but for the sign.
    [[nodiscard]] bool is_axis() const { return is_axis_; }
    /// Which two coordinates of space are those in the plane, and which one is left out.
    [[nodiscard]] const std::array<std::size_t, 2>& axes() const { return axes_; }
    [[nodiscard]] std::size_t along() const { return along_; }

    /// The point of the plane at a height with these coordinates. The third coordinate is exact
    /// where is_axis(); else it is computed in doubles.
    [[nodiscard]] Point3d space(const Point2d& point, double height) const;
    /// How much larger areas are in the plane than in its coordinates: 1 across an axis.
    [[nodiscard]] double stretch() const;

private:
    Point3d normal_;
    std::array<std::size_t, 2> axes_{0, 1};
    std::size_t along_ = 2;
    bool is_axis_ = true;
};

}  // namespace trisect
