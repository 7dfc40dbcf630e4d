// SPDX-License-Identifier: Apache-2.0
//
// The position in an array that a signed number stands for.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trisect::detail {

/// \pre i >= 0
[[nodiscard]] constexpr std::size_t as_index(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace trisect::detail
