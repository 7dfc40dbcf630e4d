// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/brep_mesh.h>

#include "page_scene.h"

namespace trisect::app {

PageShape shape_of(const Brep& brep) {
    PageShape out;
    MeshMap map;
    out.mesh = to_polygon_mesh(brep, {}, &map);
    for (const FaceId f : map.face) out.face.push_back(f.index);
    for (const EdgeId e : brep.edges()) {
        const HalfedgeId h = brep.halfedge(e);
        out.edges.push_back({brep.origin(h).index, brep.target(h).index});
    }
    for (const FaceId f : brep.faces()) out.source.push_back(brep.source(f).face);
    return out;
}

PageShape shape_of(const PolygonMesh& mesh) {
    PageShape out;
    out.mesh.points = mesh.points;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
            out.mesh.add_triangle(corners[0], corners[k], corners[k + 1]);
            out.face.push_back(static_cast<std::uint32_t>(f));
        }
    }
    return out;
}

}  // namespace trisect::app
