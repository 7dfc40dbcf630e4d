// SPDX-License-Identifier: Apache-2.0
//
// Planes given by doubles in the user's units, on a lattice.
#pragma once

#include <array>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>

namespace trisect {

/// The plane a x + b y + c z + d = 0 of doubles in the user's units, exactly, on a lattice.
/// \throw UsageError when it is no plane, LimitError when its coefficients span too many bits for
/// a Plane (they fit when they have at most about 80 significant bits in common units).
[[nodiscard]] Plane plane_on_lattice(const std::array<double, 4>& coefficients, Lattice lattice);

}  // namespace trisect
