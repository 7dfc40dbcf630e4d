// SPDX-License-Identifier: Apache-2.0
//
// Boxes and other meshes as models for tests of interference.
#pragma once

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/interference/interference_model.h>

namespace models {

[[nodiscard]] trisect::InterferenceModel box(const trisect::Point3d& low,
                                             const trisect::Point3d& high);
[[nodiscard]] trisect::InterferenceModel box(double x0, double y0, double z0, double x1, double y1,
                                             double z1);
/// The cube from (low, low, low) to (high, high, high).
[[nodiscard]] trisect::InterferenceModel box(double low, double high);

[[nodiscard]] trisect::InterferenceModel of_mesh(const trisect::PolygonMesh& mesh);

}  // namespace models
