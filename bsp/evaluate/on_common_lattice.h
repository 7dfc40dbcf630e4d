// SPDX-License-Identifier: Apache-2.0
//
// Conversion of operands on different lattices to a common one.
#pragma once

#include <memory>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/lattice.h>

namespace trisect::detail {

/// Replaces every state that lies on another lattice than the common one, and returns that lattice
/// and what was rounded on the way to it. Solids on it already keep their trees; the others become
/// equal sets, unrefined, under the same names of faces.
///
/// The common lattice is the finest one of an operand where all are whole and have room there,
/// unless most of the facets are on coarser ones; else the coarsest one, on which the finer
/// operands get fractions. Where these have too many digits, it is a finer one on which all fit.
/// Where there is none the finer operands are rounded to one on which the coarser ones fit: these
/// are new sources that may intersect themselves and are to be resolved. \throw LimitError when
/// rounding is refused, or would leave nothing of an operand, or an operand is a half-space.
[[nodiscard]] LatticeReport move_to_common_lattice(
    std::vector<std::shared_ptr<const SolidState>>& states, EvaluateOptions::Lattices policy);

/// An equal set on another lattice, unrefined. \throw LimitError where it has no place there
/// without rounding.
[[nodiscard]] std::shared_ptr<const SolidState> moved_to_lattice(
    const std::shared_ptr<const SolidState>& state, Lattice lattice);

/// An equal set with a tree of one leaf.
[[nodiscard]] std::shared_ptr<const SolidState> without_tree(
    const std::shared_ptr<const SolidState>& state);

}  // namespace trisect::detail
