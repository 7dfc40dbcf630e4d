// SPDX-License-Identifier: Apache-2.0
//
// The part of a solid on one side of a plane.
#pragma once

#include <array>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// The points of a solid with a x + b y + c z + d >= 0: the side to which the normal points. Exact,
/// for the coefficients as they are. A face in the plane is a face of the part on its side, and of
/// nothing on the other one.
/// \throw as Solid::half_space() and evaluate()
[[nodiscard]] Solid trimmed(const Solid& solid, const std::array<double, 4>& plane,
                            const EvaluateOptions& options = {});

}  // namespace trisect
