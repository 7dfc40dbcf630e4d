// SPDX-License-Identifier: Apache-2.0
//
// degenerate_face: all corners of a face on one line. It bounds nothing.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_degenerate_faces(const CheckedMesh& m, ValidationReport& report) {
    for (const std::uint32_t f : m.mesh.degenerate_faces)
        report.add(DefectKind::DegenerateFace, [&] {
            return Defect{DefectKind::DegenerateFace,
                          {},
                          {f},
                          m.face_place(f),
                          m.face_text(f) + ": all corners lie on one line"};
        });
}

}  // namespace trisect::detail
