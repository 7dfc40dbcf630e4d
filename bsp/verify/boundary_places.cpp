// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/verify/boundary_places.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <trisect/brep/planar_loops.h>
#include <trisect/brep/triangulate.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Place = BoundaryPlaces::Place;

/// Vertices that are looked at for one corner: where more are near, the reach is no rounding.
constexpr std::size_t most_seen = 64;

Int128 distance(const GridPoint& a, const GridPoint& b) {
    Int128 most = 0;
    for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, a[k] > b[k] ? a[k] - b[k] : b[k] - a[k]);
    return most;
}

/// Cells that share a key are looked at in vain, no more.
std::uint64_t mixed(std::uint64_t key, std::int64_t v) {
    return (key ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15U + (key >> 29);
}

double lattice_units(Int128 v) { return std::ldexp(WideInt<2>(v).to_double(), -grid_bits); }
ExactRational exact_lattice_units(Int128 v) {
    return ExactRational(WideInt<2>(v)).scaled(-grid_bits);
}
Vector3 lattice_units(const GridPoint& p) {
    return {lattice_units(p[0]), lattice_units(p[1]), lattice_units(p[2])};
}

template <class Id>
Id first_copy(const Brep& brep, Id id) {
    const auto copies = brep.copies(id);
    return copies.empty() ? id : *std::min_element(copies.begin(), copies.end());
}

}  // namespace

BoundaryTriangles boundary_triangles(const Brep& brep) {
    std::vector<GridPoint> points;
    for (const Point& p : brep.points()) points.push_back(to_grid(p));
    std::vector<GridTriangle> triangles;
    std::vector<FaceId> faces;
    for (const FaceId f : brep.faces()) {
        for (const IndexTriangle& t : triangulate(brep, f)) {
            triangles.emplace_back(points[t[0]], points[t[1]], points[t[2]]);
            faces.push_back(f);
        }
    }
    return {GridTriangles(std::move(triangles)), std::move(faces)};
}

BoundaryPlaces::BoundaryPlaces(const Brep& brep, const BoundaryTriangles& surface, double reach)
    : brep_(brep),
      surface_(surface),
      reach_(std::min(reach, 0x1p52)),
      grid_reach_(static_cast<Int128>(std::ldexp(reach_, grid_bits)) + 1) {
    list_vertices();
}

void BoundaryPlaces::list_vertices() {
    const std::size_t n = brep_.counts().vertices;
    at_.reserve(n);
    faces_.resize(n);
    for (const VertexId v : brep_.vertices()) {
        at_.push_back(to_grid(brep_.point(v)));
        if (place_of(v) != v.index) continue;
        const Cell c = cell_of(at_.back());
        cells_.emplace(mixed(mixed(mixed(0, c.x), c.y), c.z), v.index);
    }
    for (const FaceId f : brep_.faces()) {
        for (const HalfedgeId h : brep_.halfedges(f)) {
            auto& faces = faces_[place_of(brep_.origin(h))];
            if (faces.empty() || faces.back() != f.index) faces.push_back(f.index);
        }
    }
}

Place BoundaryPlaces::place_of(VertexId v) const { return first_copy(brep_, v).index; }

Place BoundaryPlaces::place_at(const GridPoint& corner) {
    if (const auto known = known_.find(corner); known != known_.end()) return known->second;
    Place p = nearest_vertex(corner);
    if (p == none) p = place_within_edge(corner);
    if (p == none) p = place_within_face(corner);
    if (p == none) {
        p = add({}, {});
        at_.back() = corner;
    }
    largest_move_ = std::max(largest_move_, distance(corner, at_[p]));
    known_.emplace(corner, p);
    return p;
}

BoundaryPlaces::Cell BoundaryPlaces::cell_of(const GridPoint& p) const {
    const Int128 size = 2 * grid_reach_;
    const auto floored = [&](Int128 v) {
        return static_cast<std::int64_t>(v >= 0 ? v / size : -((size - 1 - v) / size));
    };
    return {floored(p[0]), floored(p[1]), floored(p[2])};
}

Place BoundaryPlaces::nearest_vertex(const GridPoint& p) const {
    const Int128 r = grid_reach_;
    const Cell from = cell_of({p[0] - r, p[1] - r, p[2] - r});
    const Cell to = cell_of({p[0] + r, p[1] + r, p[2] + r});
    Place best = none;
    Int128 least = r + 1;
    std::size_t seen = 0;
    for (std::int64_t x = from.x; x <= to.x; ++x)
        for (std::int64_t y = from.y; y <= to.y; ++y)
            for (std::int64_t z = from.z; z <= to.z; ++z)
                if (!look({x, y, z}, p, seen, best, least)) return none;
    return best;
}

/// False where too many vertices were seen.
bool BoundaryPlaces::look(const Cell& c, const GridPoint& corner, std::size_t& seen, Place& best,
                          Int128& least) const {
    const auto [begin, end] = cells_.equal_range(mixed(mixed(mixed(0, c.x), c.y), c.z));
    for (auto i = begin; i != end; ++i) {
        if (++seen > most_seen) return false;
        const Int128 d = distance(corner, at_[i->second]);
        if (d > least || (d == least && i->second > best)) continue;
        best = i->second;
        least = d;
    }
    return true;
}

void BoundaryPlaces::list_segments() {
    std::vector<GridTriangle> lines;
    for (const EdgeId e : brep_.edges()) {
        if (first_copy(brep_, e) != e) continue;
        const HalfedgeId h = brep_.halfedge(e);
        Place a = place_of(brep_.origin(h));
        Place b = place_of(brep_.target(h));
        if (a > b) std::swap(a, b);
        segments_.push_back({e, a, b});
        lines.emplace_back(at_[a], at_[b], at_[b]);
    }
    segment_search_.emplace(std::move(lines));
}

Place BoundaryPlaces::place_within_edge(const GridPoint& corner) {
    if (!segment_search_) list_segments();
    const GridTriangles::Nearest nearest = segment_search_->nearest(corner);
    if (!(nearest.upper <= reach_)) return none;
    const Segment& s = segments_[nearest.triangle];
    const Vector3 a = lattice_units(at_[s.from]);
    const Vector3 along = minus(lattice_units(at_[s.to]), a);
    const double parameter = dot(minus(lattice_units(corner), a), along) / dot(along, along);
    if (!(parameter > 0 && parameter < 1)) return none;
    const auto [place, is_new] = within_[s.edge].try_emplace(parameter, none);
    if (!is_new) return place->second;
    const ExactPoint from = exact(s.from);
    const ExactPoint to = exact(s.to);
    const ExactRational t = ExactRational::from_double(parameter);
    ExactPoint point;
    for (std::size_t k = 0; k < 3; ++k) point[k] = from[k] + t * (to[k] - from[k]);
    std::set<std::uint32_t> faces;
    const auto add_faces = [&](EdgeId e) {
        const HalfedgeId h = brep_.halfedge(e);
        faces.insert({brep_.face(h).index, brep_.face(brep_.twin(h)).index});
    };
    add_faces(s.edge);
    for (const EdgeId e : brep_.copies(s.edge)) add_faces(e);
    place->second = add(std::move(point), {faces.begin(), faces.end()});
    return place->second;
}

/// Along the plane's dominant axis.
Place BoundaryPlaces::place_within_face(const GridPoint& corner) {
    const GridTriangles::Nearest nearest = surface_.triangles.nearest(corner);
    if (!(nearest.upper <= reach_)) return none;
    const FaceId f = surface_.faces[nearest.triangle];
    const Plane& plane = brep_.plane(f);
    const int w = plane.dominant_axis();
    ExactPoint point;
    ExactRational sum(plane.offset());
    for (int k = 0; k < 3; ++k) {
        if (k == w) continue;
        auto& c = point[static_cast<std::size_t>(k)];
        c = exact_lattice_units(corner[static_cast<std::size_t>(k)]);
        sum += ExactRational(plane.normal(k)) * c;
    }
    point[static_cast<std::size_t>(w)] = -(sum / ExactRational(plane.normal(w)));
    return add(std::move(point), {f.index});
}

Place BoundaryPlaces::add(ExactPoint point, std::vector<std::uint32_t> faces) {
    const auto place = static_cast<Place>(at_.size());
    at_.push_back(to_grid(point, Lattice{0}));
    faces_.push_back(std::move(faces));
    Approximation rounded;
    for (std::size_t k = 0; k < 3; ++k) {
        rounded.c[k] = point[k].to_double();
        rounded.error = std::max(rounded.error, std::fabs(rounded.c[k]) * 0x1p-52 + 0x1p-1000);
    }
    extra_.push_back({std::move(point), rounded});
    return place;
}

ExactPoint BoundaryPlaces::exact(Place p) const {
    const std::size_t vertices = brep_.counts().vertices;
    if (p >= vertices) return extra_[p - vertices].point;
    const HomogeneousPoint h = brep_.point(VertexId(p)).homogeneous();
    const ExactRational weight(h.w);
    return {ExactRational(h.xyz[0]) / weight, ExactRational(h.xyz[1]) / weight,
            ExactRational(h.xyz[2]) / weight};
}

const Approximation& BoundaryPlaces::approximation(Place p) const {
    const std::size_t vertices = brep_.counts().vertices;
    if (p >= vertices) return extra_[p - vertices].approximation;
    return brep_.point(VertexId(p)).approximation();
}

int BoundaryPlaces::orientation(FaceId face, const std::array<Place, 3>& t) const {
    const Plane& plane = brep_.plane(face);
    if (std::max({t[0], t[1], t[2]}) < brep_.counts().vertices)
        return PlaneProjection(plane, brep_.points()).orientation(t[0], t[1], t[2]);
    const PlaneProjection::Axes axes = PlaneProjection::axes_of(plane);
    const int filtered = PlaneProjection::filtered_orientation(
        approximation(t[0]), approximation(t[1]), approximation(t[2]), axes);
    if (filtered != 0) return filtered;
    const auto u = static_cast<std::size_t>(axes.u);
    const auto v = static_cast<std::size_t>(axes.v);
    const ExactPoint a = exact(t[0]);
    const ExactPoint b = exact(t[1]);
    const ExactPoint c = exact(t[2]);
    return ((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u])).sign();
}

std::vector<Place> BoundaryPlaces::within(HalfedgeId h) const {
    std::vector<Place> out;
    const auto found = within_.find(first_copy(brep_, brep_.edge(h)));
    if (found == within_.end()) return out;
    for (const auto& [parameter, place] : found->second) out.push_back(place);
    if (place_of(brep_.origin(h)) > place_of(brep_.target(h))) std::reverse(out.begin(), out.end());
    return out;
}

}  // namespace trisect::detail
