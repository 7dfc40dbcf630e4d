// SPDX-License-Identifier: Apache-2.0
//
// sRGB and amounts of light (IEC 61966-2-1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trisect::detail {

[[nodiscard]] inline double light_of_srgb(std::uint8_t level) {
    const double c = level / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// The nearest level of an amount of light; amounts outside 0 to 1 become the nearer of these.
[[nodiscard]] inline std::uint8_t srgb_of_light(double light) {
    const double l = std::clamp(light, 0.0, 1.0);
    const double c = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * c));
}

}  // namespace trisect::detail
