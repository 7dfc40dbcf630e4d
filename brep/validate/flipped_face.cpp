// SPDX-License-Identifier: Apache-2.0
//
// flipped_face: an open edge that both of its faces traverse in the same direction. It is found
// among the open edges, since such an edge may also cancel with others of its line.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

Defect describe_flipped_face(const CheckedMesh& m, const NetEdge& edge,
                             const std::vector<std::uint32_t>& faces) {
    return Defect{DefectKind::FlippedFace,
                  {m.name(edge.from), m.name(edge.to)},
                  faces,
                  m.place(edge.from),
                  "faces " + std::to_string(faces[0]) + " and " + std::to_string(faces[1]) +
                      " run the same way along the " + m.edge_text(edge.from, edge.to) +
                      ": one of them is turned over"};
}

}  // namespace trisect::detail
