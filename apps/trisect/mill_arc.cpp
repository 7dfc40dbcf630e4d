// SPDX-License-Identifier: Apache-2.0
#include "mill_arc.h"

#include <trisect/kernel/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace trisect::app {
namespace {

/// The axes of a plane, and the one across it.
std::array<std::size_t, 3> axes_of(int plane) {
    const auto p = static_cast<std::size_t>(plane);
    constexpr std::array<std::array<std::size_t, 3>, 3> axes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    return axes.at(p);
}

}  // namespace

std::vector<Point3d> chords_of(const Arc& arc, double deviation) {
    const auto [u, v, w] = axes_of(arc.plane);
    const double from_u = arc.from[u] - arc.center[u];
    const double from_v = arc.from[v] - arc.center[v];
    const double to_u = arc.to[u] - arc.center[u];
    const double to_v = arc.to[v] - arc.center[v];
    const double from_radius = std::hypot(from_u, from_v);
    const double to_radius = std::hypot(to_u, to_v);
    if (from_radius == 0 || to_radius == 0) throw UsageError("an arc without a radius");
    if (std::abs(from_radius - to_radius) > std::max(0.002, 0.001 * from_radius))
        throw UsageError("the ends of the arc have different distances from its centre");
    const double begin = std::atan2(from_v, from_u);
    double angle = std::atan2(to_v, to_u) - begin;
    const bool is_circle = arc.from[u] == arc.to[u] && arc.from[v] == arc.to[v];
    constexpr double turn = 2 * std::numbers::pi;
    if (arc.is_clockwise && (angle >= 0 || is_circle)) angle -= turn;
    if (!arc.is_clockwise && (angle <= 0 || is_circle)) angle += turn;
    if (is_circle) angle = arc.is_clockwise ? -turn : turn;
    const double largest = std::max(from_radius, to_radius);
    const double widest = 2 * std::acos(std::max(0.0, 1 - deviation / largest));
    const double count = std::max(std::ceil(std::abs(angle) / std::max(widest, 1e-9)), 1.0);
    if (count > 1e6) throw UsageError("an arc of more than a million chords (--chord)");
    std::vector<Point3d> out;
    for (double i = 1; i < count; ++i) {
        const double t = i / count;
        const double radius = from_radius + t * (to_radius - from_radius);
        Point3d p{};
        p[u] = arc.center[u] + radius * std::cos(begin + t * angle);
        p[v] = arc.center[v] + radius * std::sin(begin + t * angle);
        p[w] = arc.from[w] + t * (arc.to[w] - arc.from[w]);
        out.push_back(p);
    }
    out.push_back(arc.to);
    return out;
}

Point3d center_by_radius(const Arc& arc, double radius) {
    const auto [u, v, w] = axes_of(arc.plane);
    const double du = arc.to[u] - arc.from[u];
    const double dv = arc.to[v] - arc.from[v];
    const double length = std::hypot(du, dv);
    if (length == 0) throw UsageError("a full circle needs I, J, K");
    const double square = radius * radius - length * length / 4;
    // A half circle whose radius was rounded has its centre in the middle.
    if (square < -1e-3 * radius * radius)
        throw UsageError("the radius does not reach from end to end");
    const double height = std::sqrt(std::max(square, 0.0));
    // The centre of the shorter clockwise arc lies to the right.
    const double side = (arc.is_clockwise ? -1 : 1) * (radius < 0 ? -1 : 1);
    Point3d center = arc.from;
    center[u] += du / 2 - side * height * dv / length;
    center[v] += dv / 2 + side * height * du / length;
    return center;
}

}  // namespace trisect::app
