// SPDX-License-Identifier: Apache-2.0
//
// To triangles, facet by facet. Nearly all facets of a large result pass through. So corners get
// their numbers first, in the order of their sources: which of them are in use is one pass over the
// marks, their coordinates are one pass over the points, and then a facet is three look-ups in a
// table. Vertices that cuts have made come after them, as triangles have them. A hash map from
// vertices to numbers costs more than everything else here together.
//
// Facets that did not pass through are cut into triangles before anything is written. Then it is
// known how many triangles come before any facet, and several threads write parts of the mesh.

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/assembly/assembly_parts.h>
#include <trisect/bsp/assembly/joining/join_coplanar_facets.h>
#include <trisect/bsp/assembly/joining/join_facets.h>
#include <trisect/bsp/assembly/joining/straight_vertices.h>
#include <trisect/bsp/assembly/parts/boundary_edges.h>
#include <trisect/bsp/assembly/parts/facet_cutter.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/flat/flat_mesh.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/ordered_parts.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/ready_memory.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t no_number = static_cast<std::uint32_t>(-1);
constexpr std::uint32_t in_use = 0;  // until corners have numbers

using Triangle = std::array<std::uint32_t, 3>;

// Fewer points are not worth a part of their own, nor fewer groups of eight facets.
constexpr std::size_t least_points = 16384;
constexpr std::size_t least_group_count = 4096;

// Of fewer facets that pass through the triangles are in no new memory of megabytes.
constexpr std::size_t many_whole_facets = std::size_t{1} << 16;

// Nor are fewer vertices that cuts have made, or edges of facets that were cut.
constexpr std::size_t least_made = 512;
constexpr std::size_t least_cut_edges = 1024;

// By source: the numbers of its corners in the mesh.
using CornerTables = std::vector<PoolVector<std::uint32_t>>;

// Marks the corners of the facets in groups of eight that pass through as in use.
void mark_corners(const FacetMarks& marks, std::size_t begin, std::size_t end,
                  std::uint32_t* table) {
    const Triangle* const triangles = marks.source()->mesh().triangles.data();
    const auto mark = [=](std::uint32_t facet, bool) {
        for (const std::uint32_t v : triangles[facet]) table[v] = in_use;
    };
    const auto mark_eight = [=](std::uint32_t facet) {
        for (std::uint32_t k = 0; k < 8; ++k) mark(facet + k, false);
    };
    marks.for_each_whole(begin, end, mark_eight, mark);
}

// The same where several threads mark the same ones. They look first, so that they need not wait
// for each other's caches.
void mark_shared(std::uint32_t& number) {
    const std::atomic_ref shared(number);
    if (shared.load(std::memory_order_relaxed) == no_number)
        shared.store(in_use, std::memory_order_relaxed);
}
void mark_corners_shared(const FacetMarks& marks, std::size_t begin, std::size_t end,
                         std::uint32_t* table) {
    const Triangle* const triangles = marks.source()->mesh().triangles.data();
    marks.for_each_whole(begin, end, [=](std::uint32_t facet, bool) {
        for (const std::uint32_t v : triangles[facet]) mark_shared(table[v]);
    });
}

CornerTables corners_in_use(const BoundaryParts& parts, std::uint32_t threads) {
    CornerTables tables(parts.sources.size());
    const auto make = [&](std::size_t t) {
        tables[t].assign(parts.sources[t].source()->mesh().points.size(), no_number);
    };
    const PartsOfRanges of_groups(
        tables.size(), [&](std::size_t t) { return parts.sources[t].group_count(); }, threads,
        least_group_count);
    if (of_groups.count() != tables.size())
        for (std::size_t t = 0; t < tables.size(); ++t) make(t);
    of_groups.for_each([&](std::size_t, const PartsOfRanges::Part& p) {
        if (tables[p.range].empty()) make(p.range);
        const auto& mark = p.is_whole ? mark_corners : mark_corners_shared;
        mark(parts.sources[p.range], p.begin, p.end, tables[p.range].data());
    });
    return tables;
}

class MeshWriter {
public:
    /// `tables` as corners_in_use() makes them.
    MeshWriter(const SolidState& solid, const BoundaryParts& parts, CornerTables tables,
               std::uint32_t threads)
        : lattice_(solid.lattice),
          unit_(lattice_.to_double(1)),
          threads_(threads),
          parts_(parts),
          bench_(parts.bench),
          tables_(std::move(tables)) {}

    PolygonMesh write(std::span<const BoundaryEdge> edges) {
        number_.assign(bench_.point_count(), no_number);
        const auto number_and_cut = [&] { cut_facets(edges, number_corners(edges)); };
        if (threads_ != 1 && parts_.stats.whole_facets >= many_whole_facets) {
            both_at_once([&] { make_room(edges.size()); }, number_and_cut);
        } else {
            number_and_cut();
        }
        resize_ready(mesh_.corners, 3 * parts_.stats.whole_facets + worked_.size());
        write_sources();
        number_faces();
        return std::move(mesh_);
    }

    /// The face that each triangle is part of. \pre written
    [[nodiscard]] std::vector<FaceSource> names() const {
        std::vector<FaceSource> out;
        auto next = worked_facets_.begin();
        const auto add_worked_before = [&](std::size_t t, std::uint64_t place) {
            for (; next->place < std::pair(t, place); ++next) {
                const auto facet = static_cast<std::uint32_t>(next->place.second / 2);
                out.insert(out.end(), ((next + 1)->begin - next->begin) / 3,
                           parts_.sources[next->place.first].source()->name_of(facet));
            }
        };
        for (std::size_t t = 0; t < tables_.size(); ++t) {
            const FacetMarks& marks = parts_.sources[t];
            marks.for_each_whole([&](std::uint32_t facet, bool flipped) {
                add_worked_before(t, place_of(facet, flipped));
                out.push_back(marks.source()->name_of(facet));
            });
            add_worked_before(t, no_place);
        }
        return out;
    }

    /// The vertices, in lattice units. \pre written; `count` of them
    [[nodiscard]] std::vector<Point> exact_points(std::size_t count) const {
        std::vector<Point> out(count);
        for (std::size_t t = 0; t < tables_.size(); ++t) {
            const auto& points = parts_.sources[t].source()->mesh().points;
            for (std::size_t v = 0; v < tables_[t].size(); ++v)
                if (tables_[t][v] != no_number) out[tables_[t][v]] = points[v];
        }
        for (std::size_t p = 0; p < number_.size(); ++p)
            if (number_[p] != no_number) out[number_[p]] = bench_.point(static_cast<PointId>(p));
        return out;
    }

private:
    // A facet that does not pass through: its triangles are in worked_, from `begin` on.
    struct Worked {
        std::pair<std::size_t, std::uint64_t> place;  // source and place_of
        std::size_t begin;
    };

    // The order of the facets of a source; none is as late as `no_place`.
    static constexpr std::uint64_t no_place = static_cast<std::uint64_t>(-1);
    static std::uint64_t place_of(std::uint32_t facet, bool flipped) {
        return 2 * std::uint64_t{facet} + (flipped ? 1 : 0);
    }

    // For the triangles: memory that is new to the process takes as long to be had and zeroed as
    // they take to be written. Facets that are cut have about as many triangles as edges.
    void make_room(std::size_t edges) {
        const std::size_t facets = parts_.stats.whole_facets;
        reserve_ready(mesh_.corners, 3 * (facets + edges));
        resize_ready(mesh_.corners, 3 * facets);
        reserve_ready(mesh_.face_begin, facets + edges + 1);
        resize_ready(mesh_.face_begin, facets);
    }

    // The corners of the result's facets, source by source, in the order of their vertices. Returns
    // the vertices that are none.
    PoolVector<PointId> number_corners(std::span<const BoundaryEdge> edges) {
        mark_points(edges);
        PoolVector<PointId> corners;
        PoolVector<PointId> made;
        list_points(corners, made);
        const std::vector<EqualCorners::Pair> equal = replaced_corners();
        number_tables(made.size());
        for (const EqualCorners::Pair& e : equal)
            table_of_equal(e.mesh)[e.corner] = table_of_equal(0)[e.first];
        for (const PointId p : corners) number_[as_index(p)] = corner_of(p);
        return made;
    }

    // The points that edges have, and those of them that are corners.
    void mark_points(std::span<const BoundaryEdge> edges) {
        ParallelParts(edges.size(), threads_, least_points)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (const BoundaryEdge& e : edges.subspan(begin, end - begin))
                    mark_shared(number_[as_index(e.from)]);
            });
    }
    void list_points(PoolVector<PointId>& corners, PoolVector<PointId>& made) {
        const ParallelParts parts(number_.size(), threads_, least_points);
        std::vector<std::array<PoolVector<PointId>, 2>> lists(parts.count());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (number_[i] == no_number) continue;
                const auto p = static_cast<PointId>(i);
                const bool is_corner = bench_.is_corner(p);
                if (is_corner) mark_shared(corner_of(p));
                lists[part][is_corner ? 0 : 1].push_back(p);
            }
        });
        if (lists.size() == 1) {
            corners.swap(lists[0][0]);
            made.swap(lists[0][1]);
            return;
        }
        for (const auto& [c, m] : lists) {
            corners.insert(corners.end(), c.begin(), c.end());
            made.insert(made.end(), m.begin(), m.end());
        }
    }

    [[nodiscard]] PoolVector<std::uint32_t>& table_of_equal(std::size_t mesh) {
        return tables_[parts_.table_of(parts_.equal_sources[mesh])];
    }

    // Corners in use that others stand for, which are in use instead.
    std::vector<EqualCorners::Pair> replaced_corners() {
        std::vector<EqualCorners::Pair> out;
        if (parts_.equal_corners == nullptr) return out;
        PoolVector<std::uint32_t>& first = table_of_equal(0);
        PoolVector<std::uint32_t>& second = table_of_equal(1);
        for (const EqualCorners::Pair& e : parts_.equal_corners->pairs) {
            std::uint32_t& corner = (e.mesh == 0 ? first : second)[e.corner];
            if (corner == no_number) continue;
            corner = no_number;
            first[e.first] = in_use;
            out.push_back(e);
        }
        return out;
    }

    // Numbers and coordinates for the corners in use. There will be so many other vertices.
    void number_tables(std::size_t others) {
        const PartsOfRanges parts(
            tables_.size(), [&](std::size_t t) { return tables_[t].size(); }, threads_,
            least_points);
        PoolVector<std::size_t> first(parts.count());
        parts.for_each([&](std::size_t number, const PartsOfRanges::Part& p) {
            const auto part = std::span(tables_[p.range]).subspan(p.begin, p.end - p.begin);
            first[number] =
                part.size() - static_cast<std::size_t>(std::ranges::count(part, no_number));
        });
        const std::size_t count = std::accumulate(first.begin(), first.end(), std::size_t{0});
        std::exclusive_scan(first.begin(), first.end(), first.begin(), std::size_t{0});
        reserve_ready(mesh_.points, count + others);
        resize_ready(mesh_.points, count);
        parts.for_each([&](std::size_t number, const PartsOfRanges::Part& p) {
            number_part(p, first[number]);
        });
    }
    void number_part(const PartsOfRanges::Part& part, std::size_t n) {
        const LatticePoint* const points =
            parts_.sources[part.range].source()->mesh().points.data();
        PoolVector<std::uint32_t>& table = tables_[part.range];
        Point3d* const out = mesh_.points.data();
        const double unit = unit_;
        for (std::size_t i = part.begin; i < part.end; ++i) {
            if (table[i] == no_number) continue;
            out[n] = coordinates_of(points[i], unit);
            table[i] = static_cast<std::uint32_t>(n++);
        }
    }

    // The place in the table of its source of a point that is a corner.
    std::uint32_t& corner_of(PointId p) {
        const auto [source, v] = bench_.corner_name(p);
        return tables_[parts_.table_of(source)][v];
    }

    // A power of two times a double, which is what Lattice::to_double is unless the power
    // underflows.
    [[nodiscard]] Point3d in_units(const std::array<double, 3>& p, double unit) const {
        if (unit >= 0x1p-1000) [[likely]]
            return {p[0] * unit, p[1] * unit, p[2] * unit};
        return {lattice_.to_double(p[0]), lattice_.to_double(p[1]), lattice_.to_double(p[2])};
    }

    [[nodiscard]] Point3d coordinates_of(const LatticePoint& p, double unit) const {
        return in_units(p.doubles(), unit);
    }

    // Cuts facets that do not pass through into triangles. `made`: vertices that are no corners.
    void cut_facets(std::span<const BoundaryEdge> edges, std::span<const PointId> made) {
        PoolVector<std::size_t> begins;  // of the edges of each
        for (std::size_t i = 0; i < edges.size(); ++i)
            if (i == 0 || edges[i].facet != edges[i - 1].facet) begins.push_back(i);
        const PoolVector<Point3d> rounded = rounded_coordinates(made);
        const MadeVertices vertices{number_, rounded, unit_};
        // By edges: few facets may have nearly all of them.
        const ParallelParts parts(edges.size(), threads_, least_cut_edges);
        std::vector<CutFacets> cut(parts.count());
        PerThread<FacetCutter> cutters;  // each has arrays as long as there are points
        const auto facet_from = [&](std::size_t part) {
            const std::size_t edge = edges.size() * part / parts.count();
            return static_cast<std::size_t>(std::ranges::lower_bound(begins, edge) -
                                            begins.begin());
        };
        begins.push_back(edges.size());
        const auto cut_part = [&](std::size_t part) {
            const std::size_t first = facet_from(part);
            const std::size_t last = facet_from(part + 1);
            FacetCutter& cutter =
                cutters.local([&] { return std::make_unique<FacetCutter>(parts_, vertices); });
            cut[part].corners.reserve(3 * (begins[last] - begins[first]));
            for (std::size_t i = first; i < last; ++i) {
                check_stop();
                look_ahead_at_facet(edges, begins, i, last);
                cutter.cut(edges.subspan(begins[i], begins[i + 1] - begins[i]), cut[part]);
            }
        };
        worked_.reserve(3 * edges.size());  // about as many triangles as edges
        worked_facets_.reserve(begins.size());
        PoolVector<std::uint32_t> at(made.size(), no_number);
        const auto number_part = [&](std::size_t part) {
            number_made(cut[part], made, rounded, at);
            cut[part] = {};
        };
        // This thread gives numbers while others cut on.
        if (parts.count() == 1) {
            cut_part(0);
            number_part(0);
        } else {
            for_each_in_order(parts.count(), threads_, cut_part, number_part);
        }
        worked_facets_.push_back({{tables_.size(), 0}, worked_.size()});  // ends the last one
        for (std::size_t i = 0; i < made.size(); ++i) number_[as_index(made[i])] = at[i];
    }

    // The names of supports, which lie anywhere in memory.
    void look_ahead_at_facet(std::span<const BoundaryEdge> edges,
                             std::span<const std::size_t> begins, std::size_t i,
                             std::size_t end) const {
        constexpr std::size_t ahead = 6;
        if (i + ahead >= end) return;
        const BoundaryFacet& f = parts_.facets[as_index(edges[begins[i + ahead]].facet)];
        __builtin_prefetch(&bench_.name(f.support));
    }

    // Numbers them in this order, too, for the time being.
    PoolVector<Point3d> rounded_coordinates(std::span<const PointId> made) {
        PoolVector<Point3d> out(made.size());
        ParallelParts(made.size(), threads_, least_made)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                // Points and the names of their planes lie anywhere in memory.
                constexpr std::size_t ahead = 6;
                for (std::size_t i = begin; i < end; ++i) {
                    if (i + 2 * ahead < end)
                        __builtin_prefetch(&bench_.planes_of(made[i + 2 * ahead]));
                    if (i + ahead < end)
                        for (const PlaneId p : bench_.planes_of(made[i + ahead]))
                            __builtin_prefetch(&bench_.name(p));
                    number_[as_index(made[i])] = static_cast<std::uint32_t>(i);
                    out[i] = in_units(bench_.nearest(made[i]), unit_);
                }
            });
        return out;
    }

    // In the order in which triangles have them, which depends on the exact points alone; the next
    // part of them. All are corners of triangles. `at`: the numbers so far.
    void number_made(const CutFacets& cut, std::span<const PointId> made,
                     std::span<const Point3d> rounded, PoolVector<std::uint32_t>& at) {
        for (const CutFacets::Facet& f : cut.facets)
            worked_facets_.push_back(
                {{f.source, place_of(f.facet, f.flipped)}, worked_.size() + f.begin});
        for (const PointId p : cut.corners) {
            std::uint32_t number = number_[as_index(p)];
            // Without a look at the point, which lies anywhere in memory.
            if (number < made.size() && made[number] == p) {
                std::uint32_t& known = at[number];
                if (known == no_number) {
                    known = static_cast<std::uint32_t>(mesh_.points.size());
                    mesh_.points.push_back(rounded[number]);
                }
                number = known;
            }
            worked_.push_back(number);
        }
    }

    static Triangle numbered(const Triangle& corners, bool flipped, const std::uint32_t* numbers) {
        return {numbers[corners[0]], numbers[corners[flipped ? 2 : 1]],
                numbers[corners[flipped ? 1 : 2]]};
    }

    // The first facet that was cut, from one of a source on.
    [[nodiscard]] PoolVector<Worked>::const_iterator worked_from(std::size_t t,
                                                                 std::size_t facet) const {
        const std::pair at(t, place_of(static_cast<std::uint32_t>(facet), false));
        return std::ranges::lower_bound(worked_facets_, at, {}, &Worked::place);
    }

    // Facets in their order, whether they pass through or were cut.
    void write_sources() {
        const PartsOfRanges parts(
            tables_.size(), [&](std::size_t t) { return parts_.sources[t].group_count(); },
            threads_, least_group_count);
        PoolVector<std::size_t> whole(parts.count());  // before each part
        parts.for_each([&](std::size_t number, const PartsOfRanges::Part& p) {
            whole[number] = parts_.sources[p.range].counts(p.begin, p.end).whole;
        });
        std::exclusive_scan(whole.begin(), whole.end(), whole.begin(), std::size_t{0});
        parts.for_each([&](std::size_t number, const PartsOfRanges::Part& p) {
            write_part(p.range, p.begin, p.end, whole[number]);
        });
    }

    // Groups [begin, end) of a source, before which so many facets that pass through are written.
    // What the loop needs is kept by value: numbers that it writes may alias others.
    void write_part(std::size_t t, std::size_t begin, std::size_t end, std::size_t whole_before) {
        auto next = worked_from(t, 8 * begin);
        const auto last = worked_from(t, 8 * end);
        std::uint32_t* out = mesh_.corners.data() + 3 * whole_before + next->begin;
        const auto place_of_next = [&] { return next != last ? next->place.second : no_place; };
        std::uint64_t next_place = place_of_next();
        const auto write_worked_before = [&](std::uint64_t place) {
            for (; next_place < place; ++next, next_place = place_of_next())
                out = std::copy(worked_.data() + next->begin, worked_.data() + (next + 1)->begin,
                                out);
        };
        const FacetMarks& marks = parts_.sources[t];
        const Triangle* const triangles = marks.source()->mesh().triangles.data();
        const std::uint32_t* const numbers = tables_[t].data();
        const auto write = [&](std::uint32_t facet, bool flipped) {
            if (next_place < place_of(facet, flipped)) [[unlikely]]
                write_worked_before(place_of(facet, flipped));
            const Triangle corners = numbered(triangles[facet], flipped, numbers);
            out = std::copy(corners.begin(), corners.end(), out);
        };
        const auto write_eight = [&](std::uint32_t facet) {
            if (next_place < place_of(facet + 7, false)) [[unlikely]] {
                for (std::uint32_t k = 0; k < 8; ++k) write(facet + k, false);
                return;
            }
            std::uint32_t* const at = std::exchange(out, out + 24);
            for (std::size_t k = 0; k < 8; ++k)
                for (std::size_t i = 0; i < 3; ++i)
                    at[3 * k + i] = numbers[triangles[facet + k][i]];
        };
        marks.for_each_whole(begin, end, write_eight, write);
        write_worked_before(no_place);
    }

    void number_faces() {
        resize_ready(mesh_.face_begin, mesh_.corners.size() / 3 + 1);
        ParallelParts(mesh_.face_begin.size(), threads_, least_points)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    mesh_.face_begin[i] = static_cast<std::uint32_t>(3 * i);
            });
    }

    Lattice lattice_;
    double unit_;
    std::uint32_t threads_;
    const BoundaryParts& parts_;
    const Workbench& bench_;
    CornerTables tables_;
    PolygonMesh mesh_;
    PoolVector<Worked> worked_facets_;  // in their order; then one more where they end
    PoolVector<std::uint32_t> worked_;  // three corners a triangle
    PoolVector<std::uint32_t> number_;  // by PointId
};

// The corners of facets that pass through: vertices, whatever the others do there. `tables` as
// corners_in_use() makes them.
PoolVector<PointId> corners_of_whole_facets(const BoundaryParts& parts,
                                            const CornerTables& tables) {
    PoolVector<PointId> out;
    for (std::size_t p = 0; p < parts.bench.point_count(); ++p) {
        if (!parts.bench.is_corner(static_cast<PointId>(p))) continue;
        const auto [source, v] = parts.bench.corner_name(static_cast<PointId>(p));
        // No table: a corner of a facet that only named the point.
        const std::int32_t t = parts.table_ids.find(BoundaryParts::key_of(source));
        if (t >= 0 && tables[as_index(t)][v] == in_use) out.push_back(parts.representatives[p]);
    }
    return out;
}

// What is said of a mesh besides.
struct MeshDetails {
    std::vector<FaceSource>* names = nullptr;
    std::vector<Point>* points = nullptr;
};

PolygonMesh assemble(const SolidState& solid, AssemblyStats* stats, bool by_planes,
                     std::uint32_t threads, const MeshDetails& details) {
    BoundaryParts parts;
    gather_parts(solid, parts, by_planes, threads);
    if (threads != 1) parts.bench.share();
    BoundaryEdges edges = std::move(parts.edges);
    const auto join = [&] {
        if (parts.are_joined) return sort_by_facet(parts, edges);
        join_facets(parts, edges, threads);
        // Else none is left out before facets of one plane are joined.
        if (!parts.are_general) remove_straight_vertices(parts, true, {}, edges, threads);
        // Facets that nothing changed are left alone, so that it does not show which of them the
        // tree has looked at.
        mark_unchanged_facets(parts, edges, threads);
        parts.stats.joined_facets = join_coplanar_facets(parts, false, edges, threads);
        join_planes_across_axes(parts, edges, threads);
    };
    // What was cut and what passes through have nothing to do with each other yet.
    CornerTables tables;
    const bool large = parts.stats.whole_facets >= 8 * least_group_count;
    const auto find_corners = [&](std::uint32_t on) { tables = corners_in_use(parts, on); };
    if (large && threads != 1 && edges.size() >= parts.stats.whole_facets / 64) {
        // A thread that waits for the other one does not help it.
        both_at_once([&] { find_corners(threads_here() > 2 ? threads : 1); }, join);
    } else {
        join();
        find_corners(large ? threads : 1);
    }
    if (!parts.are_joined && (parts.stats.joined_facets != 0 || parts.stats.axis_facets != 0))
        remove_straight_vertices(parts, false, corners_of_whole_facets(parts, tables), edges,
                                 threads);
    if (stats != nullptr) *stats = parts.stats;
    MeshWriter writer(solid, parts, std::move(tables), threads);
    PolygonMesh mesh = writer.write(edges);
    if (details.names != nullptr) *details.names = writer.names();
    if (details.points != nullptr) *details.points = writer.exact_points(mesh.points.size());
    return mesh;
}

// How many facets a form lists, and how often these cross, or what edges their outlines have.
struct ListedFacets {
    std::size_t operator()(const CellTree& tree) const {
        return tree.root.node->size() + (tree.crossings ? tree.crossings->pairs.size() : 0);
    }
    std::size_t operator()(const PrismOutlines& prisms) const {
        return prisms.whole->size() + prisms.outlines->edges.size();
    }
    std::size_t operator()(const FlatPrism& prism) const {
        return prism.operand->given().segments.size();
    }
    std::size_t operator()(const UndividedMeshes& meshes) const {
        std::size_t facets = meshes.crossings->pairs.size();
        for (const UncrossedFacets& list : meshes.uncrossed) facets += list.facets.size();
        if (meshes.outlined != nullptr) facets += meshes.outlined->edges.size();
        return meshes.beside != nullptr ? facets + (*this)(*meshes.beside) : facets;
    }
};

PolygonMesh assemble_on_threads(const SolidState& solid, AssemblyStats* stats, bool by_planes,
                                std::uint32_t threads, const MeshDetails& details) {
    // No arena for what no step would divide.
    const bool small = std::visit(ListedFacets(), solid.form) < 8 * least_group_count;
    return on_threads(small ? 1 : threads, [&](std::uint32_t n) {
        return assemble(solid, stats, by_planes, n, details);
    });
}

}  // namespace

PolygonMesh assemble_mesh(const SolidState& solid, AssemblyStats* stats, bool by_planes,
                          std::uint32_t threads, std::vector<FaceSource>* names) {
    if (const auto* const flat = std::get_if<FlatPrism>(&solid.form);
        flat != nullptr && names == nullptr && stats == nullptr)
        return flat_mesh(*flat);
    return assemble_on_threads(solid, stats, by_planes, threads, {names, nullptr});
}

ExactMesh assemble_exact_mesh(const SolidState& solid, std::uint32_t threads) {
    ExactMesh out;
    out.lattice = solid.lattice;
    const PolygonMesh mesh =
        assemble_on_threads(solid, nullptr, true, threads, {&out.source, &out.points});
    out.triangles.reserve(mesh.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        out.triangles.push_back(
            {mesh.corners[3 * f], mesh.corners[3 * f + 1], mesh.corners[3 * f + 2]});
    return out;
}

}  // namespace trisect::detail
