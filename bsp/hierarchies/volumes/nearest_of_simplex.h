// SPDX-License-Identifier: Apache-2.0
//
// Simplex: up to four points, and the point nearest to the origin.
// The nearest point is that of their convex hull.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/bsp/interference/boxes/obb_fit.h>

namespace trisect::hierarchies {

/// What the iteration of Gilbert, Johnson and Keerthi keeps of a convex set. In doubles without
/// guarantees: for searches whose results are proved by other means. But `nearest` is in the hull
/// of points that were added, up to rounding: weights are not negative and their sum is 1.
class Simplex {
public:
    /// \pre fewer than four points are kept: nearest() was called since the fourth.
    void add(const detail::Vector3& p) { point_[count_++] = p; }
    /// The nearest point to the origin; keeps only the points that it is in the hull of, four if
    /// the origin is inside.
    detail::Vector3 nearest();
    [[nodiscard]] std::size_t count() const { return count_; }

private:
    std::array<detail::Vector3, 4> point_{};
    std::size_t count_ = 0;
};

}  // namespace trisect::hierarchies
