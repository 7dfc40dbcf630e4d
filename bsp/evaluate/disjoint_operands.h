// SPDX-License-Identifier: Apache-2.0
//
// Unions in place of exclusive ors of operands without common insides.
#pragma once

#include <trisect/bsp/evaluate/translate.h>

namespace trisect::detail {

/// The same set by a union, where the formula is an exclusive or of three imported meshes or more,
/// none of them complemented, and the insides of their boxes have nothing in common: tiles, bricks,
/// parts that stand on each other. Sets that are equal but for what has no inside are one, so all
/// that touches is closed either way, and unions are evaluated without cells where meshes touch.
/// O(n log n) for n operands in most places, and no more than 64 n pairs; what takes more stays as
/// it is.
[[nodiscard]] Translation with_unions_of_disjoint(Translation translation);

}  // namespace trisect::detail
