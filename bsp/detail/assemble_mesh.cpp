// SPDX-License-Identifier: Apache-2.0
//
// To triangles, facet by facet. Nearly all facets of a large result pass through. So corners get
// their numbers first, in the order of their sources: which of them are in use is one pass over the
// marks, their coordinates are one pass over the points, and then a facet is three look-ups in a
// table. Vertices that cuts have made come after them, as they are met. A hash map from vertices to
// numbers costs more than everything else here together.

#include <algorithm>
#include <utility>

#include <trisect/brep/detail/small_polygon.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/detail/assembly.h>
#include <trisect/bsp/detail/assembly_parts.h>
#include <trisect/bsp/detail/boundary_edges.h>
#include <trisect/bsp/detail/face_loops.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/stop_scope.h>

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
        number_.assign(bench_.point_count(), none);
        number_corners(edges);
        mesh_.corners.resize(3 * (parts_.stats.whole_facets + edges.size()));
        rest_ = edges;
        for (std::size_t t = 0; t < tables_.size(); ++t) write_source(t);
        mesh_.corners.resize(corner_count_);
        mesh_.face_begin.resize(corner_count_ / 3 + 1);
        std::uint32_t begin = 0;
        for (std::uint32_t& f : mesh_.face_begin) f = std::exchange(begin, begin + 3);
        return std::move(mesh_);
    }

private:
    // The corners of the result's facets, source by source, in the order of their vertices.
    void number_corners(std::span<const BoundaryEdge> edges) {
        constexpr std::uint32_t used = 0;
        tables_.resize(parts_.sources.size());
        for (std::size_t t = 0; t < tables_.size(); ++t) {
            const LatticeMesh& mesh = parts_.sources[t].source()->mesh();
            tables_[t].assign(mesh.points.size(), none);
            std::uint32_t* const table = tables_[t].data();
            parts_.sources[t].for_each_whole([&](std::uint32_t facet, bool) {
                for (const std::uint32_t v : mesh.triangles[facet]) table[v] = used;
            });
        }
        std::size_t made = 0;  // at most: vertices that are no corners
        for (const BoundaryEdge& e : edges) {
            if (std::exchange(number_[u(e.from)], used) != none) continue;
            if (bench_.is_corner(e.from)) {
                corner_of(e.from) = used;
            } else {
                ++made;
            }
        }
        std::size_t count = made;
        for (const auto& table : tables_)
            count += table.size() - static_cast<std::size_t>(std::ranges::count(table, none));
        mesh_.points.reserve(count);
        for (std::size_t t = 0; t < tables_.size(); ++t) {
            const LatticePoint* p = parts_.sources[t].source()->mesh().points.data();
            for (std::uint32_t& number : tables_[t]) {
                if (number != none) number = add_point(*p);
                ++p;
            }
        }
        for (const BoundaryEdge& e : edges)
            number_[u(e.from)] = bench_.is_corner(e.from) ? corner_of(e.from) : none;
    }

    // The place in the table of its source of a point that is a corner.
    std::uint32_t& corner_of(PointId p) {
        const auto [source, v] = bench_.corner_name(p);
        return tables_[parts_.table_of(source)][v];
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
        mesh_.points.push_back({in_units(p[0]), in_units(p[1]), in_units(p[2])});
        return static_cast<std::uint32_t>(mesh_.points.size() - 1);
    }

    std::uint32_t add_point(const LatticePoint& p) {
        return add_point(std::array{static_cast<double>(p.x), static_cast<double>(p.y),
                                    static_cast<double>(p.z)});
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
        const auto& corners = parts_.sources[t].source()->mesh().triangles[facet];
        const std::uint32_t* const numbers = tables_[t].data();
        add_triangle(numbers[corners[0]], numbers[corners[flipped ? 2 : 1]],
                     numbers[corners[flipped ? 1 : 2]]);
    }

    // The facet whose edges come next.
    void write_worked() {
        const BoundaryFacet& f = parts_.facets[u(rest_[0].facet)];
        check_stop();
        std::size_t n = 1;
        while (n < rest_.size() && rest_[n].facet == rest_[0].facet) ++n;
        make_room(n);
        const std::size_t begin = corner_count_;
        loops_.set_region(f.support, f.flipped, rest_.first(n));
        rest_ = rest_.subspan(n);
        if (loops_.loop_count() == 1 && is_all_of(f, loops_.loop(0))) {
            copy(parts_.table_of(f.source), f.facet, f.flipped);
        } else if (loops_.has_holes()) {
            write_large(f, 0, loops_.loop_count());
        } else {
            for (std::size_t l = 0; l < loops_.loop_count(); ++l) write_loop(f, l);
        }
        worked_corners_ += corner_count_ - begin;
    }

    void write_loop(const BoundaryFacet& f, std::size_t l) {
        const auto loop = loops_.loop(l);
        if (loop.size() > small_polygon_limit || !is_simple(loop)) {
            write_large(f, l, l + 1);
        } else {
            write_small(f, loop);
        }
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
        if (at == none) at = add_point(bench_.nearest(p));
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

    // Loops [first, end) as one region.
    void write_large(const BoundaryFacet& f, std::size_t first, std::size_t end) {
        points_.clear();
        ids_.clear();
        outline_.clear();
        local_.resize(bench_.point_count(), none);
        for (std::size_t l = first; l < end; ++l) {
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
    PolygonMesh mesh_;                    // its corners are longer than what is written so far:
    std::size_t corner_count_ = 0;        // in mesh_.corners, and of these:
    std::size_t worked_corners_ = 0;      // those of facets that did not pass through
    std::span<const BoundaryEdge> rest_;  // of facets not yet written
    std::vector<std::vector<std::uint32_t>> tables_;  // by source: the numbers of its corners
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

PolygonMesh assemble_mesh(const SolidState& solid, AssemblyStats* stats, bool by_planes) {
    BoundaryParts parts;
    gather_parts(solid, parts, by_planes);
    std::vector<BoundaryEdge> edges = std::move(parts.edges);
    join_facets(parts, edges);
    remove_straight_vertices(parts, true, {}, edges);
    // Facets that nothing changed are left alone, so that it does not show which of them the tree
    // has looked at.
    mark_unchanged_facets(parts, edges);
    parts.stats.joined_facets = join_coplanar_facets(parts, false, edges);
    join_planes_across_axes(parts, edges);
    if (parts.stats.joined_facets != 0 || parts.stats.axis_facets != 0)
        remove_straight_vertices(parts, false, corners_of_whole_facets(parts), edges);
    if (stats != nullptr) *stats = parts.stats;
    return MeshWriter(solid, parts).write(edges);
}

}  // namespace trisect::detail
