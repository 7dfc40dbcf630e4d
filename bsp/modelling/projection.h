// SPDX-License-Identifier: Apache-2.0
//
// Projections of solids onto the plane z = 0: sections and shadows.
#pragma once

#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// The section with the plane z = `height`: the corners are where edges pass through it, exact, and
/// those that are no doubles are rounded, once. What touches the plane with a face counts, what
/// touches it with edges and points does not. \throw UnsupportedError for an unbounded set; what
/// evaluate() throws
[[nodiscard]] PlaneRegion section(const Solid& solid, double height,
                                  const EvaluateOptions& options = {});

/// The same of a closed mesh of triangles, which may meet itself, as the prism over it between z =
/// 0 and z = 1: what it goes around.
[[nodiscard]] Solid section_of_mesh(const PolygonMesh& mesh, double height,
                                    const EvaluateOptions& options = {});

/// What the solid covers seen from above, as the prism over it between z = 0 and z = 1. Exact over
/// the corners of its mesh.
/// \throw as section()
[[nodiscard]] Solid shadow(const Solid& solid, const EvaluateOptions& options = {});
/// The same of a closed mesh of triangles.
[[nodiscard]] Solid shadow_of_mesh(const PolygonMesh& mesh, const EvaluateOptions& options = {});

}  // namespace trisect
