// SPDX-License-Identifier: Apache-2.0
//
// Statues and a cloud of small spheres, as in the published record of booleans of many operands.
#pragma once

#include <cstddef>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace bench {

/// Six statues in two rows of three, made of three models, each of which comes twice, turned; then
/// `n` spheres of 234 triangles, turned at random, with centres at random in the box of the
/// statues. A point of the box lies in half a sphere on average, whatever `n` is.
/// \pre three models
[[nodiscard]] std::vector<trisect::PolygonMesh> statues_and_spheres(
    const std::vector<trisect::PolygonMesh>& models, std::size_t n);

constexpr std::size_t statues_of_record = 6;

}  // namespace bench
