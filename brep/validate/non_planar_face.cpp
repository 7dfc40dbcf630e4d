// SPDX-License-Identifier: Apache-2.0
//
// non_planar_face: corners that do not lie in one plane exactly.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_non_planar_faces(const CheckedMesh& m, ValidationReport& report) {
    for (const std::uint32_t f : m.mesh.nonplanar_faces)
        report.add(DefectKind::NonPlanarFace, [&] {
            return Defect{DefectKind::NonPlanarFace,
                          {},
                          {f},
                          m.face_place(f),
                          m.face_text(f) + ": the corners do not lie in one plane"};
        });
}

}  // namespace trisect::detail
