// SPDX-License-Identifier: Apache-2.0
//
// Proof of names of faces that were made of outlines.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/bsp/cells/named_outlines.h>

namespace trisect::detail {

/// Whether all faces that are named after one of the outlines' first facets have a part of that
/// facet, so that a tree would name them alike. False where no point of the facet is found that is
/// surely in the face, though there may be one. Linear in the edges of such faces.
[[nodiscard]] bool names_are_proved(const Brep& brep, const NamedOutlines& outlines);

}  // namespace trisect::detail
