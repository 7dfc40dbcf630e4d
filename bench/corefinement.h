// SPDX-License-Identifier: Apache-2.0
//
// CGAL's corefinement as a peer: union, intersection and difference of two triangle meshes with
// exact points (EPECK) beside the doubles. Only benchmarks and campaigns use it; it is compiled
// where CGAL is found.
#pragma once

#include <memory>
#include <string>

#include <trisect/brep/polygon_mesh.h>

namespace corefinement {

/// "5.5.1" or so.
[[nodiscard]] std::string version();

/// A triangle mesh in CGAL's form.
struct Polyhedron;

enum class Operation { Union, Intersection, Difference };

struct Answer {
    /// Empty when there is a result; else what CGAL says or throws.
    std::string refusal;
    trisect::PolygonMesh mesh;  ///< coordinates rounded
    double import_seconds = 0;  ///< building both Surface_meshes
    double operation_seconds = 0;
    double export_seconds = 0;  ///< the result as arrays
};

/// \pre triangles only. \throw std::runtime_error when the mesh is not a manifold.
[[nodiscard]] std::shared_ptr<Polyhedron> import(const trisect::PolygonMesh& mesh);
/// Refines both operands on the way. \throw std::runtime_error when CGAL declines.
[[nodiscard]] std::shared_ptr<Polyhedron> combine(Polyhedron& a, Polyhedron& b,
                                                  Operation operation);
[[nodiscard]] trisect::PolygonMesh to_mesh(const Polyhedron& polyhedron);

/// Import, operation and export, timed. \pre triangles only.
[[nodiscard]] Answer run(const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
                         Operation operation);

}  // namespace corefinement
