// SPDX-License-Identifier: Apache-2.0
//
// Operands on different lattices are moved to the finest of them, exactly.
#pragma once

#include <memory>
#include <vector>

#include <trisect/bsp/detail/solid_state.h>

namespace trisect::detail {

/// Replaces every state that lies on a coarser lattice by an equal one on the finest lattice, and
/// returns that lattice. Solids on it already keep their trees; the others become unrefined.
/// \throw LimitError when a coordinate leaves the range of the common lattice.
[[nodiscard]] Lattice move_to_common_lattice(
    std::vector<std::shared_ptr<const SolidState>>& states);

}  // namespace trisect::detail
