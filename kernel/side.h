// SPDX-License-Identifier: Apache-2.0
//
// Side: position relative to an oriented plane.
#pragma once

#include <cstdint>

namespace trisect {

/// Above is the side that the plane's normal points to. A solid lies Below its face planes.
enum class Side : std::int8_t { Below = -1, On = 0, Above = 1 };

[[nodiscard]] constexpr Side side_from_sign(int s) {
    return s < 0 ? Side::Below : (s > 0 ? Side::Above : Side::On);
}
[[nodiscard]] constexpr Side opposite(Side s) {
    return static_cast<Side>(-static_cast<std::int8_t>(s));
}
[[nodiscard]] constexpr int sign_of(Side s) { return static_cast<int>(s); }

}  // namespace trisect
