// SPDX-License-Identifier: Apache-2.0
//
// Colours between sRGB and amounts of light (IEC 61966-2-1).
#include <trisect/brep/io/property_colors.h>

#include <cmath>

namespace trisect {
namespace {

/// 0 to 1 either way; numbers outside stay, by the same formulas.
double light_of_srgb_number(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double srgb_number_of_light(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace

bool has_linear_colors(MeshFormat format) noexcept { return format == MeshFormat::Glb; }

void convert_colors(CornerProperties& properties, bool to_linear) {
    const PropertyMeaning from = to_linear ? PropertyMeaning::Color : PropertyMeaning::LinearColor;
    const PropertyMeaning to = to_linear ? PropertyMeaning::LinearColor : PropertyMeaning::Color;
    std::size_t column = 0;
    for (PropertyChannel& channel : properties.channels) {
        const std::size_t first = column;
        column += channel.width;
        if (channel.meaning != from) continue;
        channel.meaning = to;
        const std::size_t parts = channel.width < 3 ? channel.width : 3;
        for (std::size_t at = first; at < properties.values.size(); at += properties.width)
            for (std::size_t i = 0; i < parts; ++i) {
                double& value = properties.values[at + i];
                value = to_linear ? light_of_srgb_number(value) : srgb_number_of_light(value);
            }
    }
}

}  // namespace trisect
