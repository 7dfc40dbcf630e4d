// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/exact_mesh.h>

namespace trisect {

PolygonMesh to_polygon_mesh(const ExactMesh& mesh) {
    PolygonMesh out;
    out.points.reserve(mesh.points.size());
    for (const Point& p : mesh.points) {
        const auto c = p.nearest();
        out.points.push_back({mesh.lattice.to_double(c[0]), mesh.lattice.to_double(c[1]),
                              mesh.lattice.to_double(c[2])});
    }
    out.corners.reserve(3 * mesh.triangles.size());
    out.face_begin.reserve(mesh.triangles.size() + 1);
    for (const auto& t : mesh.triangles) out.add_triangle(t[0], t[1], t[2]);
    return out;
}

}  // namespace trisect
