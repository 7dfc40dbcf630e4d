// SPDX-License-Identifier: Apache-2.0
//
// Colours, and the palette that pictures and drawings share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace trisect::app {

/// sRGB, as in 0xRRGGBB.
struct Color {
    std::uint32_t rgb = 0;
    [[nodiscard]] constexpr std::uint8_t channel(int i) const {
        return static_cast<std::uint8_t>(rgb >> (16 - 8 * i));
    }
    /// "#rrggbb"
    [[nodiscard]] std::string hex() const;
};

/// Red, green and blue as amounts of light, from 0 to 1.
using LinearColor = std::array<float, 3>;

[[nodiscard]] LinearColor to_light(Color color);
/// The nearest of 256 levels of sRGB.
[[nodiscard]] std::uint8_t to_srgb(float light);

/// The colour of the operand with this number, the first one being 0. They differ in lightness as
/// well as in hue, for readers who do not tell red from green; after eight they come again.
[[nodiscard]] Color operand_color(std::size_t number);

/// A darker one of the same hue, for lines on white.
[[nodiscard]] Color operand_line_color(std::size_t number);

inline constexpr Color ink{0x1b2735};
inline constexpr Color section_color{0xfbe3bd};
inline constexpr Color hatch_color{0xc8603a};

}  // namespace trisect::app
