// SPDX-License-Identifier: Apache-2.0

#include "corefinement.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version_macros.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace corefinement {

namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Clock = std::chrono::steady_clock;
using Rounded = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Rounded::Point_3>;
using Vertex = Mesh::Vertex_index;

/// Exact points beside the mesh's doubles: made from them on first use, written to both. The way
/// of CGAL's manual to chain exact booleans on one Surface_mesh.
class ExactPoints {
public:
    using key_type = Vertex;
    using value_type = Exact::Point_3;
    using reference = Exact::Point_3;
    using category = boost::read_write_property_map_tag;

    ExactPoints() = default;
    explicit ExactPoints(Mesh& mesh)
        : mesh_(&mesh),
          known_(mesh.add_property_map<Vertex, bool>("v:exact_point_known", false).first),
          points_(mesh.add_property_map<Vertex, Exact::Point_3>("v:exact_point").first) {}

    friend reference get(const ExactPoints& map, key_type v) {
        if (!map.known_[v]) {
            const Rounded::Point_3& p = map.mesh_->point(v);
            map.points_[v] = Exact::Point_3(p.x(), p.y(), p.z());
            map.known_[v] = true;
        }
        return map.points_[v];
    }
    friend void put(const ExactPoints& map, key_type v, const value_type& p) {
        map.points_[v] = p;
        map.known_[v] = true;
        map.mesh_->point(v) = CGAL::Cartesian_converter<Exact, Rounded>()(p);
    }

private:
    Mesh* mesh_ = nullptr;
    Mesh::Property_map<Vertex, bool> known_;
    Mesh::Property_map<Vertex, Exact::Point_3> points_;
};

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

Mesh surface_mesh(const trisect::PolygonMesh& mesh) {
    Mesh out;
    out.reserve(static_cast<Mesh::size_type>(mesh.points.size()),
                static_cast<Mesh::size_type>(mesh.face_count() * 3 / 2),
                static_cast<Mesh::size_type>(mesh.face_count()));
    for (const trisect::Point3d& p : mesh.points)
        out.add_vertex(Rounded::Point_3(p[0], p[1], p[2]));
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto t = mesh.face(f);
        if (out.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == Mesh::null_face())
            throw std::runtime_error("import: not a manifold at face " + std::to_string(f));
    }
    return out;
}

trisect::PolygonMesh polygon_mesh(const Mesh& mesh) {
    trisect::PolygonMesh out;
    std::vector<std::uint32_t> index(mesh.num_vertices() + mesh.number_of_removed_vertices());
    for (const Vertex v : mesh.vertices()) {
        index[v] = static_cast<std::uint32_t>(out.points.size());
        const Rounded::Point_3& p = mesh.point(v);
        out.points.push_back({p.x(), p.y(), p.z()});
    }
    std::vector<std::uint32_t> loop;
    for (const auto f : mesh.faces()) {
        loop.clear();
        for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
            loop.push_back(index[v]);
        out.add_face(loop);
    }
    return out;
}

bool operate(Mesh& a, Mesh& b, Mesh& result, Operation operation) {
    const auto pa = processing::parameters::vertex_point_map(ExactPoints(a));
    const auto pb = processing::parameters::vertex_point_map(ExactPoints(b));
    const auto pr = processing::parameters::vertex_point_map(ExactPoints(result));
    switch (operation) {
        case Operation::Union:
            return processing::corefine_and_compute_union(a, b, result, pa, pb, pr);
        case Operation::Intersection:
            return processing::corefine_and_compute_intersection(a, b, result, pa, pb, pr);
        default:
            return processing::corefine_and_compute_difference(a, b, result, pa, pb, pr);
    }
}

}  // namespace

std::string version() { return CGAL_VERSION_STR; }

struct Polyhedron {
    Mesh mesh;
};

std::shared_ptr<Polyhedron> import(const trisect::PolygonMesh& mesh) {
    return std::make_shared<Polyhedron>(Polyhedron{surface_mesh(mesh)});
}

std::shared_ptr<Polyhedron> combine(Polyhedron& a, Polyhedron& b, Operation operation) {
    auto result = std::make_shared<Polyhedron>();
    if (!operate(a.mesh, b.mesh, result->mesh, operation))
        throw std::runtime_error("declined: the result is not a manifold");
    return result;
}

trisect::PolygonMesh to_mesh(const Polyhedron& polyhedron) { return polygon_mesh(polyhedron.mesh); }

Answer run(const trisect::PolygonMesh& a, const trisect::PolygonMesh& b, Operation operation) {
    Answer answer;
    try {
        auto start = Clock::now();
        Mesh mesh_a = surface_mesh(a);
        Mesh mesh_b = surface_mesh(b);
        answer.import_seconds = seconds_since(start);
        start = Clock::now();
        Mesh result;
        const bool done = operate(mesh_a, mesh_b, result, operation);
        answer.operation_seconds = seconds_since(start);
        if (!done) {
            answer.refusal = "declined: the result is not a manifold";
            return answer;
        }
        start = Clock::now();
        answer.mesh = polygon_mesh(result);
        answer.export_seconds = seconds_since(start);
    } catch (const std::exception& e) {
        answer.refusal = std::string("threw: ") + e.what();
    }
    return answer;
}

}  // namespace corefinement
