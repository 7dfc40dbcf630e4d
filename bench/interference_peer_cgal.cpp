// SPDX-License-Identifier: Apache-2.0

#include <chrono>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>

#include "interference_peers.h"

namespace interference_peers {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Affine = CGAL::Aff_transformation_3<Kernel>;

class Cgal : public Peer {
public:
    Cgal(bool inclusion, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
         std::span<const Placement> placements, const Placement& home)
        : inclusion_(inclusion), a_(mesh(a)), b_(mesh(b)) {
        const auto start = std::chrono::steady_clock::now();
        first_ = detection_.add_mesh(a_);
        // The tree may be built at the first query.
        detection_.get_all_intersections(first_);
        build_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        second_ = detection_.add_mesh(b_);
        detection_.set_transformation(first_, affine(home));
        for (const Placement& p : placements) poses_.push_back(affine(p));
    }
    [[nodiscard]] std::string name() const override {
        return inclusion_ ? "CGAL with inclusion" : "CGAL surfaces";
    }
    [[nodiscard]] double build_seconds() const override { return build_; }
    [[nodiscard]] bool collide(std::size_t i) override {
        detection_.set_transformation(second_, poses_[i]);
        const std::vector<std::size_t> others{first_};
        return inclusion_
                   ? !detection_.get_all_intersections_and_inclusions(second_, others).empty()
                   : !detection_.get_all_intersections(second_, others).empty();
    }

private:
    static Affine affine(const Placement& p) {
        return {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10], p[11]};
    }
    static Mesh mesh(const trisect::PolygonMesh& m) {
        Mesh r;
        for (const auto& p : m.points) r.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
        for (std::size_t f = 0; f < m.face_count(); ++f) {
            const auto c = m.face(f);
            r.add_face(Mesh::Vertex_index(c[0]), Mesh::Vertex_index(c[1]),
                       Mesh::Vertex_index(c[2]));
        }
        return r;
    }

    bool inclusion_;
    Mesh a_;  // the detection refers to them
    Mesh b_;
    double build_ = 0;
    std::size_t first_ = 0;
    std::size_t second_ = 0;
    CGAL::Rigid_triangle_mesh_collision_detection<Mesh> detection_;
    std::vector<Affine> poses_;
};

}  // namespace

void add_cgal(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
              std::span<const Placement> placements, const Placement& home) {
    peers.push_back(std::make_unique<Cgal>(false, a, b, placements, home));
    peers.push_back(std::make_unique<Cgal>(true, a, b, placements, home));
}

}  // namespace interference_peers
