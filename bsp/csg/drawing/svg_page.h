// SPDX-License-Identifier: Apache-2.0
//
// Maps of the plane in SVG: transformations, and the page.
#pragma once

#include <array>

#include <trisect/brep/io/models/xml_reader.h>
#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

/// x' = a x + c y + e, y' = b x + d y + f, in the order a to f, as SVG writes it.
struct SvgMap {
    std::array<double, 6> m{1, 0, 0, 1, 0, 0};
    [[nodiscard]] Point2d apply(const Point2d& p) const {
        return {m[0] * p[0] + m[2] * p[1] + m[4], m[1] * p[0] + m[3] * p[1] + m[5]};
    }
};

/// First `first`, then `second`.
[[nodiscard]] SvgMap compose(const SvgMap& second, const SvgMap& first);

/// Of the attribute `transform`. \throw InputError
[[nodiscard]] SvgMap svg_transform(const InputText& source, const char* at, std::string_view text);

/// From the user's units of the outermost element to millimetres with y upwards, the page's lower
/// left corner at the origin. Without a viewBox a unit is a millimetre, as OpenSCAD has it.
/// \throw InputError
[[nodiscard]] SvgMap svg_page(const InputText& source, const XmlElement& svg, double dots_per_inch);

}  // namespace trisect::detail
