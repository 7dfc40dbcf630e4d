// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/brep_index.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/lines/index_box.h>
#include <trisect/bsp/query/lines/index_handles.h>
#include <trisect/bsp/query/lines/index_nearest.h>
#include <trisect/bsp/query/lines/index_ray.h>
#include <trisect/bsp/query/lines/index_section.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect {

namespace {

using detail::DoubleBox;
using detail::IndexBase;
using detail::IndexCore;
using detail::IndexedLeaf;
using detail::IndexLine;
using detail::IndexPoint;
using detail::PolygonId;

void require_same(Lattice lattice, const Solid& solid) {
    if (detail::state_of(solid)->lattice_matters && lattice != solid.lattice())
        throw UsageError("a plane in units of 2^" + std::to_string(lattice.exponent) +
                         " for a solid in units of 2^" + std::to_string(solid.lattice().exponent));
}

// Of a point on these polygons.
Place named(const IndexCore& core, const IndexPoint& point, std::vector<PolygonId>& on) {
    Place place = detail::place_on(on, point);
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

// The mixed cells in whose boxes `enter` holds and that are wanted.
template <class Enter, class Wanted>
std::vector<IndexCell> mixed_cells(const IndexCore& core, const Enter& enter,
                                   const Wanted& wanted) {
    std::vector<IndexCell> out;
    detail::for_mixed_cells(
        *core.base, enter,
        [&](const detail::LeafInTree& leaf, const IndexedLeaf::Cell& c, const DoubleBox& box) {
            const IndexedLeaf& index = leaf.index();
            if (wanted(index, c, leaf.turned))
                out.push_back({box.lo, box.hi, index.leaf(c.leaf).count, false});
        });
    return out;
}

}  // namespace

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

void BrepIndex::refine() const {
    detail::for_tree_leaves(
        *core().base, [](const DoubleBox&) { return true; },
        [](const detail::LeafInTree& leaf) {
            if (leaf.node.size() != 0) leaf.index().divide_all();
        });
}

const Solid& BrepIndex::solid() const { return core().base->solid(); }
bool BrepIndex::has_brep() const { return core().handles != nullptr; }

const Brep& BrepIndex::brep() const {
    TRISECT_EXPECTS(has_brep(), "an index without B-rep was asked for it");
    return core().handles->brep();
}

IndexStats BrepIndex::stats() const {
    IndexStats s;
    const auto walk = [&](const auto& self, const detail::CellNode& node,
                          std::size_t depth) -> void {
        const detail::CellNode& n = detail::refined(node);
        ++s.nodes;
        s.depth = std::max(s.depth, depth);
        if (!n.is_leaf()) {
            detail::with_enough_stack([&] {
                self(self, *n.child(0).node, depth + 1);
                self(self, *n.child(1).node, depth + 1);
            });
            return;
        }
        const detail::NodeFact* const fact = n.index_fact().get();
        if (n.size() == 0) ++s.empty_leaves;
        if (fact == nullptr) {
            if (n.size() != 0) ++s.pending_cells;
            s.polygons += n.size();
            return;
        }
        const IndexedLeaf& leaf = static_cast<const IndexedLeaf&>(*fact);
        const IndexedLeaf::Stats t = leaf.stats();
        if (!leaf.is_divided()) ++s.pending_cells;
        s.polygons += leaf.polygons().size();
        s.nodes += t.nodes;
        s.mixed_leaves += t.mixed;
        s.empty_leaves += t.empty;
        s.pending_cells += t.pending;
        s.listed += t.listed;
        s.depth = std::max(s.depth, depth + t.depth);
        s.bytes += t.bytes;
    };
    walk(walk, *core().base->root().node, 0);
    if (core().handles) s.bytes += core().handles->bytes();
    if (s.polygons != 0)
        s.bytes_per_polygon = static_cast<double>(s.bytes) / static_cast<double>(s.polygons);
    s.build_seconds = core().base->build_seconds();
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
    for (const PolygonId& id : detail::polygons_in_box(*core().base, low, high)) {
        out.faces.push_back(id.face_source());
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
    const auto polygons = core().handles->polygons_of(face);
    return mixed_cells(
        core(),
        [&](const DoubleBox& cell) {
            return std::any_of(polygons.begin(), polygons.end(),
                               [&](const PolygonId& id) { return cell.overlaps(id.bounds()); });
        },
        [&](const IndexedLeaf& index, const IndexedLeaf::Cell& c, bool turned) {
            const auto listed = index.listed(index.leaf(c.leaf));
            return std::any_of(listed.begin(), listed.end(), [&](IndexedLeaf::Id id) {
                return core().handles->face_of({&index, id, turned}) == face;
            });
        });
}

std::vector<IndexCell> BrepIndex::cells(EdgeId edge) const {
    TRISECT_EXPECTS(has_brep(), "cells of an entity need the B-rep");
    const Brep& b = brep();
    const HalfedgeId h = b.halfedge(edge);
    const DoubleBox box = detail::hull(b.point(b.origin(h)), b.point(b.target(h)));
    return mixed_cells(
        core(), [&](const DoubleBox& cell) { return cell.overlaps(box); },
        [&](const IndexedLeaf& index, const IndexedLeaf::Cell& c, bool) {
            const auto edges = core().handles->edges_in(index, c);
            return std::find(edges.begin(), edges.end(), edge) != edges.end();
        });
}

std::vector<IndexCell> BrepIndex::cells(VertexId vertex) const {
    TRISECT_EXPECTS(has_brep(), "cells of an entity need the B-rep");
    const Point& p = brep().point(vertex);
    const DoubleBox box = detail::hull(p, p);
    return mixed_cells(
        core(), [&](const DoubleBox& cell) { return cell.overlaps(box); },
        [&](const IndexedLeaf& index, const IndexedLeaf::Cell& c, bool) {
            const auto vertices = core().handles->vertices_in(index, c);
            return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
        });
}

IndexCell BrepIndex::cell_at(const std::array<double, 3>& point) const {
    return detail::cell_at(*core().base, IndexPoint::from_user(point, solid().lattice()));
}

}  // namespace trisect
