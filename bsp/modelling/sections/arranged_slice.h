// SPDX-License-Identifier: Apache-2.0
//
// Slices by the arrangement of regions.
// It resolves what rounding made cross.
#pragma once

#include <trisect/bsp/modelling/sections/mesh_section.h>
#include <trisect/bsp/modelling/slices.h>

namespace trisect::detail {

/// The slice of one plane. O(n log n) for n triangles of the plane, and the crossings of sides.
[[nodiscard]] Slice arranged_slice(const MeshSection& mesh, const SectionPlane& plane,
                                   SliceRule rule, const EvaluateOptions& options);

}  // namespace trisect::detail
