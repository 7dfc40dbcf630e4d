// SPDX-License-Identifier: Apache-2.0
//
// Programs with the rounded numbers of OpenSCAD's CGAL, for comparison only.
#pragma once

#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/csg/csg_tree.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// The set that OpenSCAD (version 2021.01) makes with CGAL of a program of cubes, spheres,
/// cylinders, polyhedra, matrices and booleans. Not the set that the program describes: as there,
/// corners of each shape are moved by all matrices that stand above it alone, one after the other,
/// in doubles; then they are cut off to multiples of 2^-20, and those in neighbouring cells become
/// one. What is convex up to a tenth of a degree becomes the hull of its corners. From the first
/// boolean on all is exact, there and here, but for two things, each with a remark:
/// - A matrix above a boolean whose corners are no doubles rounds them here.
/// - Of faces that are not flat, of a shape that is not convex, OpenSCAD has triangles in floats.
/// Colours are not kept, and of the options `evaluate`, `on_progress` and `reads_files` alone
/// count. \throw CsgError: (Unsupported) for all other nodes, by name; as evaluate_csg()
[[nodiscard]] Solid evaluate_on_openscad_grid(const CsgTree& tree, const CsgOptions& options = {},
                                              CsgReport* report = nullptr);

}  // namespace trisect
