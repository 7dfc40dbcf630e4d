// SPDX-License-Identifier: Apache-2.0
//
// empty_mesh: no faces at all. Such a mesh bounds the empty set, which is a solid; but saving an
// empty model on purpose.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_emptiness(const CheckedMesh& m, ValidationReport& report) {
    if (m.mesh.face_count() != 0) return;
    report.add(DefectKind::EmptyMesh, [] {
        return Defect{DefectKind::EmptyMesh, {}, {}, {}, "the mesh has no faces: it is empty"};
    });
}

}  // namespace trisect::detail
