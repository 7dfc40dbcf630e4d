// SPDX-License-Identifier: Apache-2.0
//
// No component is ever traced. A box of `a` that is apart from the other boundary lies wholly on
// one side of it, so any point of the box says where all that is in it is. Boxes that are not apart
// are divided down to leaves of the cell tree, and there each connected piece has a point of its
// own (leaf_pieces.cpp). So every component has been seen, most of them many times, and at most the
// leaves near the other boundary are looked into.
//
// A place in doubles, off by e, is on the same side as the exact one when no box of the other
// boundary is within e of it, as in quick_relation.cpp.

#include <trisect/bsp/interference/tree/solid_sides.h>

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
      pose_(of.boxes, a.boxes, to_other) {}

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
    for (std::uint32_t k = 0; k < 4 && !sides_.are_both(); ++k) {
        if (!(a_.boxes.nodes[node].half[0][k] >= 0)) continue;
        const ObbId lane = ObbId::of(node, k);
        const OrientedBox b = a_.boxes.box(lane);
        Near met{near_.size(), 0};
        for (std::size_t i = near.begin; i < near.end; ++i) {
            const ObbId id = near_[i];
            const unsigned hits = pose_.overlaps(other_.boxes.nodes[id.node()], b);
            if ((hits >> id.lane() & 1U) != 0) near_.push_back(id);
        }
        met.end = near_.size();
        visit_lane(lane, met);
        near_.resize(before);
    }
}

// All of the box is on one side; its centre is a point in doubles.
void SolidSides::add_box(ObbId box) {
    const OrientedBox b = a_.boxes.box(box);
    std::array<double, 3> center{};
    for (std::size_t k = 0; k < 3; ++k)
        center[k] = a_.boxes.origin[k] + static_cast<double>(b.center[k]) * a_.boxes.unit;
    if (const auto quick = quick_location(center, 0)) return add(*quick);
    ExactPlace exact;
    for (std::size_t k = 0; k < 3; ++k) exact.c[k] = ExactRational::from_double(center[k]);
    add(exact_location(exact));
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

std::optional<Location> SolidSides::quick_location(const std::array<double, 3>& point,
                                                   double error) {
    const std::array<double, 3> x = map_(point);
    const double e = map_.error_below(a_.largest, error);
    for (std::size_t k = 0; k < 3; ++k)
        if (x[k] - e > other_.hi[k] || x[k] + e < other_.lo[k]) return Location::Outside;
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
