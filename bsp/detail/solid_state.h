// SPDX-License-Identifier: Apache-2.0
//
// SolidState: what a Solid shares between its copies.
#pragma once

#include <memory>

#include <trisect/bsp/cell_tree.h>

namespace trisect::detail {

struct SolidState {
    Lattice lattice;
    CellRef root;
    bool embedded = true;  ///< free of self-intersection, winding numbers 0 and 1 only
    std::uint64_t source = 0;  ///< serial of the one source of an imported solid
    bool lattice_matters = true;  ///< false for the empty set and whole space
};

}  // namespace trisect::detail
