// SPDX-License-Identifier: Apache-2.0
//
// No component is ever traced. A box of `a` that is apart from the other boundary lies wholly on
// one side of it, so any point of the box says where all that is in it is. That is a statement
// about the boundary only if there is some of it in the box: bounds are those of what leaves list,
// which need not enter their cells. So the first box on each side must prove it. Boxes that are not
// apart are divided down to leaves of the cell tree, and there each connected piece has a point of
// its own (leaf_pieces.cpp). So every component has been seen, most of them many times, and at most
// the leaves near the other boundary are looked into.
//
// A place in doubles, off by e, is on the same side as the exact one when no box of the other
// boundary is within e of it, as in quick_relation.cpp.

#include <trisect/bsp/interference/tree/solid_sides.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/tree/point_gap.h>
#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

SolidSides::SolidSides(const SolidBoundary& a, const Pose& pose_a, const SolidBoundary& of,
                       const Pose& pose_of, const ApproximateMap& to_other)
    : a_(a),
      other_(of),
      pose_a_(pose_a),
      pose_other_(pose_of),
      map_(to_other),
      pose_(of.boxes, a.boxes, to_other) {
    // How lengths change, if all do alike.
    const auto square = [&](std::size_t j) {
        return map_.m[0][j] * map_.m[0][j] + map_.m[1][j] * map_.m[1][j] +
               map_.m[2][j] * map_.m[2][j];
    };
    is_rigid_ = pose_.is_rigid();
    scale_ = 0.99 * std::sqrt(std::min({square(0), square(1), square(2)}));
}

void SolidSides::add(Location location) {
    if (location == Location::Inside) sides_.in = true;
    if (location == Location::Outside) sides_.out = true;
}

Sides SolidSides::find() {
    near_.push_back(ObbId{});
    visit_lane(ObbId{}, {0, 1});
    return sides_;
}

// Boxes that meet a box, none of them larger unless nothing is below it.
SolidSides::Near SolidSides::refined(ObbId box, Near near) {
    const auto size = [](const ObbTree& t, ObbId id) {
        const ObbNode& n = t.nodes[id.node()];
        return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
    };
    const float own = pose_.scale() * size(a_.boxes, box);
    const OrientedBox b = a_.boxes.box(box);
    Near out{near_.size(), 0};
    std::vector<ObbId> open(near_.begin() + static_cast<std::ptrdiff_t>(near.begin),
                            near_.begin() + static_cast<std::ptrdiff_t>(near.end));
    while (!open.empty()) {
        const ObbId id = open.back();
        open.pop_back();
        if (other_.boxes.is_leaf(id) || !(size(other_.boxes, id) > own)) {
            near_.push_back(id);
            continue;
        }
        const std::uint32_t node = other_.boxes.child(id).node();
        const unsigned hits = pose_.overlaps(other_.boxes.nodes[node], b);
        for (std::uint32_t k = 0; k < 4; ++k)
            if ((hits >> k & 1U) != 0) open.push_back(ObbId::of(node, k));
    }
    out.end = near_.size();
    return out;
}

// `near` meet the box.
void SolidSides::visit_lane(ObbId lane, Near near) {
    if (sides_.are_both()) return;
    const std::size_t before = near_.size();
    const Near close = refined(lane, near);
    if (close.begin == close.end)
        add_box(lane);
    else if (const SolidBoundary::LeafAt* const leaf = a_.leaf_of_hull(lane))
        add_pieces(leaf->boxed().boxes(), false);
    else
        visit(lane, close);
    near_.resize(before);
}

void SolidSides::visit(ObbId box, Near near) {
    const std::uint32_t node = a_.boxes.child(box).node();
    const std::size_t before = near_.size();
    // Of each near box the lanes that it meets.
    const std::size_t first = lanes_met_.size();
    for (std::size_t i = near.begin; i < near.end; ++i)
        lanes_met_.push_back(pose_.overlaps(other_.boxes.box(near_[i]), a_.boxes.nodes[node]));
    for (std::uint32_t k = 0; k < 4 && !sides_.are_both(); ++k) {
        if (!(a_.boxes.nodes[node].half[0][k] >= 0)) continue;
        Near met{near_.size(), 0};
        for (std::size_t i = near.begin; i < near.end; ++i) {
            const ObbId id = near_[i];
            if ((lanes_met_[first + i - near.begin] >> k & 1U) != 0) near_.push_back(id);
        }
        met.end = near_.size();
        visit_lane(ObbId::of(node, k), met);
        near_.resize(before);
    }
    lanes_met_.resize(first);
}

namespace {

// A corner of a polygon that lies in its leaf's cell as a whole, and so is boundary.
std::optional<Approximation> corner_inside(const SolidBoundary::LeafAt& leaf) {
    if (leaf.node->deferred() != nullptr) return std::nullopt;
    for (const PolygonRef p : leaf.node->polygons()) {
        if (p.fragment != nullptr) {
            if (leaf.cell.contains(p.box())) return p.fragment->vertices().front();
        } else if (!p.source->is_half_space() && leaf.cell.contains(p.box())) {
            return Approximation{p.source->corner(p.facet, 0).doubles(), 0};
        }
    }
    return std::nullopt;
}

// Whether there is boundary in the cell of a node, certainly.
bool has_boundary(const SolidBoundary::LeafAt& from) {
    std::vector<SolidBoundary::LeafAt> open{from};
    while (!open.empty()) {
        const SolidBoundary::LeafAt at = open.back();
        open.pop_back();
        const CellNode& n = *at.node;
        if (n.size() == 0) continue;
        if (n.is_leaf()) {
            if (corner_inside(at) || at.boxed().boxes().has_parts()) return true;
            continue;
        }
        for (int i = 1; i >= 0; --i) {
            const CellRef& child = n.child(i);
            open.push_back({&refined(*child.node),
                            i == 0 ? at.cell.below(n.axis(), n.splitter())
                                   : at.cell.above(n.axis(), n.splitter()),
                            at.turned != child.complemented});
        }
    }
    return false;
}

}  // namespace

void SolidSides::add_box(ObbId box) {
    if (const SolidBoundary::LeafAt* const leaf = a_.leaf_of_hull(box)) return add_hull(*leaf);
    const Location location = location_of_box(box);
    const bool is_known = location == Location::Inside    ? sides_.in
                          : location == Location::Outside ? sides_.out
                                                          : true;
    if (!is_known && has_boundary(a_.node_of(box))) add(location);
}

// Apart from the boxes that meet the leaf's bounds, which a hull may stick out of: no point of the
// hull will do, but every one of the boundary does.
void SolidSides::add_hull(const SolidBoundary::LeafAt& leaf) {
    if (const auto corner = corner_inside(leaf))
        if (const auto quick = quick_location(corner->c, corner->error)) return add(*quick);
    add_pieces(leaf.boxed().boxes(), false);
}

// All of the box is on one side; its centre is a point in doubles. Where the box reaches farther
// around it than the image of the centre is off, that image is in the image of the box as well.
Location SolidSides::location_of_box(ObbId box) {
    const OrientedBox b = a_.boxes.box(box);
    std::array<double, 3> center{};
    for (std::size_t k = 0; k < 3; ++k)
        center[k] = a_.boxes.origin[k] + static_cast<double>(b.center[k]) * a_.boxes.unit;
    const std::array<double, 3> x = map_(center);
    const double e = map_.error_below(a_.largest, 0);
    const double least = static_cast<double>(std::min({b.half[0], b.half[1], b.half[2]}));
    if (is_rigid_ && least * a_.boxes.unit * scale_ > 4 * e) {
        if (is_beyond_bounds(x, 0)) return Location::Outside;
        on_.clear();
        return locate_in_leaves(other_.base(), IndexPoint(x), on_);
    }
    if (const auto quick = quick_location(center, 0)) return *quick;
    ExactPlace exact;
    for (std::size_t k = 0; k < 3; ++k) exact.c[k] = ExactRational::from_double(center[k]);
    return exact_location(exact);
}

Sides SolidSides::find_exactly() {
    for_tree_leaves(
        a_.base(), [this](const DoubleBox&) { return !sides_.are_both(); },
        [this](const LeafInTree& leaf) {
            if (leaf.node.size() != 0) add_pieces(boxed_leaf(leaf.node, leaf.cell).boxes(), true);
        });
    return sides_;
}

void SolidSides::add_pieces(const LeafBoxes& boxes, bool exactly) {
    for (const BoundaryPoint& p : boxes.pieces()) {
        if (sides_.are_both()) return;
        if (const auto quick = exactly ? std::nullopt : quick_location(p.at, boxes.error())) {
            add(*quick);
            continue;
        }
        const IndexPolygons& all = boxes.polygons();
        add(exact_location(exact_place(p.corner != BoundaryPoint::none
                                           ? Point(all.corner(p.polygon, p.corner))
                                           : all.part(p.polygon).vertex(0))));
    }
}

bool SolidSides::is_beyond_bounds(const std::array<double, 3>& x, double error) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (x[k] - error > other_.hi[k] || x[k] + error < other_.lo[k]) return true;
    return false;
}

std::optional<Location> SolidSides::quick_location(const std::array<double, 3>& point,
                                                   double error) {
    const std::array<double, 3> x = map_(point);
    const double e = map_.error_below(a_.largest, error);
    if (is_beyond_bounds(x, e)) return Location::Outside;
    if (is_near_other(x, e)) return std::nullopt;
    on_.clear();
    return locate_in_leaves(other_.base(), IndexPoint(x), on_);
}

bool SolidSides::is_near_other(const std::array<double, 3>& point, double error) const {
    const ObbTree& tree = other_.boxes;
    const PointInBoxes at(point, error, tree.origin, tree.unit, tree.reach);
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const std::uint32_t node = stack.back();
        stack.pop_back();
        const unsigned near = at.near(tree.nodes[node]);
        for (std::uint32_t k = 0; k < 4; ++k) {
            if ((near >> k & 1U) == 0) continue;
            const ObbId lane = ObbId::of(node, k);
            if (tree.is_leaf(lane)) return true;
            stack.push_back(tree.child(lane).node());
        }
    }
    return false;
}

Location SolidSides::exact_location(const ExactPlace& place) {
    if (!exact_) exact_.emplace(relative_pose(pose_other_, other_.lattice, pose_a_, a_.lattice));
    on_.clear();
    return locate_in_leaves(other_.base(), IndexPoint(moved(place, *exact_).c), on_);
}

}  // namespace trisect::detail
