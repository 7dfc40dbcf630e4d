// SPDX-License-Identifier: Apache-2.0
//
// A mixed leaf holds a few dozen polygons of two or more operands. Every polygon that another one
// cuts is clipped to the cell and split along the traces of the others into convex pieces, as in
// the local BSPs of EMBER (Trettner, Nehring-Wirxel, Kobbelt 2022, sec. 5), but with a flat list
// instead of a tree: leaves are small, and a split is made only where the trace runs through the
// piece's interior. A piece is then on one side of everything, so one winding number on each side
// of it says whether it bounds the result: it does iff the formula changes across it.
//
// Winding numbers come from exact segment traces from the cell's reference point. Those are dear,
// so they are carried over as far as possible: where all operands are embedded, from vertex to
// vertex and within each polygon (leaf_anchors.h, leaf_cutting.h); where an operand may meet
// itself, from piece to piece (leaf_links.h).
//
// Coplanar overlaps: the pieces of a facet are split along the edges of every facet that overlaps
// it, so each piece is overlapped completely or not at all. Of all facets that overlap a piece the
// first one (by slot, source, facet) represents all: the others drop theirs, and the step of
// winding numbers across the piece is the sum over all of them.
//
// What goes wrong otherwise: classifying the two halves of one clipped polygon separately by float
// rays (holes), closed coplanar twins emitted twice, and snapping intersection points. Here no
// coordinate is constructed; a piece is a list of planes.

#include <trisect/bsp/leaf/exact/exact_leaf.h>

#include <algorithm>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/leaf/exact/leaf_pieces.h>
#include <trisect/bsp/leaf/straight_crossings.h>

namespace trisect::detail {

std::optional<LeafResult> ExactLeaf::try_to_arrange(const LeafProblem& problem,
                                                    LeafFindings& findings) {
    findings.note_uncertain(problem);
    work_.start(problem, findings.stats);
    pairs_.relate_all(work_);
    may_cross_straight_ = may_have_straight_crossings(problem);
    if (may_cross_straight_) findings.may_have_straight_crossings = true;
    if (std::ranges::all_of(problem.operands, &LeafOperand::embedded)) {
        arrange_embedded();
    } else {
        arrange_any();
    }
    findings.incomplete.insert(findings.incomplete.end(), work_.incomplete.begin(),
                               work_.incomplete.end());
    return LeafPolygons{listed()};
}

// Operands without self-intersections: cut only what the result needs (leaf_cutting.h).
void ExactLeaf::arrange_embedded() {
    windings_.start(work_);
    anchors_.build(work_, windings_);
    formula_.start(*work_.problem);
    cutting_.start(work_, windings_, anchors_, formula_, may_cross_straight_);
    for (LeafIndex i = 0; i < work_.item_count(); ++i) {
        const bool whole = work_.item(i).is_whole();
        if (whole && !work_.item(i).ref.touched) ++work_.stats->untouched_polygons;
        emit_remains(i, whole ? cutting_.whole(i) : cutting_.cut(i));
    }
}

void ExactLeaf::emit_remains(LeafIndex i, const LeafRemains& remains) {
    const LeafItem& item = work_.item(i);
    make_room(out_);
    switch (remains.kind) {
        case LeafRemains::Kind::Nothing:
            return;
        case LeafRemains::Kind::Uncut:
            if (item.is_whole()) {
                emit(item.ref, remains.inside_above);
            } else if (const auto part = clip_to_cell(work_.bench, item.ref, work_.problem->cell)) {
                // What cuts a facet somewhere must show in every cell (see PolygonRef), so only a
                // facet within the cell stays whole.
                emit(*part, remains.inside_above);
            }
            return;
        case LeafRemains::Kind::Parts:
            for (const LeafPart& part : cutting_.parts()) {
                make_room(out_);
                emit(make_fragment(work_.bench, item.ref, part.shape), part.inside_above);
            }
            return;
    }
}

// Any operands: cut everything, then classify the pieces by their neighbours.
void ExactLeaf::arrange_any() {
    has_common_lines_.assign(work_.items.size(), false);
    for (LeafIndex i = 0; i < work_.item_count(); ++i)
        if (!work_.item(i).is_whole()) has_common_lines_[as_index(i)] = make_pieces(work_, i);
    links_.build(work_);
    classes_.classify(work_, links_);
    emit_all();
}

void ExactLeaf::emit_all() {
    std::size_t first = 0;
    for (LeafIndex i = 0; i < work_.item_count(); ++i) {
        const LeafItem& item = work_.item(i);
        if (item.is_whole()) {
            if (!item.ref.touched) ++work_.stats->untouched_polygons;
            if (const auto& sides = classes_.sides(i); sides && sides->differ())
                emit(item.ref, sides->above);
            continue;
        }
        std::size_t last = first;
        while (last < work_.pieces.size() && work_.pieces[last].item == i) ++last;
        emit_pieces(i, first, last);
        first = last;
    }
}

void ExactLeaf::emit_pieces(LeafIndex i, std::size_t first, std::size_t last) {
    const LeafItem& item = work_.item(i);
    kept_.clear();
    for (std::size_t k = first; k < last; ++k) {
        const auto& sides = classes_.sides(work_.item_count() + static_cast<LeafNode>(k));
        if (sides && sides->differ()) kept_.emplace_back(&work_.pieces[k].shape, *sides);
    }
    if (kept_.empty()) return;
    const bool uniform = std::all_of(kept_.begin(), kept_.end(), [&](const auto& k) {
        return k.second.above == kept_.front().second.above;
    });
    if (kept_.size() == last - first && uniform &&
        (kept_.size() == 1 || !has_common_lines_[as_index(i)])) {
        // Every cut was in vain here: keep what there was. What cuts a facet somewhere must show in
        // every cell, though (see PolygonRef), so only a facet within the cell stays whole.
        make_room(out_);
        if (const auto part = clip_to_cell(work_.bench, item.ref, work_.problem->cell))
            emit(*part, kept_.front().second.above);
        return;
    }
    for (const auto& [shape, sides] : kept_) {
        make_room(out_);
        emit(make_fragment(work_.bench, item.ref, *shape), sides.above);
    }
}

// The outside faces upwards, unless flipped.
void ExactLeaf::emit(const PolygonRef& ref, bool inside_above) {
    PolygonRef out = ref;
    out.flipped = inside_above;
    out_.push_back(out);
}

}  // namespace trisect::detail
