// SPDX-License-Identifier: Apache-2.0
//
// Exact planes as pages read them.
#pragma once

#include <trisect/kernel/plane.h>

#include "outcome.h"

namespace trisect::app {

/// Normal and offset of n·x + d = 0 in lattice units: four whole numbers, hexadecimal.
[[nodiscard]] Json plane_json(const Plane& plane);

}  // namespace trisect::app
