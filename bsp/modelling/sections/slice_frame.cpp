// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/slice_frame.h>

#include <cmath>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect {

SliceFrame::SliceFrame(const Point3d& normal) : normal_(normal) {
    for (const double c : normal)
        if (!std::isfinite(c)) throw UsageError("a normal of slices must be finite");
    if (normal == Point3d{0, 0, 0}) throw UsageError("a normal of slices must not be zero");
    for (const std::size_t k : {std::size_t{1}, std::size_t{0}})
        if (std::fabs(normal[k]) > std::fabs(normal[along_])) along_ = k;
    axes_ = {(along_ + 1) % 3, (along_ + 2) % 3};
    is_axis_ = std::fabs(normal[along_]) == 1 && normal[axes_[0]] == 0 && normal[axes_[1]] == 0;
    if (normal[along_] < 0) std::swap(axes_[0], axes_[1]);
}

SliceFrame SliceFrame::across(int axis) {
    if (axis < 0 || axis > 2) throw UsageError("an axis of slices must be 0, 1 or 2");
    Point3d normal{0, 0, 0};
    normal[static_cast<std::size_t>(axis)] = 1;
    return SliceFrame(normal);
}

Point3d SliceFrame::space(const Point2d& point, double height) const {
    Point3d out{};
    out[axes_[0]] = point[0];
    out[axes_[1]] = point[1];
    const double rest = normal_[axes_[0]] * point[0] + normal_[axes_[1]] * point[1];
    out[along_] = (is_axis_ ? height : height - rest) / normal_[along_] + 0.0;
    return out;
}

double SliceFrame::stretch() const {
    return is_axis_ ? 1
                    : std::hypot(normal_[0], normal_[1], normal_[2]) / std::fabs(normal_[along_]);
}

}  // namespace trisect
