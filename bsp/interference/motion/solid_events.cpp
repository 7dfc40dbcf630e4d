// SPDX-License-Identifier: Apache-2.0
//
// Triangles here are those of fans that fill polygons clipped to their cells. Sides of polygons may
// be walls of cells and corners may be on nothing but walls; all of them are of the boundary, so an
// event there is a contact, and only diagonals can be left out as they are in models. What a model
// has is here, too: its vertices are corners of polygons, and of its edges each point is inside of
// a side or a corner of polygons. Where two edges cross at a corner that a wall made on one of
// them, that corner arrives in a polygon at the other edge: not in both planes there for good,
// since then the edges would have been coplanar for good. So all times of events of the model are
// found, and further ones (a wall's corner that slides over an edge) do no harm: the first contact
// cannot be earlier than it is, and whether interiors meet after an event is found by a static
// query anyway.
//
// Doubles are those of the exact corners, not of the corners that boxes are around: fans of these
// may begin elsewhere. Boxes of either contain the whole polygon within their errors, so a search
// comes to all polygons that meet, and looks at all triangles of both.
//
// A corner or side belongs to the first polygon that has it and is made, whichever that is: all
// polygons that have it are looked at when something arrives there. Equal ones are recognized where
// their coordinates are doubles; others, corners that operations made, are looked at once for each
// polygon that has them.

#include <trisect/bsp/interference/motion/solid_events.h>

#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/tree/entity_names.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

std::array<std::uint64_t, 3> place_of(const Point& p) {
    const LatticePoint& x = p.lattice();
    return {x.x.bits(), x.y.bits(), x.z.bits()};
}

MpzVector normal_of(const PolygonId& p) {
    const Plane plane = p.support();
    return {to_gmp(plane.normal(0)), to_gmp(plane.normal(1)), to_gmp(plane.normal(2))};
}

// Of the line that planes have in common; 0 where all of them are parallel.
MpzVector direction_of(const std::vector<PolygonId>& polygons) {
    MpzVector r;
    for (const PolygonId& p : polygons) {
        r = cross(normal_of(polygons.front()), normal_of(p));
        if (r != MpzVector{}) break;
    }
    return r;
}

}  // namespace

std::size_t SolidEvents::Hash::operator()(const Place& p) const {
    return mix64(mix64(mix64(p[0]) + p[1]) + p[2]);
}

std::size_t SolidEvents::Hash::operator()(const Ends& e) const {
    return mix64(operator()(e[0]) + 3 * operator()(e[1]));
}

EventModel::Range SolidEvents::triangles_of(std::uint32_t part) {
    const ExactTriangles::Range made = exact_.triangles_of(part);
    const Range fan{made.begin, made.end};
    // Numbers count up, so what was made just now is at the end.
    if (fan.end > done_) own(fan);
    return fan;
}

void SolidEvents::own(const Range& fan) {
    resize(fan.end);
    done_ = fan.end;
    if (fan.begin == fan.end) return;
    const bool turned = exact_.polygon(exact_[fan.begin].polygon).is_flipped();
    for (std::uint32_t t = fan.begin; t < fan.end; ++t) {
        const bool is_first = t == fan.begin;
        const bool is_last = t + 1 == fan.end;
        // Side 1 is of the polygon; the other two are diagonals but at the ends of the fan.
        if (is_first) {
            own_vertex(t, 0);
            own_vertex(t, turned ? 2 : 1);
        }
        own_vertex(t, turned ? 1 : 2);
        own_edge(t, 1);
        if (is_first) own_edge(t, turned ? 2 : 0);
        if (is_last) own_edge(t, turned ? 0 : 2);
    }
}

void SolidEvents::own_vertex(std::uint32_t t, std::size_t i) {
    const Point& p = point(t, i);
    if (!p.is_lattice() || vertices_.insert(place_of(p)).second) set_owns_vertex(t, i);
}

void SolidEvents::own_edge(std::uint32_t t, std::size_t i) {
    const Point& p = point(t, i);
    const Point& q = point(t, (i + 1) % 3);
    if (p.is_lattice() && q.is_lattice()) {
        Ends ends{place_of(p), place_of(q)};
        if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
        if (!edges_.insert(ends).second) return;
    }
    set_owns_edge(t, i);
}

EventModel::Corners SolidEvents::corners(std::uint32_t t) const {
    Corners r;
    for (std::size_t i = 0; i < 3; ++i) {
        const Approximation& x = exact_[t].corner[i].approximation();
        for (std::size_t k = 0; k < 3; ++k) r[i][k] = Ball(x.c[k], x.error);
    }
    return r;
}

std::vector<PolygonId> SolidEvents::polygons_at(const IndexPoint& point) const {
    std::vector<PolygonId> on;
    (void)locate_in_leaves(solid_.base(), point, on);
    return on;
}

// A side may be a part of an edge, or within a face: what is at its middle says which.
SolidEvents::Entity SolidEvents::entity_of(const ContactFeature& feature) const {
    const ExactTriangles::Triangle& t = exact_[feature.triangle];
    if (feature.feature.is_interior()) {
        std::vector<PolygonId> face{exact_.polygon(t.polygon)};
        return {name_of(place_on(face)), {}};
    }
    const std::size_t i = feature.feature.index();
    ExactPlace at = exact_place(t.corner[i]);
    if (feature.feature.is_side()) {
        const ExactPlace end = exact_place(t.corner[(i + 1) % 3]);
        for (std::size_t k = 0; k < 3; ++k) at.c[k] = (at.c[k] + end.c[k]) / ExactRational(2);
    }
    const IndexPoint point(at.c);
    std::vector<PolygonId> on = polygons_at(point);
    return {name_of(place_on(on, point)), {t.corner[i], direction_of(on)}};
}

}  // namespace trisect::detail
