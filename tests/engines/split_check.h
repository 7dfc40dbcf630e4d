// SPDX-License-Identifier: Apache-2.0
//
// Results of split() and evaluate_all() beside those of evaluate().
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "reference/random_solids.h"

namespace engines {

/// What is different of two sets: the mesh corner by corner, the names of its faces, the volume or
/// the lattice. Empty when nothing is. Half-spaces that were made anew have other names, and
/// unbounded sets of them another lattice, which is no difference unless they are
/// `with_same_planes`.
[[nodiscard]] std::string solids_difference(const trisect::Solid& solid,
                                            const trisect::Solid& expected,
                                            bool with_same_planes = true);

/// What is wrong of split(a, b) by one, two and four threads: other solids than of `a & b` and
/// `a - b`, volumes that are not that of `a` together. Empty when nothing is. `shared`: counts
/// splits in one evaluation.
[[nodiscard]] std::string split_difference(const trisect::Solid& a, const trisect::Solid& b,
                                           const trisect::EvaluateOptions& options,
                                           std::uint64_t& shared);

/// The same for the parts between planes, ascending or not. `shared`: counts parts that took no
/// evaluation of their own.
[[nodiscard]] std::string planes_difference(const trisect::Solid& solid,
                                            std::span<const std::array<double, 4>> planes,
                                            const trisect::EvaluateOptions& options,
                                            std::uint64_t& shared);

/// The same for all usual formulas over two solids at once.
[[nodiscard]] std::string all_difference(const trisect::Solid& a, const trisect::Solid& b,
                                         const trisect::EvaluateOptions& options,
                                         std::uint64_t& shared);

/// The operand in units of half the size, each triangle divided into four: enough facets to be
/// evaluated as a whole mesh, with many in one plane.
[[nodiscard]] reference::Operand divided(const reference::Operand& operand);

}  // namespace engines
