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

}  // namespace trisect::detail
