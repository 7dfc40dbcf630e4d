// SPDX-License-Identifier: Apache-2.0
//
// Programs in OpenSCAD's evaluated form, evaluated by Manifold.
#pragma once

#include <cstddef>

#include <trisect/bsp/csg/csg_evaluate.h>

namespace bench {

struct ManifoldOutcome {
    double volume = 0;  ///< area, of a region of the plane
    std::size_t triangles = 0;
    std::size_t approximate = 0;  ///< nodes whose facets are others than OpenSCAD's
};

/// The same tree by Manifold's own calls, to the arrays of a mesh; regions of the plane by its
/// CrossSection, to polygons. Boxes and cylinders are its own; corners of other shapes, of files
/// and of text are those that evaluate_csg() takes. Equal shapes and groups are made once, as
/// there. \throw std::runtime_error that names the node for what Manifold has no call for, or
/// refuses; what evaluate_csg() throws for malformed nodes
[[nodiscard]] ManifoldOutcome evaluate_by_manifold(const trisect::CsgTree& tree,
                                                   const trisect::CsgOptions& options);

}  // namespace bench
