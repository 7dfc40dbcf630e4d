// SPDX-License-Identifier: Apache-2.0
//
// Rounding of doubles to floats and back.
#pragma once

namespace trisect::detail {

/// The nearest float, as a double. A function of its own that loops cannot be vectorized over: at
/// -O3 g++ 12 leaves coordinates at the end as they are where a loop over points has one over their
/// coordinates, and each is converted to float and back.
[[nodiscard]] double nearest_float(double v);

}  // namespace trisect::detail
