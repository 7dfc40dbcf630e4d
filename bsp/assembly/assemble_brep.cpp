// SPDX-License-Identifier: Apache-2.0
//
// Cells give pieces; a boundary needs faces, edges and vertices that fit together. The road:
//
//   parts    (assembly_parts.cpp)   polygons of the cells with exact vertices, conforming in each
//                                   cell; facets that nothing touched stay as they are
//   join     (joining/)             parts of one facet, then facets of one plane: cancel common
//                                   edges, drop vertices at which nothing turns
//   loops    (face_loops.cpp)       chains of edges, holes in their faces
//   pairing  (brep/brep_builder.h)  opposite halfedges; where four or more faces meet at an edge
//                                   their exact radial order and the inside decide
//
// Every exact sign is computed inside one cell, on one line or in one plane; what is global is
// sorting and hashing. Welding by float distance, the usual way, loses faces or invents them as
// soon as two different vertices round to the same place.

#include <algorithm>
#include <tuple>

#include <trisect/brep/brep_builder.h>
#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/assembly/assembly_parts.h>
#include <trisect/bsp/assembly/joining/join_coplanar_facets.h>
#include <trisect/bsp/assembly/joining/join_facets.h>
#include <trisect/bsp/assembly/joining/straight_vertices.h>
#include <trisect/bsp/assembly/parts/boundary_vertices.h>
#include <trisect/bsp/assembly/parts/broken_edges.h>
#include <trisect/bsp/assembly/parts/face_loops.h>
#include <trisect/bsp/assembly/parts/whole_facets.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

FaceSource source_of(const BoundaryFacet& f) { return f.source->name_of(f.facet); }

// Gives the builder faces in the order of facets.
class FaceWriter {
public:
    FaceWriter(const SolidState& solid, const BoundaryParts& parts, BoundaryVertices& vertices)
        : parts_(parts), vertices_(vertices), loops_(parts.bench), builder_(solid.lattice) {}

    Brep write(std::span<const WholeFacet> whole, std::span<const BoundaryEdge> edges) {
        builder_.reserve(vertices_.size(), whole.size() + edges.size() / 3,
                         3 * whole.size() + edges.size());
        number_.assign(vertices_.size(), BoundaryVertices::none);
        std::size_t i = 0;
        for (const WholeFacet& w : whole) {
            if (w.joins) continue;
            const BoundaryFacet f{parts_.sources[w.table].source(), w.facet, w.flipped};
            while (i < edges.size() && precedes(parts_.facets[as_index(edges[i].facet)], f))
                i = write_cut(edges, i);
            write_whole(f, w);
        }
        while (i < edges.size()) i = write_cut(edges, i);
        return std::move(builder_).build();
    }

private:
    static bool precedes(const BoundaryFacet& a, const BoundaryFacet& b) {
        return std::tuple(a.source->serial(), a.facet, a.flipped) <
               std::tuple(b.source->serial(), b.facet, b.flipped);
    }

    std::uint32_t number(BoundaryVertices::Index v) {
        if (v >= number_.size()) number_.resize(vertices_.size(), BoundaryVertices::none);
        std::uint32_t& at = number_[v];
        if (at == BoundaryVertices::none) at = builder_.add_vertex(vertices_.exact(v));
        return at;
    }

    // All faces of the facet that edges[first] belongs to; returns where the next facet begins.
    std::size_t write_cut(std::span<const BoundaryEdge> edges, std::size_t first) {
        check_stop();
        std::size_t end = first;
        while (end < edges.size() && edges[end].facet == edges[first].facet) ++end;
        const BoundaryFacet& f = parts_.facets[as_index(edges[first].facet)];
        const Plane& support = parts_.bench.plane_at(f.support);
        const Plane plane = f.flipped ? support.flipped() : support;
        loops_.set_region(f.support, f.flipped, edges.subspan(first, end - first));
        for (const auto& face : loops_.faces()) {
            outline_.clear();
            for (const std::uint32_t l : face) {
                auto& loop = outline_.emplace_back();
                for (const PointId p : loops_.loop(l))
                    loop.push_back(number(vertices_.of_point(p)));
            }
            builder_.add_face(plane, outline_, source_of(f));
        }
        return end;
    }

    // The loop starts at its smallest corner, as FaceLoops has it.
    void write_whole(const BoundaryFacet& f, const WholeFacet& w) {
        const Plane support = f.source->support(f.facet);
        const int k = support.dominant_axis();
        const auto key = [&](std::size_t i) {
            const int corner = static_cast<int>(i == 0 ? 0 : (f.flipped ? 3 - i : i));
            const LatticePoint& p = f.source->corner(f.facet, corner);
            return std::pair(p[(k + 1) % 3], p[(k + 2) % 3]);
        };
        std::size_t first = 0;
        for (const std::size_t i : {std::size_t{1}, std::size_t{2}})
            if (key(i) < key(first)) first = i;
        std::array<std::uint32_t, 3> loop{};
        for (std::size_t i = 0; i < 3; ++i) loop[i] = number(w.corners[(first + i) % 3]);
        builder_.add_polygon(f.flipped ? support.flipped() : support, loop, source_of(f));
    }

    const BoundaryParts& parts_;
    BoundaryVertices& vertices_;
    FaceLoops loops_;
    BrepBuilder builder_;
    PoolVector<std::uint32_t> number_;  // by vertex: the builder's
    std::vector<IndexLoop> outline_;
};

// Vertices at which a facet that passed through turns are real, whatever the others do there.
PoolVector<PointId> corners_to_keep(std::span<const WholeFacet> whole,
                                    const BoundaryVertices& vertices) {
    PoolVector<PointId> keep;
    for (const WholeFacet& w : whole) {
        if (w.joins) continue;
        for (const auto v : w.corners)
            if (const PointId p = vertices.point(v); p >= 0) keep.push_back(p);
    }
    return keep;
}

}  // namespace

Brep assemble_brep(const SolidState& solid, const AssembleOptions& options, AssemblyStats* stats) {
    const bool within_faces = !options.maximal_faces;
    BoundaryParts parts;
    gather_parts(solid, parts, false);
    BoundaryEdges edges = std::move(parts.edges);
    join_facets(parts, edges);
    // Neighbours in one plane stay apart, so the points between them on other facets are vertices.
    if (within_faces) conform_unmatched_edges(parts, edges);
    remove_straight_vertices(parts, true, {}, edges);
    BoundaryVertices vertices(parts);
    PoolVector<WholeFacet> whole = list_whole_facets(parts, edges, within_faces, vertices);
    const PoolVector<BrokenEdge> broken = find_broken_edges(parts, edges, whole);
    add_joining_facets(whole, broken, vertices, parts, edges);
    join_coplanar_facets(parts, within_faces, edges);
    if (stats != nullptr) {
        *stats = parts.stats;
        stats->joined_facets = static_cast<std::uint64_t>(
            std::count_if(whole.begin(), whole.end(), [](const auto& w) { return w.joins; }));
    }
    remove_straight_vertices(parts, within_faces, corners_to_keep(whole, vertices), edges);
    return FaceWriter(solid, parts, vertices).write(whole, edges);
}

}  // namespace trisect::detail
