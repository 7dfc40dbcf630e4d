// SPDX-License-Identifier: Apache-2.0
//
// Formulas whose slots are each named once.
#pragma once

#include <optional>

#include <trisect/bsp/evaluate/translate.h>

namespace trisect::detail {

/// The same formula without slots that it does not name, and with one slot for equal solids: those
/// that share a tree, or a region and its place. The same as it was where it names none. O(n)
[[nodiscard]] Translation with_named_slots(Translation translation);

/// The same formula with copies of what it names again, each in a slot of its own: rules for
/// operands that are named once may serve then. A copy is a source of its own whose faces have the
/// names of the first one's. Nothing where no operand is named again, for exclusive ors, for large
/// formulas, and where what is named again is no mesh as it was imported, or all copies have more
/// facets than all operands. \pre with_named_slots() has been applied
[[nodiscard]] std::optional<Translation> with_copies(const Translation& translation);

}  // namespace trisect::detail
