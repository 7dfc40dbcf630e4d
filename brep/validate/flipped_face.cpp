// SPDX-License-Identifier: Apache-2.0
//
// flipped_face: an edge that both of its faces traverse in the same direction.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_flipped_faces(const CheckedMesh& m, ValidationReport& report) {
    m.edges.for_each_edge(
        [&](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
            if (uses.size() != 2 || uses[0].is_forward() != uses[1].is_forward()) return;
            report.add(DefectKind::FlippedFace, [&] {
                const std::uint32_t from = uses[0].is_forward() ? low : high;
                const std::uint32_t to = uses[0].is_forward() ? high : low;
                return Defect{DefectKind::FlippedFace,
                              {m.name(from), m.name(to)},
                              {uses[0].face(), uses[1].face()},
                              m.place(from),
                              "faces " + std::to_string(uses[0].face()) + " and " +
                                  std::to_string(uses[1].face()) + " run the same way along the " +
                                  m.edge_text(from, to) + ": one of them is turned over"};
            });
        });
}

}  // namespace trisect::detail
