// SPDX-License-Identifier: Apache-2.0
//
// Conversion of CGAL meshes: Surface_mesh and Polyhedron_3 over any kernel.
// Header-only templates; nothing else in the library includes this file or CGAL, so its licence
// concerns only builds that do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/error.h>

namespace trisect {

/// A mesh that came from CGAL.
struct FromCgal {
    PolygonMesh mesh;
    /// Coordinates of an exact kernel that are not doubles and were replaced by near ones.
    std::size_t rounded_coordinates = 0;
};

/// Any model of CGAL's FaceListGraph with a vertex point map: Surface_mesh, Polyhedron_3 and
/// others. Vertices and faces keep their order; removed ones are skipped. O(n) expected.
template <class Graph>
[[nodiscard]] FromCgal from_cgal(const Graph& graph) {
    using Vertex = typename boost::graph_traits<Graph>::vertex_descriptor;
    FromCgal out;
    std::unordered_map<Vertex, std::uint32_t> index;
    const auto point_of = get(CGAL::vertex_point, graph);
    for (const Vertex v : CGAL::make_range(vertices(graph))) {
        index.emplace(v, static_cast<std::uint32_t>(out.mesh.points.size()));
        const auto& p = get(point_of, v);
        Point3d q{};
        for (int i = 0; i < 3; ++i) {
            const double c = CGAL::to_double(p[i]);
            if (!(p[i] == c)) ++out.rounded_coordinates;
            q[static_cast<std::size_t>(i)] = c;
        }
        out.mesh.points.push_back(q);
    }
    std::vector<std::uint32_t> loop;
    for (const auto f : CGAL::make_range(faces(graph))) {
        loop.clear();
        for (const Vertex v : CGAL::vertices_around_face(halfedge(f, graph), graph))
            loop.push_back(index.at(v));
        out.mesh.add_face(loop);
    }
    return out;
}

/// Vertex i and face i become the i-th of the result. CGAL's meshes are manifolds.
/// \throw UsageError naming the first face that CGAL refuses: one whose edge already has a face on
/// that side, or that makes a vertex non-manifold.
template <class Point>
[[nodiscard]] CGAL::Surface_mesh<Point> to_cgal_surface_mesh(const PolygonMesh& mesh) {
    using Mesh = CGAL::Surface_mesh<Point>;
    Mesh out;
    std::vector<typename Mesh::Vertex_index> vertex;
    vertex.reserve(mesh.points.size());
    for (const Point3d& p : mesh.points) vertex.push_back(out.add_vertex(Point(p[0], p[1], p[2])));
    std::vector<typename Mesh::Vertex_index> loop;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        loop.clear();
        for (const std::uint32_t c : mesh.face(f)) loop.push_back(vertex[c]);
        if (out.add_face(loop) == Mesh::null_face())
            throw UsageError("face " + std::to_string(f) + " does not fit into a CGAL mesh");
    }
    return out;
}

namespace detail {

template <class HalfedgeDS>
class CgalBuilder : public CGAL::Modifier_base<HalfedgeDS> {
public:
    explicit CgalBuilder(const PolygonMesh& mesh) : mesh_(mesh) {}

    void operator()(HalfedgeDS& target) override {
        using Point = typename HalfedgeDS::Vertex::Point;
        CGAL::Polyhedron_incremental_builder_3<HalfedgeDS> builder(target, false);
        builder.begin_surface(mesh_.points.size(), mesh_.face_count());
        for (const Point3d& p : mesh_.points) builder.add_vertex(Point(p[0], p[1], p[2]));
        std::vector<std::size_t> loop;
        for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
            loop.assign(mesh_.face(f).begin(), mesh_.face(f).end());
            if (!builder.test_facet(loop.begin(), loop.end())) {
                builder.rollback();
                refused_ = f;
                return;
            }
            builder.add_facet(loop.begin(), loop.end());
        }
        builder.end_surface();
    }
    [[nodiscard]] std::size_t refused() const { return refused_; }

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

private:
    const PolygonMesh& mesh_;
    std::size_t refused_ = none;
};

}  // namespace detail

/// As to_cgal_surface_mesh.
template <class Kernel>
[[nodiscard]] CGAL::Polyhedron_3<Kernel> to_cgal_polyhedron(const PolygonMesh& mesh) {
    using Polyhedron = CGAL::Polyhedron_3<Kernel>;
    Polyhedron out;
    detail::CgalBuilder<typename Polyhedron::HalfedgeDS> builder(mesh);
    out.delegate(builder);
    if (builder.refused() != builder.none)
        throw UsageError("face " + std::to_string(builder.refused()) +
                         " does not fit into a CGAL mesh");
    return out;
}

}  // namespace trisect
