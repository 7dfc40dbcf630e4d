// SPDX-License-Identifier: Apache-2.0
//
// Triangles here are parts of polygons in cells: sides may be walls of cells, or diagonals, and a
// point on one of those is nothing special of the boundary. So what meets at a point is put
// together by the point itself: by the corners of the features that meet, which are numbered by
// their exact places; then doubles distinguish most points, and rationals the rest. All triangles
// that contain a common point of the boundaries are in pairs that meet there, so the set at each
// point is complete, and the cones there (contact_cones.h) need nothing else.
//
// Every piece of either boundary that touches the other one has such a point in its closure,
// because the contact set is a complex of points, segments and polygons; the corners of the
// triangles' intersections are among its vertices.

#include <trisect/bsp/interference/tree/exact_contacts.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <trisect/bsp/interference/boxes/crossing_place.h>
#include <trisect/bsp/interference/relation/contact_cones.h>
#include <trisect/bsp/interference/tree/point_gap.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

bool contains(const std::vector<TriangleAt>& all, std::uint32_t triangle) {
    return std::ranges::any_of(all, [&](const TriangleAt& t) { return t.triangle == triangle; });
}

void add_once(std::vector<TriangleAt>& all, std::uint32_t triangle, Feature feature) {
    if (!contains(all, triangle)) all.push_back({triangle, feature});
}

}  // namespace

void ExactContacts::compare(const PolygonId& a, const PolygonId& b) {
    const std::uint32_t pa = a_.number_of(a);
    const std::uint32_t pb = b_.number_of(b);
    if (!compared_.insert({pa, pb}, 0).second) return;
    const ExactTriangles::Range of_a = a_.triangles_of(pa);
    const ExactTriangles::Range of_b = b_.triangles_of(pb);
    for (std::uint32_t i = of_a.begin; i < of_a.end; ++i)
        for (std::uint32_t j = of_b.begin; j < of_b.end; ++j) {
            const TriangleContact c = test_(a_[i].posed(), b_[j].posed());
            if (c.meets()) meetings_.push_back({i, j, c, {}, {}});
        }
}

PlaceName ExactContacts::place_name(std::uint32_t meeting, std::uint8_t point) {
    using Kind = PlaceName::Kind;
    const MeetingTriangles& m = meetings_[meeting];
    const MeetingPoint& p = m.contact.points[point];
    const auto side = [](ExactTriangles& of, std::uint32_t triangle, std::size_t i) {
        const std::uint32_t from = of.place_of(triangle, i);
        const std::uint32_t to = of.place_of(triangle, (i + 1) % 3);
        return std::array{std::min(from, to), std::max(from, to)};
    };
    if (p.a.is_corner()) return {Kind::CornerOfA, {a_.place_of(m.a, p.a.index())}};
    if (p.b.is_corner()) return {Kind::CornerOfB, {b_.place_of(m.b, p.b.index())}};
    if (p.a.is_side() && p.b.is_side()) {
        const auto of_a = side(a_, m.a, p.a.index());
        const auto of_b = side(b_, m.b, p.b.index());
        return {Kind::Sides, {of_a[0], of_a[1], of_b[0], of_b[1]}};
    }
    const bool is_of_a = p.a.is_side();
    const auto ends = is_of_a ? side(a_, m.a, p.a.index()) : side(b_, m.b, p.b.index());
    const std::uint32_t polygon = is_of_a ? b_[m.b].polygon : a_[m.a].polygon;
    return {is_of_a ? Kind::SideOfA : Kind::SideOfB, {ends[0], ends[1], polygon}};
}

// In A's lattice.
std::optional<Approximation> ExactContacts::approximate(const MeetingTriangles& m,
                                                        const MeetingPoint& p) const {
    const ExactTriangles::Triangle& a = a_[m.a];
    const ExactTriangles::Triangle& b = b_[m.b];
    if (p.a.is_corner()) return a.corner[p.a.index()].approximation();
    if (!poses_.to_a.has_doubles()) return std::nullopt;
    if (p.b.is_corner()) return poses_.to_a.move(b.corner[p.b.index()].approximation());
    TriangleCorners of_a;
    TriangleCorners of_b;
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Approximation& x = a.corner[i].approximation();
        const Approximation y = poses_.to_a.move(b.corner[i].approximation());
        of_a[i] = x.c;
        of_b[i] = y.c;
        error = std::max({error, x.error, y.error});
    }
    double g = 0;
    for (const auto& x : of_a)
        for (const auto& y : of_b) g = std::max(g, largest_component(minus(x, y)));
    const bool side_of_a = p.a.is_side();
    if (side_of_a && p.b.is_side()) {  // of flush triangles, too, whose planes are one
        const std::size_t i = p.a.index();
        const std::size_t j = p.b.index();
        const auto place =
            sides_crossing(of_a[i], of_a[(i + 1) % 3], of_b[j], of_b[(j + 1) % 3], 2 * g, error);
        if (place) return Approximation{place->at, place->error};
    }
    const TriangleCorners& t = side_of_a ? of_a : of_b;
    const std::size_t i = side_of_a ? p.a.index() : p.b.index();
    const auto place = side_in_plane(t[i], t[(i + 1) % 3], side_of_a ? of_b : of_a, 2 * g, error);
    if (!place) return std::nullopt;
    return Approximation{place->at, place->error};
}

MeetingPlace ExactContacts::place_at(std::uint32_t meeting, std::uint8_t point) {
    const MeetingTriangles& m = meetings_[meeting];
    MeetingPlace place{{}, 0, meeting, point};
    if (const auto known = approximate(m, m.contact.points[point])) {
        place.at = known->c;
        place.error = known->error;
        return place;
    }
    const ExactPlace& at = exact(place);
    for (std::size_t k = 0; k < 3; ++k) {
        place.at[k] = at.c[k].to_double();
        place.error =
            std::max(place.error, std::nextafter(unit_roundoff * std::fabs(place.at[k]), 1.0));
    }
    return place;
}

const ExactPlace& ExactContacts::exact(MeetingPlace& place) const {
    if (!place.exact) {
        const MeetingTriangles& m = meetings_[place.meeting];
        place.exact =
            place_of(a_[m.a].posed(), b_[m.b].posed(), poses_, m.contact.points[place.point]);
    }
    return *place.exact;
}

bool ExactContacts::are_same(MeetingPlace& p, MeetingPlace& q) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::fabs(p.at[k] - q.at[k]) > 1.001 * (p.error + q.error)) return false;
    if (p.error == 0 && q.error == 0) return true;
    return exact(p) == exact(q);
}

// Of incidences in the order of their names: a place for each name, by first coordinates, and one
// of all that are the same point.
void ExactContacts::unite(const std::vector<Incidence>& all) {
    struct Named {
        MeetingPlace place;
        std::size_t begin = 0;
        std::size_t end = 0;
    };
    std::vector<Named> named;
    for (std::size_t i = 0; i < all.size();) {
        std::size_t end = i + 1;
        while (end < all.size() && all[end].name == all[i].name) ++end;
        named.push_back({place_at(all[i].meeting, all[i].point), i, end});
        largest_error_ = std::max(largest_error_, named.back().place.error);
        i = end;
    }
    std::ranges::sort(named, [](const Named& p, const Named& q) {
        return std::tie(p.place.at[0], p.begin) < std::tie(q.place.at[0], q.begin);
    });
    std::size_t low = 0;  // places below are too far
    for (Named& n : named) {
        while (low < places_.size() && n.place.at[0] - places_[low].at[0] > 2.01 * largest_error_)
            ++low;
        std::size_t at = low;
        while (at < places_.size() && !are_same(places_[at], n.place)) ++at;
        if (at == places_.size()) places_.push_back(std::move(n.place));
        for (std::size_t i = n.begin; i < n.end; ++i) {
            MeetingTriangles& m = meetings_[all[i].meeting];
            m.places[all[i].point] = static_cast<std::uint32_t>(at);
            add_once(places_[at].a, m.a, m.contact.points[all[i].point].a);
            add_once(places_[at].b, m.b, m.contact.points[all[i].point].b);
        }
    }
}

void ExactContacts::find_places() {
    std::vector<Incidence> all;
    for (std::uint32_t m = 0; m < meetings_.size(); ++m)
        for (std::uint8_t k = 0; k < meetings_[m].contact.count; ++k)
            all.push_back({place_name(m, k), m, k});
    std::ranges::sort(all, [](const Incidence& p, const Incidence& q) {
        return std::tie(p.name, p.meeting, p.point) < std::tie(q.name, q.meeting, q.point);
    });
    unite(all);
    add_others();
}

// Places that both triangles of a pair contain, though none of the corners of what they have in
// common is there.
void ExactContacts::add_others() {
    const double slack = 1.001 * largest_error_;
    for (MeetingTriangles& m : meetings_) {
        const ExactTriangles::Triangle& t = a_[m.a];
        auto p = std::ranges::lower_bound(places_, t.lo[0] - slack, {},
                                          [](const MeetingPlace& q) { return q.at[0]; });
        for (; p != places_.end() && p->at[0] <= t.hi[0] + slack; ++p) {
            const auto number = static_cast<std::uint32_t>(p - places_.begin());
            const auto own = std::span(m.places).first(m.contact.count);
            if (std::ranges::find(own, number) != own.end()) continue;
            if (p->at[1] < t.lo[1] - slack || p->at[1] > t.hi[1] + slack ||
                p->at[2] < t.lo[2] - slack || p->at[2] > t.hi[2] + slack)
                continue;
            add_if_there(m, number);
        }
    }
}

// Doubles exclude nearly all.
bool ExactContacts::may_contain(const ExactTriangles::Triangle& t, const Approximation& at) {
    TriangleCorners corners;
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = t.corner[i].approximation().c;
        error = std::max(error, t.corner[i].approximation().error);
    }
    return !is_certainly_beyond(corners, error, at.c, at.error);
}

void ExactContacts::add_if_there(MeetingTriangles& meeting, std::uint32_t place) {
    MeetingPlace& p = places_[place];
    const ExactTriangles::Triangle& a = a_[meeting.a];
    const ExactTriangles::Triangle& b = b_[meeting.b];
    const bool has_a = contains(p.a, meeting.a);
    const bool has_b = contains(p.b, meeting.b);
    const Approximation at{p.at, p.error};
    if (!has_a && !may_contain(a, at)) return;
    if (!has_b && poses_.to_b.has_doubles() && !may_contain(b, poses_.to_b.move(at))) return;
    std::optional<Feature> in_a;
    std::optional<Feature> in_b;
    if (!has_a && !(in_a = feature_at(a.posed(), exact(p)))) return;
    if (!has_b && !(in_b = feature_at(b.posed(), moved(exact(p), poses_.to_b)))) return;
    if (in_a) p.a.push_back({meeting.a, *in_a});
    if (in_b) p.b.push_back({meeting.b, *in_b});
    meeting.others.push_back(place);
}

namespace {

std::vector<ConePart> cone_of(ExactTriangles& triangles, const std::vector<TriangleAt>& at) {
    std::vector<ConePart> cone;
    for (const TriangleAt& t : at) {
        ConePart part{triangles[t.triangle].posed(), {}, t.feature};
        for (std::size_t i = 0; i < 3; ++i) part.place[i] = triangles.place_of(t.triangle, i);
        cone.push_back(part);
    }
    return cone;
}

}  // namespace

BoundaryFlags ExactContacts::flags_at(const MeetingPlace& place) {
    return compare_cones(cone_of(a_, place.a), cone_of(b_, place.b), poses_, true);
}

BoundaryFlags ExactContacts::flags() {
    BoundaryFlags flags;
    flags.meet = !meetings_.empty();
    for (const MeetingTriangles& m : meetings_)
        if (m.contact.dimension() == 2) (m.contact.opposite ? flags.opposite : flags.same) = true;
    for (const MeetingPlace& p : places_) {
        if (flags.is_decided()) break;
        flags |= flags_at(p);
    }
    return flags;
}

}  // namespace trisect::detail
