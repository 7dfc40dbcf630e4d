// SPDX-License-Identifier: Apache-2.0
//
// Facets that are long and thin.
#pragma once

#include <span>

#include <trisect/bsp/cells/source.h>

namespace trisect::detail {

/// Whether the square of the longest edge is at least so many times twice the area (1.2 for equal
/// edges), for most facets of most sources: splitting planes part them badly. Looks at a few of
/// each.
[[nodiscard]] bool are_mostly_thin(std::span<const Source* const> sources, double times);

}  // namespace trisect::detail
