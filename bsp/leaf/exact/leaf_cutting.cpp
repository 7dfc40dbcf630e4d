// SPDX-License-Identifier: Apache-2.0
//
// The way from an item's start (a vertex, or the middle of what the cell leaves of it) to a part
// runs in the item's plane, so it meets only what cuts the item: a handful of polygons instead of
// the whole leaf. What is wanted are the winding numbers just above the plane. A cutter that goes
// through the plane is met there as it is in the plane; one that stands on the plane with an edge
// is met just above it, although in the plane only its edge is; one that hangs below is not. All
// signs come from doubles; where those cannot decide, a trace through the leaf does.

#include <trisect/bsp/leaf/exact/leaf_cutting.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <trisect/bsp/cells/facet_in_cell.h>
#include <trisect/bsp/cells/trace/trace.h>
#include <trisect/bsp/leaf/exact/leaf_coincidence.h>
#include <trisect/bsp/leaf/split_piece.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

void LeafCutting::start(LeafWork& work, LeafWindings& windings, LeafAnchors& anchors,
                        LeafFormula& formula, bool keeps_common_lines) {
    keeps_common_lines_ = keeps_common_lines;
    work_ = &work;
    windings_ = &windings;
    anchors_ = &anchors;
    formula_ = &formula;
    last_anchor_ = -1;
}

LeafCutting::Part& LeafCutting::add_part() {
    if (count_ == parts_.size()) parts_.emplace_back();
    Part& p = parts_[count_++];
    p.state = Part::State::Open;
    return p;
}

// An embedded operand has 0 outside its own facets and 1 inside.
void LeafCutting::set_sides(Sides& sides, const std::vector<int>& windings) const {
    const LeafItem& item = work_->item(item_);
    sides.above.resize(formula_->row_size());
    std::copy(windings.begin(), windings.end(), sides.above.begin());
    sides.below = sides.above;
    sides.above[as_index(item.operand)] = item.orientation > 0 ? 0 : 1;
    sides.below[as_index(item.operand)] = item.orientation > 0 ? 1 : 0;
    formula_->fill(sides.above);
    formula_->fill(sides.below);
}

// Winding numbers of the other operands at some point of the item.
void LeafCutting::set_start(const WorkPolygon& part) {
    if (const LeafAnchor anchor = anchors_->anchor_of(item_); anchor.windings >= 0) {
        start_.windings = anchors_->windings(anchor.windings);
        start_.vertex = work_->shape(item_).points[anchor.corner];
        start_.at = work_->bench.approximation(start_.vertex);
        return;
    }
    const LeafItem& item = work_->item(item_);
    known_.assign(work_->problem->operands.size(), 0);
    known_[as_index(item.operand)] = 1;
    start_.windings.assign(known_.size(), 0);
    start_.vertex = -1;
    // In the plane of another facet it is not clear whether the point lies on that.
    for (const LeafContact& c : work_->contacts(item_)) {
        if (!c.overlaps) continue;
        const std::size_t operand = as_index(work_->item(c.other).operand);
        start_.windings[operand] = unknown_winding;
        known_[operand] = 1;
    }
    // A mesh that coincides with the others needs no trace for each of its facets.
    if (std::all_of(known_.begin(), known_.end(), [](char known) { return known != 0; })) return;
    step_.assign(known_.size(), 0);
    start_.at = windings_->windings_above(item_, part, step_, known_, start_.windings);
}

bool LeafCutting::may_bound(const Part& part) {
    const int above = formula_->value(part.sides.above);
    return above < 0 || above != formula_->value(part.sides.below);
}

// Drops what lies in a coincident facet that represents both. That comes first: a part may be
// decided to bound the result long before all is known about the operand of that facet.
void LeafCutting::leave_to_representatives() {
    const LeafItem& item = work_->item(item_);
    if (!item.overlapped) return;
    for (const LeafContact& c : work_->contacts(item_)) {
        if (!c.overlaps || !represents_before(*work_, c.other, item_)) continue;
        const std::size_t before = count_;
        for (std::size_t k = 0; k < before; ++k) {
            if (parts_[k].state != Part::State::Open || !is_near(parts_[k], c.other)) continue;
            // Moved to the end and split there; its place is taken by the first of the new parts.
            const std::size_t first = count_;
            (void)add_part();
            parts_[first] = parts_[k];
            split_along_edges(first, c.other);
            for (std::size_t j = first; j < count_; ++j) {
                if (!is_overlapped(parts_[j], c.other)) continue;
                parts_[j].state = Part::State::Dropped;
                if (!item.contained)
                    work_->incomplete.push_back({item.ref.source->serial(), item.ref.facet});
            }
            std::swap(parts_[k], parts_[first]);
            --count_;
            if (first != count_) std::swap(parts_[first], parts_[count_]);
        }
    }
}

void LeafCutting::settle(Part& part) {
    const int above = formula_->value(part.sides.above);
    if (above < 0) return;
    const int below = formula_->value(part.sides.below);
    if (below < 0) return;
    part.state = above == below ? Part::State::Dropped : Part::State::Kept;
    part.inside_above = above == 1;
}

LeafRemains LeafCutting::whole(LeafIndex i) {
    item_ = i;
    const LeafItem& item = work_->item(i);
    const LeafAnchor anchor = anchors_->anchor_of(i);
    const int key = 2 * item.operand + (item.orientation > 0 ? 1 : 0);
    if (anchor.windings >= 0 && anchor.windings == last_anchor_ && key == last_key_)
        return last_remains_;
    if (anchor.windings >= 0) {
        start_.windings = anchors_->windings(anchor.windings);
    } else {
        WorkPolygon clipped;
        if (!item.contained) {
            if (certainly_misses(item.ref, work_->problem->cell.lattice_box())) return {};
            clipped =
                work_->bench.clipped(work_->with_edges(i), item.ref.box(), work_->problem->cell);
            if (clipped.is_empty()) return {};  // listed for its box, but not in the cell
        }
        set_start(item.contained ? work_->shape(i) : clipped);
        anchors_->remember(i, start_.windings);
    }
    count_ = 0;
    Part& part = add_part();
    set_sides(part.sides, start_.windings);
    settle(part);
    LeafRemains remains;
    if (part.state == Part::State::Kept) remains = {LeafRemains::Kind::Uncut, part.inside_above};
    last_anchor_ = anchor.windings;
    last_key_ = key;
    last_remains_ = remains;
    return remains;
}

LeafRemains LeafCutting::cut(LeafIndex i) {
    item_ = i;
    has_common_lines_ = false;
    count_ = 0;
    kept_.clear();
    const LeafItem& item = work_->item(i);
    {
        Part& part = add_part();
        part.shape = work_->with_edges(i);
        if (!item.contained)
            part.shape =
                work_->bench.clipped(std::move(part.shape), item.ref.box(), work_->problem->cell);
        if (part.shape.is_empty()) return {};
        set_box(part);
        set_start(part.shape);
        const std::span<const LeafContact> contacts = work_->contacts(i);
        known_windings_ = start_.windings;
        for (const LeafContact& c : contacts)
            if (c.cuts || c.overlaps)
                known_windings_[as_index(work_->item(c.other).operand)] = unknown_winding;
        set_sides(part.sides, known_windings_);
        if (!may_bound(part)) return {};
    }
    leave_to_representatives();
    for (std::size_t k = 0; k < count_; ++k)
        if (parts_[k].state == Part::State::Open) settle(parts_[k]);
    const std::span<const LeafContact> contacts = work_->contacts(i);
    const auto operand_at = [&](std::size_t k) { return work_->item(contacts[k].other).operand; };
    // First by those operands that the start lies in: they are likely to decide about large parts.
    for (const bool around : {true, false}) {
        for (std::size_t begin = 0; begin < contacts.size();) {
            std::size_t end = begin + 1;
            while (end < contacts.size() && operand_at(end) == operand_at(begin)) ++end;
            const auto group = contacts.subspan(begin, end - begin);
            if ((start_.windings[as_index(operand_at(begin))] > 0) == around &&
                std::any_of(group.begin(), group.end(),
                            [](const LeafContact& c) { return c.cuts || c.overlaps; }))
                cut_by(operand_at(begin), group);
            begin = end;
        }
    }
    work_->stats->pieces += count_;
    return remains();
}

LeafRemains LeafCutting::remains() {
    std::size_t kept = 0;
    bool uniform = true;
    const Part* first = nullptr;
    for (std::size_t k = 0; k < count_; ++k) {
        const Part& p = parts_[k];
        TRISECT_EXPECTS(p.state != Part::State::Open, "a part of a facet was not decided");
        if (p.state == Part::State::Dropped) continue;
        ++kept;
        if (first == nullptr) first = &p;
        uniform = uniform && p.inside_above == first->inside_above;
    }
    if (kept == 0) return {};
    if (kept == count_ && uniform && (count_ == 1 || !has_common_lines_))
        return {LeafRemains::Kind::Uncut, first->inside_above};
    for (std::size_t k = 0; k < count_; ++k)
        if (parts_[k].state == Part::State::Kept)
            kept_.push_back({std::move(parts_[k].shape), parts_[k].inside_above});
    return {LeafRemains::Kind::Parts, false};
}

void LeafCutting::cut_by(LeafIndex operand, std::span<const LeafContact> contacts) {
    const std::size_t before = count_;
    for (std::size_t k = 0; k < before; ++k) {
        if (parts_[k].state != Part::State::Open) continue;
        if (std::none_of(contacts.begin(), contacts.end(), [&](const LeafContact& c) {
                return (c.cuts || c.overlaps) && is_near(parts_[k], c.other);
            })) {
            find_sides(parts_[k], operand, contacts);
            settle(parts_[k]);
            continue;
        }
        const bool above_matters = formula_->value(parts_[k].sides.above) < 0;
        const bool below_matters = formula_->value(parts_[k].sides.below) < 0;
        const std::size_t first = count_;
        (void)add_part();
        parts_[first] = parts_[k];
        is_common_line_ = false;
        split(first, contacts);
        has_common_lines_ = has_common_lines_ || is_common_line_;
        for (std::size_t j = first; j < count_; ++j) find_sides(parts_[j], operand, contacts);
        if (count_ == first + 1 ||
            (!is_common_line_ && same_sides(first, operand, above_matters, below_matters))) {
            // Undone, if anything was cut.
            Part& part = parts_[k];
            const Sides& found = parts_[first].sides;
            if (above_matters)
                formula_->set(part.sides.above, as_index(operand), found.above[as_index(operand)]);
            if (below_matters)
                formula_->set(part.sides.below, as_index(operand), found.below[as_index(operand)]);
            if (count_ > first + 1) ++work_->stats->cuts_undone;
            count_ = first;
            settle(part);
            continue;
        }
        for (std::size_t j = first; j < count_; ++j) settle(parts_[j]);
        // The first of the new parts takes the place of the old one, the last one its place.
        std::swap(parts_[k], parts_[first]);
        --count_;
        if (first != count_) std::swap(parts_[first], parts_[count_]);
    }
}

bool LeafCutting::same_sides(std::size_t first, LeafIndex operand, bool above_matters,
                             bool below_matters) const {
    for (std::size_t j = first + 1; j < count_; ++j) {
        const Sides& a = parts_[first].sides;
        const Sides& b = parts_[j].sides;
        if (above_matters && a.above[as_index(operand)] != b.above[as_index(operand)]) return false;
        if (below_matters && a.below[as_index(operand)] != b.below[as_index(operand)]) return false;
    }
    return true;
}

// With the errors of the points.
void LeafCutting::set_box(Part& part) const {
    part.lo.fill(std::numeric_limits<double>::infinity());
    part.hi.fill(-std::numeric_limits<double>::infinity());
    for (const PointId p : part.shape.points) {
        const Approximation& a = work_->bench.approximation(p);
        for (std::size_t k = 0; k < 3; ++k) {
            part.lo[k] = std::min(part.lo[k], a.c[k] - 1.001 * a.error);
            part.hi[k] = std::max(part.hi[k], a.c[k] + 1.001 * a.error);
        }
    }
}

// Whether the boxes of a part and an item meet, with a unit to spare for rounding.
bool LeafCutting::is_near(const Part& part, LeafIndex item) const {
    const Box& box = work_->item(item).box;
    for (std::size_t k = 0; k < 3; ++k)
        if (part.lo[k] > static_cast<double>(box.hi[k]) + 1 ||
            part.hi[k] < static_cast<double>(box.lo[k]) - 1)
            return false;
    return true;
}

bool LeafCutting::is_overlapped(const Part& part, LeafIndex other) {
    return is_near(part, other) && is_within(work_->bench, part.shape, work_->with_edges(other));
}

void LeafCutting::split_along_line(std::size_t first, PlaneId line, LeafIndex cutter, bool sure) {
    const std::size_t end = count_;
    for (std::size_t j = first; j < end; ++j) {
        if (!is_near(parts_[j], cutter)) continue;
        WorkPolygon above;
        PlaneId edge = -1;
        if (!split_along(work_->bench, parts_[j].shape, line, work_->item(cutter).shape, sure,
                         above, keeps_common_lines_ && !sure ? &edge : nullptr)) {
            if (edge >= 0 && !is_common_line_)
                is_common_line_ =
                    is_common_line(work_->bench, work_->item(item_).shape.edges, edge, line);
            continue;
        }
        set_box(parts_[j]);
        Part& other = add_part();
        other.shape = std::move(above);
        other.sides = parts_[j].sides;
        set_box(other);
    }
}

// The edges of an overlapping facet are lines in the plane of the item.
void LeafCutting::split_along_edges(std::size_t first, LeafIndex other) {
    for (const WorkEdge& e : work_->with_edges(other).edges)
        split_along_line(first, e.plane, other, false);
}

void LeafCutting::split(std::size_t first, std::span<const LeafContact> contacts) {
    // Nothing but the first cutter can have cut a whole item in the cell: it need not be tested.
    bool sure = first == 1 && !work_->item(item_).overlapped && work_->item(item_).contained;
    for (const LeafContact& c : contacts) {
        if (!c.cuts) continue;
        split_along_line(first, work_->with_edges(c.other).support, c.other, sure);
        sure = false;
    }
    for (const LeafContact& c : contacts)
        if (c.overlaps) split_along_edges(first, c.other);
}

void LeafCutting::find_sides(Part& part, LeafIndex operand, std::span<const LeafContact> contacts) {
    for (const LeafContact& c : contacts) {
        if (!c.overlaps || !is_overlapped(part, c.other)) continue;
        const LeafItem& other = work_->item(c.other);
        const bool same = same_orientation(work_->bench.plane_at(part.shape.support),
                                           work_->bench.plane_at(other.shape.support));
        const bool faces_up = (other.orientation > 0) == same;
        formula_->set(part.sides.above, as_index(operand), faces_up ? 0 : 1);
        formula_->set(part.sides.below, as_index(operand), faces_up ? 1 : 0);
        return;
    }
    int winding = start_.windings[as_index(operand)];
    if (winding != unknown_winding) {
        const auto change = change_to(part.shape, contacts);
        winding = change ? winding + *change : unknown_winding;
    }
    if (winding == unknown_winding) winding = traced_winding(part.shape, operand);
    formula_->set(part.sides.above, as_index(operand), winding);
    formula_->set(part.sides.below, as_index(operand), winding);
}

std::optional<int> LeafCutting::change_to(const WorkPolygon& part,
                                          std::span<const LeafContact> cutters) {
    ++work_->stats->traces_within;
    const TraceTarget target = middle_of(work_->bench, part);
    int change = 0;
    for (const LeafContact& c : cutters) {
        if (!c.cuts) continue;
        const auto met = crossing(c.other, target.approximation());
        if (!met) return std::nullopt;
        change += *met;
    }
    return change;
}

std::optional<int> LeafCutting::crossing(LeafIndex cutter, const Approximation& end) {
    const Workbench& bench = work_->bench;
    const WorkPolygon& shape = work_->with_edges(cutter);
    const Plane& support = bench.plane_at(shape.support);
    const auto at_end = filtered_side(end, support);
    if (!at_end) return std::nullopt;
    int at_start = 0;
    if (const auto s = filtered_side(start_.at, support)) {
        at_start = sign_of(*s);
    } else if (start_.vertex >= 0) {
        at_start = bench.side(start_.vertex, shape.support);
    } else {
        return std::nullopt;
    }
    // The start is on no polygon; one in whose plane it lies is not met on the way out of that.
    if (at_start == 0 || at_start == sign_of(*at_end)) return 0;
    const int step = at_start * work_->item(cutter).orientation;
    const auto x = approximate_crossing(start_.at, end, support);
    if (!x) return std::nullopt;
    bool uncertain = false;
    for (const WorkEdge& e : shape.edges) {
        const auto s = filtered_side(*x, bench.plane_at(e.plane));
        if (!s) {
            uncertain = true;
        } else if ((*s == Side::Above) != e.above) {
            return 0;
        }
    }
    if (!uncertain) return step;
    const PlaneId plane = work_->item(item_).shape.support;
    Few<int> sides;
    for (const PointId p : shape.points) sides.push_back(bench.side(p, plane));
    const auto [lo, hi] = std::minmax_element(sides.begin(), sides.end());
    if (*hi <= 0) return 0;
    if (*lo < 0) return std::nullopt;
    for (std::size_t k = 0; k < shape.edges.size(); ++k) {
        if (sides[k] == 0 && sides[(k + 1) % sides.size()] == 0) continue;
        if (!filtered_side(*x, bench.plane_at(shape.edges[k].plane))) return std::nullopt;
    }
    return step;
}

int LeafCutting::traced_winding(const WorkPolygon& part, LeafIndex operand) {
    known_.assign(work_->problem->operands.size(), 1);
    known_[as_index(operand)] = 0;
    step_.assign(known_.size(), 0);
    traced_.assign(known_.size(), 0);
    (void)windings_->windings_above(item_, part, step_, known_, traced_);
    return traced_[as_index(operand)];
}

}  // namespace trisect::detail
