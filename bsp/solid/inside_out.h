// SPDX-License-Identifier: Apache-2.0
//
// Refusal of boundaries that are inside out.
#pragma once

#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// For a boundary that is inside out. \throw Error (InvalidSolid) unless that is accepted
void require_accepted(Embedding embedding, InsideOut inside_out);

}  // namespace trisect::detail
