// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/brep_index.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/lines/index_box.h>
#include <trisect/bsp/query/lines/index_handles.h>
#include <trisect/bsp/query/lines/index_nearest.h>
#include <trisect/bsp/query/lines/index_ray.h>
#include <trisect/bsp/query/lines/index_section.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::IndexBase;
using detail::IndexCore;
using detail::IndexLine;
using detail::IndexPoint;
using detail::PolygonId;

// A boundary that may cross itself is made free of that first.
Solid resolved(const Solid& solid) {
    return detail::state_of(solid)->embedded ? solid : evaluate(Expression(solid));
}

// All facets of one source in one leaf: then facets keep their numbers.
const detail::Source* only_source(const Solid& solid) {
    const detail::CellRef& root = detail::cut_state(solid)->root();
    if (root.complemented || !root.node->is_leaf()) return nullptr;
    const detail::Source* source = nullptr;
    std::uint32_t next = 0;
    for (const detail::PolygonRef r : root.node->polygons()) {
        if (next == 0) source = r.source;
        if (r.source != source || r.fragment != nullptr || r.flipped || r.facet != next++)
            return nullptr;
    }
    if (source == nullptr || source->is_half_space() || next != source->facet_count())
        return nullptr;
    return source;
}

void require_same(Lattice lattice, const Solid& solid) {
    if (detail::state_of(solid)->lattice_matters && lattice != solid.lattice())
        throw UsageError("a plane in units of 2^" + std::to_string(lattice.exponent) +
                         " for a solid in units of 2^" + std::to_string(solid.lattice().exponent));
}

// Of a point on these polygons.
Place named(const IndexCore& core, const IndexPoint& point, std::vector<PolygonId>& on) {
    Place place = detail::place_on(core.polygons(), on, point);
    if (core.handles) core.handles->name(core, place, on, point);
    return place;
}

Place located(const IndexCore& core, const IndexPoint& point, std::vector<PolygonId>& on) {
    Place place;
    place.location = detail::locate_polygons(*core.base, point, on);
    return place.is_on_boundary() ? named(core, point, on) : place;
}

template <class T>
void sort_unique(std::vector<T>& v) {
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
}

IndexCell to_cell(const IndexCore& core, const detail::IndexTree::Cell& c,
                  const detail::DoubleBox& cell) {
    return {cell.lo, cell.hi, core.tree().leaf(c.leaf).count, false};
}

}  // namespace

namespace detail {

IndexBase::IndexBase(const Solid& s) : solid(resolved(s)) {
    const auto start = std::chrono::steady_clock::now();
    if (const Source* source = only_source(solid)) polygons = IndexPolygons(*source);
    tree = IndexTree(*detail::cut_state(solid), polygons);
    std::vector<PolygonId> on;
    tree.set_inside_beyond(locate_polygons(*this, IndexPoint(tree.lo()), on) == Location::Inside);
    build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace detail

const char* to_string(Location location) {
    switch (location) {
        case Location::Outside:
            return "outside";
        case Location::OnFace:
            return "face";
        case Location::OnEdge:
            return "edge";
        case Location::OnVertex:
            return "vertex";
        case Location::Inside:
            return "inside";
    }
    return "";
}

BrepIndex::BrepIndex(const Solid& solid) {
    auto core = std::make_shared<IndexCore>();
    core->base = std::make_shared<const IndexBase>(solid);
    core_ = std::move(core);
}

const IndexCore& BrepIndex::empty_core() {
    // Never destroyed: it may be used after main().
    static const auto& empty = *new BrepIndex(Solid());
    return *empty.core_;
}

BrepIndex BrepIndex::with_brep() const {
    if (core().handles) return *this;
    auto with = std::make_shared<IndexCore>();
    with->base = core().base;
    with->handles = std::make_shared<const detail::IndexHandles>(*with->base);
    return BrepIndex(std::shared_ptr<const IndexCore>(std::move(with)));
}

void BrepIndex::refine() const { core().tree().divide_all(); }

const Solid& BrepIndex::solid() const { return core().base->solid; }
bool BrepIndex::has_brep() const { return core().handles != nullptr; }

const Brep& BrepIndex::brep() const {
    TRISECT_EXPECTS(has_brep(), "an index without B-rep was asked for it");
    return core().handles->brep();
}

IndexStats BrepIndex::stats() const {
    const detail::IndexTree& tree = core().tree();
    IndexStats s;
    s.polygons = core().polygons().size();
    const detail::IndexTree::Stats t = tree.stats();
    s.nodes = t.nodes;
    s.mixed_leaves = t.mixed;
    s.empty_leaves = t.empty;
    s.pending_cells = t.pending;
    s.listed = t.listed;
    s.depth = t.depth;
    s.bytes = t.bytes + core().polygons().bytes();
    if (core().handles) s.bytes += core().handles->bytes();
    if (s.polygons != 0)
        s.bytes_per_polygon = static_cast<double>(s.bytes) / static_cast<double>(s.polygons);
    s.build_seconds = core().base->build_seconds;
    if (core().handles) s.brep_seconds = core().handles->seconds();
    return s;
}

Place BrepIndex::locate(const std::array<double, 3>& point) const {
    std::vector<PolygonId> on;
    return located(core(), IndexPoint::from_user(point, solid().lattice()), on);
}

Place BrepIndex::locate(std::initializer_list<double> point) const {
    if (point.size() != 3) throw UsageError("a point of other than three coordinates");
    return locate(Point3d{point.begin()[0], point.begin()[1], point.begin()[2]});
}
Place BrepIndex::locate(const LatticePoint& point) const {
    std::vector<PolygonId> on;
    return located(core(), IndexPoint(point), on);
}

Place BrepIndex::locate(const Point& point) const {
    std::vector<PolygonId> on;
    return located(core(), IndexPoint(point), on);
}

Place BrepIndex::locate(const std::array<ExactRational, 3>& point) const {
    std::vector<PolygonId> on;
    IndexPoint::Rational p = point;
    for (ExactRational& x : p) x = x.scaled(-solid().lattice().exponent);
    return located(core(), IndexPoint(std::move(p)), on);
}

std::vector<Place> BrepIndex::locate(std::span<const std::array<double, 3>> points,
                                     unsigned threads) const {
    std::vector<Place> places(points.size());
    detail::locate_batch(
        *core().base, points, threads,
        [&](std::uint32_t i, Location l, const IndexPoint* p, std::vector<PolygonId>& on) {
            places[i].location = l;
            if (l == Location::OnFace) places[i] = named(core(), *p, on);
        });
    return places;
}

void BrepIndex::classify(std::span<const std::array<double, 3>> points, std::span<Location> results,
                         unsigned threads) const {
    if (points.size() != results.size()) throw UsageError("as many results as points are needed");
    detail::classify_batch(*core().base, points, threads, results);
}

std::optional<RayHit> BrepIndex::first_hit(const Ray& ray) const {
    return detail::first_hit(core(), IndexLine(ray, solid().lattice()));
}
std::optional<RayHit> BrepIndex::first_hit(const Segment& segment) const {
    return detail::first_hit(core(), IndexLine(segment, solid().lattice()));
}
std::optional<FacetHit> BrepIndex::first_facet(const Ray& ray) const {
    return detail::first_facet(core(), IndexLine(ray, solid().lattice()));
}
std::optional<FacetHit> BrepIndex::first_facet(const Segment& segment) const {
    return detail::first_facet(core(), IndexLine(segment, solid().lattice()));
}
std::vector<RayHit> BrepIndex::all_hits(const Ray& ray) const {
    return detail::all_hits(core(), IndexLine(ray, solid().lattice()));
}
std::vector<RayHit> BrepIndex::all_hits(const Segment& segment) const {
    return detail::all_hits(core(), IndexLine(segment, solid().lattice()));
}

std::optional<Nearest> BrepIndex::nearest(const std::array<double, 3>& point) const {
    return detail::nearest(core(), IndexPoint::from_user(point, solid().lattice()),
                           detail::NearestKind::Boundary);
}
std::optional<Nearest> BrepIndex::nearest_edge(const std::array<double, 3>& point) const {
    return detail::nearest(core(), IndexPoint::from_user(point, solid().lattice()),
                           detail::NearestKind::Edge);
}
std::optional<Nearest> BrepIndex::nearest_vertex(const std::array<double, 3>& point) const {
    return detail::nearest(core(), IndexPoint::from_user(point, solid().lattice()),
                           detail::NearestKind::Vertex);
}

std::optional<NearestBounds> BrepIndex::distance(const std::array<double, 3>& point) const {
    return detail::distance(core(), IndexPoint::from_user(point, solid().lattice()));
}

std::optional<SignedDistance> BrepIndex::signed_distance(const std::array<double, 3>& point) const {
    auto found = nearest(point);
    if (!found) return std::nullopt;
    const IndexPoint p = IndexPoint::from_user(point, solid().lattice());
    std::vector<PolygonId> on;
    const Location l = detail::locate_polygons(*core().base, p, on);
    const int sign = l == Location::Inside ? -1 : (l == Location::Outside ? 1 : 0);
    return SignedDistance{sign, std::move(*found)};
}

std::vector<SectionRegion> BrepIndex::section(const std::array<double, 4>& plane) const {
    return detail::section(core(), plane_on_lattice(plane, solid().lattice()));
}
std::vector<SectionRegion> BrepIndex::section(const Plane& plane, Lattice lattice) const {
    require_same(lattice, solid());
    return detail::section(core(), plane);
}
PlaneRelation BrepIndex::relation_to(const std::array<double, 4>& plane) const {
    return detail::relation_to(core(), plane_on_lattice(plane, solid().lattice()));
}
PlaneRelation BrepIndex::relation_to(const Plane& plane, Lattice lattice) const {
    require_same(lattice, solid());
    return detail::relation_to(core(), plane);
}

BoxEntities BrepIndex::in_box(const std::array<double, 3>& lo,
                              const std::array<double, 3>& hi) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (!(lo[k] <= hi[k])) throw UsageError("a box whose lower end is above its upper one");
    const Lattice lattice = solid().lattice();
    const IndexPoint low = IndexPoint::from_user(lo, lattice);
    const IndexPoint high = IndexPoint::from_user(hi, lattice);
    BoxEntities out;
    for (const PolygonId id : detail::polygons_in_box(*core().base, low, high)) {
        out.faces.push_back(core().polygons().face_source(id));
        if (core().handles) out.face_ids.push_back(core().handles->face_of(id));
    }
    sort_unique(out.faces);
    sort_unique(out.face_ids);
    if (!core().handles) return out;
    // An edge that meets the box is one of a face that does.
    const Brep& b = brep();
    for (const FaceId f : out.face_ids)
        for (const HalfedgeId h : b.halfedges(f)) {
            out.edge_ids.push_back(b.edge(h));
            out.vertex_ids.push_back(b.origin(h));
        }
    sort_unique(out.edge_ids);
    sort_unique(out.vertex_ids);
    std::erase_if(out.vertex_ids,
                  [&](VertexId v) { return !detail::is_in_box(b.point(v), low, high); });
    std::erase_if(out.edge_ids, [&](EdgeId e) {
        const HalfedgeId h = b.halfedge(e);
        return !detail::meets_box(b.point(b.origin(h)), b.point(b.target(h)), low, high);
    });
    return out;
}

std::vector<IndexCell> BrepIndex::cells(FaceId face) const {
    TRISECT_EXPECTS(has_brep(), "cells of an entity need the B-rep");
    std::vector<IndexCell> out;
    const auto polygons = core().handles->polygons_of(face);
    detail::for_leaves(
        core().tree(),
        [&](const detail::DoubleBox& cell) {
            return std::any_of(polygons.begin(), polygons.end(), [&](PolygonId id) {
                return cell.overlaps(core().polygons().bounds(id));
            });
        },
        [&](const detail::IndexTree::Cell& c, const detail::DoubleBox& cell) {
            if (!c.is_mixed()) return;
            const auto listed = core().tree().listed(core().tree().leaf(c.leaf));
            if (std::any_of(listed.begin(), listed.end(),
                            [&](PolygonId id) { return core().handles->face_of(id) == face; }))
                out.push_back(to_cell(core(), c, cell));
        });
    return out;
}

std::vector<IndexCell> BrepIndex::cells(EdgeId edge) const {
    TRISECT_EXPECTS(has_brep(), "cells of an entity need the B-rep");
    const Brep& b = brep();
    const HalfedgeId h = b.halfedge(edge);
    const detail::DoubleBox box = detail::hull(b.point(b.origin(h)), b.point(b.target(h)));
    std::vector<IndexCell> out;
    detail::for_leaves(
        core().tree(), [&](const detail::DoubleBox& cell) { return cell.overlaps(box); },
        [&](const detail::IndexTree::Cell& c, const detail::DoubleBox& cell) {
            if (!c.is_mixed()) return;
            const auto edges = core().handles->edges_in(c.leaf);
            if (std::find(edges.begin(), edges.end(), edge) != edges.end())
                out.push_back(to_cell(core(), c, cell));
        });
    return out;
}

std::vector<IndexCell> BrepIndex::cells(VertexId vertex) const {
    TRISECT_EXPECTS(has_brep(), "cells of an entity need the B-rep");
    const Point& p = brep().point(vertex);
    const detail::DoubleBox box = detail::hull(p, p);
    std::vector<IndexCell> out;
    detail::for_leaves(
        core().tree(), [&](const detail::DoubleBox& cell) { return cell.overlaps(box); },
        [&](const detail::IndexTree::Cell& c, const detail::DoubleBox& cell) {
            if (!c.is_mixed()) return;
            const auto vertices = core().handles->vertices_in(c.leaf);
            if (std::find(vertices.begin(), vertices.end(), vertex) != vertices.end())
                out.push_back(to_cell(core(), c, cell));
        });
    return out;
}

IndexCell BrepIndex::cell_at(const std::array<double, 3>& point) const {
    return detail::cell_at(*core().base, IndexPoint::from_user(point, solid().lattice()));
}

}  // namespace trisect
