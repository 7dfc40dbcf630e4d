// SPDX-License-Identifier: Apache-2.0
//
// LineThrough: a line beside or through convex polygons, in doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

/// A line through a point, both with errors in each coordinate.
class LineThrough {
public:
    LineThrough(const Vector3& origin, double origin_error, const Vector3& direction,
                double direction_error)
        : o_(origin), o_error_(origin_error), d_(direction), d_error_(direction_error) {}

    /// 1: through the interior of a convex polygon whose corners are within their errors of these;
    /// -1: past it; 0: doubles do not decide. \pre three corners or more, or none.
    ///
    /// With a and b the corners of a side seen from the origin, the signs of d · (a × b) say it.
    /// For components below M of a and b, and below D of d, with errors e of a and b and f of d, a
    /// determinant errs by M^2 (r D + 6 f) + 12 M D e, r = difference_determinant_rounding.
    [[nodiscard]] int of(std::span<const Approximation> corners) const {
        if (corners.empty()) return 0;
        const double dm = largest_component(d_);
        bool left = true;
        bool right = true;
        bool any_left = false;
        bool any_right = false;
        Vector3 a = minus(corners.back().c, o_);
        double a_error = corners.back().error;
        for (const Approximation& corner : corners) {
            const Vector3 b = minus(corner.c, o_);
            const double m = std::max(largest_component(a), largest_component(b));
            const double e = o_error_ + std::max(a_error, corner.error);
            if (!(e < m && d_error_ < dm)) return 0;
            const double bound =
                m * m * (difference_determinant_rounding * dm + 24 * d_error_) + 48 * m * dm * e;
            const double value = dot(d_, cross(a, b));
            left = left && value > bound;
            right = right && value < -bound;
            any_left = any_left || value > bound;
            any_right = any_right || value < -bound;
            a = b;
            a_error = corner.error;
        }
        if (any_left && any_right) return -1;
        return left || right ? 1 : 0;
    }

private:
    Vector3 o_;
    double o_error_;
    Vector3 d_;
    double d_error_;
};

}  // namespace trisect::detail
