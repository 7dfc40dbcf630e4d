// SPDX-License-Identifier: Apache-2.0
//
// Half-spaces: the tree of one, and its move to any lattice.
#pragma once

#include <memory>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/kernel/lattice.h>

namespace trisect::detail {

/// One leaf. \pre the source is a half-space
[[nodiscard]] CellRef half_space_root(const Source& source);

/// Whether the set is one half-space, or the complement of one, on which nothing has operated.
[[nodiscard]] bool is_half_space(const SolidState& state);

/// The same set on a lattice of any unit. \pre is_half_space(state)
/// \throw LimitError when the plane's coefficients there are too long.
[[nodiscard]] std::shared_ptr<const SolidState> half_space_on(const SolidState& state,
                                                              Lattice lattice);

}  // namespace trisect::detail
