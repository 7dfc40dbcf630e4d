// SPDX-License-Identifier: Apache-2.0
#include "color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trisect::app {
namespace {

// IEC 61966-2-1.
double srgb_to_light(double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
double light_to_srgb(double l) {
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

constexpr int table_size = 4096;

std::vector<std::uint8_t> srgb_table() {
    std::vector<std::uint8_t> table(table_size + 1);
    for (int i = 0; i <= table_size; ++i) {
        table[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
            std::lround(255 * light_to_srgb(static_cast<double>(i) / table_size)));
    }
    return table;
}

}  // namespace

std::string Color::hex() const { return fmt::format("#{:06x}", rgb); }

LinearColor to_light(Color color) {
    LinearColor light{};
    for (int i = 0; i < 3; ++i) {
        light[static_cast<std::size_t>(i)] =
            static_cast<float>(srgb_to_light(color.channel(i) / 255.0));
    }
    return light;
}

std::uint8_t to_srgb(float light) {
    static const std::vector<std::uint8_t> table = srgb_table();
    const float position = std::clamp(light, 0.0F, 1.0F) * table_size + 0.5F;
    return table[static_cast<std::size_t>(position)];
}

Color operand_color(std::size_t number) {
    static constexpr Color colors[] = {{0x9cb8d8}, {0xf0a35e}, {0x86bf8b}, {0xd98a9f},
                                       {0xb3a1dc}, {0xe8cf6a}, {0x6fc0bd}, {0xb79878}};
    return colors[number % std::size(colors)];
}

Color operand_line_color(std::size_t number) {
    static constexpr Color colors[] = {{0x2a62a8}, {0xc45f14}, {0x2f7d3b}, {0xb03a5b},
                                       {0x6a4fb0}, {0x937a08}, {0x1d7f7c}, {0x77552e}};
    return colors[number % std::size(colors)];
}

}  // namespace trisect::app
