// SPDX-License-Identifier: Apache-2.0
//
// A direction for an infinitesimal shift.
#pragma once

#include <array>
#include <optional>
#include <span>

#include <trisect/bsp/cells/infinitesimal_shift.h>

namespace trisect::detail {

/// A shift that has a positive product with all directions, by their signs, of which the first one
/// that is not 0 counts; nothing where there is none.
[[nodiscard]] std::optional<InfinitesimalShift> shift_along(
    std::span<const std::array<int, 3>> directions);

}  // namespace trisect::detail
