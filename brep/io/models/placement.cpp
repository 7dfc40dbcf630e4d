// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/placement.h>

#include <trisect/kernel/stop_scope.h>

#include <algorithm>

namespace trisect::detail {

void add_placed(ModelPart& part, const PolygonMesh& mesh, const ExactAffine& placement,
                ModelReport& report) {
    const std::size_t first_face = part.mesh.face_count();
    const std::size_t first_point = part.mesh.points.size();
    append(part.mesh, mesh);
    if (placement.is_identity()) return;
    for (std::size_t v = first_point; v < part.mesh.points.size(); ++v) {
        check_stop();
        const ExactAffine::Image image = placement.apply(part.mesh.points[v]);
        part.mesh.points[v] = image.point;
        report.rounded_vertices += image.move > 0 ? 1U : 0U;
        report.largest_move = std::max(report.largest_move, image.move);
    }
    if (placement.orientation() > 0) return;
    for (std::size_t f = first_face; f < part.mesh.face_count(); ++f) {
        const auto begin = part.mesh.corners.begin();
        std::reverse(begin + part.mesh.face_begin[f] + 1, begin + part.mesh.face_begin[f + 1]);
    }
}

}  // namespace trisect::detail
