// SPDX-License-Identifier: Apache-2.0
//
// Cells give pieces; a boundary needs faces, edges and vertices that fit together. The road:
//
//   parts   (assembly_parts.cpp)   polygons of the cells with exact vertices, conforming in each
//   cell join    (boundary_edges.cpp)   parts of one facet, then facets of one plane: cancel common
//   edges,
//                                  drop vertices at which nothing turns
//   loops   (face_loops.cpp)       chains of edges, holes in their faces
//   pairing (brep/brep_builder.h)  opposite halfedges; where four or more faces meet at an edge
//   their
//                                  exact radial order and the inside decide
//
// Every exact question is asked inside one cell, on one line or in one plane; what is global is
// sorting and hashing. Welding by float distance, the usual way, loses faces or invents them as
// soon as two different vertices round to the same place.

#include <trisect/bsp/detail/assembly.h>

#include <algorithm>
#include <unordered_map>

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/detail/assembly_parts.h>
#include <trisect/bsp/detail/boundary_edges.h>
#include <trisect/bsp/detail/face_loops.h>

namespace trisect::detail {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

// Calls visit(facet, edges of that facet) for every run of edges.
template <class Visit>
void for_each_face(std::span<const BoundaryEdge> edges, Visit&& visit) {
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        while (j < edges.size() && edges[j].facet == edges[i].facet) ++j;
        visit(edges[i].facet, edges.subspan(i, j - i));
        i = j;
    }
}

FaceSource source_of(const BoundaryFacet& f) {
    return {static_cast<std::uint32_t>(f.source->serial()),
            f.source->is_half_space() ? 0 : f.source->mesh().face_of(f.facet)};
}

class MeshWriter {
public:
    MeshWriter(const SolidState& solid, const BoundaryParts& parts)
        : lattice_(solid.lattice), parts_(parts) {}

    PolygonMesh write(std::span<const BoundaryEdge> edges) {
        const std::size_t triangles = parts_.whole.size() + 2 * edges.size();
        mesh_.face_begin.reserve(triangles + 1);
        mesh_.corners.reserve(3 * triangles);
        mesh_.points.reserve(triangles);
        for (const std::int32_t f : parts_.whole) copy(parts_.facets[u(f)]);
        point_index_.assign(parts_.bench.point_count(), -1);
        exact_index_.assign(parts_.bench.point_count(), -1);
        for_each_face(edges, [&](std::int32_t f, std::span<const BoundaryEdge> face) {
            triangulate_face(parts_.facets[u(f)], face);
        });
        return std::move(mesh_);
    }

private:
    std::uint32_t add_point(const std::array<double, 3>& lattice_units) {
        Point3d p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = lattice_.to_double(lattice_units[k]);
        mesh_.points.push_back(p);
        return static_cast<std::uint32_t>(mesh_.points.size() - 1);
    }

    std::uint32_t corner(const Source* source, std::uint32_t vertex) {
        auto& table = corner_index_[source];
        if (table.empty()) table.assign(source->mesh().points.size(), -1);
        std::int64_t& at = table[vertex];
        if (at < 0) at = add_point(trisect::approximate(source->mesh().points[vertex]).c);
        return static_cast<std::uint32_t>(at);
    }

    void copy(const BoundaryFacet& f) {
        std::array<std::uint32_t, 3> t{};
        for (int i = 0; i < 3; ++i)
            t[static_cast<std::size_t>(i)] = corner(f.source, f.source->corner_index(f.facet, i));
        if (f.flipped) std::swap(t[1], t[2]);
        mesh_.add_face(t);
    }

    const Point& point(PointId p) {
        std::int32_t& at = exact_index_[u(p)];
        if (at < 0) {
            at = static_cast<std::int32_t>(exact_.size());
            exact_.push_back(parts_.bench.point(p));
        }
        return exact_[u(at)];
    }

    std::uint32_t vertex(PointId p) {
        std::int64_t& at = point_index_[u(p)];
        if (at >= 0) return static_cast<std::uint32_t>(at);
        if (parts_.bench.is_corner(p)) {
            const auto [source, v] = parts_.bench.corner_name(p);
            at = corner(source, v);
        } else {
            at = add_point(point(p).nearest());
        }
        return static_cast<std::uint32_t>(at);
    }

    void triangulate_face(const BoundaryFacet& f, std::span<const BoundaryEdge> edges) {
        const auto faces = make_face_loops(parts_.bench, f.support, f.flipped, edges);
        const Plane& support = parts_.bench.plane_at(f.support);
        for (const FaceLoops& face : faces) {
            if (face.loops.size() == 1 && face.loops[0].size() == 3) {
                const auto& l = face.loops[0];
                mesh_.add_triangle(vertex(l[0]), vertex(l[1]), vertex(l[2]));
                continue;
            }
            std::vector<PointId> ids;
            std::vector<Point> points;
            std::vector<std::vector<std::uint32_t>> loops;
            for (const auto& l : face.loops) {
                auto& loop = loops.emplace_back();
                for (const PointId p : l) {
                    const auto at = std::find(ids.begin(), ids.end(), p);
                    loop.push_back(static_cast<std::uint32_t>(at - ids.begin()));
                    if (at != ids.end()) continue;
                    ids.push_back(p);
                    points.push_back(point(p));
                }
            }
            for (const auto& t :
                 triangulate(f.flipped ? support.flipped() : support, points, loops))
                mesh_.add_triangle(vertex(ids[t[0]]), vertex(ids[t[1]]), vertex(ids[t[2]]));
        }
    }

    Lattice lattice_;
    const BoundaryParts& parts_;
    PolygonMesh mesh_;
    std::unordered_map<const Source*, std::vector<std::int64_t>> corner_index_;
    std::vector<std::int64_t> point_index_;
    std::vector<std::int32_t> exact_index_;
    std::vector<Point> exact_;
};

}  // namespace

Brep assemble_brep(const SolidState& solid, const AssembleOptions& options) {
    BoundaryParts parts;
    gather_parts(solid, true, parts);
    std::vector<BoundaryEdge> edges = std::move(parts.edges);
    join_facets(parts, edges);
    remove_straight_vertices(parts, true, edges);
    join_coplanar_facets(parts, !options.maximal_faces, edges);
    remove_straight_vertices(parts, !options.maximal_faces, edges);
    BrepBuilder builder(solid.lattice);
    std::vector<std::int64_t> index(parts.bench.point_count(), -1);
    std::vector<std::vector<std::uint32_t>> loops;
    for_each_face(edges, [&](std::int32_t facet, std::span<const BoundaryEdge> face) {
        const BoundaryFacet& f = parts.facets[u(facet)];
        const Plane& support = parts.bench.plane_at(f.support);
        for (const FaceLoops& l : make_face_loops(parts.bench, f.support, f.flipped, face)) {
            loops.clear();
            for (const auto& points : l.loops) {
                auto& loop = loops.emplace_back();
                for (const PointId p : points) {
                    if (index[u(p)] < 0) index[u(p)] = builder.add_vertex(parts.bench.point(p));
                    loop.push_back(static_cast<std::uint32_t>(index[u(p)]));
                }
            }
            builder.add_face(f.flipped ? support.flipped() : support, loops, source_of(f));
        }
    });
    return std::move(builder).build();
}

PolygonMesh assemble_mesh(const SolidState& solid) {
    BoundaryParts parts;
    gather_parts(solid, false, parts);
    std::vector<BoundaryEdge> edges = std::move(parts.edges);
    join_facets(parts, edges);
    remove_straight_vertices(parts, true, edges);
    return MeshWriter(solid, parts).write(edges);
}

}  // namespace trisect::detail
