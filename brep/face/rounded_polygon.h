// SPDX-License-Identifier: Apache-2.0
//
// Corners of a small polygon in plane coordinates, as nearly exact doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/brep/face/small_polygon.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

/// Turns between corners by doubles. Where corners are rounded correctly that decides nearly all
/// turns but those on one line. Doubles as approximate() makes them, with errors ten to a thousand
/// times as large, leave open what two cuts by nearly coplanar facets make; and the two halves of
/// each face of a box that was rotated are such facets.
class RoundedPolygon {
public:
    void clear() {
        size_ = 0;
        error_ = 0;
    }
    /// A corner whose coordinates are off by at most `error` each; seen from above the polygon's
    /// plane, v is a quarter turn to the left of u.
    /// \pre fewer than small_polygon_limit corners so far; coordinates are 0 or between 2^-340 and
    /// 2^400.
    void add(double u, double v, double error) {
        u_[size_] = u;
        v_[size_] = v;
        ++size_;
        error_ = std::max(error_, error);
    }
    /// A corner whose coordinates are the nearest doubles of the exact ones.
    void add_nearest(double u, double v) {
        add(u, v, unit_roundoff * std::max(std::fabs(u), std::fabs(v)));
    }
    [[nodiscard]] std::size_t size() const { return size_; }

    /// 1 when corners a, b, c turn left, -1 when they turn right, 0 when doubles do not decide.
    ///
    /// (a - c) × (b - c). A difference is off by 2e and one rounding, each product by the errors of
    /// its factors and one rounding, the difference of the products by one more: 4u (|s| + |t|),
    /// and 8u with the roundings of the bound, beside what 2e makes of the products. Differences
    /// are 0 or at least 2^-393, so nothing underflows.
    [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const double au = u_[a] - u_[c];
        const double av = v_[a] - v_[c];
        const double bu = u_[b] - u_[c];
        const double bv = v_[b] - v_[c];
        const double s = au * bv;
        const double t = av * bu;
        const double sides = (std::fabs(au) + std::fabs(av)) + (std::fabs(bu) + std::fabs(bv));
        const double bound = minor_rounding * (std::fabs(s) + std::fabs(t)) +
                             2.0000002 * error_ * (sides + 4 * error_);
        if (s - t > bound) return 1;
        if (t - s > bound) return -1;
        return 0;
    }

private:
    std::array<double, small_polygon_limit> u_;
    std::array<double, small_polygon_limit> v_;
    std::size_t size_ = 0;
    double error_ = 0;  // of any coordinate
};

}  // namespace trisect::detail
