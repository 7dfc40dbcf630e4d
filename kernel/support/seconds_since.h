// SPDX-License-Identifier: Apache-2.0
//
// Time passed on the steady clock.
#pragma once

#include <chrono>

namespace trisect::detail {

[[nodiscard]] inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace trisect::detail
