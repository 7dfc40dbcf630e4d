// SPDX-License-Identifier: Apache-2.0
//
// non_simple_face: a loop that crosses itself, so that no triangulation of it is free of folds.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_non_simple_faces(const CheckedMesh& m, ValidationReport& report) {
    for (const std::uint32_t f : m.mesh.nonsimple_faces)
        report.add(DefectKind::NonSimpleFace, [&] {
            return Defect{DefectKind::NonSimpleFace,
                          {},
                          {f},
                          m.face_place(f),
                          m.face_text(f) + ": the loop crosses or folds onto itself"};
        });
}

}  // namespace trisect::detail
