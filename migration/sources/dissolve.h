// SPDX-License-Identifier: Apache-2.0
//
// Dissolution of edges between coplanar faces of one name.
#pragma once

#include <trisect/brep/brep.h>

namespace manifold {

/// The boundary with neighbouring faces joined that are in one plane and have the same source, and
/// without vertices at which no edge turns.
[[nodiscard]] trisect::Brep dissolved(const trisect::Brep& brep);

}  // namespace manifold
