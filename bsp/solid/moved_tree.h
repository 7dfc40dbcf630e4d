// SPDX-License-Identifier: Apache-2.0
//
// Exact moves of a tree: the same cells and polygons somewhere else.
#pragma once

#include <memory>

#include <trisect/bsp/cells/lattice_move.h>
#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// The polygons of a tree, but for unbounded ones. Empty when there are none.
[[nodiscard]] Box box_of(const CellRef& root);

/// The moved set, on the same lattice. O(n); nothing is cut.
/// \pre its form is a tree
/// \throw LimitError when something leaves the range of the lattice
[[nodiscard]] std::shared_ptr<const SolidState> moved_state(const SolidState& state,
                                                            const LatticeMove& move);

}  // namespace trisect::detail
