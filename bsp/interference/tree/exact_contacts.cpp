// SPDX-License-Identifier: Apache-2.0
//
// Triangles here are parts of polygons in cells: sides may be walls of cells, or diagonals, and a
// point on one of those is nothing special of the boundary. So no name of a side counts. What meets
// at a point is put together by the point itself: doubles distinguish most of them, rationals the
// rest. All triangles that contain a common point of the boundaries are in pairs that meet there,
// so the set at each point is complete, and the cones there (contact_cones.h) need nothing else.
//
// Every piece of either boundary that touches the other one has such a point in its closure,
// because the contact set is a complex of points, segments and polygons; the corners of the
// triangles' intersections are among its vertices.

#include <trisect/bsp/interference/tree/exact_contacts.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/relation/contact_cones.h>
#include <trisect/kernel/number/error_bounds.h>

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

ExactPlace ExactContacts::exact_place_of(const Incidence& i) const {
    const MeetingTriangles& m = meetings_[i.meeting];
    return place_of(a_[m.a].posed(), b_[m.b].posed(), poses_, m.contact.points[i.point]);
}

ExactContacts::Incidence ExactContacts::incidence(std::uint32_t meeting, std::uint8_t point) const {
    const MeetingTriangles& m = meetings_[meeting];
    const MeetingPoint& p = m.contact.points[point];
    Incidence out{{}, 0, meeting, point};
    std::optional<Approximation> known;
    if (p.a.is_corner())
        known = a_[m.a].corner[p.a.index()].approximation();
    else if (p.b.is_corner() && poses_.to_a.has_doubles())
        known = poses_.to_a.move(b_[m.b].corner[p.b.index()].approximation());
    if (known) {
        out.at = known->c;
        out.error = known->error;
        return out;
    }
    const ExactPlace place = exact_place_of(out);
    for (std::size_t k = 0; k < 3; ++k) {
        out.at[k] = place.c[k].to_double();
        out.error = std::max(out.error, std::nextafter(unit_roundoff * std::fabs(out.at[k]), 1.0));
    }
    return out;
}

const ExactPlace& ExactContacts::exact(MeetingPlace& place, const Incidence& of) {
    if (!place.exact) place.exact = exact_place_of(of);
    return *place.exact;
}

bool ExactContacts::is_at(MeetingPlace& place, const Incidence& first, const Incidence& other) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::fabs(place.at[k] - other.at[k]) > 1.001 * (place.error + other.error))
            return false;
    if (place.error == 0 && other.error == 0) return true;
    return exact(place, first) == exact_place_of(other);
}

// Incidences by their first coordinates; each one goes to a place that is there, or is a new one.
void ExactContacts::unite(std::vector<Incidence>& all) {
    std::ranges::sort(all, [](const Incidence& p, const Incidence& q) {
        return std::tie(p.at[0], p.meeting, p.point) < std::tie(q.at[0], q.meeting, q.point);
    });
    for (const Incidence& i : all) largest_error_ = std::max(largest_error_, i.error);
    std::vector<std::uint32_t> first;  // incidence of each place
    std::size_t low = 0;               // places below are too far
    for (std::uint32_t n = 0; n < all.size(); ++n) {
        const Incidence& i = all[n];
        while (low < places_.size() && i.at[0] - places_[low].at[0] > 2.01 * largest_error_) ++low;
        std::size_t at = low;
        while (at < places_.size() && !is_at(places_[at], all[first[at]], i)) ++at;
        if (at == places_.size()) {
            places_.push_back({i.at, i.error, {}, {}, {}});
            first.push_back(n);
        }
        MeetingTriangles& m = meetings_[i.meeting];
        m.places[i.point] = static_cast<std::uint32_t>(at);
        add_once(places_[at].a, m.a, m.contact.points[i.point].a);
        add_once(places_[at].b, m.b, m.contact.points[i.point].b);
    }
    for (std::size_t p = 0; p < places_.size(); ++p) (void)exact(places_[p], all[first[p]]);
}

void ExactContacts::find_places() {
    std::vector<Incidence> all;
    for (std::uint32_t m = 0; m < meetings_.size(); ++m)
        for (std::uint8_t k = 0; k < meetings_[m].contact.count; ++k)
            all.push_back(incidence(m, k));
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

void ExactContacts::add_if_there(MeetingTriangles& meeting, std::uint32_t place) {
    MeetingPlace& p = places_[place];
    const bool has_a = contains(p.a, meeting.a);
    const bool has_b = contains(p.b, meeting.b);
    if (!has_a) {
        const auto at = feature_at(a_[meeting.a].posed(), *p.exact);
        if (!at) return;
        if (!has_b) {
            const auto at_b = feature_at(b_[meeting.b].posed(), moved(*p.exact, poses_.to_b));
            if (!at_b) return;
            p.b.push_back({meeting.b, *at_b});
        }
        p.a.push_back({meeting.a, *at});
    } else if (!has_b) {
        const auto at = feature_at(b_[meeting.b].posed(), moved(*p.exact, poses_.to_b));
        if (!at) return;
        p.b.push_back({meeting.b, *at});
    }
    meeting.others.push_back(place);
}

namespace {

// Corners with numbers, equal ones at the same place.
class CornerNumbers {
public:
    [[nodiscard]] std::uint32_t of(const Point& p) {
        for (std::uint32_t i = 0; i < points_.size(); ++i)
            if (*points_[i] == p) return i;
        points_.push_back(&p);
        return static_cast<std::uint32_t>(points_.size() - 1);
    }

private:
    std::vector<const Point*> points_;
};

std::vector<ConePart> cone_of(const ExactTriangles& triangles, const std::vector<TriangleAt>& at) {
    CornerNumbers numbers;
    std::vector<ConePart> cone;
    for (const TriangleAt& t : at) {
        ConePart part{triangles[t.triangle].posed(), {}, t.feature};
        for (std::size_t i = 0; i < 3; ++i) part.place[i] = numbers.of(*part.triangle.corner[i]);
        cone.push_back(part);
    }
    return cone;
}

}  // namespace

BoundaryFlags ExactContacts::flags_at(const MeetingPlace& place) const {
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
