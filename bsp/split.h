// SPDX-License-Identifier: Apache-2.0
//
// split: both parts of a solid, from one evaluation.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <trisect/bsp/evaluate_all.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// Their union is the solid that was split, and they have no volume in common.
struct SplitSolid {
    Solid common;  ///< inside the other set, or below the plane
    Solid rest;    ///< outside of it, or above the plane
};

/// The sets `a & b` and `a - b`: exactly those, with the names of faces and the meshes that
/// evaluate() gives. Any operands, unbounded ones as well; where `a` only touches `b` one part is
/// empty.
///
/// Of two meshes facets are compared once (evaluate_all()); a mesh is cut by a half-space in one
/// pass. Where neither serves, since an operand is a result with a tree, meets itself, or the plane
/// goes through a corner, this is two evaluations; EvaluateAllCounters has how many it was.
/// \throw as evaluate()
[[nodiscard]] SplitSolid split(const Solid& a, const Solid& b, const EvaluateOptions& options = {},
                               EvaluateReport* report = nullptr);

/// By the plane a x + b y + c z + d = 0, exactly, in the user's units: `common` is where that is
/// not positive. \throw also UsageError when that is no plane, LimitError as Solid::half_space()
[[nodiscard]] SplitSolid split(const Solid& solid, const std::array<double, 4>& plane,
                               const EvaluateOptions& options = {},
                               EvaluateReport* report = nullptr);

/// Into one part more than there are planes: the first ones below each plane and not below any
/// plane before it, the last one above all. Of parallel planes in ascending order these are slabs,
/// and of a mesh all of them are cut in one pass; slabs beside a plane through a corner are
/// evaluated one by one. Of other planes one cut follows the other. Parts may be empty. Without
/// planes it is the solid itself.
/// \throw also LimitError for more than 65,536 planes
[[nodiscard]] std::vector<Solid> split(const Solid& solid,
                                       std::span<const std::array<double, 4>> planes,
                                       const EvaluateOptions& options = {});

}  // namespace trisect
