// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/glyph_shapes.h>

#include <cmath>
#include <utility>

namespace trisect::detail {
namespace {

double twice_area(const Outline& outline) {
    double out = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point2d& p = outline[i];
        const Point2d& q = outline[(i + 1) % outline.size()];
        out += p[0] * q[1] - p[1] * q[0];
    }
    return out;
}

bool goes_around(const Outline& outline, const Point2d& at) {
    bool out = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point2d& p = outline[i];
        const Point2d& q = outline[(i + 1) % outline.size()];
        if ((p[1] > at[1]) == (q[1] > at[1])) continue;
        const double x = p[0] + (at[1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
        if (x > at[0]) out = !out;
    }
    return out;
}

}  // namespace

std::vector<DrawingShape> glyph_shapes(std::vector<Outline> contours) {
    double sum = 0;
    std::vector<double> areas;
    for (const Outline& contour : contours) sum += areas.emplace_back(twice_area(contour));
    std::vector<DrawingShape> out;
    std::vector<double> sizes;
    std::vector<Outline> holes;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        if (contours[i].size() < 3 || areas[i] == 0) continue;
        if ((areas[i] > 0) == (sum > 0)) {
            out.push_back({{std::move(contours[i])}, {}});
            sizes.push_back(std::fabs(areas[i]));
        } else {
            holes.push_back(std::move(contours[i]));
        }
    }
    for (Outline& hole : holes) {
        std::size_t best = out.size();
        for (std::size_t s = 0; s < sizes.size(); ++s)
            if ((best == out.size() || sizes[s] < sizes[best]) &&
                goes_around(out[s].outlines[0], hole[0]))
                best = s;
        if (best < sizes.size())
            out[best].outlines.push_back(std::move(hole));
        else
            out.push_back({{std::move(hole)}, {}});
    }
    return out;
}

}  // namespace trisect::detail
