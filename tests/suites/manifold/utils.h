// SPDX-License-Identifier: Apache-2.0
//
// Stand-in for a private header of Manifold's that its tests include: what they use of it.
#pragma once

#include <manifold/common.h>

namespace manifold {

// NOLINTNEXTLINE(readability-identifier-naming): theirs
inline constexpr double kPrecision = 1e-12;

}  // namespace manifold
