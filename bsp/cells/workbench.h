// SPDX-License-Identifier: Apache-2.0
//
// Workbench: planes and points of one leaf arrangement or assembly, by id.
//
// Planes are found by name, so that the symbolic stage of a predicate is a comparison of ids;
// planes found to be the same point set share a class. Points are corners of sources or triples of
// planes. A workbench belongs to one thread, since planes are made on demand, until it is shared.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/refined_point.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/few.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/spin_lock.h>

namespace trisect::detail {

using PlaneId = std::int32_t;
using PointId = std::int32_t;

struct WorkEdge {
    PlaneId plane = -1;
    bool above = false;  ///< the polygon lies above the plane instead of below
};

/// A convex polygon in the making: `points[i]` is the start of edge i. Counter-clockwise seen from
/// above the support, strictly convex.
struct WorkPolygon {
    PlaneId support = -1;
    Few<WorkEdge> edges;
    Few<PointId> points;
    [[nodiscard]] bool is_empty() const { return points.empty(); }
};

class Workbench {
public:
    void clear();

    PlaneId plane(const PlaneName& name);
    /// Made on first use: of most names only the name is ever used.
    [[nodiscard]] const Plane& plane_at(PlaneId id) const {
        // Free on processors of today.
        const std::int32_t at =
            std::atomic_ref(planes_[as_index(id)].place).load(std::memory_order_acquire);
        return at >= 0 ? made_.at(at) : make_plane(id);
    }
    /// Of the plane of an edge: the support of its facet.
    [[nodiscard]] PlaneId support_of(PlaneId edge) const { return planes_[as_index(edge)].support; }
    [[nodiscard]] const PlaneName& name(PlaneId id) const { return planes_[as_index(id)].name; }
    /// Records that two planes are the same point set.
    void declare_same(PlaneId a, PlaneId b);
    [[nodiscard]] PlaneId plane_class(PlaneId id) const {
        while (planes_[as_index(id)].same != id) id = planes_[as_index(id)].same;
        return id;
    }

    /// Planes of the three edges of a facet, in a row; returns the first. They are new, and not
    /// found by their names. \pre no half-space
    PlaneId add_facet(const Source* source, std::uint32_t facet);
    /// The axis along which the normal of a support is longest, and whether it points upwards
    /// there.
    struct Facing {
        int axis = 0;
        bool is_up = true;
    };
    [[nodiscard]] Facing facing(PlaneId support) const;

    PointId corner(const Source* source, std::uint32_t facet, int i);
    /// A point that is new, and not found by name: a corner, or where three planes meet.
    PointId add_corner(const Source* source, std::uint32_t vertex);
    PointId add_point(PlaneId p, PlaneId q, PlaneId r, const Approximation& known);
    /// Room for the planes of so many more facets, four each, and for so many more points. All are
    /// to be put there before anything else is done; several threads may put different ones, if the
    /// bench is shared.
    struct Room {
        PlaneId first_plane = 0;
        PointId first_point = 0;
    };
    [[nodiscard]] Room make_room(std::size_t facets, std::size_t points);
    void put_facet(PlaneId first, const Source* source, std::uint32_t facet);
    void put_corner(PointId id, const Source* source, std::uint32_t vertex);
    void put_point(PointId id, PlaneId p, PlaneId q, PlaneId r, const Approximation& known);
    /// The common point of three planes. Found by name when it was made before: from the same three
    /// planes, or as the point where the same edge of a source meets the same plane, an edge being
    /// named by its own plane or by both of its facets. Equal points
    /// may still have several names (see same_point). \pre the planes meet in one point.
    PointId meet(PlaneId p, PlaneId q, PlaneId r);
    [[nodiscard]] std::size_t point_count() const { return points_.size(); }
    [[nodiscard]] std::size_t plane_count() const { return planes_.size(); }
    [[nodiscard]] bool is_corner(PointId id) const { return points_[as_index(id)].planes[0] < 0; }
    /// \pre is_corner(id)
    [[nodiscard]] std::pair<const Source*, std::uint32_t> corner_name(PointId id) const {
        return {points_[as_index(id)].source, points_[as_index(id)].vertex};
    }
    /// \pre is_lattice(id)
    [[nodiscard]] LatticePoint lattice(PointId id) const { return points_[as_index(id)].lattice(); }
    /// Whether its coordinates are known to be integers: of corners, and of points that planes name
    /// but whose doubles came without an error.
    [[nodiscard]] bool is_lattice(PointId id) const { return points_[as_index(id)].is_lattice; }
    [[nodiscard]] const std::array<PlaneId, 3>& planes_of(PointId id) const {
        return points_[as_index(id)].planes;
    }
    [[nodiscard]] const Approximation& approximation(PointId id) const {
        return points_[as_index(id)].approximation;
    }
    /// Those of the last points are kept until the bench is shared.
    [[nodiscard]] HomogeneousPoint homogeneous(PointId id) const;
    [[nodiscard]] Point point(PointId id) const;
    /// Correctly rounded coordinates in lattice units.
    [[nodiscard]] std::array<double, 3> nearest(PointId id) const;
    /// To some hundred bits, where doubles suffice for that.
    [[nodiscard]] std::optional<RefinedPoint> refined(PointId id) const;
    /// Exact equality.
    [[nodiscard]] bool same_point(PointId a, PointId b) const;
    /// Whether doubles leave it open that two points are the same.
    [[nodiscard]] bool may_be_same(PointId a, PointId b) const;

    /// -1 below, 0 on, 1 above: symbolic, filtered, exact.
    [[nodiscard]] int side(PointId point, PlaneId plane) const {
        // The filter first: it never says On, and far most points are off.
        if (const auto s = filtered_side(approximation(point), plane_at(plane))) {
            ++detail::counters_of_thread<PredicateCounters>.filtered;
            return sign_of(*s);
        }
        return unfiltered_side(point, plane);
    }

    /// The polygon that a reference names, unclipped. Edges of whole facets carry their planes only
    /// after with_edges().
    [[nodiscard]] WorkPolygon polygon(const PolygonRef& ref);
    void with_edges(WorkPolygon& polygon, const PolygonRef& ref);
    /// Of a fragment: where the lines of two of its edges meet, `at` being the doubles of that
    /// vertex. Edges on planes of the fragment's own facet are found by their names.
    PointId vertex(const PolygonRef& ref, PlaneId support, PlaneId p, PlaneId q,
                   const Approximation& at);
    /// Room for so many planes and points without growing on the way, with their names or without.
    void reserve(std::size_t planes, std::size_t points);
    void reserve_unnamed(std::size_t planes, std::size_t points);
    /// The same, but for so many more points that are named by an edge and a plane.
    void reserve_points_on_edges(std::size_t planes, std::size_t points, std::size_t on_edges);
    /// No point will be named by planes any more: gives back what is only needed for that.
    void end_points();
    /// Several threads may call what is const, until one thread alone calls something else.
    void share();
    /// One thread alone has it again.
    void end_sharing() { adding_ = nullptr; }
    /// Gives back the planes that were made so far; they are made again on demand. Ends references
    /// to them.
    void forget_made_planes();
    [[nodiscard]] std::size_t made_plane_count() const { return made_.count(); }

    /// The part of a strictly convex polygon on one side of a plane (`keep` -1 below, 1 above);
    /// empty when that part has no area; moved from where nothing is cut. \pre the plane is not the
    /// support's.
    [[nodiscard]] WorkPolygon clipped(WorkPolygon polygon, PlaneId plane, int keep);
    /// Sides of the polygon's points, in their order; scratch that the next call overwrites.
    using Sides = std::vector<std::int8_t>;
    const Sides& sides_of(const WorkPolygon& polygon, PlaneId plane);
    /// Both parts. \pre `sides` are of the polygon and the plane, and there are points on both.
    void split(const WorkPolygon& polygon, PlaneId plane, const Sides& sides, WorkPolygon& below,
               WorkPolygon& above);
    /// The part of the polygon in the closed cell; empty when it has no area. The polygon needs its
    /// edges; one without points stands for the whole plane of its support.
    [[nodiscard]] WorkPolygon clipped(WorkPolygon polygon, const Box& box, const Cell& cell);

private:
    struct PointRecord {
        std::array<PlaneId, 3> planes{-1, -1, -1};
        std::uint32_t vertex = 0;        // of a corner
        const Source* source = nullptr;  // of a corner
        Approximation approximation;
        bool is_lattice = false;
        // Lattice positions are doubles.
        [[nodiscard]] LatticePoint lattice() const {
            return {Coordinate(approximation.c[0]), Coordinate(approximation.c[1]),
                    Coordinate(approximation.c[2])};
        }
    };
    [[nodiscard]] int unfiltered_side(PointId point, PlaneId plane) const;
    [[nodiscard]] static bool has_vertex(const PlaneName& plane, const Source* source,
                                         std::uint32_t vertex);
    [[nodiscard]] static bool contains_edge(const PlaneName& plane, const PlaneName& edge);
    [[nodiscard]] static bool contains_common_edge(const PlaneName& plane, const PlaneName& a,
                                                   const PlaneName& b);
    [[nodiscard]] static std::optional<std::array<std::uint32_t, 2>> common_edge(
        const PlaneName& a, const PlaneName& b);
    struct PlaneRecord {
        PlaneName name;
        PlaneId same = -1;     // on the way to the first of its class
        PlaneId support = -1;  // of an edge plane: that of its facet
        // Of an edge plane: the source's edge, -1 not looked up.
        std::int32_t line = -1;
        mutable std::int32_t place = -1;  // among the planes that were made
    };
    // What one thread writes and what others read at the same time are in different lines of the
    // cache: these go to and fro between processors, and take longer than what is done with them.
    static constexpr std::size_t line_bytes = 64;
    /// Planes that stay where they are while others are made. Most benches make few: the first
    /// block is small.
    class MadePlanes {
    public:
        [[nodiscard]] const Plane& at(std::int32_t i) const {
            const std::size_t n = as_index(i);
            return n < few ? few_.data()[n] : blocks_[block_of(n)].data()[place_of(n)];
        }
        std::int32_t add(const Plane& plane) {
            const std::size_t n = as_index(count_);
            if (n < few) {
                put(few_, n, few, plane);
            } else {
                if (block_of(n) == blocks_.size()) blocks_.emplace_back();
                put(blocks_[block_of(n)], place_of(n), many, plane);
            }
            return count_++;
        }
        [[nodiscard]] std::size_t count() const { return as_index(count_); }
        /// For so many in all the table of blocks stays where it is.
        void reserve(std::size_t count) { blocks_.reserve(count / many + 1); }
        void clear() { count_ = 0; }
        void free() {
            clear();
            few_ = {};
            blocks_.clear();
        }

    private:
        static constexpr std::size_t few = 32;
        static constexpr std::size_t many = 512;
        static std::size_t block_of(std::size_t n) { return (n - few) / many; }
        static std::size_t place_of(std::size_t n) { return (n - few) % many; }
        // Others may be read at the same time: a block never grows.
        static void put(PoolVector<Plane>& block, std::size_t place, std::size_t size,
                        const Plane& plane) {
            if (place < block.size()) {
                block[place] = plane;
                return;
            }
            block.reserve(size);
            block.push_back(plane);
        }
        alignas(line_bytes) PoolVector<Plane> few_;
        std::vector<PoolVector<Plane>> blocks_;
        alignas(line_bytes) std::int32_t count_ = 0;
    };

    // Exact coordinates of a point that planes name.
    struct ExactPoint {
        PointId point = -1;
        HomogeneousPoint at;
    };

    PlaneId add_plane(const PlaneName& name, PlaneId support = -1);
    [[nodiscard]] PointRecord corner_record(const Source* source, std::uint32_t vertex) const;
    [[nodiscard]] PointRecord point_record(PlaneId p, PlaneId q, PlaneId r,
                                           const Approximation& known) const;
    const Plane& make_plane(PlaneId id) const;
    [[nodiscard]] bool is_made(PlaneId id) const {
        return std::atomic_ref(planes_[as_index(id)].place).load(std::memory_order_acquire) >= 0;
    }
    [[nodiscard]] std::optional<CornerPlane> by_corners(PlaneId id) const;
    [[nodiscard]] std::optional<std::array<CornerPlane, 3>> unmade_planes_of(
        const PointRecord& point) const;
    [[nodiscard]] std::uint64_t line_of_edge(std::uint64_t owner, std::uint32_t v, std::uint32_t w);
    [[nodiscard]] std::uint64_t line_item(PlaneId p);
    [[nodiscard]] Key128 point_key(PlaneId p, PlaneId q, PlaneId r);
    // `known`: its doubles, if the caller has them; better ones are made where they are blunt.
    PointId point_named(const Key128& key, PlaneId p, PlaneId q, PlaneId r,
                        const Approximation* known);
    PointId meet_on_edge(PlaneId support, PlaneId edge, PlaneId other, const Approximation* known);
    void add_fragment(const PolygonRef& ref, WorkPolygon& out);
    [[nodiscard]] bool is_bounded_by(const WorkPolygon& polygon, int axis, std::int64_t splitter,
                                     bool above) const;
    [[nodiscard]] WorkPolygon unbounded_in(PlaneId support, const Cell& cell);

    alignas(line_bytes) std::vector<PlaneRecord, UnwrittenPoolAllocator<PlaneRecord>> planes_;
    std::unique_ptr<SpinLock> adding_;  // to made_, where the bench is shared
    FlatMap plane_ids_;
    mutable MadePlanes made_;
    alignas(line_bytes) std::vector<PointRecord, UnwrittenPoolAllocator<PointRecord>> points_;
    FlatMap corner_ids_;
    FlatMap line_ids_;
    FlatMap point_ids_;
    mutable std::vector<ExactPoint> recent_;  // by the last bits of the point
    bool names_points_ = true;
    Sides sides_;
};

}  // namespace trisect::detail
