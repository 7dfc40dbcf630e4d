// SPDX-License-Identifier: Apache-2.0
//
// Parts of a model, put in their places.
#pragma once

#include <trisect/brep/io/read_model.h>
#include <trisect/brep/number/exact_affine.h>

namespace trisect::detail {

/// Adds a mesh where the placement puts it, after what the part has; a mirror turns its faces over.
/// \pre the placement is regular
void add_placed(ModelPart& part, const PolygonMesh& mesh, const ExactAffine& placement,
                ModelReport& report);

/// The properties of a mesh that is placed so: corners come in the order that add_placed gives
/// them, and normals turn with the faces, which leaves them of some length.
[[nodiscard]] CornerProperties placed_properties(const CornerProperties& properties,
                                                 const PolygonMesh& mesh,
                                                 const ExactAffine& placement);

}  // namespace trisect::detail
