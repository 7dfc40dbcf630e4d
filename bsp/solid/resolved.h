// SPDX-License-Identifier: Apache-2.0
//
// The set that a boundary bounds, by a boundary that does not meet itself.
#pragma once

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// The solid itself unless it was imported from a mesh that may meet itself: to_brep() and
/// to_mesh() have that mesh as it is, with walls inside the set. O(1) for all others.
[[nodiscard]] Solid resolved(const Solid& solid, const EvaluateOptions& options = {});

}  // namespace trisect::detail
