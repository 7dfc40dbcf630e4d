// SPDX-License-Identifier: Apache-2.0
//
// Loops of GDML, unrolled before anything else is read.
//
// What is in <loop for="i" from="1" to="9" step="2"> stands there once for each value of i, as in
// Geant4. Formulas have the number in place of the name. In names and references an index in
// brackets becomes a part of the name: part[i] is part_0, part_2 and so on, one less than i.
#pragma once

#include "gdml_document.h"

namespace trisect::app {

/// Replaces all loops below the root of a document that is just read. Bounds are formulas of what
/// the section `define` has up to there; without `from` a loop begins at its variable's value.
/// \throw InputError with the place for bounds that cannot be computed or a loop without end,
/// LimitError for too many elements
void unroll_gdml_loops(GdmlElement& root, const GdmlDocument& document);

}  // namespace trisect::app
