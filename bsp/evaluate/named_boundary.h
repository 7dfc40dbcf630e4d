// SPDX-License-Identifier: Apache-2.0
//
// Solids of boundaries whose faces keep the names that they have.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// As Solid::from_brep, but faces of results have the names of the boundary's faces.
/// \pre the boundary is embedded and not inside out
[[nodiscard]] Solid named_solid(const Brep& brep);

}  // namespace trisect::detail
