// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/brep_mesh.h>

#include <array>
#include <utility>

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/triangulate.h>

namespace trisect {

namespace {

class MeshWriter {
public:
    MeshWriter(const Brep& brep, MeshOptions options, MeshMap* map)
        : brep_(brep), options_(options), map_(map) {}

    PolygonMesh run() {
        if (map_ != nullptr) *map_ = {};
        write_points();
        for (const FaceId f : brep_.faces()) write_face(f);
        return std::move(mesh_);
    }

private:
    void write_points() {
        const Lattice lattice = brep_.lattice();
        mesh_.points.reserve(brep_.points().size());
        for (const Point& p : brep_.points()) {
            const auto c = p.nearest();
            mesh_.points.push_back(
                {lattice.to_double(c[0]), lattice.to_double(c[1]), lattice.to_double(c[2])});
        }
    }

    void write_face(FaceId f) {
        const bool has_one_loop = brep_.loops(f).size() == 1;
        if (has_one_loop && (!options_.triangles || brep_.halfedges(f).size() == 3)) {
            loop_.clear();
            for (const HalfedgeId h : brep_.halfedges(f)) loop_.push_back(brep_.origin(h).index);
            write_polygon(loop_, f);
            return;
        }
        for (const IndexTriangle& t : triangulate(brep_, f)) write_polygon(t, f);
    }

    void write_polygon(std::span<const std::uint32_t> polygon, FaceId f) {
        mesh_.add_face(polygon);
        if (map_ == nullptr) return;
        map_->face.push_back(f);
        map_->source.push_back(brep_.source(f));
    }

    const Brep& brep_;
    MeshOptions options_;
    MeshMap* map_;
    PolygonMesh mesh_;
    std::vector<std::uint32_t> loop_;
};

}  // namespace

PolygonMesh to_polygon_mesh(const Brep& brep, MeshOptions options, MeshMap* map) {
    return MeshWriter(brep, options, map).run();
}

Brep brep_from_lattice_mesh(const LatticeMesh& mesh, std::uint32_t operand) {
    BrepBuilder builder(mesh.lattice);
    builder.reserve(mesh.points.size(), mesh.triangles.size(), 3 * mesh.triangles.size());
    for (const LatticePoint& p : mesh.points) builder.add_vertex(p);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        builder.add_polygon(Plane::through(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]),
                            t, {operand, mesh.face_of(i)});
    }
    return std::move(builder).build();
}

}  // namespace trisect
