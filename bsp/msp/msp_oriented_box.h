// SPDX-License-Identifier: Apache-2.0
//
// OrientedBox: a box along the principal directions of some points.
#pragma once

#include <array>
#include <span>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail::msp {

/// Contains the points that it was made of, errors included. A strip of a curved surface fills its
/// axis-aligned box badly; planes that nearly touch the strip pass through the box far from it.
class OrientedBox {
public:
    /// \pre there are points
    explicit OrientedBox(std::span<const Approximation> points);
    /// The strict side on which all of the box lies, or On when doubles cannot decide.
    [[nodiscard]] Side side(const Plane& plane) const;

private:
    using Vector = std::array<double, 3>;
    Vector centre_{};
    std::array<Vector, 3> axis_{};  ///< nearly orthonormal; scaled by the half lengths
    double slack_ = 0;              ///< what rounding may have cost, in any direction
};

}  // namespace trisect::detail::msp
