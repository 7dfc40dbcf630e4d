// SPDX-License-Identifier: Apache-2.0
//
// duplicate_point: points with different indices and the same coordinates. Normal in triangle
// soups; in an indexed mesh it often marks a seam that was never closed.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_duplicate_points(const CheckedMesh& m, ValidationReport& report) {
    for (const auto& [point, first] : m.repeated)
        report.add(DefectKind::DuplicatePoint, [&, p = point, id = first] {
            return Defect{DefectKind::DuplicatePoint,
                          {m.name(id), p},
                          {},
                          m.place(id),
                          "vertex " + std::to_string(p) + " lies on " + m.vertex_text(id)};
        });
}

}  // namespace trisect::detail
