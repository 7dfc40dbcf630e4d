// SPDX-License-Identifier: Apache-2.0
//
// Sine and cosine of angles in degrees.
#pragma once

namespace trisect::detail {

/// Multiples of 30 degrees have the exact value where it is a double.
[[nodiscard]] double sine_of_degrees(double degrees);
[[nodiscard]] double cosine_of_degrees(double degrees);

}  // namespace trisect::detail
