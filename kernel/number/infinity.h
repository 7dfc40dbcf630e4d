// SPDX-License-Identifier: Apache-2.0
//
// The double above all numbers.
#pragma once

#include <limits>

namespace trisect::detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace trisect::detail
