// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_extrude.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <trisect/bsp/modelling/extrusion.h>
#include <trisect/bsp/modelling/revolution.h>

#include <trisect/bsp/csg/csg_shapes.h>

namespace trisect::detail {
namespace {

double largest_radius(const PlaneRegion& region) {
    double out = 0;
    for (const Point2d& p : region.points) out = std::max(out, std::hypot(p[0], p[1]));
    return out;
}

/// By $fn, or by the angle and the length of the way of the outermost point.
double default_slices(const CsgArguments& arguments, double radius, double height, double twist) {
    const double least = std::max(std::ceil(twist / 120), 1.0);
    const double fn = std::floor(arguments.number("$fn", 0));
    if (twist == 0 || radius == 0 || (fn > 0 && fn <= 3)) return least;
    if (fn > 0) return std::max(std::ceil(twist / 360 * fn), least);
    const double way = std::hypot(height, radius * twist * std::numbers::pi / 180);
    const double by_angle = std::ceil(twist / std::max(arguments.number("$fa", 12), 0.01));
    const double by_way = std::ceil(way / std::max(arguments.number("$fs", 2), 0.01));
    return std::max(std::min(by_angle, by_way), least);
}

std::uint32_t layer_count(const CsgArguments& arguments, const PlaneRegion& region, double layers) {
    // A region may be empty; its layers are a number of 32 bits all the same.
    const std::size_t points = std::max<std::size_t>(region.points.size(), 1);
    if (!(layers * static_cast<double>(points) <= shape_limit))
        arguments.fail(ErrorCode::Limit, "too many facets");
    return static_cast<std::uint32_t>(layers);
}

}  // namespace

bool is_straight(const CsgArguments& arguments) {
    const std::vector<double> scale = arguments.numbers("scale", 2, 1);
    return arguments.number("twist", 0) == 0 && scale[0] == 1 && scale[1] == 1;
}

PolygonMesh csg_twisted(const PlaneRegion& region, const CsgArguments& arguments, double low,
                        double high) {
    const double twist = arguments.number("twist", 0);
    const std::vector<double> scale = arguments.numbers("scale", 2, 1);
    const double wanted = arguments.number(
        "slices", default_slices(arguments, largest_radius(region), high - low, std::fabs(twist)));
    ExtrusionOptions options;
    options.twist = -twist;
    options.scale = {std::max(scale[0], 0.0), std::max(scale[1], 0.0)};
    options.divisions = layer_count(arguments, region, std::max(std::floor(wanted), 1.0));
    return extrusion_mesh(region, low, high, options);
}

PolygonMesh csg_revolved(const PlaneRegion& region, const CsgArguments& arguments) {
    double least = 0;
    double most = 0;
    for (const Point2d& p : region.points) {
        least = std::min(least, p[0]);
        most = std::max(most, p[0]);
    }
    if (least < 0 && most > 0)
        arguments.fail(ErrorCode::Input, "the region is on both sides of the axis x = 0");
    RevolutionOptions options;
    options.angle = arguments.number("angle", 360);
    if (options.angle == 0) return {};
    const bool is_full = std::fabs(options.angle) >= 360;
    if (is_full) options.start = 180;
    options.segments = csg_fragments(arguments, most - least);
    const double turns = is_full ? 1 : std::fabs(options.angle) / 360;
    (void)layer_count(arguments, region, options.segments * turns);
    return revolution_mesh(region, options);
}

}  // namespace trisect::detail
