// SPDX-License-Identifier: Apache-2.0
//
// Materials and properties of a mesh that was mended.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/mend/mend.h>

namespace trisect::app {

/// `given` with the mesh that it was mended into. Each face has the material of the face that it
/// comes from, and its corners the numbers of that face's; a vertex that was put into an edge has
/// what is there between its ends. Faces that were added have neither. Normals of faces that were
/// turned over are turned where they would point inwards: they may have been right before.
[[nodiscard]] ModelPart mended_part(const ModelPart& given, MendedMesh&& mended);

}  // namespace trisect::app
