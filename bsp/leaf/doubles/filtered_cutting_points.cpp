// SPDX-License-Identifier: Apache-2.0
//
// Vertices and lines of cut facets in general position, with their names and signs.
//
// Where the segments of two cutters meet, an edge of the cutters' mesh pierces the facet. Such
// points carry the name of that edge, and no arithmetic is done on them. Other signs are of points
// that differ, and doubles nearly always decide.
//
// Facets of one plane with a common edge, the two halves of a quadrilateral say, give one line.

#include <trisect/bsp/leaf/doubles/filtered_cutting.h>

#include <algorithm>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

// Whether two items lie in one plane. Whole facets are compared where they have an edge in common
// only; fragments, of which a plane may have many that do not meet, always.
FilteredCutting::Planes FilteredCutting::compare_planes(LeafIndex a, LeafIndex b) {
    const FilteredFacet& f = (*facets_)[a];
    const FilteredFacet& g = (*facets_)[b];
    if (f.surface == g.surface && f.ref.facet == g.ref.facet) return Planes::Same;
    const bool whole = f.is_whole() && g.is_whole();
    std::size_t apex = 3;
    if (whole) {
        if (f.surface != g.surface) return Planes::Apart;
        std::size_t apart = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            if (f.has_vertex(g.vertices[c])) continue;
            apex = c;
            ++apart;
        }
        if (apart != 1) return Planes::Apart;
        if (facets_->plane(a).sign({g.corners[apex], 0.0}) != 0) return Planes::Apart;
    } else {
        for (std::size_t c = 0; c < g.size; ++c)
            if (facets_->plane(a).sign(facets_->corner(g, c)) != 0) return Planes::Apart;
    }
    const Plane p = f.ref.source->support(f.ref.facet);
    const Plane q = g.ref.source->support(g.ref.facet);
    if (g.is_of_half_space()) {
        if (!is_same_plane(p, q)) return Planes::Apart;
        return same_orientation(p, q) ? Planes::Same : Planes::Opposite;
    }
    for (std::size_t c = 0; c < 3; ++c)
        if ((!whole || c == apex) &&
            side_of(g.ref.source->corner(g.ref.facet, static_cast<int>(c)), p) != Side::On)
            return Planes::Apart;
    return same_orientation(p, q) ? Planes::Same : Planes::Opposite;
}

bool FilteredCutting::join_coplanar() {
    line_.resize(contacts_.size());
    for (std::size_t b = 0; b < contacts_.size(); ++b) {
        line_[b] = static_cast<std::int16_t>(b);
        for (std::size_t a = 0; a < b; ++a) {
            if (line_[a] == line_[b]) continue;
            const Planes planes = compare_planes(contacts_[a].other, contacts_[b].other);
            if (planes == Planes::Opposite) return false;
            if (planes == Planes::Apart) continue;
            const std::int16_t from = std::max(line_[a], line_[b]);
            const std::int16_t to = std::min(line_[a], line_[b]);
            for (std::size_t c = 0; c <= b; ++c)
                if (line_[c] == from) line_[c] = to;
        }
    }
    return true;
}

bool FilteredCutting::passes(const FilteredVertex& vertex, std::size_t contact) const {
    const FilteredLine line = line_of(contact);
    if (vertex.lines[0] == line || vertex.lines[1] == line) return true;
    if (vertex.surface < 0) return false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        if (line_[c] != line_[contact]) continue;
        const FilteredFacet& f = (*facets_)[contacts_[c].other];
        if (f.surface == vertex.surface && f.has_vertex(vertex.pierced[0]) &&
            f.has_vertex(vertex.pierced[1]))
            return true;
    }
    return false;
}

PlaneName FilteredCutting::plane_of(FilteredLine line) const {
    if (line < first_splitter_line)
        return (*facets_)[item_].edge(static_cast<std::size_t>(line)).plane;
    if (line < first_contact_line) {
        const Cell& cell = facets_->problem().cell;
        const int splitter = line - first_splitter_line;
        const auto axis = static_cast<std::size_t>(splitter / 2);
        return PlaneName::splitter(splitter / 2, splitter % 2 != 0 ? cell.hi[axis] : cell.lo[axis]);
    }
    const FilteredContact& c = contacts_[static_cast<std::size_t>(line - first_contact_line)];
    const PolygonRef& other = (*facets_)[c.other].ref;
    return PlaneName::support(other.source, other.facet);
}

// Its place in planes_, of a line or of the item's support.
std::size_t FilteredCutting::made_plane(FilteredLine line) {
    if (plane_of_line_.empty())
        plane_of_line_.assign(first_contact_line + contacts_.size() + 1, -1);
    std::int32_t& place = plane_of_line_[static_cast<std::size_t>(line + 1)];
    if (place < 0) {
        place = static_cast<std::int32_t>(planes_.size());
        const PolygonRef& own = (*facets_)[item_].ref;
        planes_.push_back(line == own_support ? own.source->support(own.facet)
                                              : plane_of(line).plane());
    }
    return static_cast<std::size_t>(place);
}

int FilteredCutting::exact_sign(std::int16_t vertex, const Plane& plane) {
    const FilteredVertex& v = vertices_[static_cast<std::size_t>(vertex)];
    const FilteredFacet& f = (*facets_)[item_];
    const PolygonRef& ref = f.ref;
    if (f.is_whole() && vertex < f.size)
        return trisect::sign_of(side_of(ref.source->corner(ref.facet, vertex), plane));
    const std::size_t own = made_plane(own_support);
    const std::size_t first = made_plane(v.lines[0]);
    const std::size_t second = made_plane(v.lines[1]);
    return trisect::sign_of(
        side_of(facets_->in_lattice(v.at), planes_[own], planes_[first], planes_[second], plane));
}

// Where two lines meet, for lines that are nearly parallel.
Approximation FilteredCutting::exact_point(const std::array<FilteredLine, 2>& lines) {
    const std::size_t own = made_plane(own_support);
    const std::size_t first = made_plane(lines[0]);
    const std::size_t second = made_plane(lines[1]);
    return facets_->from_lattice(approximate(planes_[own], planes_[first], planes_[second]));
}

// -1 below the contact's support, 0 on it, 1 above.
int FilteredCutting::sign_at(std::int16_t vertex, std::size_t contact) {
    const FilteredContact& c = contacts_[contact];
    const auto v = static_cast<std::size_t>(vertex);
    if (v < (*facets_)[item_].size) return side_of_corner(contact, v);
    if (passes(vertices_[v], contact)) return 0;
    const int s = facets_->plane(c.other).sign(vertices_[v].at);
    if (s != 0) return s;
    const Key128 key{v, contact};
    if (const std::int32_t known = exact_signs_.find(key); known >= 0) return known - 1;
    const auto line = static_cast<FilteredLine>(first_contact_line + static_cast<int>(contact));
    const Plane plane = planes_[made_plane(line)];  // others are made
    const int exact = exact_sign(vertex, plane);
    exact_signs_.insert(key, exact + 1);
    return exact;
}

// Whether a vertex on a contact's line is strictly on the inner side of an end of its segment.
bool FilteredCutting::is_inside_end(std::int16_t vertex, std::size_t contact, bool last,
                                    const LineDirection& direction) {
    const FilteredVertex& v = vertices_[static_cast<std::size_t>(vertex)];
    const FilteredEnd& end = end_of(contact, last);
    if (is_end(v, contact, end)) return false;
    const int order = direction.order(v.at, end.at);
    if (order != 0) return last ? order < 0 : order > 0;
    const FilteredContact& c = contacts_[contact];
    const LeafIndex owner = end.of_second == c.is_second ? item_ : c.other;
    const EdgeName edge = (*facets_)[owner].edge(static_cast<std::size_t>(end.edge));
    const int side = exact_sign(vertex, edge.plane.plane());
    return edge.above ? side > 0 : side < 0;
}

// Where two contacts' lines meet, the edge that their facets have in common pierces the item.
void FilteredCutting::name_pierced_edge(FilteredVertex& vertex) const {
    if (vertex.lines[0] < first_contact_line || vertex.lines[1] < first_contact_line) return;
    for (std::size_t a = 0; a < contacts_.size(); ++a) {
        if (line_of(a) != vertex.lines[0]) continue;
        const FilteredFacet& f = (*facets_)[contacts_[a].other];
        for (std::size_t b = 0; b < contacts_.size(); ++b) {
            if (line_of(b) != vertex.lines[1]) continue;
            const FilteredFacet& g = (*facets_)[contacts_[b].other];
            if (f.surface != g.surface) continue;
            std::size_t found = 0;
            std::array<std::uint32_t, 3> common{};
            for (const std::uint32_t v : g.vertices)
                if (f.has_vertex(v)) common[found++] = v;
            if (found != 2) continue;
            vertex.surface = f.surface;
            vertex.pierced = {common[0], common[1]};
            // Where that edge pierces is known better than where two lines meet that may be nearly
            // parallel.
            for (const FilteredEnd& end : crossing_of(a).ends)
                if (is_end(vertex, a, end)) vertex.at = end.at;
            return;
        }
    }
}

// Whether a vertex on a contact's line is an end of the contact's segment. Points of different
// names that are the same are left to doubles, which cannot decide.
bool FilteredCutting::is_end(const FilteredVertex& vertex, std::size_t contact,
                             const FilteredEnd& end) const {
    const FilteredContact& c = contacts_[contact];
    const int own = end.edge_of(c.is_second);
    if (own >= 0 && (vertex.lines[0] == own || vertex.lines[1] == own)) return true;
    const int other = end.edge_of(!c.is_second);
    if (other < 0) return false;
    const FilteredFacet& f = (*facets_)[c.other];
    const int mesh_edge = f.mesh_edge(static_cast<std::size_t>(other));
    if (mesh_edge < 0) {
        const PlaneName name = f.edge(static_cast<std::size_t>(other)).plane;
        return plane_of(vertex.lines[0]) == name || plane_of(vertex.lines[1]) == name;
    }
    if (vertex.surface != f.surface) return false;
    const auto e = static_cast<std::size_t>(mesh_edge);
    const std::uint32_t v = f.vertices[e];
    const std::uint32_t w = f.vertices[e == 2 ? 0 : e + 1];
    return (vertex.pierced[0] == v && vertex.pierced[1] == w) ||
           (vertex.pierced[0] == w && vertex.pierced[1] == v);
}

}  // namespace trisect::detail
