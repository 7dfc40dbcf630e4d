// SPDX-License-Identifier: Apache-2.0
//
// What crosses a facet in general position leaves a path of segments on it, and where two of them
// meet, an edge of the cutters' mesh pierces the facet. The facet is split along the whole line of
// a segment, within the part that the segment runs through, so parts stay convex. Then the next
// segment begins on a line that was cut before, exactly at the point that both lines have in
// common: such points carry the name of the edge that pierces there, and no arithmetic is done on
// them. Other signs are of points that differ, and doubles nearly always decide.
//
// Facets of one plane with a common edge, the two halves of a quadrilateral say, give one line.

#include <trisect/bsp/leaf/doubles/filtered_cutting.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/bsp/cells/facet_in_cell.h>
#include <trisect/bsp/leaf/straight_crossings.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// Contacts are compared pair by pair for common planes.
constexpr std::size_t many_contacts = 200;

// The axis along which two points are farthest apart.
std::size_t longest_axis(const Approximation& a, const Approximation& b) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(b.c[k] - a.c[k]) > std::fabs(b.c[axis] - a.c[axis])) axis = k;
    return axis;
}

}  // namespace

void FilteredCutting::start(FilteredFacets& facets, const FilteredPairs& pairs,
                            FilteredWindings& windings, LeafFormula& formula,
                            std::span<const int> open, EvaluateStats& stats) {
    keeps_common_lines_ = may_have_straight_crossings(facets.problem());
    found_common_lines_ = false;
    facets_ = &facets;
    pairs_ = &pairs;
    windings_ = &windings;
    formula_ = &formula;
    open_ = open;
    stats_ = &stats;
    n_ = facets.operand_count();
    row_ = formula.row_size();
    answers_.fill({});
}

FilteredPart& FilteredCutting::add_part() {
    if (count_ == parts_.size()) parts_.emplace_back();
    FilteredPart& p = parts_[count_++];
    p.state = FilteredPart::State::Open;
    p.sides = sides_.size();
    sides_.resize(sides_.size() + 2 * row_);
    return p;
}

// The whole outline.
bool FilteredCutting::make_shape() {
    vertices_.clear();
    const FilteredFacet& f = (*facets_)[item_];
    facets_->make_outline(item_);
    clipped_.size = 0;
    clipped_.above = 0;
    for (std::size_t c = 0; c < f.size; ++c) {
        FilteredVertex& v = vertices_.emplace_back();
        v.at = facets_->corner(f, c);
        v.lines = {static_cast<FilteredLine>(c == 0 ? f.size - 1U : c - 1),
                   static_cast<FilteredLine>(c)};
        clipped_.add(static_cast<std::int16_t>(c), static_cast<FilteredLine>(c), f.edge(c).above);
    }
    was_clipped_ = false;
    return contacts_.size() <= many_contacts;
}

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
    for (std::size_t c = 0; c < 3; ++c)
        if ((!whole || c == apex) &&
            side_of(g.ref.source->corner(g.ref.facet, static_cast<int>(c)), p) != Side::On)
            return Planes::Apart;
    const Plane q = g.ref.source->support(g.ref.facet);
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

// --- Points and lines.

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

int FilteredCutting::exact_sign(std::int16_t vertex, const Plane& plane) const {
    const FilteredVertex& v = vertices_[static_cast<std::size_t>(vertex)];
    const FilteredFacet& f = (*facets_)[item_];
    const PolygonRef& ref = f.ref;
    if (f.is_whole() && vertex < f.size)
        return trisect::sign_of(side_of(ref.source->corner(ref.facet, vertex), plane));
    return trisect::sign_of(side_of(facets_->in_lattice(v.at), ref.source->support(ref.facet),
                                    plane_of(v.lines[0]).plane(), plane_of(v.lines[1]).plane(),
                                    plane));
}

// Where two lines meet, for lines that are nearly parallel.
Approximation FilteredCutting::exact_point(const std::array<FilteredLine, 2>& lines) const {
    const PolygonRef& ref = (*facets_)[item_].ref;
    return facets_->from_lattice(approximate(
        ref.source->support(ref.facet), plane_of(lines[0]).plane(), plane_of(lines[1]).plane()));
}

// -1 below the contact's support, 0 on it, 1 above.
int FilteredCutting::sign_at(std::int16_t vertex, std::size_t contact) {
    const FilteredContact& c = contacts_[contact];
    const auto v = static_cast<std::size_t>(vertex);
    if (v < (*facets_)[item_].size) return side_of_corner(contact, v);
    if (passes(vertices_[v], contact)) return 0;
    const int s = facets_->plane(c.other).sign(vertices_[v].at);
    if (s != 0) return s;
    const PolygonRef& other = (*facets_)[c.other].ref;
    return exact_sign(vertex, other.source->support(other.facet));
}

// The same for the middle of a part; 0 when nothing decides. Where its corners are on one side of
// the support, so is the middle.
int FilteredCutting::sign_at_middle(const FilteredPart& part, const Approximation& middle,
                                    int attempt, std::size_t contact) {
    const int s = facets_->plane(contacts_[contact].other).sign(middle);
    if (s != 0 || attempt > 0) return s;
    int low = 1;
    int high = -1;
    for (std::size_t i = 0; i < part.size; ++i) {
        const int at = sign_at(part.vertices[i], contact);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return low >= 0 ? high : (high <= 0 ? low : 0);
}

// Whether a vertex on a contact's line is strictly on the inner side of an end of its segment.
bool FilteredCutting::is_inside_end(std::int16_t vertex, std::size_t contact, bool last,
                                    const LineDirection& direction) const {
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

// A point in the interior of a part.
Approximation FilteredCutting::middle_of(const FilteredPart& part, int attempt) const {
    static constexpr std::array<std::array<double, 3>, 4> weights{
        {{1, 1, 1}, {3, 5, 11}, {7, 2, 4}, {1, 6, 2}}};
    const auto& weight = weights[static_cast<std::size_t>(attempt)];
    const std::size_t n = part.size;
    const std::array<std::size_t, 3> corners{0, n / 3, 2 * n / 3};
    const double total = weight[0] + weight[1] + weight[2];
    Approximation m;
    double largest = 0;
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Approximation& a = vertices_[static_cast<std::size_t>(part.vertices[corners[i]])].at;
        error = std::max(error, a.error);
        for (std::size_t k = 0; k < 3; ++k) {
            m.c[k] += weight[i] * a.c[k] / total;
            largest = std::max(largest, std::fabs(a.c[k]));
        }
    }
    m.error = error_slack * error + largest * 0x1p-49;
    return m;
}

// --- Splitting.

// Both parts of a part whose vertices have these signs with respect to a line's plane. `cuts`: the
// new vertices in the order in which a walk around the part comes to them.
void FilteredCutting::divide(const FilteredPart& from, FilteredLine line, const Signs& signs,
                             const std::array<std::int16_t, 2>& cuts, FilteredPart& below,
                             FilteredPart& above) const {
    below.size = above.size = 0;
    below.above = above.above = 0;
    std::size_t cut = 0;
    for (std::size_t i = 0; i < from.size; ++i) {
        const int here = signs[i];
        const int next = signs[i + 1 < from.size ? i + 1 : 0];
        const std::int16_t v = from.vertices[i];
        const FilteredLine e = from.lines[i];
        const bool side = (from.above >> i & 1U) != 0;
        if (here < 0) below.add(v, e, side);
        if (here > 0) above.add(v, e, side);
        if (here == 0 && next < 0) {
            below.add(v, e, side);
            above.add(v, line, true);
        } else if (here == 0) {
            above.add(v, e, side);
            below.add(v, line, false);
        } else if (here * next < 0) {
            const std::int16_t x = cuts[cut++];
            if (next < 0) {
                below.add(x, e, side);
                above.add(x, line, true);
            } else {
                above.add(x, e, side);
                below.add(x, line, false);
            }
        }
    }
}

// Whether the part was cut before along the contact's line by a facet of another plane.
bool FilteredCutting::runs_along(const FilteredPart& part, const Signs& signs,
                                 std::size_t contact) const {
    const auto support = [&](std::size_t c) {
        const PolygonRef& ref = (*facets_)[contacts_[c].other].ref;
        return ref.source->support(ref.facet);
    };
    for (std::size_t i = 0; i < part.size; ++i) {
        const FilteredLine line = part.lines[i];
        if (signs[i] != 0 || signs[i + 1 < part.size ? i + 1 : 0] != 0) continue;
        if (line >= first_contact_line && line != line_of(contact) &&
            !is_same_plane(support(static_cast<std::size_t>(line - first_contact_line)),
                           support(contact)))
            return true;
    }
    return false;
}

FilteredCutting::Split FilteredCutting::split(std::size_t part, std::size_t contact, bool sure) {
    const FilteredPart from = parts_[part];
    Signs signs;
    bool below = false;
    bool above = false;
    for (std::size_t i = 0; i < from.size; ++i) {
        const int s = sign_at(from.vertices[i], contact);
        signs[i] = static_cast<std::int8_t>(s);
        below = below || s < 0;
        above = above || s > 0;
    }
    if (!below || !above) {
        if (keeps_common_lines_ && !is_common_line_)
            is_common_line_ = runs_along(from, signs, contact);
        return Split::Missed;
    }
    if (from.size + 2U > FilteredPart::max_size) return Split::Uncertain;
    // Where the line enters the part and where it leaves it, in its direction.
    const FilteredPlane& plane = facets_->plane(contacts_[contact].other);
    std::array<std::int16_t, 2> ends{-1, -1};
    std::array<std::int16_t, 2> cuts{};
    std::size_t made = 0;
    for (std::size_t i = 0; i < from.size; ++i) {
        const std::size_t next = i + 1 < from.size ? i + 1 : 0;
        if (signs[i] != 0 && signs[i] * signs[next] >= 0) continue;
        std::int16_t& end = ends[signs[next] > 0 ? 0 : 1];
        if (end >= 0 || signs[next] == 0) return Split::Uncertain;
        if (signs[i] == 0) {
            end = from.vertices[i];
            continue;
        }
        const Approximation u = vertices_[static_cast<std::size_t>(from.vertices[i])].at;
        const Approximation w = vertices_[static_cast<std::size_t>(from.vertices[next])].at;
        FilteredVertex x;
        x.lines = {from.lines[i], line_of(contact)};
        if (!interpolate(u, plane.value(u.c), w, plane.value(w.c), plane.error(u) + plane.error(w),
                         x.at))
            x.at = exact_point(x.lines);
        name_pierced_edge(x);
        cuts[made++] = end = static_cast<std::int16_t>(vertices_.size());
        vertices_.push_back(x);
    }
    if (ends[0] < 0 || ends[1] < 0) return Split::Uncertain;
    if (!sure) {
        // Does the segment have more than a point in common with what of the line is in the part?
        const LineDirection direction = direction_of(contact);
        if (!is_inside_end(ends[0], contact, true, direction) ||
            !is_inside_end(ends[1], contact, false, direction))
            return Split::Missed;
    }
    FilteredPart& upper = add_part();
    FilteredPart& lower = parts_[part];
    std::copy_n(sides_.begin() + static_cast<std::ptrdiff_t>(from.sides), 2 * row_,
                sides_.begin() + static_cast<std::ptrdiff_t>(upper.sides));
    divide(from, line_of(contact), signs, cuts, lower, upper);
    // Both are beside the segment, so the cutter's own solid is on one side of it.
    const bool upright = (*facets_)[contacts_[contact].other].orientation > 0;
    upper.winding = upright ? 0 : 1;
    lower.winding = upright ? 1 : 0;
    return Split::Done;
}

bool FilteredCutting::clip_at(std::size_t axis, bool high) {
    const double splitter = high ? facets_->splitter_hi()[axis] : facets_->splitter_lo()[axis];
    const FilteredPart from = clipped_;
    if (from.size + 2U > FilteredPart::max_size) return false;
    const auto point = [&](std::size_t i) -> const Approximation& {
        return vertices_[static_cast<std::size_t>(from.vertices[i])].at;
    };
    const auto error = [&](const Approximation& a) {
        return a.error + 0x1p-51 * (std::fabs(a.c[axis]) + std::fabs(splitter)) +
               facets_->splitter_error();
    };
    Signs signs;
    bool below = false;
    bool above = false;
    for (std::size_t i = 0; i < from.size; ++i) {
        int s = 0;
        if (facets_->is_whole() && from.vertices[i] < (*facets_)[item_].size &&
            point(i).error == 0) {
            // A lattice position, and the last one below the splitting plane is exact too.
            const double c = point(i).c[axis];
            s = (high ? c > facets_->inner_hi()[axis] : c >= facets_->inner_lo()[axis]) ? 1 : -1;
        } else {
            const double gap = point(i).c[axis] - splitter;
            if (std::fabs(gap) <= error(point(i))) return false;
            s = gap > 0 ? 1 : -1;
        }
        signs[i] = static_cast<std::int8_t>(s);
        below = below || s < 0;
        above = above || s > 0;
    }
    if (!(high ? above : below)) return true;  // nothing is beyond the splitting plane
    was_clipped_ = true;
    if (!(high ? below : above)) {
        clipped_.size = 0;
        return true;
    }
    const auto line = static_cast<FilteredLine>(first_splitter_line + 2 * static_cast<int>(axis) +
                                                static_cast<int>(high));
    std::array<std::int16_t, 2> cuts{};
    std::size_t made = 0;
    for (std::size_t i = 0; i < from.size; ++i) {
        const std::size_t next = i + 1 < from.size ? i + 1 : 0;
        if (signs[i] == signs[next]) continue;
        if (made == 2) return false;
        FilteredVertex x;
        if (!interpolate(point(i), point(i).c[axis] - splitter, point(next),
                         point(next).c[axis] - splitter, error(point(i)) + error(point(next)),
                         x.at))
            return false;
        x.lines = {from.lines[i], line};
        cuts[made++] = static_cast<std::int16_t>(vertices_.size());
        vertices_.push_back(x);
    }
    FilteredPart rest;
    divide(from, line, signs, cuts, high ? clipped_ : rest, high ? rest : clipped_);
    return true;
}

bool FilteredCutting::clip_to_cell() {
    const FilteredFacet& f = (*facets_)[item_];
    if (f.contained) return true;
    for (std::size_t k = 0; k < 3; ++k) {
        const unsigned ends = f.splitters >> 2 * k;
        if (clipped_.size != 0 && f.lo[k] < facets_->inner_lo()[k] && (ends & 1U) == 0 &&
            !clip_at(k, false))
            return false;
        if (clipped_.size != 0 && f.hi[k] > facets_->inner_hi()[k] && (ends & 2U) == 0 &&
            !clip_at(k, true))
            return false;
    }
    return true;
}

// --- Winding numbers.

bool FilteredCutting::trace_start() {
    for (int attempt = 0; attempt < 4; ++attempt) {
        start_ = middle_of(clipped_, attempt);
        if (!windings_->at_point(start_, (*facets_)[item_].operand, *stats_, start_windings_))
            continue;
        bool sure = true;
        start_sides_.clear();
        for (const FilteredContact& c : contacts_) {
            start_sides_.push_back(static_cast<std::int8_t>(facets_->plane(c.other).sign(start_)));
            sure = sure && start_sides_.back() != 0;
        }
        if (sure) return true;
    }
    return false;
}

// Starts at a corner of the item that lies in the cell.
void FilteredCutting::start_at(const FilteredWindings::Anchor& anchor) {
    const auto known = windings_->windings(anchor.windings);
    start_windings_.assign(known.begin(), known.end());
    const auto corner = static_cast<std::size_t>(anchor.corner);
    start_ = facets_->corner((*facets_)[item_], corner);
    start_sides_.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c)
        start_sides_.push_back(static_cast<std::int8_t>(side_of_corner(c, corner)));
}

// How winding numbers change on the straight way from the start to a point of the item.
bool FilteredCutting::change_to(const FilteredPart& part, int attempt, std::size_t begin,
                                std::size_t end, int& change) {
    const Approximation middle = middle_of(part, attempt);
    change = 0;
    for (std::size_t c = begin; c < end; ++c) {
        const FilteredPlane& plane = facets_->plane(contacts_[c].other);
        const int at_end = sign_at_middle(part, middle, attempt, c);
        if (at_end == 0) return false;
        const int at_start = start_sides_[c];
        if (at_start == at_end) continue;
        Approximation x;
        if (!interpolate(start_, plane.value(start_.c), middle, plane.value(middle.c),
                         plane.error(start_) + plane.error(middle), x))
            return false;
        const auto& segment = crossing_of(c).ends;
        const std::size_t axis = longest_axis(segment[0].at, segment[1].at);
        const int first = compare_along(axis, x, segment[0].at);
        const int second = compare_along(axis, x, segment[1].at);
        if (first == 0 || second == 0) return false;
        if (first != second) change += at_start * (*facets_)[contacts_[c].other].orientation;
    }
    return true;
}

bool FilteredCutting::find_sides(const FilteredPart& part, LeafIndex operand, std::size_t begin,
                                 std::size_t end) {
    ++stats_->traces_within;
    const auto set = [&](int w) {
        formula_->set(above(part), as_index(operand), w);
        formula_->set(below(part), as_index(operand), w);
    };
    if (part.winding >= 0) {
        set(part.winding);
        return true;
    }
    for (int attempt = 0; attempt < 4; ++attempt) {
        int change = 0;
        if (!change_to(part, attempt, begin, end, change)) continue;
        set(start_windings_[as_index(operand)] + change);
        return true;
    }
    return false;
}

// An embedded operand has 0 outside its own facets and 1 inside.
void FilteredCutting::set_sides(const FilteredPart& part, std::span<const int> windings) {
    const FilteredFacet& f = (*facets_)[item_];
    std::copy(windings.begin(), windings.end(), above(part).begin());
    std::copy(windings.begin(), windings.end(), below(part).begin());
    above(part)[as_index(f.operand)] = f.orientation > 0 ? 0 : 1;
    below(part)[as_index(f.operand)] = f.orientation > 0 ? 1 : 0;
    formula_->fill(above(part));
    formula_->fill(below(part));
}

void FilteredCutting::settle(FilteredPart& part) {
    const int over = formula_->value(above(part));
    if (over < 0) return;
    const int under = formula_->value(below(part));
    if (under < 0) return;
    part.state = over == under ? FilteredPart::State::Dropped : FilteredPart::State::Kept;
    part.inside_above = over == 1;
}

// --- Items.

void FilteredCutting::start_item(LeafIndex item) {
    item_ = item;
    has_common_lines_ = false;
    contacts_ = pairs_->contacts(item);
    sides_.clear();
    count_ = 0;
}

// Whether an operand other than a facet's own decides the formula on both of its sides.
bool FilteredCutting::is_covered(LeafIndex operand, std::span<const int> windings) const {
    for (std::size_t o = 0; o < open_.size(); ++o)
        if (windings[o] != open_[o] && o != as_index(operand)) return true;
    return false;
}

FilteredCutting::Result FilteredCutting::whole(LeafIndex item) {
    start_item(item);
    const FilteredFacet& f = (*facets_)[item];
    LeafIndex windings = windings_->anchor_of(item, *stats_).windings;
    const int key = 2 * f.operand + (f.orientation > 0 ? 1 : 0);
    const auto answer_for = [&](LeafIndex w) -> Answer& {
        return answers_[(4 * as_index(w) + static_cast<std::size_t>(key)) % answers_.size()];
    };
    const auto is_known = [&](LeafIndex w) {
        return answer_for(w).windings == w && answer_for(w).key == key;
    };
    if (windings >= 0 && is_known(windings)) return answer_for(windings).result;
    if (windings < 0) {
        if (!f.contained && f.is_whole() &&
            certainly_misses(f.ref, facets_->problem().cell.lattice_box()))
            return {};
        if (!make_shape() || !clip_to_cell()) return {Remains::Uncertain, false};
        if (clipped_.size == 0) return {};  // listed for its box, but not in the cell
        windings = windings_->from_clear_boxes(item, *stats_);
        if (windings < 0) {
            if (!trace_start()) return {Remains::Uncertain, false};
            windings = windings_->remember(item, start_windings_);
        }
        if (is_known(windings)) return answer_for(windings).result;
    }
    Result result;
    if (!is_covered(f.operand, windings_->windings(windings))) {
        FilteredPart& part = add_part();
        set_sides(part, windings_->windings(windings));
        settle(part);
        if (part.state == FilteredPart::State::Kept) result = {Remains::Uncut, part.inside_above};
    }
    answer_for(windings) = {windings, key, result};
    return result;
}

std::optional<std::span<const int>> FilteredCutting::windings_on(LeafIndex item) {
    start_item(item);
    if (const auto at = windings_->anchor_of(item, *stats_).windings; at >= 0)
        return windings_->windings(at);
    if (!make_shape() || !clip_to_cell()) return std::nullopt;
    if (clipped_.size == 0) return std::span<const int>();
    if (!trace_start()) return std::nullopt;
    return start_windings_;
}

// Makes the item its first part, without a shape. False when it cannot bound the result.
bool FilteredCutting::add_item() {
    known_windings_.assign(start_windings_.begin(), start_windings_.end());
    for (const FilteredContact& c : contacts_)
        known_windings_[as_index((*facets_)[c.other].operand)] = unknown_winding;
    const FilteredPart& part = add_part();
    set_sides(part, known_windings_);
    const int over = formula_->value(above(part));
    return over < 0 || over != formula_->value(below(part));
}

FilteredCutting::Result FilteredCutting::cut(LeafIndex item) {
    constexpr Result uncertain{Remains::Uncertain, false};
    start_item(item);
    const auto operand_at = [&](std::size_t c) { return (*facets_)[contacts_[c].other].operand; };
    // Winding numbers at a corner may show at once that the item lies within some other solid.
    const FilteredWindings::Anchor anchor = windings_->anchor_of(item, *stats_);
    if (anchor.windings >= 0) {
        start_at(anchor);
        if (!add_item()) return {};
    }
    if (!make_shape() || !join_coplanar() || !clip_to_cell()) return uncertain;
    if (clipped_.size == 0) return {};
    if (anchor.windings < 0) {
        if (!trace_start()) return uncertain;
        if (!add_item()) return {};
    }
    const std::size_t sides = parts_[0].sides;
    parts_[0] = clipped_;
    parts_[0].state = FilteredPart::State::Open;
    parts_[0].sides = sides;
    settle(parts_[0]);
    // First by those operands that the start lies in: they are likely to decide about large parts.
    for (const bool around : {true, false}) {
        for (std::size_t begin = 0; begin < contacts_.size();) {
            std::size_t end = begin + 1;
            while (end < contacts_.size() && operand_at(end) == operand_at(begin)) ++end;
            if ((start_windings_[as_index(operand_at(begin))] > 0) == around &&
                !cut_by(operand_at(begin), begin, end))
                return uncertain;
            begin = end;
        }
    }
    stats_->pieces += count_;
    found_common_lines_ = found_common_lines_ || has_common_lines_;
    return remains();
}

bool FilteredCutting::cut_by(LeafIndex operand, std::size_t begin, std::size_t end) {
    const std::size_t o = as_index(operand);
    const std::size_t before = count_;
    for (std::size_t k = 0; k < before; ++k) {
        if (parts_[k].state != FilteredPart::State::Open) continue;
        const bool above_matters = formula_->value(above(parts_[k])) < 0;
        const bool below_matters = formula_->value(below(parts_[k])) < 0;
        const std::size_t first = count_;
        {
            const std::size_t sides = add_part().sides;
            parts_[first] = parts_[k];
            parts_[first].sides = sides;
            parts_[first].winding = -1;
            std::copy_n(above(parts_[k]).begin(), 2 * row_, above(parts_[first]).begin());
        }
        // Nothing but the first cutter can have cut a whole item in the cell: it need not be
        // tested.
        bool sure = first == 1 && (*facets_)[item_].contained;
        is_common_line_ = false;
        for (std::size_t c = begin; c < end; ++c) {
            const std::size_t last = count_;
            for (std::size_t j = first; j < last; ++j)
                if (split(j, c, sure) == Split::Uncertain) return false;
            sure = false;
        }
        for (std::size_t j = first; j < count_; ++j)
            if (!find_sides(parts_[j], operand, begin, end)) return false;
        has_common_lines_ = has_common_lines_ || is_common_line_;
        if (count_ == first + 1 ||
            (!is_common_line_ && same_sides(first, operand, above_matters, below_matters))) {
            // Undone, if anything was cut.
            FilteredPart& part = parts_[k];
            if (above_matters) formula_->set(above(part), o, above(parts_[first])[o]);
            if (below_matters) formula_->set(below(part), o, below(parts_[first])[o]);
            if (count_ > first + 1) ++stats_->cuts_undone;
            count_ = first;
            settle(part);
            continue;
        }
        for (std::size_t j = first; j < count_; ++j) settle(parts_[j]);
        // The first of the new parts takes the place of the old one, the last one its place.
        parts_[k] = parts_[first];
        --count_;
        if (first != count_) parts_[first] = parts_[count_];
    }
    return true;
}

bool FilteredCutting::same_sides(std::size_t first, LeafIndex operand, bool above_matters,
                                 bool below_matters) const {
    const std::size_t o = as_index(operand);
    const auto over = [&](std::size_t j) { return sides_[parts_[j].sides + o]; };
    const auto under = [&](std::size_t j) { return sides_[parts_[j].sides + row_ + o]; };
    for (std::size_t j = first + 1; j < count_; ++j)
        if ((above_matters && over(j) != over(first)) ||
            (below_matters && under(j) != under(first)))
            return false;
    return true;
}

FilteredCutting::Result FilteredCutting::remains() const {
    std::size_t kept = 0;
    bool uniform = true;
    bool inside_above = false;
    for (const FilteredPart& p : parts()) {
        if (p.state == FilteredPart::State::Open) return {Remains::Uncertain, false};
        if (p.state == FilteredPart::State::Dropped) continue;
        if (kept++ == 0) inside_above = p.inside_above;
        uniform = uniform && p.inside_above == inside_above;
    }
    if (kept == 0) return {};
    if (kept == count_ && uniform && (count_ == 1 || !has_common_lines_))
        return {Remains::Uncut, inside_above};
    return {Remains::Parts, false};
}

// A vertex of a new fragment in lattice units. Where points of one chain of cuts are made out of
// each other errors grow, so those that are large for the fragment are made anew.
Approximation FilteredCutting::in_lattice(std::int16_t vertex, double extent) const {
    const FilteredVertex& v = vertices_[static_cast<std::size_t>(vertex)];
    const FilteredFacet& f = (*facets_)[item_];
    const bool is_corner = vertex < f.size;
    if (is_corner && !f.is_whole())
        return f.ref.fragment->vertices()[static_cast<std::size_t>(vertex)];
    if (is_corner || v.at.error <= 0x1p-30 * extent) return facets_->in_lattice(v.at);
    return approximate(f.ref.source->support(f.ref.facet), plane_of(v.lines[0]).plane(),
                       plane_of(v.lines[1]).plane());
}

PolygonRef FilteredCutting::fragment(const FilteredPart& part) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vector3 lo{infinity, infinity, infinity};
    Vector3 hi{-infinity, -infinity, -infinity};
    for (std::size_t i = 0; i < part.size; ++i) {
        edges_[i] = {plane_of(part.lines[i]), (part.above >> i & 1U) != 0};
        const Approximation& a = vertices_[static_cast<std::size_t>(part.vertices[i])].at;
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], a.c[k] - a.error);
            hi[k] = std::max(hi[k], a.c[k] + a.error);
        }
    }
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, hi[k] - lo[k]);
    for (std::size_t i = 0; i < part.size; ++i) corners_[i] = in_lattice(part.vertices[i], extent);
    PolygonRef out = (*facets_)[item_].ref;
    out.fragment = Fragment::make(std::span(edges_).first(part.size),
                                  std::span(corners_).first(part.size), facets_->positions(lo, hi));
    return out;
}

}  // namespace trisect::detail
