// SPDX-License-Identifier: Apache-2.0
//
// Faces between copies of a region, and its ends.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/modelling/plane_region.h>

namespace trisect::detail {

/// Walls between two copies of the points; those of the second one begin at `upper`. Of equal
/// diagonals that one is taken which goes up along a loop that runs counter-clockwise, if `along`.
void add_walls(PolygonMesh& mesh, const PlaneRegion& region, std::uint32_t lower,
               std::uint32_t upper, bool along);
void add_ends(PolygonMesh& mesh, const PlaneRegion& region, std::uint32_t lower,
              std::uint32_t upper);

/// \throw LimitError when so many copies have more than 2^24 corners
void require_corners(const PlaneRegion& region, double copies);

}  // namespace trisect::detail
