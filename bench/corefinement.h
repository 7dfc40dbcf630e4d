// SPDX-License-Identifier: Apache-2.0
//
// CGAL's corefinement as a peer: union, intersection and difference of two triangle meshes with
// exact points (EPECK) beside the doubles. Only benchmarks and campaigns use it; it is compiled
// where CGAL is found.
#pragma once

#include <string>

#include <trisect/brep/polygon_mesh.h>

namespace corefinement {

enum class Operation { Union, Intersection, Difference };

struct Answer {
    /// Empty when there is a result; else what CGAL says or throws.
    std::string refusal;
    trisect::PolygonMesh mesh;  ///< coordinates rounded
    double import_seconds = 0;  ///< building both Surface_meshes
    double operation_seconds = 0;
    double export_seconds = 0;  ///< the result as arrays
};

/// \pre triangles only.
[[nodiscard]] Answer run(const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
                         Operation operation);

}  // namespace corefinement
