// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/workbench.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/triangle_normal.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

void Workbench::clear() {
    planes_.clear();
    made_.clear();
    recent_.clear();
    points_.clear();
    plane_ids_.clear();
    corner_ids_.clear();
    line_ids_.clear();
    point_ids_.clear();
    names_points_ = true;
}

void Workbench::end_points() {
    names_points_ = false;
    line_ids_ = {};
    point_ids_ = {};
}

void Workbench::forget_made_planes() {
    adding_ = nullptr;
    for (PlaneRecord& p : planes_) p.place = -1;
    made_.free();
}

void Workbench::reserve(std::size_t planes, std::size_t points) {
    planes_.reserve(planes);
    plane_ids_.reserve(planes / 2);
    line_ids_.reserve(planes / 2);
    points_.reserve(points);
    point_ids_.reserve(points);
}

void Workbench::reserve_unnamed(std::size_t planes, std::size_t points) {
    planes_.reserve(planes);
    points_.reserve(points);
}

void Workbench::reserve_points_on_edges(std::size_t planes, std::size_t points,
                                        std::size_t on_edges) {
    reserve_unnamed(planes, points + on_edges);
    line_ids_.reserve(on_edges / 2);
    point_ids_.reserve(on_edges);
}

PlaneId Workbench::add_plane(const PlaneName& name, PlaneId support) {
    const auto id = static_cast<PlaneId>(planes_.size());
    planes_.push_back({name, id, support});
    return id;
}

const Plane& Workbench::make_plane(PlaneId id) const {
    const PlaneRecord& r = planes_[as_index(id)];
    const Plane plane = r.name.is_edge()
                            ? r.name.source()->edge_plane(
                                  r.name.facet, static_cast<int>(r.name.kind), plane_at(r.support))
                            : r.name.plane();
    if (adding_ == nullptr) {
        r.place = made_.add(plane);
        return made_.at(r.place);
    }
    const std::lock_guard lock(*adding_);
    if (r.place < 0) std::atomic_ref(r.place).store(made_.add(plane), std::memory_order_release);
    return made_.at(r.place);
}

void Workbench::share() {
    made_.reserve(planes_.size());
    if (adding_ == nullptr) adding_ = std::make_unique<SpinLock>();
}

// The edge planes of a facet are found by one key and have ids in a row.
PlaneId Workbench::plane(const PlaneName& name) {
    const std::uint32_t kind = name.is_edge() ? PlaneName::Edge0 : name.kind;
    const PlaneId offset = name.is_edge() ? static_cast<PlaneId>(name.kind) : 0;
    const Key128 key{name.owner, (std::uint64_t{kind} << 32) | name.facet};
    const auto [id, inserted] = plane_ids_.insert(key, static_cast<PlaneId>(planes_.size()));
    if (!inserted) return id + offset;
    if (!name.is_edge()) return add_plane(name);
    const Source* source = name.source();
    for (int k = 0; k < 3; ++k) add_plane(PlaneName::edge(source, name.facet, k));
    // The support may be new as well: its id comes after theirs.
    const PlaneId support = plane(PlaneName::support(source, name.facet));
    for (PlaneId k = 0; k < 3; ++k) planes_[as_index(id + k)].support = support;
    return id + offset;
}

PlaneId Workbench::add_facet(const Source* source, std::uint32_t facet) {
    const auto first = static_cast<PlaneId>(planes_.size());
    for (int k = 0; k < 3; ++k) add_plane(PlaneName::edge(source, facet, k), first + 3);
    add_plane(PlaneName::support(source, facet));
    return first;
}

void Workbench::declare_same(PlaneId a, PlaneId b) {
    const PlaneId ca = plane_class(a);
    const PlaneId cb = plane_class(b);
    planes_[as_index(std::max(ca, cb))].same = std::min(ca, cb);
}

Workbench::Room Workbench::make_room(std::size_t facets, std::size_t points) {
    const Room out{static_cast<PlaneId>(planes_.size()), static_cast<PointId>(points_.size())};
    planes_.resize(planes_.size() + 4 * facets);
    points_.resize(points_.size() + points);
    return out;
}

void Workbench::put_facet(PlaneId first, const Source* source, std::uint32_t facet) {
    for (PlaneId k = 0; k < 3; ++k)
        planes_[as_index(first + k)] = {PlaneName::edge(source, facet, k), first + k, first + 3};
    planes_[as_index(first + 3)] = {PlaneName::support(source, facet), first + 3};
}

Workbench::PointRecord Workbench::corner_record(const Source* source, std::uint32_t vertex) const {
    return {{-1, -1, -1}, vertex, source, approximate(source->mesh().points[vertex]), true};
}

void Workbench::put_corner(PointId id, const Source* source, std::uint32_t vertex) {
    points_[as_index(id)] = corner_record(source, vertex);
}

PointId Workbench::corner(const Source* source, std::uint32_t facet, int i) {
    const Key128 key{reinterpret_cast<std::uintptr_t>(source), source->corner_index(facet, i)};
    const auto next = static_cast<PointId>(points_.size());
    const auto [id, inserted] = corner_ids_.insert(key, next);
    if (inserted) points_.push_back(corner_record(source, source->corner_index(facet, i)));
    return id;
}

PointId Workbench::add_corner(const Source* source, std::uint32_t vertex) {
    points_.push_back(corner_record(source, vertex));
    return static_cast<PointId>(points_.size() - 1);
}

// Facets of one source that share an edge: its vertices.
std::optional<std::array<std::uint32_t, 2>> Workbench::common_edge(const PlaneName& a,
                                                                   const PlaneName& b) {
    if (a.owner != b.owner || a.kind != PlaneName::Support || b.kind != PlaneName::Support)
        return std::nullopt;
    const Source* source = a.source();
    if (source->is_half_space()) return std::nullopt;
    std::array<std::uint32_t, 2> ends{};
    std::size_t found = 0;
    for (int i = 0; i < 3 && found < 2; ++i) {
        const std::uint32_t v = source->corner_index(a.facet, i);
        if (v == source->corner_index(b.facet, 0) || v == source->corner_index(b.facet, 1) ||
            v == source->corner_index(b.facet, 2))
            ends[found++] = v;
    }
    if (found < 2) return std::nullopt;
    return ends;
}

std::uint64_t Workbench::line_of_edge(std::uint64_t owner, std::uint32_t v, std::uint32_t w) {
    const Key128 key{owner, (std::uint64_t{std::min(v, w)} << 32) | std::max(v, w)};
    const auto line = line_ids_.insert(key, static_cast<std::int32_t>(line_ids_.size())).first;
    return (std::uint64_t{1} << 32) | static_cast<std::uint64_t>(line);
}

// What a plane adds to the name of a point: itself, or for the plane of an edge that edge of the
// source, which both of its facets share.
std::uint64_t Workbench::line_item(PlaneId p) {
    PlaneRecord& r = planes_[as_index(p)];
    const PlaneName& n = r.name;
    if (!n.is_edge()) return static_cast<std::uint64_t>(p);
    if (r.line < 0) {
        const auto v = n.source()->corner_index(n.facet, static_cast<int>(n.kind));
        const auto w = n.source()->corner_index(n.facet, static_cast<int>((n.kind + 1) % 3));
        r.line = static_cast<std::int32_t>(line_of_edge(n.owner, v, w) & 0xffffffffU);
    }
    return (std::uint64_t{1} << 32) | static_cast<std::uint64_t>(r.line);
}

Key128 Workbench::point_key(PlaneId p, PlaneId q, PlaneId r) {
    std::array<std::uint64_t, 3> items{line_item(p), line_item(q), line_item(r)};
    std::sort(items.begin(), items.end());
    const bool has_line = items[2] >> 32 != 0;
    // A line and one more item name the point; the plane that carries the line adds nothing, and it
    // is the smallest item when the other one is a line too. With one line the two planes are the
    // facet that the line belongs to and what meets it: only the latter may stay.
    if (!has_line) {
        // The planes of two facets that share an edge name that edge: the point where it meets the
        // third plane is the same from whichever of them it is reached.
        const std::array<PlaneId, 3> planes{p, q, r};
        for (std::size_t i = 0; i < 3; ++i) {
            const PlaneName& a = name(planes[i]);
            if (const auto ends = common_edge(a, name(planes[(i + 1) % 3])))
                return {line_item(planes[(i + 2) % 3]),
                        line_of_edge(a.owner, (*ends)[0], (*ends)[1])};
        }
        return {items[0] | (items[1] << 33), items[2] | (std::uint64_t{1} << 63)};
    }
    if (items[1] >> 32 != 0) return {items[1], items[2]};
    const PlaneId line_plane = line_item(p) == items[2] ? p : (line_item(q) == items[2] ? q : r);
    const PlaneName& line = name(line_plane);
    const auto carries = [&](std::uint64_t item) {
        return planes_[item].name == PlaneName::support(line.source(), line.facet);
    };
    if (carries(items[0])) return {items[1], items[2]};
    if (carries(items[1])) return {items[0], items[2]};
    return {items[0] | (items[1] << 33), items[2]};
}

PointId Workbench::meet(PlaneId p, PlaneId q, PlaneId r) {
    return point_named(point_key(p, q, r), p, q, r, nullptr);
}

// The same for a facet's support and one of its edges; point_key comes to this key by a longer way.
PointId Workbench::meet_on_edge(PlaneId support, PlaneId edge, PlaneId other,
                                const Approximation* known) {
    const std::uint64_t a = line_item(edge);
    const std::uint64_t b = line_item(other);
    return point_named({std::min(a, b), std::max(a, b)}, support, edge, other, known);
}

namespace {

// As sharp as approximate() makes them.
bool is_sharp(const Approximation& a) {
    const double largest =
        std::max(std::fabs(a.c[0]), std::max(std::fabs(a.c[1]), std::fabs(a.c[2])));
    return a.error <= 0x1p-40 * largest;
}

// Doubles without an error are the coordinates.
bool is_lattice_point(const Approximation& a) {
    constexpr double finest = 0x1p73;
    static_assert(fraction_limit == 73);
    return a.error == 0 && std::ranges::all_of(a.c, [](double c) {
               return std::fabs(c) <= static_cast<double>(coordinate_limit) &&
                      std::nearbyint(c * finest) == c * finest;
           });
}

}  // namespace

PointId Workbench::point_named(const Key128& key, PlaneId p, PlaneId q, PlaneId r,
                               const Approximation* known) {
    const auto next = static_cast<PointId>(points_.size());
    TRISECT_EXPECTS(names_points_, "a point was named after the last one");
    const auto [id, inserted] = point_ids_.insert(key, next);
    if (!inserted) return id;
    const bool take = known != nullptr && is_sharp(*known);
    const Approximation at = take ? *known : approximate(plane_at(p), plane_at(q), plane_at(r));
    points_.push_back({{p, q, r}, 0, nullptr, at, is_lattice_point(at)});
    return id;
}

Workbench::PointRecord Workbench::point_record(PlaneId p, PlaneId q, PlaneId r,
                                               const Approximation& known) const {
    const Approximation at =
        is_sharp(known) ? known : approximate(plane_at(p), plane_at(q), plane_at(r));
    return {{p, q, r}, 0, nullptr, at, is_lattice_point(at)};
}

void Workbench::put_point(PointId id, PlaneId p, PlaneId q, PlaneId r, const Approximation& known) {
    points_[as_index(id)] = point_record(p, q, r, known);
}

PointId Workbench::add_point(PlaneId p, PlaneId q, PlaneId r, const Approximation& known) {
    points_.push_back(point_record(p, q, r, known));
    return static_cast<PointId>(points_.size() - 1);
}

HomogeneousPoint Workbench::homogeneous(PointId id) const {
    const PointRecord& r = points_[as_index(id)];
    if (r.is_lattice) return trisect::homogeneous(r.lattice());
    const auto compute = [&] {
        const auto h =
            intersect(plane_at(r.planes[0]), plane_at(r.planes[1]), plane_at(r.planes[2]));
        TRISECT_EXPECTS(h.has_value(), "a point of planes that do not meet in one");
        return *h;
    };
    if (adding_ != nullptr) return compute();
    constexpr std::size_t kept = 64;
    recent_.resize(kept);
    ExactPoint& known = recent_[as_index(id) % kept];
    if (known.point != id) known = {id, compute()};
    return known.at;
}

Point Workbench::point(PointId id) const {
    const PointRecord& r = points_[as_index(id)];
    if (r.is_lattice) return Point(r.lattice());
    return Point(plane_at(r.planes[0]), plane_at(r.planes[1]), plane_at(r.planes[2]));
}

std::array<double, 3> Workbench::nearest(PointId id) const {
    const PointRecord& r = points_[as_index(id)];
    if (r.is_lattice) return r.approximation.c;
    if (const auto planes = unmade_planes_of(r))
        if (const auto nearest = nearest_doubles(r.approximation, *planes)) return *nearest;
    return nearest_doubles(r.approximation, plane_at(r.planes[0]), plane_at(r.planes[1]),
                           plane_at(r.planes[2]));
}

std::optional<RefinedPoint> Workbench::refined(PointId id) const {
    const PointRecord& r = points_[as_index(id)];
    if (r.is_lattice) return RefinedPoint{r.approximation.c, {}, 0};
    if (const auto planes = unmade_planes_of(r))
        if (const auto refined = refined_point(r.approximation, *planes)) return refined;
    return refined_point(r.approximation, plane_at(r.planes[0]), plane_at(r.planes[1]),
                         plane_at(r.planes[2]));
}

namespace {

TriangleNormal triangle_normal(const Source& source, std::uint32_t facet) {
    return {source.corner(facet, 0).doubles(), source.corner(facet, 1).doubles(),
            source.corner(facet, 2).doubles()};
}

}  // namespace

// Mostly doubles decide, and then the plane is not made.
Workbench::Facing Workbench::facing(PlaneId support) const {
    const PlaneName& n = name(support);
    if (!is_made(support) && !n.is_splitter() && !n.source()->is_half_space()) {
        const TriangleNormal normal = triangle_normal(*n.source(), n.facet);
        const std::size_t k = normal.longest_axis();
        const double least = std::fabs(normal.n[k]) - normal.error[k];
        const auto is_shorter = [&](std::size_t i) {
            return std::fabs(normal.n[i]) + normal.error[i] < slightly_less * least;
        };
        if (is_shorter((k + 1) % 3) && is_shorter((k + 2) % 3))
            return {static_cast<int>(k), normal.n[k] > 0};
    }
    const Plane& p = plane_at(support);
    const int k = p.dominant_axis();
    return {k, p.normal(k) > 0};
}

// An edge is in any plane through it; the one along the longest axis meets others best.
std::optional<CornerPlane> Workbench::by_corners(PlaneId id) const {
    const PlaneName& n = name(id);
    const Source* const source = n.source();
    if (source == nullptr) return std::nullopt;
    CornerPlane out;
    if (source->is_half_space()) {
        out.made = &plane_at(id);
        return out;
    }
    const auto corner = [&](std::uint32_t i) {
        return &source->corner(n.facet, static_cast<int>(i % 3));
    };
    out.is_whole = source->is_whole();
    if (!n.is_edge()) {
        out.corners = {corner(0), corner(1), corner(2)};
    } else {
        out.corners = {corner(n.kind), corner(n.kind + 1), nullptr};
        out.axis = static_cast<int>(triangle_normal(*source, n.facet).longest_axis());
    }
    return out;
}

// Of planes that are not there yet: these take longer to make, and memory.
std::optional<std::array<CornerPlane, 3>> Workbench::unmade_planes_of(
    const PointRecord& point) const {
    if (std::ranges::all_of(point.planes, [&](PlaneId p) { return is_made(p); }))
        return std::nullopt;
    std::array<CornerPlane, 3> planes;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto plane = by_corners(point.planes[i]);
        if (!plane) return std::nullopt;
        planes[i] = *plane;
    }
    return planes;
}

// Whether the name of a plane says that it passes through a vertex of a source.
bool Workbench::has_vertex(const PlaneName& plane, const Source* source, std::uint32_t vertex) {
    if (plane.is_splitter() || plane.source() != source || source->is_half_space()) return false;
    const auto is_corner = [&](std::uint32_t i) {
        return source->corner_index(plane.facet, static_cast<int>(i % 3)) == vertex;
    };
    if (plane.is_edge()) return is_corner(plane.kind) || is_corner(plane.kind + 1);
    return is_corner(0) || is_corner(1) || is_corner(2);
}

// Whether the name of a plane says that it passes through the line of an edge of a source.
bool Workbench::contains_edge(const PlaneName& plane, const PlaneName& edge) {
    if (!edge.is_edge() || plane.owner != edge.owner) return false;
    const Source* source = edge.source();
    const auto end = [&](std::uint32_t i) {
        return source->corner_index(edge.facet, static_cast<int>(i % 3));
    };
    return has_vertex(plane, source, end(edge.kind)) &&
           has_vertex(plane, source, end(edge.kind + 1));
}

// The same for the common edge of two facets.
bool Workbench::contains_common_edge(const PlaneName& plane, const PlaneName& a,
                                     const PlaneName& b) {
    if (plane.owner != a.owner || plane.is_splitter()) return false;
    const auto ends = common_edge(a, b);
    return ends && has_vertex(plane, a.source(), (*ends)[0]) &&
           has_vertex(plane, a.source(), (*ends)[1]);
}

int Workbench::unfiltered_side(PointId point, PlaneId plane) const {
    const PointRecord& r = points_[as_index(point)];
    const Plane& p = plane_at(plane);
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (r.planes[0] < 0) {
        if (has_vertex(name(plane), r.source, r.vertex)) {
            ++counters.symbolic;
            return 0;
        }
        return sign_of(side_of(r.lattice(), p));
    }
    const PlaneId c = plane_class(plane);
    for (std::size_t i = 0; i < 3; ++i) {
        const PlaneId q = r.planes[i];
        if (q == plane || plane_class(q) == c || contains_edge(name(plane), name(q)) ||
            contains_common_edge(name(plane), name(q), name(r.planes[(i + 1) % 3]))) {
            ++counters.symbolic;
            return 0;
        }
    }
    if (r.is_lattice) return sign_of(side_of(r.lattice(), p));
    if (adding_ == nullptr && !recent_.empty()) {
        const ExactPoint& known = recent_[as_index(point) % recent_.size()];
        if (known.point == point) return sign_of(side_of(known.at, p));
    }
    return sign_of(side_of(r.approximation, plane_at(r.planes[0]), plane_at(r.planes[1]),
                           plane_at(r.planes[2]), p));
}

bool Workbench::may_be_same(PointId a, PointId b) const {
    const Approximation& p = approximation(a);
    const Approximation& q = approximation(b);
    for (std::size_t k = 0; k < 3; ++k)
        if (std::fabs(p.c[k] - q.c[k]) > error_slack * (p.error + q.error)) return false;
    return true;
}

bool Workbench::same_point(PointId a, PointId b) const {
    if (a == b) return true;
    if (!may_be_same(a, b)) return false;
    const PointRecord& ra = points_[as_index(a)];
    const PointRecord& rb = points_[as_index(b)];
    if (ra.is_lattice && rb.is_lattice) return ra.approximation.c == rb.approximation.c;
    const PointRecord& named = ra.planes[0] < 0 ? rb : ra;
    const PointId other = ra.planes[0] < 0 ? a : b;
    return std::all_of(named.planes.begin(), named.planes.end(),
                       [&](PlaneId p) { return side(other, p) == 0; });
}

WorkPolygon Workbench::polygon(const PolygonRef& ref) {
    WorkPolygon w;
    w.support = plane(PlaneName::support(ref.source, ref.facet));
    if (ref.fragment == nullptr) {
        if (ref.source->is_half_space()) return w;  // unbounded: clipped by its cell before use
        for (int i = 0; i < 3; ++i) w.points.push_back(corner(ref.source, ref.facet, i));
        return w;
    }
    add_fragment(ref, w);
    return w;
}

namespace {

bool is_own_edge(const PlaneName& plane, const PolygonRef& ref) {
    return plane.is_edge() && plane.facet == ref.facet && plane.source() == ref.source;
}

}  // namespace

void Workbench::add_fragment(const PolygonRef& ref, WorkPolygon& w) {
    const auto edges = ref.fragment->edges();
    const Approximation* const vertices = ref.fragment->vertices().data();
    const std::size_t n = edges.size();
    PlaneId own = -1;  // the first of the facet's edge planes
    for (const EdgeName& e : edges) {
        if (!is_own_edge(e.plane, ref)) {
            w.edges.push_back({plane(e.plane), e.above});
            continue;
        }
        const auto i = static_cast<PlaneId>(e.plane.kind);
        if (own < 0) own = plane(e.plane) - i;
        w.edges.push_back({own + i, e.above});
    }
    for (std::size_t i = 0; i < n; ++i)
        w.points.push_back(vertex(ref, w.support, w.edges[i == 0 ? n - 1 : i - 1].plane,
                                  w.edges[i].plane, vertices[i]));
}

PointId Workbench::vertex(const PolygonRef& ref, PlaneId support, PlaneId p, PlaneId q,
                          const Approximation& at) {
    const bool own_p = is_own_edge(name(p), ref);
    const bool own_q = is_own_edge(name(q), ref);
    // Edge i begins at corner i.
    if (own_p && own_q) {
        const auto i = static_cast<int>(name(p).kind);
        const auto j = static_cast<int>(name(q).kind);
        return corner(ref.source, ref.facet, (i + 1) % 3 == j ? j : i);
    }
    if (own_p || own_q) return meet_on_edge(support, own_p ? p : q, own_p ? q : p, &at);
    return point_named(point_key(support, p, q), support, p, q, &at);
}

void Workbench::with_edges(WorkPolygon& polygon, const PolygonRef& ref) {
    if (!polygon.edges.empty() || ref.source->is_half_space()) return;
    const PlaneId first = plane(PlaneName::edge(ref.source, ref.facet, 0));
    for (PlaneId i = 0; i < 3; ++i) polygon.edges.push_back({first + i, false});
}

const Workbench::Sides& Workbench::sides_of(const WorkPolygon& polygon, PlaneId plane) {
    sides_.clear();
    for (const PointId p : polygon.points)
        sides_.push_back(static_cast<std::int8_t>(side(p, plane)));
    return sides_;
}

void Workbench::split(const WorkPolygon& polygon, PlaneId plane, const Sides& sides,
                      WorkPolygon& below, WorkPolygon& above) {
    below = {polygon.support, {}, {}};
    above = {polygon.support, {}, {}};
    const std::size_t n = polygon.points.size();
    // Walk once around. A point goes to the parts it touches; where the walk leaves a part along
    // the cut, that part gets an edge on the cutting plane.
    for (std::size_t i = 0; i < n; ++i) {
        const int here = sides[i];
        const int next = sides[(i + 1) % n];
        const PointId p = polygon.points[i];
        const WorkEdge& e = polygon.edges[i];
        const auto add = [](WorkPolygon& w, PointId point, WorkEdge edge) {
            w.points.push_back(point);
            w.edges.push_back(edge);
        };
        if (here < 0) add(below, p, e);
        if (here > 0) add(above, p, e);
        if (here == 0) {
            // The next strict side decides which part continues along e; the other turns into the
            // cut.
            if (next < 0) {
                add(below, p, e);
                add(above, p, {plane, true});
            } else {
                add(above, p, e);
                add(below, p, {plane, false});
            }
        } else if (here * next < 0) {
            const PointId x = meet(polygon.support, e.plane, plane);
            if (next < 0) {
                add(below, x, e);
                add(above, x, {plane, true});
            } else {
                add(above, x, e);
                add(below, x, {plane, false});
            }
        }
    }
}

WorkPolygon Workbench::clipped(WorkPolygon polygon, PlaneId plane, int keep) {
    const Sides& sides = sides_of(polygon, plane);
    const auto has = [&](int side) {
        return std::find(sides.begin(), sides.end(), side) != sides.end();
    };
    if (!has(-keep)) return polygon;
    WorkPolygon below{polygon.support, {}, {}};
    WorkPolygon above{polygon.support, {}, {}};
    if (has(keep)) split(polygon, plane, sides, below, above);
    return keep < 0 ? std::move(below) : std::move(above);
}

WorkPolygon Workbench::unbounded_in(PlaneId support, const Cell& cell) {
    // Seen along the dominant axis k the other two axes j, l span the plane, and the bounding
    // planes of the cell across them cut out a quadrilateral.
    const Plane& s = plane_at(support);
    const int k = s.dominant_axis();
    const int j = (k + 1) % 3;
    const int l = (k + 2) % 3;
    const auto splitter = [&](int axis, bool high) {
        const auto i = static_cast<std::size_t>(axis);
        return WorkEdge{plane(PlaneName::splitter(axis, high ? cell.hi[i] : cell.lo[i])), !high};
    };
    WorkPolygon w;
    w.support = support;
    w.edges = {splitter(l, false), splitter(j, true), splitter(l, true), splitter(j, false)};
    if (plane_at(support).normal(k) < 0) std::reverse(w.edges.begin(), w.edges.end());
    for (std::size_t i = 0; i < 4; ++i)
        w.points.push_back(meet(support, w.edges[(i + 3) % 4].plane, w.edges[i].plane));
    return w;
}

// Whether the polygon has an edge on a splitting plane, and so lies on one side of it.
bool Workbench::is_bounded_by(const WorkPolygon& polygon, int axis, std::int64_t splitter,
                              bool above) const {
    const PlaneName n = PlaneName::splitter(axis, splitter);
    return std::any_of(polygon.edges.begin(), polygon.edges.end(),
                       [&](const WorkEdge& e) { return e.above == above && name(e.plane) == n; });
}

WorkPolygon Workbench::clipped(WorkPolygon polygon, const Box& box, const Cell& cell) {
    // A whole plane reaches beyond the box of its source, along its dominant axis too.
    const bool unbounded = polygon.is_empty();
    WorkPolygon w = unbounded ? unbounded_in(polygon.support, cell) : std::move(polygon);
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        // Boxes are rounded outwards, so those of parts that end at a splitting plane reach beyond
        // it.
        if ((unbounded || box.lo[k] <= lattice_below(cell.lo[k])) &&
            !is_bounded_by(w, axis, cell.lo[k], true))
            w = clipped(std::move(w), plane(PlaneName::splitter(axis, cell.lo[k])), 1);
        if (w.is_empty()) return w;
        if ((unbounded || box.hi[k] > lattice_below(cell.hi[k])) &&
            !is_bounded_by(w, axis, cell.hi[k], false))
            w = clipped(std::move(w), plane(PlaneName::splitter(axis, cell.hi[k])), -1);
        if (w.is_empty()) return w;
    }
    return w;
}

}  // namespace trisect::detail
