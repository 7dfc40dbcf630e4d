// SPDX-License-Identifier: Apache-2.0
//
// ExactPoint: a point or vector of three fractions.
#pragma once

#include <array>

#include <trisect/brep/exact_rational.h>

namespace trisect {

/// In the user's units.
using ExactPoint = std::array<ExactRational, 3>;

}  // namespace trisect
