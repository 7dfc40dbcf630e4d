// SPDX-License-Identifier: Apache-2.0
//
// Two meshes of so few facets that a leaf has them all.
#pragma once

#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// Whether the boxes of the meshes are apart, or corners of one lie on facets of the other, as far
/// as doubles show: a leaf would be arranged exactly then, which takes twice as long as to
/// compare whole facets. \pre whole meshes of few facets. O(nm)
[[nodiscard]] bool are_apart_or_touch(const SolidStates& solids);

}  // namespace trisect::detail
