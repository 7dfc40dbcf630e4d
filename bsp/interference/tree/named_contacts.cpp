// SPDX-License-Identifier: Apache-2.0
//
// What entity a point of a contact is on follows from the polygons that contain it (place_on): in
// one plane a face, through one line an edge, else a vertex. Of a segment it is the same for all
// inner points between two neighbouring meeting places on it, and polygons that contain both of
// these contain all between them.

#include <algorithm>
#include <iterator>
#include <tuple>

#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/bsp/interference/tree/entity_names.h>
#include <trisect/bsp/interference/tree/exact_contacts.h>
#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

namespace {

std::vector<PolygonId> polygons_of(const ExactTriangles& triangles,
                                   const std::vector<TriangleAt>& at) {
    std::vector<PolygonId> out;
    for (const TriangleAt& t : at) out.push_back(triangles.polygon(triangles[t.triangle].polygon));
    sort_unique(out);
    return out;
}

bool are_on_one_line(const ExactPlace& p, const ExactPlace& q, const ExactPlace& r) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if ((q.c[i] - p.c[i]) * (r.c[j] - p.c[j]) != (q.c[j] - p.c[j]) * (r.c[i] - p.c[i]))
            return false;
    }
    return true;
}

}  // namespace

// A corner of a source is looked for at vertices alone.
EntityName ExactContacts::name_at(MeetingPlace& place, bool of_a) const {
    std::vector<PolygonId> on = of_a ? polygons_of(a_, place.a) : polygons_of(b_, place.b);
    if (const EntityName name = name_of(place_on(on)); name.kind != EntityName::Kind::Vertex)
        return name;
    const ExactTriangles& triangles = of_a ? a_ : b_;
    for (const TriangleAt& t : of_a ? place.a : place.b)
        if (t.feature.is_corner())
            return name_of(
                place_on(on, IndexPoint(triangles[t.triangle].corner[t.feature.index()])));
    const ExactPlace at = of_a ? exact(place) : moved(exact(place), poses_.to_b);
    return name_of(place_on(on, IndexPoint(at.c)));
}

std::vector<PolygonId> ExactContacts::common_polygons(std::uint32_t p, std::uint32_t q,
                                                      bool of_a) const {
    const auto of = [&](std::uint32_t place) {
        return of_a ? polygons_of(a_, places_[place].a) : polygons_of(b_, places_[place].b);
    };
    const std::vector<PolygonId> at_p = of(p);
    const std::vector<PolygonId> at_q = of(q);
    std::vector<PolygonId> out;
    std::ranges::set_intersection(at_p, at_q, std::back_inserter(out), std::less<PolygonId>());
    return out;
}

void ExactContacts::add_segment(const MeetingTriangles& m, std::uint32_t from, std::uint32_t to,
                                std::vector<NamedContact>& out) {
    std::vector<std::uint32_t> on{from, to};
    const auto between = [&](std::uint32_t p) {
        const ExactPlace& x = exact(places_[p]);
        const ExactPlace& a = exact(places_[from]);
        const ExactPlace& b = exact(places_[to]);
        const auto& [low, high] = std::minmax(a, b);
        return low < x && x < high && are_on_one_line(a, b, x);
    };
    for (std::size_t k = 0; k < m.contact.count; ++k)
        if (m.places[k] != from && m.places[k] != to && between(m.places[k]))
            on.push_back(m.places[k]);
    for (const std::uint32_t p : m.others)
        if (between(p)) on.push_back(p);
    if (on.size() > 2)
        std::ranges::sort(on, [this](std::uint32_t p, std::uint32_t q) {
            return exact(places_[p]) < exact(places_[q]);
        });
    for (std::size_t i = 1; i < on.size(); ++i) {
        std::vector<PolygonId> on_a = common_polygons(on[i - 1], on[i], true);
        std::vector<PolygonId> on_b = common_polygons(on[i - 1], on[i], false);
        out.push_back({name_of(place_on(on_a)), name_of(place_on(on_b)), 1, false});
    }
}

void ExactContacts::add_segments(const MeetingTriangles& m, std::vector<NamedContact>& out) {
    const TriangleContact& c = m.contact;
    for (std::size_t i = 0; i < c.count; ++i)
        for (std::size_t j = i + 1; j < c.count; ++j) {
            // Corners of a polygon are neighbours where a side of one triangle carries both.
            const Feature a = feature_between(c.points[i].a, c.points[j].a);
            const Feature b = feature_between(c.points[i].b, c.points[j].b);
            if (c.count == 2 || a.is_side() || b.is_side())
                add_segment(m, m.places[i], m.places[j], out);
        }
}

std::vector<NamedContact> ExactContacts::contacts() {
    std::vector<NamedContact> all;
    for (MeetingPlace& p : places_) {
        const NamedContact c{name_at(p, true), name_at(p, false), 0, false};
        // Insides of faces have more than a point in common, here under the names of other faces in
        // the same planes.
        if (c.a.kind != EntityName::Kind::Face || c.b.kind != EntityName::Kind::Face)
            all.push_back(c);
    }
    for (const MeetingTriangles& m : meetings_) {
        add_segments(m, all);
        if (m.contact.count < 3) continue;
        std::vector<PolygonId> on_a{a_.polygon(a_[m.a].polygon)};
        std::vector<PolygonId> on_b{b_.polygon(b_[m.b].polygon)};
        all.push_back({name_of(place_on(on_a)), name_of(place_on(on_b)), 2, m.contact.opposite});
    }
    // Of each pair of entities the largest dimension.
    std::ranges::sort(all, [](const NamedContact& x, const NamedContact& y) {
        return std::tie(x.a, x.b, y.dimension) < std::tie(y.a, y.b, x.dimension);
    });
    const auto same_pair = [](const NamedContact& x, const NamedContact& y) {
        return x.a == y.a && x.b == y.b;
    };
    all.erase(std::unique(all.begin(), all.end(), same_pair), all.end());
    return all;
}

}  // namespace trisect::detail
