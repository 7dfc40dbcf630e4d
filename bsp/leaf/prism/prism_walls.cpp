// SPDX-License-Identifier: Apache-2.0
//
// Facets of one plane that are neighbours make a region. What of its boundary is not within the
// boundary of the box around it would be inside of that box; so where there is nothing such, the
// region is the box, which is a rectangle in the plane. The facets meet nowhere else, so the edges
// that have no neighbour are the boundary.

#include <trisect/bsp/leaf/prism/prism_walls.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

FlatFacet::FlatFacet(const PolygonRef& ref, std::size_t axis) {
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& p = ref.source->corner(ref.facet, i);
        corners[as_index(i)] = {coordinate(p, (axis + 1) % 3), coordinate(p, (axis + 2) % 3)};
        heights[as_index(i)] = coordinate(p, axis);
    }
}

void PrismWalls::clear() {
    walls_.clear();
    facets_.clear();
    corners_.clear();
}

std::span<const PolygonRef> PrismWalls::facets(LeafIndex wall) const {
    const Wall& w = walls_[as_index(wall)];
    return std::span(facets_).subspan(w.facets_begin, w.facets_end - w.facets_begin);
}

std::span<const PrismCorner> PrismWalls::side(LeafIndex wall, Side side) const {
    const Wall& w = walls_[as_index(wall)];
    return std::span(corners_).subspan(w.corners[side], w.corners[side + 1U] - w.corners[side]);
}

bool PrismWalls::add(std::span<const PolygonRef> polygons, LeafIndex operand, bool flipped,
                     std::size_t axis, PoolVector<PrismSideFace>& out) {
    if (!list_facets(polygons, axis) || !join_neighbours()) return false;
    number_groups();
    if (!find_rims()) return false;
    place_facets();
    std::size_t end = 0;
    for (std::uint32_t group = 0; group < groups_.size(); ++group) {
        const std::size_t begin = end;
        while (end < rims_.size() && rims_[end].group == group) ++end;
        add_wall(group, {rims_.data() + begin, end - begin}, operand, flipped, out);
    }
    return true;
}

bool PrismWalls::list_facets(std::span<const PolygonRef> polygons, std::size_t axis) {
    listed_.clear();
    flat_.clear();
    for (const PolygonRef& ref : polygons) {
        const FlatFacet flat(ref, axis);
        if (flat.is_cap()) continue;
        if (!flat.is_upright()) return false;
        listed_.push_back(ref);
        flat_.push_back(flat);
    }
    return true;
}

std::uint32_t PrismWalls::root(std::uint32_t facet) {
    while (root_[facet] != facet) facet = root_[facet] = root_[root_[facet]];
    return facet;
}

namespace {

// Whether two upright facets with a common edge are in one plane: beside an edge along the axis
// they may not be.
bool are_in_one_plane(const FlatFacet& f, std::size_t edge, const FlatFacet& g, std::size_t other) {
    const FlatCorner& at = f.corners[edge];
    if (at != f.corners[(edge + 1) % 3]) return true;
    return turn(at, f.corners[(edge + 2) % 3], g.corners[(other + 2) % 3]) == 0;
}

}  // namespace

// False where more than two facets have an edge in common, or two are turned against each other.
bool PrismWalls::join_neighbours() {
    edges_.clear();
    for (std::uint32_t f = 0; f < listed_.size(); ++f)
        for (int i = 0; i < 3; ++i) {
            const PolygonRef& ref = listed_[f];
            const std::uint32_t a = ref.source->corner_index(ref.facet, i);
            const std::uint32_t b = ref.source->corner_index(ref.facet, (i + 1) % 3);
            edges_.push_back(
                {std::min(a, b), std::max(a, b), f, static_cast<std::uint8_t>(i), b < a});
        }
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
    });
    root_.resize(listed_.size());
    std::iota(root_.begin(), root_.end(), 0U);
    rim_edges_.clear();
    for (std::size_t i = 0; i < edges_.size();) {
        std::size_t j = i + 1;
        while (j < edges_.size() && edges_[j].low == edges_[i].low &&
               edges_[j].high == edges_[i].high)
            ++j;
        if (j > i + 2) return false;
        const Edge& a = edges_[i];
        const Edge& b = edges_[j - 1];
        if (j == i + 2 && are_in_one_plane(flat_[a.facet], a.edge, flat_[b.facet], b.edge)) {
            if (a.turned == b.turned) return false;
            const auto [low, high] = std::minmax({root(a.facet), root(b.facet)});
            root_[high] = low;
        } else {
            rim_edges_.insert(rim_edges_.end(), edges_.begin() + static_cast<std::ptrdiff_t>(i),
                              edges_.begin() + static_cast<std::ptrdiff_t>(j));
        }
        i = j;
    }
    return true;
}

// By their first facets.
void PrismWalls::number_groups() {
    groups_.clear();
    group_of_.assign(listed_.size(), 0);
    for (std::uint32_t f = 0; f < listed_.size(); ++f) {
        const std::uint32_t first = root(f);
        const FlatFacet& flat = flat_[f];
        if (first == f) {
            group_of_[f] = static_cast<std::uint32_t>(groups_.size());
            groups_.push_back({flat.corners[0], flat.corners[0], flat.heights[0], flat.heights[0]});
        } else {
            group_of_[f] = group_of_[first];
        }
        Group& group = groups_[group_of_[f]];
        ++group.count;
        for (std::size_t i = 0; i < 3; ++i) {
            group.from = std::min(group.from, flat.corners[i]);
            group.to = std::max(group.to, flat.corners[i]);
            group.lo = std::min(group.lo, flat.heights[i]);
            group.hi = std::max(group.hi, flat.heights[i]);
        }
    }
}

// False where an edge without a neighbour is not on a side of the rectangle.
bool PrismWalls::find_rims() {
    rims_.clear();
    for (const Edge& e : rim_edges_)
        if (!add_rim(e)) return false;
    const auto key = [](const RimCorner& r) {
        return std::tuple(r.group, r.side, r.at, !r.begins_edge, r.facet);
    };
    std::sort(rims_.begin(), rims_.end(),
              [&](const RimCorner& a, const RimCorner& b) { return key(a) < key(b); });
    return true;
}

bool PrismWalls::add_rim(const Edge& edge) {
    const std::uint32_t g = group_of_[edge.facet];
    const Group& group = groups_[g];
    const FlatFacet& flat = flat_[edge.facet];
    const std::size_t i = edge.edge;
    const std::size_t j = (i + 1) % 3;
    Side side = AtFrom;
    if (flat.corners[i] == flat.corners[j]) {
        if (flat.corners[i] != group.from && flat.corners[i] != group.to) return false;
        side = flat.corners[i] == group.from ? AtFrom : AtTo;
    } else {
        if (flat.heights[i] != flat.heights[j]) return false;
        if (flat.heights[i] != group.lo && flat.heights[i] != group.hi) return false;
        side = flat.heights[i] == group.lo ? Bottom : Top;
    }
    const bool by_u = group.from.u != group.to.u;
    const auto place = [&](std::size_t k) {
        if (side == AtFrom || side == AtTo) return flat.heights[k];
        return by_u ? flat.corners[k].u : flat.corners[k].v;
    };
    for (const std::size_t k : {i, j})
        rims_.push_back({g, side, k == i, static_cast<std::uint8_t>(k), place(k), edge.facet});
    return true;
}

void PrismWalls::place_facets() {
    std::size_t next = facets_.size();
    for (Group& group : groups_) {
        group.next = next;
        next += group.count;
    }
    facets_.resize(next);
    for (std::size_t f = 0; f < listed_.size(); ++f)
        facets_[groups_[group_of_[f]].next++] = listed_[f];
}

void PrismWalls::add_wall(std::uint32_t group, std::span<const RimCorner> rim, LeafIndex operand,
                          bool flipped, PoolVector<PrismSideFace>& out) {
    const Group& g = groups_[group];
    PrismSideFace w;
    w.operand = operand;
    w.wall = static_cast<LeafIndex>(walls_.size());
    w.from = g.from;
    w.to = g.to;
    w.lo = g.lo;
    w.hi = g.hi;
    Wall wall;
    auto next = rim.begin();
    for (const Side side : {AtFrom, AtTo, Bottom, Top}) {
        wall.corners[side] = corners_.size();
        bool has_edge = side > AtTo;
        for (; next != rim.end() && next->side == side; ++next) {
            const PolygonRef& ref = listed_[next->facet];
            if (!has_edge && next->begins_edge) {
                // In the plane, along the side face and up: a facet that turns left there is above
                // on the right.
                const FlatFacet& f = flat_[next->facet];
                const auto at = [&](std::size_t k) {
                    return FlatCorner{g.from.u != g.to.u ? f.corners[k].u : f.corners[k].v,
                                      f.heights[k]};
                };
                w.facets[side] = ref;
                w.upright[side].edge = next->corner;
                w.above_is_left[side] = turn(at(0), at(1), at(2)) < 0;
                has_edge = true;
            }
            if (wall.corners[side] == corners_.size() || (next - 1)->at != next->at)
                corners_.push_back({ref.facet, next->corner});
        }
    }
    wall.corners[4] = corners_.size();
    const bool outside_above = w.facets[0].flipped == flipped;
    w.inside_is_left = outside_above != w.above_is_left[0];
    wall.facets_begin = g.next - g.count;
    wall.facets_end = g.next;
    const auto own = std::span(facets_).subspan(wall.facets_begin, g.count);
    const Source& source = *own[0].source;
    wall.first_facet = own[0].facet;
    for (const PolygonRef& f : own) {
        wall.first_facet = std::min(wall.first_facet, f.facet);
        wall.several_faces =
            wall.several_faces || source.face_of(f.facet) != source.face_of(own[0].facet);
    }
    walls_.push_back(wall);
    out.push_back(w);
}

}  // namespace trisect::detail
