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
#include <trisect/bsp/assembly/parts/boundary_edges.h>
#include <trisect/bsp/assembly/parts/facet_cutter.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/flat/flat_mesh.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
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

// Marks the corners of the facets that pass through as in use. Several threads mark the same ones,
// and look first, so that they need not wait for each other's caches.
CornerTables corners_in_use(const BoundaryParts& parts, std::uint32_t threads) {
    CornerTables tables;
    for (const FacetMarks& marks : parts.sources) {
        const Triangle* const triangles = marks.source()->mesh().triangles.data();
        const std::size_t count = marks.source()->mesh().points.size();
        std::uint32_t* const table = tables.emplace_back(count, no_number).data();
        const ParallelParts of_groups(marks.group_count(), threads, least_group_count);
        if (of_groups.count() == 1) {
            const auto mark = [=](std::uint32_t facet, bool) {
                for (const std::uint32_t v : triangles[facet]) table[v] = in_use;
            };
            const auto mark_eight = [=](std::uint32_t facet) {
                for (std::uint32_t k = 0; k < 8; ++k) mark(facet + k, false);
            };
            marks.for_each_whole(0, marks.group_count(), mark_eight, mark);
            continue;
        }
        of_groups.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            marks.for_each_whole(begin, end, [=](std::uint32_t facet, bool) {
                for (const std::uint32_t v : triangles[facet]) {
                    const std::atomic_ref corner(table[v]);
                    if (corner.load(std::memory_order_relaxed) == no_number)
                        corner.store(in_use, std::memory_order_relaxed);
                }
            });
        });
    }
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
        for (std::size_t t = 0; t < tables_.size(); ++t) write_source(t);
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
        PoolVector<PointId> made;
        PoolVector<PointId> corners;
        for (const BoundaryEdge& e : edges) {
            if (std::exchange(number_[as_index(e.from)], in_use) != no_number) continue;
            if (bench_.is_corner(e.from)) {
                corner_of(e.from) = in_use;
                corners.push_back(e.from);
            } else {
                made.push_back(e.from);
            }
        }
        const std::vector<EqualCorners::Pair> equal = replaced_corners();
        const auto used_in = [](std::span<const std::uint32_t> part) {
            return part.size() - static_cast<std::size_t>(std::ranges::count(part, no_number));
        };
        std::vector<PoolVector<std::size_t>> counts;  // of every part of a table
        std::size_t count = made.size();
        for (const auto& table : tables_) {
            const ParallelParts parts(table.size(), threads_, least_points);
            auto& of_parts = counts.emplace_back(parts.count());
            parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
                of_parts[part] = used_in(std::span(table).subspan(begin, end - begin));
            });
            count = std::accumulate(of_parts.begin(), of_parts.end(), count);
        }
        reserve_ready(mesh_.points, count);
        for (std::size_t t = 0; t < tables_.size(); ++t) number_table(t, counts[t]);
        for (const EqualCorners::Pair& e : equal)
            table_of_equal(e.mesh)[e.corner] = table_of_equal(0)[e.first];
        for (const PointId p : corners) number_[as_index(p)] = corner_of(p);
        return made;
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

    // Numbers and coordinates for the corners in use; `counts` of them in each part.
    void number_table(std::size_t t, std::span<const std::size_t> counts) {
        const LatticePoint* const points = parts_.sources[t].source()->mesh().points.data();
        PoolVector<std::uint32_t>& table = tables_[t];
        PoolVector<std::size_t> first(counts.size());
        std::exclusive_scan(counts.begin(), counts.end(), first.begin(), mesh_.points.size());
        resize_ready(mesh_.points, first.back() + counts.back());
        Point3d* const out = mesh_.points.data();
        ParallelParts(table.size(), threads_, least_points)
            .for_each([&, unit = unit_](std::size_t part, std::size_t begin, std::size_t end) {
                std::size_t n = first[part];
                for (std::size_t i = begin; i < end; ++i) {
                    if (table[i] == no_number) continue;
                    out[n] = coordinates_of(points[i], unit);
                    table[i] = static_cast<std::uint32_t>(n++);
                }
            });
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
        const auto facet_from = [&](std::size_t edge) {
            return static_cast<std::size_t>(std::ranges::lower_bound(begins, edge) -
                                            begins.begin());
        };
        begins.push_back(edges.size());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            const std::size_t first = facet_from(begin);
            const std::size_t last = facet_from(end);
            FacetCutter& cutter =
                cutters.local([&] { return std::make_unique<FacetCutter>(parts_, vertices); });
            cut[part].corners.reserve(3 * (begins[last] - begins[first]));
            for (std::size_t i = first; i < last; ++i) {
                check_stop();
                look_ahead_at_facet(edges, begins, i, last);
                cutter.cut(edges.subspan(begins[i], begins[i + 1] - begins[i]), cut[part]);
            }
        });
        number_made(cut, made, rounded);
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

    // In the order in which triangles have them, which depends on the exact points alone. All are
    // corners of triangles.
    void number_made(std::span<const CutFacets> cut, std::span<const PointId> made,
                     std::span<const Point3d> rounded) {
        PoolVector<std::uint32_t> at(made.size(), no_number);
        std::size_t corners = 0;
        std::size_t facets = 1;
        for (const CutFacets& part : cut) {
            corners += part.corners.size();
            facets += part.facets.size();
        }
        worked_.reserve(corners);
        worked_facets_.reserve(facets);
        for (const CutFacets& part : cut) {
            for (const CutFacets::Facet& f : part.facets)
                worked_facets_.push_back(
                    {{f.source, place_of(f.facet, f.flipped)}, worked_.size() + f.begin});
            for (const PointId p : part.corners) {
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
        worked_facets_.push_back({{tables_.size(), 0}, worked_.size()});  // ends the last one
        for (std::size_t i = 0; i < made.size(); ++i) number_[as_index(made[i])] = at[i];
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
    void write_source(std::size_t t) {
        const FacetMarks& marks = parts_.sources[t];
        const ParallelParts parts(marks.group_count(), threads_, least_group_count);
        PoolVector<std::size_t> whole(parts.count());  // before each part
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            whole[part] = marks.counts(begin, end).whole;
        });
        const std::size_t count = std::accumulate(whole.begin(), whole.end(), std::size_t{0});
        std::exclusive_scan(whole.begin(), whole.end(), whole.begin(), whole_written_);
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            write_part(t, begin, end, whole[part]);
        });
        whole_written_ += count;
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
    std::size_t whole_written_ = 0;
    PoolVector<std::uint32_t> number_;  // by PointId
};

// The corners of facets that pass through: vertices, whatever the others do there.
PoolVector<PointId> corners_of_whole_facets(const BoundaryParts& parts) {
    std::vector<std::vector<bool>> used;
    for (const FacetMarks& marks : parts.sources) {
        const LatticeMesh& mesh = marks.source()->mesh();
        auto& is_used = used.emplace_back(mesh.points.size(), false);
        marks.for_each_whole([&](std::uint32_t facet, bool) {
            for (const std::uint32_t v : mesh.triangles[facet]) is_used[v] = true;
        });
    }
    PoolVector<PointId> out;
    for (std::size_t p = 0; p < parts.bench.point_count(); ++p) {
        if (!parts.bench.is_corner(static_cast<PointId>(p))) continue;
        const auto [source, v] = parts.bench.corner_name(static_cast<PointId>(p));
        // No table: a corner of a facet that only named the point.
        const std::int32_t t = parts.table_ids.find(BoundaryParts::key_of(source));
        if (t >= 0 && used[as_index(t)][v]) out.push_back(parts.representatives[p]);
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
        join_facets(parts, edges);
        remove_straight_vertices(parts, true, {}, edges, threads);
        // Facets that nothing changed are left alone, so that it does not show which of them the
        // tree has looked at.
        mark_unchanged_facets(parts, edges);
        parts.stats.joined_facets = join_coplanar_facets(parts, false, edges, threads);
        join_planes_across_axes(parts, edges);
        if (parts.stats.joined_facets != 0 || parts.stats.axis_facets != 0)
            remove_straight_vertices(parts, false, corners_of_whole_facets(parts), edges, threads);
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
