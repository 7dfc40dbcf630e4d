// SPDX-License-Identifier: Apache-2.0
//
// Points in single precision, and what rounding to it changes: for binary STL and GLB.
#pragma once

#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <string>
#include <vector>

namespace trisect::detail {

using FloatPoint = std::array<float, 3>;

/// Rounds all points, and adds to the report what that changes. `name` stands for the file and
/// `format` for the format in errors. \throw LimitError for a coordinate beyond the range of float
[[nodiscard]] std::vector<FloatPoint> float_points(const PolygonMesh& mesh, const std::string& name,
                                                   const char* format, WriteReport& report);

}  // namespace trisect::detail
