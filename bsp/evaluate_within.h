// SPDX-License-Identifier: Apache-2.0
//
// evaluate_within: a formula evaluated in one box of space.
#pragma once

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/expression.h>

namespace trisect {

/// The set that the formula describes, within a box. Exact. Operands need to be right near the box
/// only: what they are elsewhere is never looked at, and may meet itself there. So a part of a mesh
/// that no memory holds will do, closed by any triangles beyond the box.
///
/// `window` is the box: a solid of make_box(). Its faces are those of the result in the box's
/// sides, by their names. The operands have to be right up to three units of the common lattice
/// beyond it; that is the coarsest one of them and the window, or a finer one.
/// \pre operands are imported meshes that nothing was done to
/// \throw UsageError when one is not, or when the window is no box along the axes; otherwise as
/// evaluate()
[[nodiscard]] Solid evaluate_within(const Solid& window, const Expression& expression,
                                    const EvaluateOptions& options = {},
                                    EvaluateReport* report = nullptr);

/// A closed mesh as an operand that may meet itself, beyond the box and in it. Facets that do are
/// looked for at once, where Embedding::Check would first ask whether there are any.
[[nodiscard]] Solid operand_within(LatticeMesh mesh);

}  // namespace trisect
