// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/prism_facets.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include <trisect/bsp/leaf/prism/crossed_ways.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

auto side_face_key(const PrismSideFace& w) {
    return std::tuple(w.operand, w.from, w.to, w.lo, w.hi, w.facets[0].source != nullptr ? 0 : 1);
}

bool same_rectangle(const PrismSideFace& a, const PrismSideFace& b) {
    return a.operand == b.operand && a.from == b.from && a.to == b.to && a.lo == b.lo &&
           a.hi == b.hi;
}

}  // namespace

bool PrismFacets::faces_up(const PolygonRef& cap) const {
    const auto corner = [&](int i) { return flat(cap.source->corner(cap.facet, i)); };
    return turn(corner(0), corner(1), corner(2)) > 0;
}

PrismFacets::Upright PrismFacets::upright_edge(const PrismSideFace& side_face,
                                               std::size_t end) const {
    const PolygonRef& ref = side_face.facets[end];
    const auto corner = [&](int i) -> const LatticePoint& {
        return ref.source->corner(ref.facet, i % 3);
    };
    int i = 0;
    while (flat(corner(i)) != flat(corner(i + 1))) ++i;
    const bool up = coordinate(corner(i), axis_) < coordinate(corner(i + 1), axis_);
    return {up ? i : (i + 1) % 3, up ? (i + 1) % 3 : i, i};
}

// Two of its corners have two coordinates in common, or all three have one.
bool PrismFacets::may_be_of_prism(const PolygonRef& polygon) {
    if (polygon.fragment != nullptr || polygon.source->is_half_space()) return false;
    std::array<int, 3> equal{};  // by axis: sides along which it does not change
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& a = polygon.source->corner(polygon.facet, i);
        const LatticePoint& b = polygon.source->corner(polygon.facet, (i + 1) % 3);
        int here = 0;
        for (std::size_t k = 0; k < 3; ++k)
            if (coordinate(a, k) == coordinate(b, k)) {
                ++equal[k];
                ++here;
            }
        if (here == 2) return true;
    }
    return std::ranges::any_of(equal, [](int n) { return n == 3; });
}

bool PrismFacets::list(const LeafProblem& problem) {
    for (const LeafOperand& o : problem.operands)
        if (!o.embedded || (!o.polygons.empty() && !(may_be_of_prism(o.polygons.front()) &&
                                                     may_be_of_prism(o.polygons.back()))))
            return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!may_end_at_caps(problem, axis) || !list_along(problem, axis)) continue;
        // Where everything is axis-perpendicular other ways are shorter, whatever the axis.
        if (is_grid()) return false;
        if (!join_halves() || !find_layers()) continue;
        find_outside(problem);
        return true;
    }
    return false;
}

// Of large meshes: whether the first side faces end at caps. Straight walls of several rings of
// facets do not, and to list them takes much longer.
bool PrismFacets::may_end_at_caps(const LeafProblem& problem, std::size_t axis) {
    constexpr std::size_t large = 16384;
    constexpr std::size_t few = 64;
    std::size_t size = 0;
    for (const LeafOperand& o : problem.operands) size += o.polygons.size();
    if (size < large) return true;
    axis_ = axis;
    const auto heights = [&](const PolygonRef& ref) {
        std::array<Coordinate, 3> out;
        for (int i = 0; i < 3; ++i)
            out[as_index(i)] = coordinate(ref.source->corner(ref.facet, i), axis_);
        return out;
    };
    const auto is_flat = [](const std::array<Coordinate, 3>& h) {
        return h[0] == h[1] && h[0] == h[2];
    };
    const auto has_upright_edge = [&](const PolygonRef& ref) {
        const auto corner = [&](int i) { return flat(ref.source->corner(ref.facet, i)); };
        return corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0);
    };
    std::vector<Coordinate> ends;
    for (const LeafOperand& o : problem.operands)
        for (const PolygonRef& ref : o.polygons.first(std::min(few, o.polygons.size()))) {
            const auto h = heights(ref);
            if (is_flat(h)) continue;
            if (!has_upright_edge(ref)) return false;
            ends.insert(ends.end(), h.begin(), h.end());
        }
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const LeafOperand& o : problem.operands)
        for (const PolygonRef& ref : o.polygons) {
            if (ends.empty()) return true;
            const auto h = heights(ref);
            if (is_flat(h)) std::erase(ends, h[0]);
        }
    return ends.empty();
}

bool PrismFacets::list_along(const LeafProblem& problem, std::size_t axis) {
    axis_ = axis;
    side_faces_.clear();
    caps_.clear();
    for (std::size_t o = 0; o < problem.operands.size(); ++o)
        for (const PolygonRef& ref : problem.operands[o].polygons) {
            if (ref.fragment != nullptr || ref.source->is_half_space() ||
                !add(ref, static_cast<LeafIndex>(o), problem.operands[o].flipped) ||
                !problem.cell.contains(ref.box()))
                return false;
        }
    return true;
}

bool PrismFacets::is_grid() const {
    return std::ranges::all_of(side_faces_, [](const PrismSideFace& w) {
        return w.from.u == w.to.u || w.from.v == w.to.v;
    });
}

bool PrismFacets::add(const PolygonRef& ref, LeafIndex operand, bool flipped) {
    std::array<FlatCorner, 3> corners;
    std::array<Coordinate, 3> height{};
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& p = ref.source->corner(ref.facet, i);
        corners[static_cast<std::size_t>(i)] = flat(p);
        height[static_cast<std::size_t>(i)] = coordinate(p, axis_);
    }
    if (height[0] == height[1] && height[0] == height[2]) {
        caps_.push_back({operand, ref, 0});
        return true;
    }
    // The edge along the axis.
    std::size_t i = 0;
    while (i < 3 && corners[i] != corners[(i + 1) % 3]) ++i;
    if (i == 3) return false;
    const std::size_t third = (i + 2) % 3;
    const auto [lo, hi] = std::minmax(height[i], height[(i + 1) % 3]);
    if (height[third] != lo && height[third] != hi) return false;
    PrismSideFace w;
    w.operand = operand;
    w.lo = lo;
    w.hi = hi;
    w.from = corners[i];
    w.to = corners[third];
    const bool turned = w.to < w.from;
    if (turned) std::swap(w.from, w.to);
    // Up along the axis and then away from it: the normal is to the left of that way.
    const bool up = height[i] < height[(i + 1) % 3];
    const std::size_t half = turned ? 1 : 0;
    w.facets[half] = ref;
    w.above_is_left[half] = up != turned;
    const bool outside_above = ref.flipped == flipped;
    w.inside_is_left = outside_above != w.above_is_left[half];
    side_faces_.push_back(w);
    return true;
}

bool PrismFacets::join_halves() {
    if (side_faces_.size() % 2 != 0) return false;
    std::sort(side_faces_.begin(), side_faces_.end(),
              [](const PrismSideFace& a, const PrismSideFace& b) {
                  return side_face_key(a) < side_face_key(b);
              });
    for (std::size_t i = 0; i < side_faces_.size(); i += 2) {
        PrismSideFace& a = side_faces_[i];
        const PrismSideFace& b = side_faces_[i + 1];
        if (!same_rectangle(a, b) || a.facets[0].source == nullptr ||
            b.facets[1].source == nullptr || a.inside_is_left != b.inside_is_left)
            return false;
        a.facets[1] = b.facets[1];
        a.above_is_left[1] = b.above_is_left[1];
        side_faces_[i / 2] = a;
    }
    side_faces_.resize(side_faces_.size() / 2);
    for (std::size_t i = 1; i < side_faces_.size(); ++i)
        if (same_rectangle(side_faces_[i - 1], side_faces_[i])) return false;
    return true;
}

bool PrismFacets::find_layers() {
    const auto height = [&](const PolygonRef& ref) {
        return coordinate(ref.source->corner(ref.facet, 0), axis_);
    };
    positions_.clear();
    for (const PrismCap& c : caps_) positions_.push_back(height(c.ref));
    std::ranges::sort(positions_);
    positions_.erase(std::unique(positions_.begin(), positions_.end()), positions_.end());
    const auto index = [&](Coordinate p) {
        return static_cast<std::size_t>(std::ranges::lower_bound(positions_, p) -
                                        positions_.begin());
    };
    for (PrismSideFace& w : side_faces_) {
        w.first_layer = index(w.lo) + 1;
        w.end_layer = index(w.hi) + 1;
        // Ends where it meets no cap.
        if (w.end_layer > positions_.size() || positions_[w.first_layer - 1] != w.lo ||
            positions_[w.end_layer - 1] != w.hi)
            return false;
    }
    named_.assign(positions_.size(), PolygonRef{});
    for (PrismCap& c : caps_) {
        c.position = index(height(c.ref));
        if (named_[c.position].source == nullptr) named_[c.position] = c.ref;
    }
    const auto key = [](const PrismCap& c) {
        return std::tuple(c.position, c.operand, c.ref.source->serial(), c.ref.facet);
    };
    std::sort(caps_.begin(), caps_.end(),
              [&](const PrismCap& a, const PrismCap& b) { return key(a) < key(b); });
    return true;
}

// From the reference straight to where nothing is, within its layer.
void PrismFacets::find_outside(const LeafProblem& problem) {
    outside_.clear();
    for (const LeafOperand& o : problem.operands)
        outside_.push_back(is_inside(o.winding, problem.options->winding) ? 1 : 0);
    const FinePoint& r = problem.reference;
    const auto layer = static_cast<std::size_t>(
        std::ranges::partition_point(positions_,
                                     [&](Coordinate p) { return compare(p, r.c[axis_]) <= 0; }) -
        positions_.begin());
    const FlatFinePoint point{r.c[(axis_ + 1) % 3], r.c[(axis_ + 2) % 3]};
    for (const PrismSideFace& w : side_faces_)
        if (w.is_in(layer) && crosses_way(w, point)) outside_[as_index(w.operand)] ^= 1;
}

}  // namespace trisect::detail
