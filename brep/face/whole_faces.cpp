// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/whole_faces.h>

#include <trisect/brep/joined_loops.h>
#include <trisect/brep/triangulate.h>

#include <optional>
#include <vector>

namespace trisect {
namespace {

std::vector<IndexLoop> vertex_loops(const Brep& brep, FaceId face) {
    std::vector<IndexLoop> loops;
    for (const LoopId l : brep.loops(face)) {
        loops.emplace_back();
        for (const HalfedgeId h : brep.halfedges(l)) loops.back().push_back(brep.origin(h).index);
    }
    return loops;
}

}  // namespace

PolygonMesh whole_face_mesh(const Brep& brep, MeshMap* map) {
    PolygonMesh out;
    if (map != nullptr) *map = {};
    const Lattice lattice = brep.lattice();
    out.points.reserve(brep.points().size());
    for (const Point& p : brep.points()) {
        const auto c = p.nearest();
        out.points.push_back(
            {lattice.to_double(c[0]), lattice.to_double(c[1]), lattice.to_double(c[2])});
    }
    const auto add = [&](std::span<const std::uint32_t> polygon, FaceId f) {
        out.add_face(polygon);
        if (map == nullptr) return;
        map->face.push_back(f);
        map->source.push_back(brep.source(f));
    };
    for (const FaceId f : brep.faces()) {
        const std::vector<IndexLoop> loops = vertex_loops(brep, f);
        if (loops.size() == 1) {
            add(loops.front(), f);
            continue;
        }
        const std::vector<IndexTriangle> triangles = triangulate(brep, f);
        if (const auto joined = joined_loops(loops, triangles)) {
            add(*joined, f);
        } else {
            for (const IndexTriangle& t : triangles) add(t, f);
        }
    }
    return out;
}

}  // namespace trisect
