// SPDX-License-Identifier: Apache-2.0
//
// Booleans of prisms over regions of the plane.
#pragma once

#include <memory>
#include <optional>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// The value of a formula as an arrangement of segments. Nothing where an operand is none of these
/// prisms, they differ in axis or heights, the value is not bounded, or there is no lattice on
/// which all are exact.
[[nodiscard]] std::shared_ptr<SolidState> evaluate_flat(const Translation& translation,
                                                        const EvaluateOptions& options);

/// The same formula, with prisms that are meshes in place of prisms that were made of them and are
/// none. Nothing where there are no such operands, or some that are made of others than meshes.
[[nodiscard]] std::optional<Translation> over_prisms(const Translation& translation);

}  // namespace trisect::detail
