// SPDX-License-Identifier: Apache-2.0
//
// Page of the partitions behind a solid, through which points are followed.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/bsp/solid.h>

#include <string>

namespace trisect::app {

/// The tree of cells, and, of a solid of few faces, the tree whose cuts are planes of faces
/// (MspTree).
[[nodiscard]] std::string tree_page(const std::string& title, const Solid& solid, const Brep& brep);

}  // namespace trisect::app
