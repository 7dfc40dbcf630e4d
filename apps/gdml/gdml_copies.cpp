// SPDX-License-Identifier: Apache-2.0
#include "gdml_copies.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trisect::app {
namespace {

constexpr std::uint32_t most_copies = 1U << 22;
constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

std::vector<Point3d> moves_along(std::size_t axis, std::uint32_t number, double first,
                                 double width) {
    std::vector<Point3d> out(number);
    for (std::uint32_t i = 0; i < number; ++i) out[i][axis] = first + width * i;
    return out;
}

/// The axis of an element <direction>: the one whose attribute is 1.
std::optional<std::size_t> direction(const GdmlSource& source, const GdmlElement& along) {
    const GdmlElement* e = along.child("direction");
    if (e == nullptr) return std::nullopt;
    for (std::size_t axis = 0; axis < axis_names.size(); ++axis)
        if (source.values.number(*e, axis_names[axis], 0) == 1) return axis;
    return std::nullopt;
}

double side_of_box(const GdmlSource& source, const GdmlElement& division, const GdmlElement& solid,
                   std::size_t axis) {
    if (solid.name != "box")
        source.document.fail_unsupported(division,
                                         "<divisionvol> of <" + solid.name + "> is not supported");
    return source.values.length(solid, axis_names[axis]);
}

}  // namespace

std::vector<Point3d> gdml_replica_moves(const GdmlSource& source, const GdmlElement& element) {
    const GdmlElement* along = element.child("replicate_along_axis");
    const auto axis = along == nullptr ? std::nullopt : direction(source, *along);
    if (!axis)
        source.document.fail_unsupported(element,
                                         "<replicavol> not along x, y or z is not supported");
    const GdmlElement* wide = along->child("width");
    if (wide == nullptr) source.document.fail(*along, "<replicate_along_axis> without <width>");
    const std::uint32_t number = source.values.count(element, "number", 1, most_copies);
    const double width = source.values.length(*wide, "value");
    // All copies are rounded as the first one is, so they are as far apart as their width.
    return moves_along(*axis, number, -std::floor((number - 1) * width / 2), width);
}

std::vector<Point3d> gdml_division_moves(const GdmlSource& source, const GdmlElement& element,
                                         const GdmlElement& mother, const GdmlElement& daughter) {
    const std::string axis_name = source.document.required(element, "axis");
    std::optional<std::size_t> axis;
    for (std::size_t i = 0; i < axis_names.size(); ++i)
        if (axis_name == std::array{"kXAxis", "kYAxis", "kZAxis"}[i]) axis = i;
    if (!axis)
        source.document.fail_unsupported(element,
                                         "<divisionvol> along " + axis_name + " is not supported");
    const double whole = side_of_box(source, element, mother, *axis);
    const double cell = side_of_box(source, element, daughter, *axis);
    const double offset = source.values.length(element, "offset", 0);
    const bool has_number = source.values.number(element, "number", 0) != 0;
    double width = source.values.length(element, "width", 0);
    if (!has_number && width <= 0)
        source.document.fail(element, "<divisionvol> without number and width");
    const std::uint32_t number = has_number
                                     ? source.values.count(element, "number", 1, most_copies)
                                     : static_cast<std::uint32_t>(std::fmin(
                                           std::floor((whole - offset) / width), most_copies));
    if (width <= 0) width = (whole - offset) / number;
    if (std::fabs(width - cell) > 1)
        source.document.fail_unsupported(
            element, "<divisionvol> whose daughter is not as wide as a copy is not supported");
    return moves_along(*axis, number, std::nearbyint(offset + (width - whole) / 2), width);
}

}  // namespace trisect::app
