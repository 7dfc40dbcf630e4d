// SPDX-License-Identifier: Apache-2.0
//
// unused_point: a point that no face names.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_unused_points(const CheckedMesh& m, ValidationReport& report) {
    for (const auto& [point, place] : m.unused)
        report.add(DefectKind::UnusedPoint, [&, p = point, at = place] {
            return Defect{DefectKind::UnusedPoint,
                          {p},
                          {},
                          m.place(at),
                          "vertex " + std::to_string(p) + " " + place_text(m.place(at)) +
                              " belongs to no face"};
        });
}

}  // namespace trisect::detail
