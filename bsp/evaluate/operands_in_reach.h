// SPDX-License-Identifier: Apache-2.0
//
// Formulas without the operands that are beside all that these may change.
#pragma once

#include <trisect/bsp/evaluate/translate.h>

namespace trisect::detail {

/// The same set without operands that are apart from what others leave: tools beside a part, or
/// those that are scattered about what all have in common. Of three imported meshes or more; else
/// the same as it was. O(n). \pre with_named_slots() has been applied
[[nodiscard]] Translation with_operands_in_reach(Translation translation);

}  // namespace trisect::detail
