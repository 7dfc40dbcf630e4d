// SPDX-License-Identifier: Apache-2.0
//
// Convex parts: boundary patches like those of convex bodies.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/interference_model.h>

namespace trisect::hierarchies {

/// Triangles of a model (InterferenceModelData::triangles) of which each lies on the boundary of
/// their hull: every corner of the part is on or below the plane of every face in it.
struct ConvexPart {
    std::vector<std::uint32_t> triangles;
};

/// Of all triangles, each in exactly one part. Connected; grown from triangle to triangle over
/// edges, first within the cell of the solid's BSP tree under the triangle, then beyond while that
/// stays convex: cells are convex, so what bounds one cell mostly is a part, and neighbours that
/// the tree's planes cut from each other for no reason come together again. A convex solid is one
/// part.
///
/// Exact: signs of points against planes of faces. The tree is used for models with lattice
/// vertices and up to 20,000 triangles; otherwise parts grow without it. A part has at most 512
/// planes, so cost is O(512 n) signs and that of build_bsp.
/// Source: Ehmann and Lin, Accurate and fast proximity queries between polyhedra using convex
/// surface decomposition (Eurographics 2001), sec. 3, without their tree of searches.
[[nodiscard]] std::vector<ConvexPart> convex_parts(const InterferenceModel& model);

}  // namespace trisect::hierarchies
