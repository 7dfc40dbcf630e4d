// SPDX-License-Identifier: Apache-2.0
//
// AxisFaceOutlines: AxisFaces in numbers of one type.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/axis/axis_faces.h>
#include <trisect/bsp/assembly/axis/axis_outline.h>
#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/occupancy_grid.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// See axis_numbers.h.
template <class Number>
class AxisFaceOutlines final : public AxisFaces {
public:
    AxisFaceOutlines(BoundaryParts& parts, std::uint32_t threads)
        : parts_(parts), threads_(threads) {}

    void choose(std::span<const Leaf> leaves) override;
    void note_vertices(std::span<const BoundaryEdge> edges) override;
    void make_edges(BoundaryEdges& edges) override;
    void add_vertices_in(const BoundaryEdge& edge, PoolVector<PointId>& out) override;

private:
    using Numbers = AxisNumbers<Number>;
    using Plane = AxisPlane<Number>;
    using Outline = AxisOutline<Number>;
    using Interval = AxisInterval<Number>;
    using Side = AxisSide<Number>;
    // Fewer are not worth a part.
    static constexpr std::size_t least_planes = 8;
    static constexpr std::size_t least_lines = 256;
    static constexpr std::size_t least_stops = 8192;
    // Places by their ranks among the coordinates of each axis.
    using Ranks = std::array<std::uint32_t, 3>;
    // A vertex on a line.
    struct Stop {
        static constexpr PointId none = -1;
        static constexpr PointId wanted = -2;
        std::uint32_t place = 0;  // its rank along the line
        std::uint32_t same = 0;   // the stop that stands for all of this vertex
        PointId point = none;     // of that one, once it was requested
    };
    // The stops of one line, or of an interval with its ends.
    struct Stops {
        std::uint32_t first = 0;
        std::uint32_t end = 0;
    };
    // All stops of a line along an axis.
    struct StopLine {
        Stops stops;
        std::size_t along = 0;
        Ranks at{};  // 0 along the axis
    };
    /// A plane. By facing of its faces, down and up: the first facet.
    struct FacePlane {
        Plane plane;
        PlaneName name;
        std::array<std::int32_t, 2> first{-1, -1};
        bool is_general = false;   // not taken
        bool has_passing = false;  // a facet passes through
        std::size_t parts = 0;
        PlaneId id = -1;  // once it was requested
        std::uint32_t rank = 0;
        Outline outline;
        std::vector<Stops> stops;  // of each interval
    };
    // Stretches on a line, of one plane and facing.
    struct LineRun {
        FacePlane* face_plane = nullptr;
        typename Outline::Run run;
        [[nodiscard]] std::span<const Interval> intervals() const {
            return face_plane->outline.intervals().subspan(run.first, run.end - run.first);
        }
    };
    struct Facet {
        std::int32_t face_plane = -1;
        bool normal_is_up = false;
        bool is_blocked = false;   // reaches into a cell with polygons of other kinds
        bool is_cut = false;       // surely: not all of it bounds the result with one facing
        std::uint8_t corners = 0;  // that its parts have, a bit each
        double area = 0;           // of its parts, twice; off by `slack` at most
        double slack = 0;
    };
    struct PolygonName {
        const Source* source = nullptr;
        std::uint32_t facet = 0;
    };
    struct CornerName {
        const Source* source = nullptr;
        std::uint32_t facet = 0;
        int corner = 0;
    };
    // A line by the ranks along the two axes after its own.
    using LineKey = std::uint64_t;
    static LineKey line_at(std::size_t along, const Ranks& r) {
        return (LineKey{r[(along + 1) % 3]} << 32) | r[(along + 2) % 3];
    }
    // A vertex at which no outline need turn.
    struct Other {
        LineKey line = 0;
        std::uint32_t place = 0;
        friend auto operator<=>(const Other&, const Other&) = default;
    };

    static Key128 key_of(const Plane& plane) { return key_of(plane.axis, plane.position); }
    static Key128 key_of(std::size_t axis, std::int64_t position) {
        return {axis, static_cast<std::uint64_t>(position)};
    }
    // Positions have 126 bits with their signs.
    static Key128 key_of(std::size_t axis, Int128 position) {
        return {static_cast<std::uint64_t>(position >> 64) << 2 | axis,
                static_cast<std::uint64_t>(position)};
    }
    [[nodiscard]] const FacetMarks& marks_of(const Source* source);
    [[nodiscard]] FacePlane& face_plane_at(const Plane& plane, const PlaneName& name);
    void list_open_planes();
    void read_leaf(const Leaf& leaf);
    void list_leaf(const Leaf& leaf);
    void read_listed(std::span<const Leaf> leaves);
    void read_planes(std::span<const Leaf> leaves, std::size_t rest, std::size_t divisor,
                     const StopScope* scope);
    void read_in_leaf(const PolygonRef& polygon, std::int32_t number, const Leaf& leaf,
                      std::size_t place, std::vector<Side>& sides);
    void block_leaf(const Leaf& leaf);
    void read_facet(const PolygonRef& facet, std::int32_t number, const OccupancyGrid::Part& part,
                    const Cell& cell);
    void read_all_units();
    // Those between layers across an axis, of planes whose number leaves that rest.
    struct UnitsOf {
        std::size_t axis = 0;
        std::uint32_t divisor = 1;
        std::uint32_t rest = 0;
    };
    void read_units(const Leaf& leaf, const UnitsOf& some);
    void pass(const PolygonRef& facet);
    [[nodiscard]] FacePlane& face_plane_of(const PolygonRef& polygon, std::int32_t number);
    [[nodiscard]] bool count_part(FacePlane& face_plane, std::int32_t number);
    void read_polygon(const PolygonRef& polygon, std::int32_t number, const Cell& cell,
                      std::vector<Side>& sides);
    void add_area(const PolygonRef& part, Facet& facet, const Plane& plane) const;
    void note_corners(const PolygonRef& part, Facet& facet, std::size_t axis,
                      std::span<const Side> sides) const;
    void judge();
    [[nodiscard]] bool has_changed(std::int32_t number) const;

    using PlaneCoordinates = std::array<std::vector<double>, 3>;
    [[nodiscard]] PlaneCoordinates plane_coordinates() const;
    [[nodiscard]] static std::span<const double> coordinates_near(const PlaneCoordinates& planes,
                                                                  std::size_t axis,
                                                                  const Approximation& a,
                                                                  double& whole);
    [[nodiscard]] std::optional<LatticePoint> place_of(PointId p,
                                                       const PlaneCoordinates& planes) const;
    void place_others();
    void list_corners();
    void rank_coordinates();
    void rank_places(FacePlane& face_plane);
    void name_corners();
    void add_other(const Ranks& at);
    void make_stops();
    void add_line(FacePlane& face_plane, const Interval& interval);
    // A face: all of a plane with one facing.
    struct Face {
        std::int32_t first = -1;  // of its facets
        std::size_t face_plane = 0;
        bool faces_up = false;
        PoolVector<std::uint32_t> intervals;  // loop after loop
    };
    [[nodiscard]] std::vector<Face> faces_in_order() const;
    [[nodiscard]] std::size_t count_edges(const Face& face) const;
    void unite_stops();
    [[nodiscard]] std::uint32_t first_stop_at(const Ranks& at, std::size_t axes,
                                              std::uint32_t own) const;
    void name_points(const Face& face);
    void name_planes(const Face& face);
    void make_points(std::span<const Face> faces);
    [[nodiscard]] PointId put_points(const StopLine& line, PointId next);
    void put_point(PointId id, const Ranks& ranks);
    template <class Visit>
    void for_each_vertex(const Face& face, const Visit& visit) const;
    void make_edges_of(const Face& face, BoundaryEdge* out) const;
    template <class Visit>
    void for_each_stop(const Interval& interval, const Stops& stops, const Visit& visit) const;
    [[nodiscard]] Ranks ranks_of(const LatticePoint& p) const;
    [[nodiscard]] std::uint32_t rank(std::size_t axis, Number at) const;
    [[nodiscard]] PlaneId plane_of(std::size_t axis, std::uint32_t rank);
    [[nodiscard]] PointId point_at(const Ranks& ranks);
    [[nodiscard]] PointId make_point(const Ranks& ranks);
    [[nodiscard]] Approximation place_at(const Ranks& ranks) const;
    [[nodiscard]] static std::size_t along_of(const FacePlane& face_plane,
                                              const Interval& interval) {
        return (face_plane.plane.axis + 2 - interval.axis) % 3;
    }
    [[nodiscard]] static std::size_t across_of(const FacePlane& face_plane,
                                               const Interval& interval) {
        return (face_plane.plane.axis + 1 + interval.axis) % 3;
    }
    [[nodiscard]] static Ranks line_of(const FacePlane& face_plane, const Interval& interval);
    [[nodiscard]] std::span<const Other> others_on(std::size_t along, const Ranks& line) const;
    [[nodiscard]] FacePlane& face_plane_at_rank(std::size_t axis, std::uint32_t rank);
    [[nodiscard]] const FacePlane& face_plane_at_rank(std::size_t axis, std::uint32_t rank) const;
    static Key128 key_of(const Ranks& r) { return {(std::uint64_t{r[0]} << 32) | r[1], r[2]}; }

    BoundaryParts& parts_;
    std::uint32_t threads_;
    bool is_alone_ = true;  // one thread reads all polygons
    std::vector<const Leaf*> with_units_;
    const Source* last_source_ = nullptr;
    std::size_t last_table_ = 0;
    std::optional<Plane> last_passed_;
    FlatMap open_planes_;
    std::size_t open_count_ = 0;
    std::vector<Facet> facets_;
    std::vector<FacePlane> face_planes_;
    FlatMap face_plane_ids_;
    bool names_points_ = false;  // others have points as well
    // Corners that are vertices of parts of facets taken, then those of facets that pass through,
    // in axis-perpendicular leaves.
    std::vector<CornerName> corners_;
    std::vector<PolygonName> passing_;  // until their corners are listed
    std::size_t first_passing_ = 0;     // of corners_, once they are there too
    // Vertices of facets that are not taken, where they are on the lattice, and their places.
    PoolVector<PointId> others_;
    std::vector<LatticePoint> places_;
    std::vector<Side> sides_;

    std::array<std::vector<Number>, 3> coordinates_;         // sorted
    std::array<PoolVector<std::int32_t>, 3> face_plane_of_;  // by rank
    std::array<std::vector<Other>, 3> other_stops_;          // sorted
    PoolVector<Stop> stops_;                                 // line by line
    std::vector<StopLine> all_lines_;
    std::array<FlatMap, 3> lines_;    // by axis
    PoolVector<std::uint32_t> line_;  // the places on the line in the making
    FlatMap corner_ids_;
    FlatMap point_ids_;
};

}  // namespace trisect::detail
