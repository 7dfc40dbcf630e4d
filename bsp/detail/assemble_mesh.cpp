// SPDX-License-Identifier: Apache-2.0
//
// To triangles, facet by facet. Nearly all facets of a large result pass through: their corners get
// numbers and coordinates as they are met, in one pass over the marks. Vertices keep their places
// in tables of their own, one for each source and one for the points of the workbench; a hash map
// from vertices to numbers costs more than everything else here together.

#include <algorithm>
#include <utility>

#include <trisect/brep/detail/small_polygon.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/detail/assembly.h>
#include <trisect/bsp/detail/assembly_parts.h>
#include <trisect/bsp/detail/boundary_edges.h>
#include <trisect/bsp/detail/face_loops.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

class MeshWriter {
public:
    MeshWriter(const SolidState& solid, const BoundaryParts& parts)
        : lattice_(solid.lattice),
          unit_(lattice_.to_double(1)),
          parts_(parts),
          bench_(parts.bench),
          loops_(parts.bench) {}

    PolygonMesh write(std::span<const BoundaryEdge> edges) {
        reserve(edges.size());
        tables_.resize(parts_.sources.size());
        number_.assign(bench_.point_count(), none);
        for (std::size_t t = 0; t < tables_.size(); ++t)
            tables_[t].assign(parts_.sources[t].source()->mesh().points.size(), none);
        rest_ = edges;
        for (std::size_t t = 0; t < tables_.size(); ++t) write_source(t);
        mesh_.points.resize(point_count_);
        mesh_.corners.resize(corner_count_);
        mesh_.face_begin.resize(corner_count_ / 3 + 1);
        std::uint32_t begin = 0;
        for (std::uint32_t& f : mesh_.face_begin) f = std::exchange(begin, begin + 3);
        return std::move(mesh_);
    }

private:
    // Of k edges come k - 2 triangles, and two more for each hole.
    void reserve(std::size_t edges) {
        const std::size_t whole = parts_.stats.whole_facets;
        mesh_.corners.resize(3 * (whole + edges));
        std::size_t corners = edges;
        for (const FacetMarks& marks : parts_.sources)
            corners += marks.source()->mesh().points.size();
        mesh_.points.resize(std::min(corners, 3 * whole + edges));
    }

    // For the triangles of so many edges beside those of the facets that pass through.
    void make_room(std::size_t edges) {
        const std::size_t needed = 3 * (parts_.stats.whole_facets + 2 * edges) + worked_corners_;
        if (needed > mesh_.corners.size()) mesh_.corners.resize(needed + needed / 4);
    }

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        std::uint32_t* out = &mesh_.corners[corner_count_];
        out[0] = a;
        out[1] = b;
        out[2] = c;
        corner_count_ += 3;
    }

    // A power of two times a double, which is what Lattice::to_double is unless the power
    // underflows.
    [[nodiscard]] double in_units(double v) const {
        return unit_ >= 0x1p-1000 ? v * unit_ : lattice_.to_double(v);
    }

    std::uint32_t add_point(const std::array<double, 3>& p) {
        mesh_.points[point_count_] = {in_units(p[0]), in_units(p[1]), in_units(p[2])};
        return static_cast<std::uint32_t>(point_count_++);
    }

    std::uint32_t add_point(const LatticePoint& p) {
        return add_point(std::array{static_cast<double>(p.x), static_cast<double>(p.y),
                                    static_cast<double>(p.z)});
    }

    // The table of a source: by vertex, its number in the mesh.
    std::uint32_t corner(std::size_t table, std::uint32_t vertex) {
        std::uint32_t& at = tables_[table][vertex];
        if (at == none) at = add_point(parts_.sources[table].source()->mesh().points[vertex]);
        return at;
    }

    // Facets in their order, whether they pass through or have edges.
    void write_source(std::size_t t) {
        const Source* source = parts_.sources[t].source();
        // The place in the order of the facet whose edges come next.
        constexpr std::uint64_t never = ~std::uint64_t{0};
        const auto place = [](std::uint32_t facet, bool flipped) {
            return 2 * std::uint64_t{facet} + (flipped ? 1 : 0);
        };
        const auto next_worked = [&] {
            if (rest_.empty()) return never;
            const BoundaryFacet& f = parts_.facets[u(rest_[0].facet)];
            return f.source == source ? place(f.facet, f.flipped) : never;
        };
        std::uint64_t next = next_worked();
        parts_.sources[t].for_each_whole([&](std::uint32_t facet, bool flipped) {
            for (; next < place(facet, flipped); next = next_worked()) write_worked();
            copy(t, facet, flipped);
        });
        for (; next != never; next = next_worked()) write_worked();
    }

    void copy(std::size_t t, std::uint32_t facet, bool flipped) {
        const LatticeMesh& mesh = parts_.sources[t].source()->mesh();
        const auto& corners = mesh.triangles[facet];
        std::uint32_t* const numbers = tables_[t].data();
        const auto number = [&](std::uint32_t vertex) {
            if (numbers[vertex] == none) numbers[vertex] = add_point(mesh.points[vertex]);
            return numbers[vertex];
        };
        const std::uint32_t a = number(corners[0]);
        const std::uint32_t b = number(corners[flipped ? 2 : 1]);
        const std::uint32_t c = number(corners[flipped ? 1 : 2]);
        add_triangle(a, b, c);
    }

    // The facet whose edges come next.
    void write_worked() {
        const BoundaryFacet& f = parts_.facets[u(rest_[0].facet)];
        std::size_t n = 1;
        while (n < rest_.size() && rest_[n].facet == rest_[0].facet) ++n;
        make_room(n);
        const std::size_t begin = corner_count_;
        loops_.set_region(f.support, f.flipped, rest_.first(n));
        rest_ = rest_.subspan(n);
        const auto loop = loops_.loop(0);
        if (loops_.loop_count() > 1 || loop.size() > small_polygon_limit || !is_simple(loop)) {
            write_large(f);
        } else if (is_all_of(f, loop)) {
            copy(parts_.table_of(f.source), f.facet, f.flipped);
        } else {
            write_small(f, loop);
        }
        worked_corners_ += corner_count_ - begin;
    }

    // A facet may have been touched in vain; then nothing may tell it from one that was not.
    bool is_all_of(const BoundaryFacet& f, std::span<const PointId> loop) const {
        return loop.size() == 3 && std::ranges::all_of(loop, [&](PointId p) {
                   if (!bench_.is_corner(p)) return false;
                   const auto [source, v] = bench_.corner_name(p);
                   if (source != f.source) return false;
                   const auto& corners = source->mesh().triangles[f.facet];
                   return std::ranges::find(corners, v) != corners.end();
               });
    }

    std::uint32_t vertex(PointId p) {
        std::uint32_t& at = number_[u(p)];
        if (at != none) return at;
        if (bench_.is_corner(p)) {
            const auto [source, v] = bench_.corner_name(p);
            at = corner(parts_.table_of(source), v);
        } else {
            at = add_point(bench_.nearest(p));
        }
        return at;
    }

    // In a loop of one region all passages of a vertex have one name.
    static bool is_simple(std::span<const PointId> loop) {
        for (std::size_t i = 0; i < loop.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (loop[i] == loop[j]) return false;
        return true;
    }

    void write_small(const BoundaryFacet& f, std::span<const PointId> loop) {
        const auto axes = PlaneProjection::axes_of(bench_.plane_at(f.support), f.flipped);
        const auto orientation = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            const int s = PlaneProjection::filtered_orientation(
                bench_.approximation(loop[a]), bench_.approximation(loop[b]),
                bench_.approximation(loop[c]), axes);
            if (s != 0) return s;
            return PlaneProjection::exact_orientation(bench_.homogeneous(loop[a]),
                                                      bench_.homogeneous(loop[b]),
                                                      bench_.homogeneous(loop[c]), axes);
        };
        const auto first_corner = [&] {
            std::uint32_t first = 0;
            for (std::uint32_t i = 1; i < loop.size(); ++i) {
                const int c = compare_along(bench_, loop[i], loop[first], axes.u);
                if (c < 0 || (c == 0 && compare_along(bench_, loop[i], loop[first], axes.v) < 0))
                    first = i;
            }
            return first;
        };
        const bool done =
            cut_small_polygon(loop.size(), orientation, first_corner,
                              [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                                  add_triangle(vertex(loop[a]), vertex(loop[b]), vertex(loop[c]));
                              });
        TRISECT_EXPECTS(done, "a face with a simple outline has an ear");
    }

    void write_large(const BoundaryFacet& f) {
        points_.clear();
        ids_.clear();
        outline_.clear();
        local_.resize(bench_.point_count(), none);
        for (std::size_t l = 0; l < loops_.loop_count(); ++l) {
            auto& loop = outline_.emplace_back();
            for (const PointId p : loops_.loop(l)) {
                if (local_[u(p)] == none) {
                    local_[u(p)] = static_cast<std::uint32_t>(ids_.size());
                    ids_.push_back(p);
                    points_.push_back(bench_.point(p));
                }
                loop.push_back(local_[u(p)]);
            }
        }
        for (const PointId p : ids_) local_[u(p)] = none;
        const Plane& support = bench_.plane_at(f.support);
        for (const IndexTriangle& t :
             triangulate(f.flipped ? support.flipped() : support, points_, outline_))
            add_triangle(vertex(ids_[t[0]]), vertex(ids_[t[1]]), vertex(ids_[t[2]]));
    }

    Lattice lattice_;
    double unit_;
    const BoundaryParts& parts_;
    const Workbench& bench_;
    PolygonMesh mesh_;                                // longer than what is written so far:
    std::size_t point_count_ = 0;                     // in mesh_.points
    std::size_t corner_count_ = 0;                    // in mesh_.corners, and of these:
    std::size_t worked_corners_ = 0;                  // those of facets that did not pass through
    std::span<const BoundaryEdge> rest_;              // of facets not yet written
    std::vector<std::vector<std::uint32_t>> tables_;  // by source
    std::vector<std::uint32_t> number_;               // by PointId
    FaceLoops loops_;
    std::vector<std::uint32_t> local_;  // by PointId, while one face is triangulated
    std::vector<PointId> ids_;
    std::vector<Point> points_;
    std::vector<IndexLoop> outline_;
};

// The corners of facets that pass through: vertices, whatever the others do there.
std::vector<PointId> corners_of_whole_facets(const BoundaryParts& parts) {
    std::vector<std::vector<bool>> used;
    for (const FacetMarks& marks : parts.sources) {
        const LatticeMesh& mesh = marks.source()->mesh();
        auto& is_used = used.emplace_back(mesh.points.size(), false);
        marks.for_each_whole([&](std::uint32_t facet, bool) {
            for (const std::uint32_t v : mesh.triangles[facet]) is_used[v] = true;
        });
    }
    std::vector<PointId> out;
    for (std::size_t p = 0; p < parts.bench.point_count(); ++p) {
        if (!parts.bench.is_corner(static_cast<PointId>(p))) continue;
        const auto [source, v] = parts.bench.corner_name(static_cast<PointId>(p));
        // No table: a corner of a facet that only named the point.
        const std::int32_t t = parts.table_ids.find(BoundaryParts::key_of(source));
        if (t >= 0 && used[u(t)][v]) out.push_back(parts.representatives[p]);
    }
    return out;
}

}  // namespace

PolygonMesh assemble_mesh(const SolidState& solid, AssemblyStats* stats) {
    BoundaryParts parts;
    gather_parts(solid, parts);
    std::vector<BoundaryEdge> edges = std::move(parts.edges);
    join_facets(parts, edges);
    remove_straight_vertices(parts, true, {}, edges);
    // Facets that nothing changed are left alone, so that it does not show which of them the tree
    // has looked at.
    mark_unchanged_facets(parts, edges);
    parts.stats.joined_facets = join_coplanar_facets(parts, false, edges);
    if (parts.stats.joined_facets != 0)
        remove_straight_vertices(parts, false, corners_of_whole_facets(parts), edges);
    if (stats != nullptr) *stats = parts.stats;
    return MeshWriter(solid, parts).write(edges);
}

}  // namespace trisect::detail
