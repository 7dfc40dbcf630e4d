// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/circle.h>

#include <cmath>
#include <numbers>

#include <trisect/kernel/error.h>

namespace trisect::detail {

void require_positive(double value, const std::string& name) {
    if (!std::isfinite(value) || value <= 0)
        throw UsageError(name + " must be a positive number, not " + std::to_string(value));
}

void require_between(std::uint32_t value, std::uint32_t low, std::uint32_t high,
                     const std::string& name) {
    if (value < low || value > high)
        throw UsageError(name + " must be between " + std::to_string(low) + " and " +
                         std::to_string(high) + ", not " + std::to_string(value));
}

double snap(double coordinate, double extent) {
    int top = 0;
    std::frexp(extent, &top);
    return std::ldexp(std::nearbyint(std::ldexp(coordinate, 32 - top)), top - 32);
}

std::vector<Point2d> circle(double radius, std::uint32_t segments, double extent) {
    std::vector<Point2d> points;
    points.reserve(segments);
    const std::uint32_t computed = segments % 4 == 0 ? segments / 4 : segments;
    for (std::uint32_t i = 0; i < computed; ++i) {
        const double angle = 2 * std::numbers::pi * i / segments;
        points.push_back(
            {snap(radius * std::cos(angle), extent), snap(radius * std::sin(angle), extent)});
    }
    while (points.size() < segments) {
        const Point2d p = points[points.size() - computed];
        points.push_back({-p[1], p[0]});
    }
    return points;
}

}  // namespace trisect::detail
