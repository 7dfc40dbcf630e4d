// SPDX-License-Identifier: Apache-2.0
//
// Zero of a linear function between two points.
// In doubles, with a proved bound of its error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/kernel/point.h>

namespace trisect::detail {

/// The point between u and w where a linear function is 0. Its values there are known up to
/// `error` in sum and have different signs. False when that says too little.
[[nodiscard]] inline bool interpolate(const Approximation& u, double at_u, const Approximation& w,
                                      double at_w, double error, Approximation& x) {
    const double spread = std::fabs(at_u) + std::fabs(at_w);
    if (!(spread > 4 * error)) return false;
    const double lambda = std::fabs(at_u) / spread;
    // |dλ| <= (eu |w| + ew |u|) / (|u|+|w|)^2 to first order; the factor covers the rest.
    const double lambda_error = 2 * error / spread + 0x1p-50;
    double span = 0;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double step = w.c[k] - u.c[k];
        x.c[k] = u.c[k] + lambda * step;
        span = std::max(span, std::fabs(step));
        largest = std::max({largest, std::fabs(u.c[k]), std::fabs(w.c[k])});
    }
    x.error = (span * lambda_error + u.error + w.error + largest * 0x1p-50) * 1.001;
    return true;
}

}  // namespace trisect::detail
