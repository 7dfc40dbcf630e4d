// SPDX-License-Identifier: Apache-2.0
#include "section_drawing.h"

#include <trisect/kernel/error.h>

#include "render_camera.h"

namespace trisect::app {
namespace {

std::array<double, 3> to_array(const Eigen::Vector3d& v) {
    return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};  // no -0
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double signed_area(const std::vector<DrawingPoint>& loop) {
    double twice = 0;
    for (std::size_t i = 2; i < loop.size(); ++i) {
        // Relative to the first corner: far from the origin that loses fewer digits.
        const double au = loop[i - 1][0] - loop[0][0];
        const double av = loop[i - 1][1] - loop[0][1];
        const double bu = loop[i][0] - loop[0][0];
        const double bv = loop[i][1] - loop[0][1];
        twice += au * bv - av * bu;
    }
    return twice / 2;
}

}  // namespace

PlaneFrame::PlaneFrame(const std::array<double, 4>& coefficients) {
    const View view = View::from_eye_direction(
        Eigen::Vector3d(coefficients[0], coefficients[1], coefficients[2]));
    right_ = to_array(view.right);
    up_ = to_array(view.up);
}

DrawingPoint PlaneFrame::point(const std::array<double, 3>& p) const {
    return {dot(p, right_), dot(p, up_)};
}

std::vector<DrawingPoint> PlaneFrame::loop(const SectionLoop& loop) const {
    std::vector<DrawingPoint> out;
    out.reserve(loop.rounded.size());
    for (const auto& p : loop.rounded) out.push_back(point(p));
    return out;
}

std::vector<std::vector<DrawingPoint>> PlaneFrame::loops(const SectionRegion& region) const {
    std::vector<std::vector<DrawingPoint>> out{loop(region.outer)};
    for (const SectionLoop& hole : region.holes) out.push_back(loop(hole));
    return out;
}

double PlaneFrame::area(const SectionRegion& region) const {
    double sum = 0;
    for (const auto& corners : loops(region)) sum += signed_area(corners);
    return sum;
}

}  // namespace trisect::app
