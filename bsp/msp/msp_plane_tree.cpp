// SPDX-License-Identifier: Apache-2.0
//
// A plane of space cut by lines, lines cut by points.
//
// What a plane's region holds is not the face alone that the plane was chosen for. Other faces lie
// in the same plane, edges of faces end on it, faces cross it and leave a trace, corners touch it.
// All of that separates places that are different: the tree has to answer for the whole region, not
// only for the face. Segments carry it, each with the polygon that it belongs to; a corner that
// touches from one side is a lone point.
//
// Lines are chosen among the segments' lines until no segment is left in a part. A lone point needs
// a line too, but a line through it bounds nothing, so it would decide nothing about its sides. So
// lone points wait until their part has no segment any more; then what is around them is known.
// Segments where polygons only touch the plane wait too: a face of the plane may go on behind them
// (msp_line.cpp).
//
// Cutting a segment needs no new kind of number: both its line and the cutting one are named by
// planes, and three planes name the point.

#include <trisect/bsp/msp/msp_plane_tree.h>

#include <algorithm>
#include <array>
#include <utility>

#include <trisect/kernel/contract.h>

namespace trisect::detail::msp {

class PlaneTreeBuilder::Items {
public:
    explicit Items(const PlaneTreeBuilder& b) : b_(b) {}
    [[nodiscard]] const Plane& plane(PlaneIndex p) const { return b_.geometry_.plane(p); }
    [[nodiscard]] PlaneIndex cut_of(ItemIndex i) const { return b_.segments_[i].line; }
    [[nodiscard]] double size(ItemIndex i) const {
        Extent e;
        e.add(b_.geometry_.approximation(b_.segments_[i].a.point));
        e.add(b_.geometry_.approximation(b_.segments_[i].b.point));
        return e.size();
    }
    template <class F>
    void points(ItemIndex i, F&& f) const {
        f(b_.geometry_.approximation(b_.segments_[i].a.point));
        f(b_.geometry_.approximation(b_.segments_[i].b.point));
    }
    [[nodiscard]] Parts parts(ItemIndex i, PlaneIndex plane) const {
        const Segment& s = b_.segments_[i];
        const Side a = b_.geometry_.side(s.a.point, plane);
        const Side b = b_.geometry_.side(s.b.point, plane);
        return {a == Side::Below || b == Side::Below, a == Side::Above || b == Side::Above};
    }

private:
    const PlaneTreeBuilder& b_;
};

void PlaneTreeBuilder::add(Region& region, ItemIndex i) const {
    const Segment& s = segments_[i];
    Extent e;
    e.add(geometry_.approximation(s.a.point));
    e.add(geometry_.approximation(s.b.point));
    (s.contact.elevation == 0 ? region.segments : region.touching).add(i, e, i);
}

void PlaneTreeBuilder::build(PlaneIndex plane, PlaneContents&& contents, const Slot& slot) {
    plane_ = plane;
    segments_ = std::move(contents.segments);
    Region all{{}, {}, std::move(contents.points), contents.around, slot};
    for (std::size_t i = 0; i < segments_.size(); ++i) add(all, static_cast<ItemIndex>(i));
    push(std::move(all));
    while (!pending_.empty()) {
        Region region = std::move(pending_.back());
        pending_.pop_back();
        refine(std::move(region));
    }
}

void PlaneTreeBuilder::push(Region&& region) {
    if (region.segments.is_empty() && region.touching.is_empty() && region.points.empty()) {
        nodes_.set(region.slot, region.around);
    } else {
        pending_.push_back(std::move(region));
    }
}

PlaneIndex PlaneTreeBuilder::choose_line(const Region& region) const {
    if (!region.segments.is_empty())
        return segments_[choose(region.segments, Items(*this), options_)].line;
    if (!region.touching.is_empty())
        return segments_[choose(region.touching, Items(*this), options_)].line;
    return region.points[region.points.size() / 2].line;
}

void PlaneTreeBuilder::part(Groups& list, Groups Region::*kind, const LineFrame& line,
                            Region& below, Region& above) {
    for (Groups::Pointer& group : list.groups()) {
        const Side side = list.side(*group, Items(*this), geometry_.plane(line.cut), turn_);
        if (side == Side::On) {
            for (const ItemIndex i : group->items) send(i, line, below, above);
        } else {
            ((side == Side::Below ? below : above).*kind).add(std::move(group));
        }
    }
}

void PlaneTreeBuilder::refine(Region&& region) {
    const PlaneIndex cut = choose_line(region);
    const LineFrame line = line_frame(geometry_, plane_, cut);
    const std::uint32_t id = nodes_.add(2, cut, region.slot);
    Region below{{}, {}, {}, {}, {&MspTree::Node::below, id}};
    Region above{{}, {}, {}, {}, {&MspTree::Node::above, id}};
    const bool is_settled = !region.segments.is_empty();
    const bool is_covered = region.around.kind() == MspTree::Leaf::OnFace;
    on_line_.clear();
    ++turn_;
    part(region.segments, &Region::segments, line, below, above);
    part(region.touching, &Region::touching, line, below, above);
    for (const LonePoint& p : region.points) {
        const Side side = geometry_.side(p.place.point, cut);
        if (side == Side::On) {
            on_line_.points.push_back(p.place);
        } else {
            (side == Side::Below ? below : above).points.push_back(p);
        }
    }
    const auto evidence = is_settled                             ? MspLine::Evidence::Settled
                          : is_covered || on_line_.along.empty() ? MspLine::Evidence::Around
                                                                 : MspLine::Evidence::All;
    const MspLine divided(geometry_, line, on_line_, evidence, region.around);
    below.around = line.left_is_below() ? divided.left() : divided.right();
    above.around = line.left_is_below() ? divided.right() : divided.left();
    add_line(line, divided, {&MspTree::Node::on, id});
    push(std::move(above));
    push(std::move(below));
}

void PlaneTreeBuilder::send(ItemIndex i, const LineFrame& line, Region& below, Region& above) {
    Segment& s = segments_[i];
    const Side a = geometry_.side(s.a.point, line.cut);
    const Side b = geometry_.side(s.b.point, line.cut);
    if (a == Side::On && b == Side::On) {
        on_line_.along.push_back(s);
        return;
    }
    const Side left = line.left_is_below() ? Side::Below : Side::Above;
    const auto touch = [&](BorderPoint& end, Side rest) {
        if (end.is_dead) return;
        on_line_.points.push_back(end);
        if (rest == left) on_line_.rays.push_back({end.point, s.line, s.contact});
        end.is_dead = true;
    };
    if (a == Side::On) touch(s.a, b);
    if (b == Side::On) touch(s.b, a);
    if (a != opposite(b)) {
        const Side side = a == Side::On ? b : a;
        add(side == Side::Below ? below : above, i);
        return;
    }
    const BorderPoint crossing{geometry_.meet(plane_, line.cut, s.line), s.contact.own, true};
    on_line_.points.push_back({crossing.point, crossing.label, false});
    on_line_.rays.push_back({crossing.point, s.line, s.contact});
    Segment rest = s;
    rest.a = crossing;
    s.b = crossing;
    segments_.push_back(rest);  // ends the life of s
    add(a == Side::Below ? below : above, i);
    add(b == Side::Below ? below : above, static_cast<ItemIndex>(segments_.size() - 1));
}

// A balanced tree over the stops of a line.
void PlaneTreeBuilder::add_line(const LineFrame& line, const MspLine& contents, const Slot& slot) {
    const auto transversal = [&](PointIndex point) {
        for (const PlaneIndex p : geometry_.planes_of(point)) {
            const int s = sign_of_det(geometry_.plane(p), geometry_.plane(line.plane),
                                      geometry_.plane(line.cut));
            if (s != 0) return std::pair(p, s * line.sign > 0);
        }
        TRISECT_EXPECTS(false, "MSP tree: a point without a plane across its line");
        return std::pair(PlaneIndex{0}, false);
    };
    struct Part {
        std::size_t first;
        std::size_t last;
        Slot slot;
    };
    std::vector<Part> parts{{0, contents.stops().size(), slot}};
    while (!parts.empty()) {
        const Part part = parts.back();
        parts.pop_back();
        if (part.first == part.last) {
            nodes_.set(part.slot, contents.between()[part.first]);
            continue;
        }
        const std::size_t middle = (part.first + part.last) / 2;
        const auto [plane, above_is_ahead] = transversal(contents.stops()[middle].point);
        const std::uint32_t id = nodes_.add(1, plane, part.slot);
        nodes_.set({&MspTree::Node::on, id}, contents.stops()[middle].label);
        const Slot below{&MspTree::Node::below, id};
        const Slot above{&MspTree::Node::above, id};
        parts.push_back({middle + 1, part.last, above_is_ahead ? above : below});
        parts.push_back({part.first, middle, above_is_ahead ? below : above});
    }
}

}  // namespace trisect::detail::msp
