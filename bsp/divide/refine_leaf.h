// SPDX-License-Identifier: Apache-2.0
//
// Refinement of large leaves of a solid, shared by all its users.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// A leaf whose polygons outnumber those of the other operands is halved by itself; so a small tool
/// does not decide where a large part is cut, and no part is cut twice. Halves that are still as
/// large are halved at once, a few levels deep.
inline constexpr std::size_t refinable_leaf = 512;

/// The leaf's two halves as a node with children, made on first use and kept with the leaf. The
/// splitting planes depend on the leaf and its cell only. Nothing when halving does not separate
/// the polygons. Safe to call from several threads at once. `threads`: 1, or 0 for as many as there
/// are here; the outcome does not depend on it.
[[nodiscard]] const CellNode* refined(const CellNode& leaf, const Cell& cell,
                                      std::uint32_t threads = 1);

/// Refines all large leaves below a node, those of refinements too. `threads` as in
/// EvaluateOptions.
void refine_all(const CellRef& root, std::uint32_t threads);

}  // namespace trisect::detail
