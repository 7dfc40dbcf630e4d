// SPDX-License-Identifier: Apache-2.0

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "query_peers.h"

namespace query_peers {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Point& p) { return {p[0], p[1], p[2]}; }

class Cgal final : public Peer {
public:
    explicit Cgal(const trisect::PolygonMesh& mesh) {
        for (const auto& p : mesh.points) mesh_.add_vertex(to_cgal(p));
        using V = Mesh::Vertex_index;
        for (std::size_t i = 0; i < mesh.face_count(); ++i) {
            const auto f = mesh.face(i);
            mesh_.add_face(V(f[0]), V(f[1]), V(f[2]));
        }
        const double start = thread_seconds();
        tree_ = std::make_unique<Tree>(faces(mesh_).first, faces(mesh_).second, mesh_);
        tree_->build();
        build_seconds_ = thread_seconds() - start;
        side_ = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel>>(*tree_);
    }

    [[nodiscard]] std::string name() const override { return "CGAL"; }
    [[nodiscard]] double build_seconds() const override { return build_seconds_; }

    void locate(std::span<const Point> points, std::span<Side> sides) const override {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const CGAL::Bounded_side s = (*side_)(to_cgal(points[i]));
            sides[i] = s == CGAL::ON_BOUNDED_SIDE ? 1 : (s == CGAL::ON_BOUNDARY ? 2 : 0);
        }
    }

    void first_hits(std::span<const Ray> rays, std::span<std::int64_t> hits) const override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Kernel::Ray_3 ray(
                to_cgal(rays[i].origin),
                Kernel::Vector_3(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]));
            const auto hit = tree_->first_intersected_primitive(ray);
            hits[i] = hit ? static_cast<std::int64_t>(std::size_t(*hit)) : -1;
        }
    }

    void squared_distances(std::span<const Point> points, std::span<double> out) const override {
        for (std::size_t i = 0; i < points.size(); ++i)
            out[i] = tree_->squared_distance(to_cgal(points[i]));
    }

private:
    Mesh mesh_;
    std::unique_ptr<Tree> tree_;
    std::unique_ptr<CGAL::Side_of_triangle_mesh<Mesh, Kernel>> side_;
    double build_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Peer> make_cgal(const trisect::PolygonMesh& mesh) {
    return std::make_unique<Cgal>(mesh);
}

}  // namespace query_peers
