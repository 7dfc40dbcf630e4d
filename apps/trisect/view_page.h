// SPDX-License-Identifier: Apache-2.0
//
// Pages of solids: one HTML file each, self-contained.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/brep/polygon_mesh.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trisect::app {

/// What a page shows.
struct ViewedSolid {
    std::string title;
    Brep brep;
    std::vector<std::string> operands;  ///< names, in the order of the command line
    std::vector<std::optional<std::size_t>> operand_of;  ///< by face: nothing for other sources
    std::vector<PolygonMesh> inputs;  ///< to be seen through; empty: they are left out
};

/// A page that shows the boundary, and names its faces, edges and vertices exactly. It loads
/// nothing and needs WebGL. Of a vertex it has the rounded coordinates, and computes exact ones
/// from the planes of its faces; these follow from corners, or are written out. Linear.
[[nodiscard]] std::string page_text(const ViewedSolid& solid);

/// The program of the page (web/viewer), without its data.
[[nodiscard]] std::string viewer_program();

}  // namespace trisect::app
