// SPDX-License-Identifier: Apache-2.0
//
// The certificate of an output file, and what is said about it.
#pragma once

#include <trisect/brep/certificate.h>
#include <trisect/brep/io/mesh_format.h>
#include <trisect/bsp/certified_rounding.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "outcome.h"

namespace trisect::app {

/// Of the coordinates as the format holds them. \pre `mesh` is to_polygon_mesh(brep)
[[nodiscard]] Certificate certify_output(const Brep& brep, PolygonMesh mesh, MeshFormat format);

/// The same. \pre `mesh` is to_polygon_mesh(exact)
[[nodiscard]] Certificate certify_output(const ExactMesh& exact, PolygonMesh mesh,
                                         MeshFormat format);

/// What was done to a mesh whose triangles met once rounded.
struct Mending {
    std::size_t divided = 0;    ///< triangles more, since edges lie in faces
    bool gave_thin_up = false;  ///< triangles thinner than the rounding
    double radius = 0;          ///< how far the set moved at most, rounding included
};

/// A certificate that does not hold because edges lie in faces, or triangles are thinner than the
/// rounding, becomes one of other triangles, which take the place of the mesh; `sources`, where
/// there are any, stay beside them.
[[nodiscard]] std::optional<Mending> mend_output(PolygonMesh& mesh,
                                                 std::vector<FaceSource>& sources,
                                                 Certificate& certificate, MeshFormat format);

/// As the format holds them, repaired where that takes it.
[[nodiscard]] CertifiedRounding round_output(const Brep& brep, MeshFormat format,
                                             const EvaluateOptions& evaluation);

[[nodiscard]] Json to_json(const CertifiedRounding& rounding);
[[nodiscard]] std::string to_text(const CertifiedRounding& rounding);
[[nodiscard]] Json to_json(const Certificate& certificate);
[[nodiscard]] std::string to_text(const Certificate& certificate);
/// An object with the key "radius", or null.
[[nodiscard]] Json to_json(const std::optional<Mending>& mending);
[[nodiscard]] std::string to_text(const Mending& mending);

}  // namespace trisect::app
