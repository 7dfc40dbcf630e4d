// SPDX-License-Identifier: Apache-2.0
//
// Edges of outlines, and vertices. An interval of an outline is an edge of the solid, where faces
// of two planes end. If a vertex lies inside it, then the faces around change there, and so does
// one of those two outlines: of the four quadrants around the line the two outlines determine those
// that are inside, and if they are the same before and behind, no third plane has a boundary in
// between. So the ends of all intervals on one line are all vertices on it, but for those of facets
// that are not taken (axis_face_outlines.cpp).

#include <trisect/bsp/assembly/axis/axis_face_outlines.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

template <class Number>
void AxisFaceOutlines<Number>::note_vertices(std::span<const BoundaryEdge> edges) {
    if (taken_count_ == 0) return;
    for (const BoundaryEdge& e : edges) others_.push_back(e.from);
}

// Doubles of face planes by axis, sorted.
template <class Number>
auto AxisFaceOutlines<Number>::plane_coordinates() const -> PlaneCoordinates {
    PlaneCoordinates out;
    for (const FacePlane& f : face_planes_)
        out[f.plane.axis].push_back(rounded_axis_position(f.plane.position));
    for (auto& all : out) std::ranges::sort(all);
    return out;
}

// Coordinates that an approximate one may be: a whole one, or those of planes.
template <class Number>
std::span<const double> AxisFaceOutlines<Number>::coordinates_near(const PlaneCoordinates& planes,
                                                                   std::size_t axis,
                                                                   const Approximation& a,
                                                                   double& whole) {
    const double margin = error_slack * a.error;
    if constexpr (Numbers::whole) {
        whole = std::nearbyint(a.c[axis]);
        if (std::fabs(whole - a.c[axis]) > margin || std::fabs(whole) > 0x1p53) return {};
        return {&whole, 1};
    } else {
        const auto& all = planes[axis];
        // Sums round: a little beyond.
        const double reach = margin + last_place * std::fabs(a.c[axis]);
        return {std::to_address(std::ranges::lower_bound(all, a.c[axis] - reach)),
                std::to_address(std::ranges::upper_bound(all, a.c[axis] + reach))};
    }
}

// Where a point is, if it is on planes across all axes. What names it need not say so.
template <class Number>
std::optional<LatticePoint> AxisFaceOutlines<Number>::place_of(
    PointId p, const PlaneCoordinates& planes) const {
    const Workbench& bench = parts_.bench;
    if (bench.is_lattice(p)) {
        const LatticePoint at = bench.lattice(p);
        return Numbers::takes(at) ? std::optional(at) : std::nullopt;
    }
    const Approximation& a = bench.approximation(p);
    const auto is_there = [&](const LatticePoint& place) {
        return std::ranges::all_of(bench.planes_of(p), [&](PlaneId plane) {
            return side_of(place, bench.plane_at(plane)) == trisect::Side::On;
        });
    };
    std::array<double, 3> whole{};
    const auto near = [&](std::size_t k) { return coordinates_near(planes, k, a, whole[k]); };
    for (const double x : near(0))
        for (const double y : near(1))
            for (const double z : near(2))
                if (const LatticePoint at{Coordinate(x), Coordinate(y), Coordinate(z)};
                    is_there(at))
                    return at;
    return std::nullopt;
}

template <class Number>
void AxisFaceOutlines<Number>::place_others() {
    std::ranges::sort(others_);
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    const PlaneCoordinates planes = Numbers::whole ? PlaneCoordinates{} : plane_coordinates();
    std::size_t kept = 0;
    for (const PointId p : others_) {
        const auto place = place_of(p, planes);
        if (!place) continue;
        others_[kept++] = p;
        places_.push_back(*place);
    }
    others_.resize(kept);
}

template <class Number>
std::uint32_t AxisFaceOutlines<Number>::rank(std::size_t axis, Number at) const {
    const auto& all = coordinates_[axis];
    return static_cast<std::uint32_t>(std::ranges::lower_bound(all, at) - all.begin());
}

template <class Number>
auto AxisFaceOutlines<Number>::ranks_of(const LatticePoint& p) const -> Ranks {
    const auto at = [&](std::size_t k) { return rank(k, Numbers::place(coordinate(p, k))); };
    return {at(0), at(1), at(2)};
}

// Corners of parts count as vertices even where all faces run straight on: a facet with one inside
// an edge has changed, and whether facets are put together one by one must not show. Where none are
// only those of facets that pass through count, and the others have a name to give.
template <class Number>
void AxisFaceOutlines<Number>::list_corners() {
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        if (!taken_[i]) continue;
        const BoundaryFacet& f = parts_.facets[i];
        for (int c = 0; c < 3; ++c)
            if ((facets_[i].corners >> c & 1) != 0) corners_.push_back({f.source, f.facet, c});
    }
    first_passing_ = corners_.size();
    for (const PolygonName& p : passing_)
        for (int c = 0; c < 3; ++c) corners_.push_back({p.source, p.facet, c});
    passing_ = {};
}

// Outlines turn where planes of other axes are, so their places need not be listed.
template <class Number>
void AxisFaceOutlines<Number>::rank_coordinates() {
    const auto add = [&](const LatticePoint& p) {
        for (std::size_t k = 0; k < 3; ++k)
            coordinates_[k].push_back(Numbers::place(coordinate(p, k)));
    };
    for (auto& all : coordinates_)
        all.reserve(places_.size() + corners_.size() + face_planes_.size());
    for (const LatticePoint& p : places_) add(p);
    for (const CornerName& c : corners_) add(c.source->corner(c.facet, c.corner));
    for (const FacePlane& s : face_planes_)
        coordinates_[s.plane.axis].push_back(Numbers::place_of(s.plane.position));
    for (std::size_t k = 0; k < 3; ++k) {
        auto& all = coordinates_[k];
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
        face_plane_of_[k].assign(all.size(), -1);
    }
    for (std::size_t i = 0; i < face_planes_.size(); ++i) {
        const Plane& p = face_planes_[i].plane;
        face_planes_[i].rank = rank(p.axis, Numbers::place_of(p.position));
        face_plane_of_[p.axis][face_planes_[i].rank] = static_cast<std::int32_t>(i);
    }
    ParallelParts(face_planes_.size(), threads_, least_planes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (FacePlane& s : std::span(face_planes_).subspan(begin, end - begin))
                if (!s.is_general) rank_places(s);
        });
}

// Neighbours in an outline mostly have neighbouring ranks.
template <class Number>
void AxisFaceOutlines<Number>::rank_places(FacePlane& face_plane) {
    std::array<std::uint32_t, 2> last{};
    face_plane.outline.rank_places([&](std::size_t i, Number place) {
        const std::size_t axis = (face_plane.plane.axis + 1 + i) % 3;
        const auto& all = coordinates_[axis];
        std::uint32_t& r = last[i];
        if (all[r] != place && (++r >= all.size() || all[r] != place)) r = rank(axis, place);
        TRISECT_EXPECTS(r < all.size() && all[r] == place, "an outline turns where no plane is");
        return Number{r};
    });
}

// A vertex is named by the corner of a source if there is one there: by the first.
template <class Number>
void AxisFaceOutlines<Number>::name_corners() {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Ranks at =
            ranks_of(corners_[i].source->corner(corners_[i].facet, corners_[i].corner));
        const bool is_new = corner_ids_.insert(key_of(at), static_cast<std::int32_t>(i)).second;
        if (takes_all_ ? i >= first_passing_ : is_new) add_other(at);
    }
    for (const LatticePoint& p : places_) add_other(ranks_of(p));
    for (auto& others : other_stops_) {
        std::ranges::sort(others);
        others.erase(std::unique(others.begin(), others.end()), others.end());
    }
}

template <class Number>
void AxisFaceOutlines<Number>::add_other(const Ranks& at) {
    for (std::size_t k = 0; k < 3; ++k) other_stops_[k].push_back({line_at(k, at), at[k]});
}

template <class Number>
auto AxisFaceOutlines<Number>::line_of(const FacePlane& face_plane, const Interval& interval)
    -> Ranks {
    Ranks at{};
    at[face_plane.plane.axis] = face_plane.rank;
    at[across_of(face_plane, interval)] = static_cast<std::uint32_t>(interval.at);
    return at;
}

template <class Number>
void AxisFaceOutlines<Number>::make_stops() {
    std::size_t intervals = 0;
    std::size_t runs = 0;
    for (FacePlane& s : face_planes_) {
        if (s.is_general) continue;
        s.stops.resize(s.outline.intervals().size());
        intervals += s.outline.intervals().size();
        runs += s.outline.runs().size();
    }
    // Mostly each is in two planes, and so are its ends.
    stops_.reserve(intervals);
    all_lines_.reserve(runs / 2);
    for (FacePlane& s : face_planes_) {
        if (s.is_general) continue;
        for (const typename Outline::Run& run : s.outline.runs())
            if (s.stops[run.first].end == 0) add_line(s, s.outline.intervals()[run.first]);
    }
}

// All vertices on the line of an interval, for all intervals there.
template <class Number>
void AxisFaceOutlines<Number>::add_line(FacePlane& face_plane, const Interval& interval) {
    const std::size_t across = across_of(face_plane, interval);
    const std::size_t along = along_of(face_plane, interval);
    const Ranks at = line_of(face_plane, interval);
    FacePlane& beside = face_plane_at_rank(across, at[across]);
    std::array<FacePlane*, 2> face_planes{&face_plane, beside.is_general ? nullptr : &beside};
    std::array<LineRun, 4> runs;
    std::size_t count = 0;
    line_.clear();
    for (FacePlane* const s : face_planes) {
        if (s == nullptr) continue;
        const std::size_t other = s == &face_plane ? across : face_plane.plane.axis;
        const auto axis = static_cast<std::uint8_t>((other + 2 - s->plane.axis) % 3);
        for (const bool faces_up : {false, true}) {
            const std::size_t run = s->outline.run_at(faces_up, axis, at[other]);
            if (run == s->outline.runs().size()) continue;
            runs[count++] = {s, s->outline.runs()[run]};
            for (const Interval& t : runs[count - 1].intervals()) {
                line_.push_back(static_cast<std::uint32_t>(t.low));
                line_.push_back(static_cast<std::uint32_t>(t.high));
            }
        }
    }
    for (const Other& o : others_on(along, at)) line_.push_back(o.place);
    std::ranges::sort(line_);
    line_.erase(std::unique(line_.begin(), line_.end()), line_.end());
    const auto first = static_cast<std::uint32_t>(stops_.size());
    for (const std::uint32_t place : line_) stops_.push_back({place});
    lines_[along].insert({line_at(along, at), 0}, static_cast<std::int32_t>(all_lines_.size()));
    all_lines_.push_back({{first, static_cast<std::uint32_t>(stops_.size())}, along, at});
    for (const LineRun& r : std::span(runs).first(count)) {
        std::uint32_t i = 0;
        for (std::uint32_t n = r.run.first; n < r.run.end; ++n) {
            const Interval& t = r.face_plane->outline.intervals()[n];
            while (line_[i] != t.low) ++i;
            r.face_plane->stops[n].first = first + i;
            while (line_[i] != t.high) ++i;
            r.face_plane->stops[n].end = first + i + 1;
        }
    }
}

template <class Number>
auto AxisFaceOutlines<Number>::others_on(std::size_t along, const Ranks& line) const
    -> std::span<const Other> {
    const std::vector<Other>& all = other_stops_[along];
    const LineKey key = line_at(along, line);
    const auto first = std::ranges::lower_bound(all, key, {}, &Other::line);
    const auto end = std::ranges::upper_bound(first, all.end(), key, {}, &Other::line);
    return {std::to_address(first), std::to_address(end)};
}

template <class Number>
auto AxisFaceOutlines<Number>::face_plane_at_rank(std::size_t axis, std::uint32_t rank)
    -> FacePlane& {
    const std::int32_t face_plane = face_plane_of_[axis][rank];
    TRISECT_EXPECTS(face_plane >= 0, "an outline turns where no plane is");
    return face_planes_[as_index(face_plane)];
}

template <class Number>
auto AxisFaceOutlines<Number>::face_plane_at_rank(std::size_t axis, std::uint32_t rank) const
    -> const FacePlane& {
    return face_planes_[as_index(face_plane_of_[axis][rank])];
}

template <class Number>
PlaneId AxisFaceOutlines<Number>::plane_of(std::size_t axis, std::uint32_t rank) {
    FacePlane& s = face_plane_at_rank(axis, rank);
    if (s.id < 0) s.id = parts_.bench.plane(s.name);
    return s.id;
}

template <class Number>
PointId AxisFaceOutlines<Number>::point_at(const Ranks& ranks) {
    const Key128 key = key_of(ranks);
    if (const PointId known = point_ids_.find(key); known >= 0) return known;
    return point_ids_.insert(key, make_point(ranks)).first;
}

template <class Number>
PointId AxisFaceOutlines<Number>::make_point(const Ranks& ranks) {
    if (const std::int32_t c = corner_ids_.find(key_of(ranks)); c >= 0) {
        const CornerName& name = corners_[as_index(c)];
        return parts_.bench.corner(name.source, name.facet, name.corner);
    }
    return parts_.bench.vertex({}, plane_of(0, ranks[0]), plane_of(1, ranks[1]),
                               plane_of(2, ranks[2]), place_at(ranks));
}

template <class Number>
Approximation AxisFaceOutlines<Number>::place_at(const Ranks& ranks) const {
    Approximation at;
    for (std::size_t k = 0; k < 3; ++k) at.c[k] = Numbers::to_double(coordinates_[k][ranks[k]]);
    return at;
}

// Planes are named by one thread, and so are points where others have some already. Several threads
// write the edges.
template <class Number>
void AxisFaceOutlines<Number>::make_edges(BoundaryEdges& edges) {
    if (taken_count_ == 0) return;
    names_points_ = parts_.bench.point_count() != 0;
    place_others();
    list_corners();
    rank_coordinates();
    name_corners();
    make_stops();
    unite_stops();
    for (std::size_t i = 0; i < others_.size(); ++i)
        (void)point_ids_.insert(key_of(ranks_of(places_[i])), others_[i]);
    const std::vector<Face> faces = faces_in_order();
    PoolVector<std::size_t> first;  // edge of each face
    std::size_t count = edges.size();
    for (const Face& face : faces) {
        check_stop(face.intervals.size());
        name_planes(face);
        if (names_points_) name_points(face);
        first.push_back(count);
        count += count_edges(face);
    }
    if (!names_points_) make_points(faces);
    edges.resize(count);
    ParallelParts(faces.size(), threads_, least_planes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                make_edges_of(faces[i], edges.data() + first[i]);
        });
}

// A vertex is a stop on up to three lines; the one along the first axis stands for it.
template <class Number>
void AxisFaceOutlines<Number>::unite_stops() {
    ParallelParts(all_lines_.size(), threads_, least_lines)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (const StopLine& line : std::span(all_lines_).subspan(begin, end - begin)) {
                Ranks at = line.at;
                for (std::uint32_t i = line.stops.first; i < line.stops.end; ++i) {
                    at[line.along] = stops_[i].place;
                    stops_[i].same = first_stop_at(at, line.along, i);
                }
            }
        });
}

// On a line along one of so many axes; else its own.
template <class Number>
std::uint32_t AxisFaceOutlines<Number>::first_stop_at(const Ranks& at, std::size_t axes,
                                                      std::uint32_t own) const {
    for (std::size_t k = 0; k < axes; ++k) {
        const std::int32_t line = lines_[k].find({line_at(k, at), 0});
        if (line < 0) continue;
        const Stops& on_line = all_lines_[as_index(line)].stops;
        const auto end = stops_.begin() + on_line.end;
        const auto stop =
            std::ranges::lower_bound(stops_.begin() + on_line.first, end, at[k], {}, &Stop::place);
        if (stop != end && stop->place == at[k])
            return static_cast<std::uint32_t>(stop - stops_.begin());
    }
    return own;
}

// In the order of their facets.
template <class Number>
auto AxisFaceOutlines<Number>::faces_in_order() const -> std::vector<Face> {
    std::vector<Face> faces;
    for (std::size_t i = 0; i < face_planes_.size(); ++i)
        for (const bool faces_up : {false, true})
            if (const std::int32_t first = face_planes_[i].first[faces_up ? 1 : 0];
                first >= 0 && !face_planes_[i].is_general)
                faces.push_back({first, i, faces_up, {}});
    std::ranges::sort(faces, {}, &Face::first);
    ParallelParts(faces.size(), threads_, least_planes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (Face& f : std::span(faces).subspan(begin, end - begin))
                f.intervals = face_planes_[f.face_plane].outline.loops(f.faces_up);
        });
    return faces;
}

template <class Number>
std::size_t AxisFaceOutlines<Number>::count_edges(const Face& face) const {
    const auto& stops = face_planes_[face.face_plane].stops;
    std::size_t out = 0;
    for (const std::uint32_t n : face.intervals) out += stops[n].end - stops[n].first - 1;
    return out;
}

// In the direction of the interval.
template <class Number>
template <class Visit>
void AxisFaceOutlines<Number>::for_each_stop(const Interval& interval, const Stops& stops,
                                             const Visit& visit) const {
    const std::uint32_t count = stops.end - stops.first;
    for (std::uint32_t i = 0; i < count; ++i)
        visit(interval.runs_up() ? stops.first + i : stops.end - 1 - i);
}

template <class Number>
void AxisFaceOutlines<Number>::name_planes(const Face& face) {
    const FacePlane& face_plane = face_planes_[face.face_plane];
    BoundaryFacet& f = parts_.facets[as_index(face.first)];
    f.support = parts_.bench.plane(PlaneName::support(f.source, f.facet));
    f.parts = 1;
    for (const std::uint32_t n : face.intervals) {
        const Interval& s = face_plane.outline.intervals()[n];
        const std::size_t across = across_of(face_plane, s);
        (void)plane_of(across, line_of(face_plane, s)[across]);
    }
}

// Calls visit(stop, ranks) for all vertices of all edges.
template <class Number>
template <class Visit>
void AxisFaceOutlines<Number>::for_each_vertex(const Face& face, const Visit& visit) const {
    const FacePlane& face_plane = face_planes_[face.face_plane];
    for (const std::uint32_t n : face.intervals) {
        const Interval& s = face_plane.outline.intervals()[n];
        const std::size_t along = along_of(face_plane, s);
        Ranks at = line_of(face_plane, s);
        for_each_stop(s, face_plane.stops[n], [&](std::uint32_t i) {
            at[along] = stops_[i].place;
            visit(stops_[i], at);
        });
    }
}

template <class Number>
void AxisFaceOutlines<Number>::name_points(const Face& face) {
    for_each_vertex(face, [&](const Stop& stop, const Ranks& at) {
        PointId& point = stops_[stop.same].point;
        if (point == Stop::none) point = point_at(at);
    });
}

// Where nothing else has points they take no names, and come in the order of the stops.
template <class Number>
void AxisFaceOutlines<Number>::make_points(std::span<const Face> faces) {
    for (FacePlane& s : face_planes_)
        if (s.id < 0) s.id = parts_.bench.plane(s.name);
    ParallelParts(faces.size(), stops_.size() < least_stops ? 1 : threads_, 1)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (const Face& face : faces.subspan(begin, end - begin))
                for_each_vertex(face, [&](const Stop& stop, const Ranks&) {
                    const std::atomic_ref point(stops_[stop.same].point);
                    if (point.load(std::memory_order_relaxed) == Stop::none)
                        point.store(Stop::wanted, std::memory_order_relaxed);
                });
        });
    const ParallelParts parts(all_lines_.size(), threads_, least_lines);
    PoolVector<PointId> before(parts.count() + 1, 0);
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        PointId count = 0;
        for (const StopLine& line : std::span(all_lines_).subspan(begin, end - begin))
            for (std::uint32_t i = line.stops.first; i < line.stops.end; ++i)
                count += stops_[i].point == Stop::wanted ? 1 : 0;
        before[part + 1] = count;
    });
    std::partial_sum(before.begin(), before.end(), before.begin());
    const PointId first = parts_.bench.make_room(0, as_index(before.back())).first_point;
    if (threads_ != 1) parts_.bench.share();
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        PointId next = first + before[part];
        for (const StopLine& line : std::span(all_lines_).subspan(begin, end - begin))
            next = put_points(line, next);
    });
    if (threads_ != 1) parts_.bench.end_sharing();
}

// Those of a line that are wanted. Returns the number after theirs.
template <class Number>
PointId AxisFaceOutlines<Number>::put_points(const StopLine& line, PointId next) {
    Ranks at = line.at;
    for (std::uint32_t i = line.stops.first; i < line.stops.end; ++i) {
        if (stops_[i].point != Stop::wanted) continue;
        stops_[i].point = next;
        at[line.along] = stops_[i].place;
        put_point(next++, at);
    }
    return next;
}

template <class Number>
void AxisFaceOutlines<Number>::put_point(PointId id, const Ranks& ranks) {
    if (const std::int32_t c = corner_ids_.find(key_of(ranks)); c >= 0) {
        const CornerName& name = corners_[as_index(c)];
        return parts_.bench.put_corner(id, name.source,
                                       name.source->corner_index(name.facet, name.corner));
    }
    const auto plane = [&](std::size_t k) { return face_plane_at_rank(k, ranks[k]).id; };
    parts_.bench.put_point(id, plane(0), plane(1), plane(2), place_at(ranks));
}

// \pre named; count_edges() of them
template <class Number>
void AxisFaceOutlines<Number>::make_edges_of(const Face& face, BoundaryEdge* out) const {
    const FacePlane& face_plane = face_planes_[face.face_plane];
    for (const std::uint32_t n : face.intervals) {
        const Interval& s = face_plane.outline.intervals()[n];
        const std::size_t across = across_of(face_plane, s);
        const FacePlane& beside = face_plane_at_rank(across, line_of(face_plane, s)[across]);
        BoundaryEdge e{-1, -1, face.first, {}};
        e.line = {beside.id, s.is_low == (beside.plane.sign > 0)};
        for_each_stop(s, face_plane.stops[n], [&](std::uint32_t i) {
            e.from = std::exchange(e.to, stops_[stops_[i].same].point);
            if (e.from >= 0) *out++ = e;
        });
    }
}

// An edge ends at splitting planes too, for which doubles suffice: the caller checks the result.
template <class Number>
void AxisFaceOutlines<Number>::add_vertices_in(const BoundaryEdge& edge, PoolVector<PointId>& out) {
    const Workbench& bench = parts_.bench;
    const auto support =
        axis_plane<Number>(bench.name(parts_.facets[as_index(edge.facet)].support));
    const auto beside = axis_plane<Number>(bench.name(edge.line.plane));
    if (!support || !beside) return;
    Ranks at{};
    for (const Plane& p : {*support, *beside}) {
        const Number place = Numbers::place_of(p.position);
        at[p.axis] = rank(p.axis, place);
        if (!Numbers::is_place(p.position) || at[p.axis] == coordinates_[p.axis].size() ||
            coordinates_[p.axis][at[p.axis]] != place)
            return;
    }
    const std::size_t along = 3 - support->axis - beside->axis;
    const Approximation& from = bench.approximation(edge.from);
    const Approximation& to = bench.approximation(edge.to);
    const auto rank_at = [&](double c) { return rank(along, Numbers::place_near(c)); };
    const auto [low, high] = std::minmax(from.c[along], to.c[along]);
    const double margin = 2 + from.error + to.error;
    const std::uint32_t first = rank_at(low - margin);
    const std::uint32_t last = rank_at(high + margin);
    const auto add = [&](std::uint32_t place) {
        if (place + 1 < first || place > last) return;
        at[along] = place;
        out.push_back(point_at(at));
    };
    if (const std::int32_t line = lines_[along].find({line_at(along, at), 0}); line >= 0) {
        const Stops& on_line = all_lines_[as_index(line)].stops;
        for (std::uint32_t i = on_line.first; i < on_line.end; ++i) add(stops_[i].place);
    } else {
        for (const Other& o : others_on(along, at)) add(o.place);
    }
}

template void AxisFaceOutlines<std::int64_t>::note_vertices(std::span<const BoundaryEdge> edges);
template void AxisFaceOutlines<std::int64_t>::make_edges(BoundaryEdges& edges);
template void AxisFaceOutlines<std::int64_t>::add_vertices_in(const BoundaryEdge& edge,
                                                              PoolVector<PointId>& out);
template void AxisFaceOutlines<Int128>::note_vertices(std::span<const BoundaryEdge> edges);
template void AxisFaceOutlines<Int128>::make_edges(BoundaryEdges& edges);
template void AxisFaceOutlines<Int128>::add_vertices_in(const BoundaryEdge& edge,
                                                        PoolVector<PointId>& out);

}  // namespace trisect::detail
