// SPDX-License-Identifier: Apache-2.0
//
// repeated_corner: a loop that names the same point in succession.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_repeated_corners(const CheckedMesh& m, ValidationReport& report) {
    for (std::uint32_t f = 0; f < m.mesh.face_count(); ++f) {
        const auto loop = m.mesh.loop(f);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t before = loop[i == 0 ? loop.size() - 1 : i - 1];
            if (loop.size() < 2 || before != loop[i]) continue;
            report.add(DefectKind::RepeatedCorner, [&] {
                return Defect{DefectKind::RepeatedCorner,
                              {m.name(loop[i])},
                              {f},
                              m.place(loop[i]),
                              "face " + std::to_string(f) + " names " + m.vertex_text(loop[i]) +
                                  " twice in succession"};
            });
            break;  // one a face
        }
    }
}

}  // namespace trisect::detail
