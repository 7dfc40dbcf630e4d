// SPDX-License-Identifier: Apache-2.0
//
// Sections as prisms over their regions.
// They are between z = 0 and z = 1.
#pragma once

#include <trisect/brep/exact_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/sections/mesh_section.h>
#include <trisect/bsp/modelling/slices.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// The boundary of a solid that is to be cut. \throw UnsupportedError for an unbounded set
[[nodiscard]] ExactMesh mesh_of_bounded(const Solid& solid, const EvaluateOptions& options);

struct SectionPrism {
    Solid prism;
    bool is_exact = true;  ///< no corner of the section was rounded
};

/// What one plane cuts, by the rules of winding and of faces in the plane.
[[nodiscard]] SectionPrism section_prism(const MeshSection& mesh, const SectionPlane& plane,
                                         SliceRule rule, const EvaluateOptions& options);

}  // namespace trisect::detail
