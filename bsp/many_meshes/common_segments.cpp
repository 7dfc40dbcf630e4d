// SPDX-License-Identifier: Apache-2.0
//
// The segment of two whole facets is known, with the edges that end it. What a part has of it
// follows from the passages of the part's edges through the plane of the other facet: they are
// where the ends of an edge lie on different sides of that plane, and the sides say whether the
// line comes into the part there. An edge of the part lies in an edge of its facet, which ends the
// segment or lies beyond it, or in a segment with an earlier cutter; there the point comes from the
// ends of that segment, which are nearly as good as corners, and not from those of the edge. So
// errors do not grow from step to step.
//
// All that doubles decide here are sides of vertices, and orders of points along a line. What they
// leave open is decided by integers, as if operands were moved by less than any number.

#include <trisect/bsp/many_meshes/common_segments.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/cells/trace/interpolation.h>
#include <trisect/bsp/many_meshes/sort_few.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

void CommonSegments::start(const OutlinedSolid& first, const OutlinedSolid& second) {
    solids_ = {&first, &second};
    sides_.clear();
    planes_.clear();
    ++turn_;
    for (std::size_t i = 0; i < 2; ++i)
        if (plane_of_[i].size() < solids_[i]->facets.size())
            plane_of_[i].resize(solids_[i]->facets.size());
}

const FilteredPlane& CommonSegments::plane(std::size_t solid, std::uint32_t place) {
    MadePlane& made = plane_of_[solid][place];
    if (made.turn == turn_) return planes_[made.number];
    made = {turn_, static_cast<std::uint32_t>(planes_.size())};
    planes_.push_back(plane_of(solids_[solid]->facets[place]));
    return planes_.back();
}

FilteredPlane CommonSegments::plane_of(const OutlinedSolid::Facet& facet) const {
    const std::uint32_t own = facet.number - meshes_.operands->operands[facet.slot].first;
    return FilteredFacets::plane_of(meshes_.corners(facet.slot, own), meshes_.extent);
}

bool CommonSegments::find(const std::array<std::uint32_t, 2>& places,
                          const FacetCrossing& crossing) {
    crossing_ = &crossing;
    segments_.clear();
    passages_.clear();
    inside_.clear();
    const std::array facets{&solids_[0]->facets[places[0]], &solids_[1]->facets[places[1]]};
    if (facets[0]->whole && facets[1]->whole) return walk(facets);
    set_way();
    for (std::size_t i = 0; i < 2; ++i)
        if (!facets[i]->whole && !list_passages(i, *facets[i], plane(1 - i, places[1 - i])))
            return false;
    if (!sort_inside() || !walk(facets)) return false;
    note_short_segments();
    return true;
}

// Of parts; whole facets in special position have been noted as a pair.
void CommonSegments::note_short_segments() const {
    for (const CommonSegment& s : segments_) {
        const Approximation& a = s.ends[0].at;
        const Approximation& b = s.ends[1].at;
        if (!(std::fabs(b.c[axis_] - a.c[axis_]) > bound_slack * (a.error + b.error)))
            exact_.note_short(*crossing_);
    }
}

// Along which axis the crossing is longest.
void CommonSegments::set_way() {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double step = crossing_->ends[1].at.c[k] - crossing_->ends[0].at.c[k];
        if (k > 0 && std::fabs(step) <= std::fabs(longest)) continue;
        axis_ = k;
        longest = step;
    }
    way_ = longest > 0 ? 1 : -1;
    const double error = crossing_->ends[0].at.error + crossing_->ends[1].at.error;
    if (std::fabs(longest) > bound_slack * error) return;
    const auto [axis, sign] = exact_.direction(crossing_->facets[0], crossing_->facets[1]);
    axis_ = axis;
    way_ = sign;
}

// Of the plane of the facet of the other solid. All facets around a vertex cross that facet, so
// that it is wanted several times.
inline int CommonSegments::side(std::size_t solid, std::uint32_t vertex,
                                const FilteredPlane& plane) {
    const OutlineVertex& v = solids_[solid]->vertices[vertex];
    const double value = plane.value(v.at.c);
    // Without a branch by the sign: it would be foreseen wrongly.
    if (std::fabs(value) > plane.error(v.at)) return 1 - 2 * static_cast<int>(std::signbit(value));
    return exact_side(solid, vertex);
}

int CommonSegments::exact_side(std::size_t solid, std::uint32_t vertex) {
    const OutlineVertex& v = solids_[solid]->vertices[vertex];
    const std::uint32_t facet = crossing_->facets[1 - solid];
    const Key128 key{std::uint64_t{solid} << 32 | vertex, facet};
    constexpr std::int32_t by_moves = 4;
    std::int32_t known = sides_.find(key);
    if (known < 0) {
        const ShiftedPoints::Side side = exact_.side(v, facet);
        known = side.sign + 1 + (side.by_moves ? by_moves : 0);
        sides_.insert(key, known);
    }
    if (known >= by_moves) exact_.note_side(v, crossing_->facets[solid], facet);
    return known % by_moves - 1;
}

// To the left of the crossing is what lies below the second facet for the first one, and above the
// first one for the second one. An edge has the part on its left, so the crossing leaves the part
// where the edge comes to its left.
bool CommonSegments::list_passages(std::size_t solid, const OutlinedSolid::Facet& facet,
                                   const FilteredPlane& other) {
    const OutlinedSolid& s = *solids_[solid];
    // Mostly an edge begins where the one before it ends.
    std::uint32_t last = 0;
    int side_of_last = 0;
    for (std::uint32_t e = facet.first; e < facet.first + facet.count; ++e) {
        const OutlinedSolid::Edge& edge = s.edges[e];
        const int from =
            edge.from == last && side_of_last != 0 ? side_of_last : side(solid, edge.from, other);
        const int to = side(solid, edge.to, other);
        last = edge.to;
        side_of_last = to;
        if (from == 0 || to == 0) return false;
        if (from == to) continue;
        const Passage here{Passage::Where::Before, solid == 1, (to > 0) == (solid == 0), e};
        const FacetCrossing* line = s.line_of(edge);
        if (line == nullptr) {
            if (!place_own(passages_.emplace_back(here), edge.origin.own())) return false;
            continue;
        }
        InnerPassage& p = inside_.emplace_back();
        static_cast<Passage&>(p) = here;
        if (!place_on_line(p, facet, *line, other)) return false;
        if (p.where == Passage::Where::Inside) continue;
        passages_.push_back(p);
        inside_.pop_back();
    }
    return true;
}

// Where the facet's own edge does not end the crossing it is beyond its end.
bool CommonSegments::place_own(Passage& p, std::int8_t own) const {
    p.where = p.enters ? Passage::Where::Before : Passage::Where::Behind;
    for (std::size_t k = 0; k < 2; ++k) {
        const FacetCrossing::End& end = crossing_->ends[k];
        if (end.of_second != p.of_second || end.edge != own) continue;
        p.where = k == 0 ? Passage::Where::Start : Passage::Where::End;
        return p.enters == (k == 0);
    }
    return true;
}

// An end at an edge of the facet itself is beyond all that its cutters cut.
bool CommonSegments::place_on_line(InnerPassage& p, const OutlinedSolid::Facet& facet,
                                   const FacetCrossing& line, const FilteredPlane& other) const {
    p.cutter = line.facets[line.facets[0] == facet.number ? 1 : 0];
    if (!set_place(p, {facet.number, p.cutter, crossing_->facets[p.of_second ? 0 : 1]}, line,
                   other))
        return false;
    p.along = way_ * p.at.c[axis_];
    p.where = Passage::Where::Inside;
    for (std::size_t k = 0; k < 2; ++k) {
        const FacetCrossing::End& end = crossing_->ends[k];
        if (end.of_second == p.of_second) continue;
        double gap = p.along - way_ * end.at.c[axis_];
        if (!(std::fabs(gap) > bound_slack * (p.at.error + end.at.error)))
            gap = exact_.order_to_end(*crossing_, k, p.cutter);
        if (gap == 0) return false;
        if (k == 0 && gap < 0) p.where = Passage::Where::Before;
        if (k == 1 && gap > 0) p.where = Passage::Where::Behind;
    }
    return true;
}

// From the ends of the segment, where these are clearly on different sides.
bool CommonSegments::set_place(InnerPassage& p, const std::array<std::uint32_t, 3>& facets,
                               const FacetCrossing& line, const FilteredPlane& other) const {
    const Approximation& u = line.ends[0].at;
    const Approximation& w = line.ends[1].at;
    const double at_u = other.value(u.c);
    const double at_w = other.value(w.c);
    const double error = other.error(u) + other.error(w);
    if ((at_u > 0) != (at_w > 0) && interpolate(u, at_u, w, at_w, error, p.at)) return true;
    if (other.sign(u) * other.sign(w) > 0) return false;
    p.at = exact_.meeting(facets);
    return true;
}

bool CommonSegments::sort_inside() {
    bool known = true;
    if (inside_.size() < 2) return true;
    sort_few(std::span(inside_), [&](const InnerPassage& a, const InnerPassage& b) {
        if (std::fabs(b.along - a.along) > bound_slack * (a.at.error + b.at.error))
            return a.along < b.along;
        if (a.edge == b.edge && a.of_second == b.of_second) return false;
        const int order = exact_.order_on_line(crossing_->facets, a.cutter, b.cutter);
        known = known && order != 0;
        return order < 0;
    });
    return known;
}

// Whether a part has what follows the crossing's first end.
bool CommonSegments::begin_inside(std::size_t solid, const OutlinedSolid::Facet& facet,
                                  bool& inside) const {
    int depth = facet.whole ? 1 : 0;
    for (const Passage& p : passages_)
        if (p.of_second == (solid == 1) && p.where <= Passage::Where::Start)
            depth += p.enters ? 1 : -1;
    inside = depth == 1;
    return depth == 0 || depth == 1;
}

bool CommonSegments::end_of_crossing(std::size_t k, CommonSegment::End& out,
                                     const OutlinedSolid::Facet& owner) const {
    const FacetCrossing::End& end = crossing_->ends[k];
    out.at = end.at;
    out.of_second = end.of_second;
    if (owner.whole) {
        out.edge = owner.first + static_cast<std::uint32_t>(end.edge);
        return true;
    }
    const auto where = k == 0 ? Passage::Where::Start : Passage::Where::End;
    const auto p = std::ranges::find_if(passages_, [&](const Passage& q) {
        return q.of_second == end.of_second && q.where == where;
    });
    if (p == passages_.end()) return false;
    out.edge = p->edge;
    return true;
}

bool CommonSegments::walk(const std::array<const OutlinedSolid::Facet*, 2>& facets) {
    std::array<bool, 2> in{};
    for (std::size_t i = 0; i < 2; ++i)
        if (!begin_inside(i, *facets[i], in[i])) return false;
    const auto owner = [&](std::size_t k) -> const OutlinedSolid::Facet& {
        return *facets[crossing_->ends[k].of_second ? 1 : 0];
    };
    if (in[0] && in[1] && !end_of_crossing(0, segments_.emplace_back().ends[0], owner(0)))
        return false;
    for (const InnerPassage& p : inside_) {
        bool& own = in[p.of_second ? 1 : 0];
        if (own == p.enters) return false;
        const bool was = in[0] && in[1];
        own = p.enters;
        const bool is = in[0] && in[1];
        if (was == is) continue;
        if (is) segments_.emplace_back();
        segments_.back().ends[is ? 0 : 1] = {p.at, p.edge, p.of_second};
    }
    return !(in[0] && in[1]) || end_of_crossing(1, segments_.back().ends[1], owner(1));
}

}  // namespace trisect::detail
