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

#include <trisect/bsp/evaluate/leaf_arrangement.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <trisect/bsp/leaf/doubles/plain_leaf.h>
#include <trisect/bsp/leaf/exact/leaf_anchors.h>
#include <trisect/bsp/leaf/exact/leaf_classification.h>
#include <trisect/bsp/leaf/exact/leaf_cutting.h>
#include <trisect/bsp/leaf/exact/leaf_links.h>
#include <trisect/bsp/leaf/exact/leaf_pairs.h>
#include <trisect/bsp/leaf/exact/leaf_pieces.h>
#include <trisect/bsp/leaf/grid/axis_leaf.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/bsp/leaf/leaf_work.h>
#include <trisect/bsp/leaf/prism/prism_leaf.h>

namespace trisect::detail {

class LeafArranger::Impl {
public:
    LeafResult arrange(const LeafProblem& problem, SlotValues& values, EvaluateStats& stats);
    std::optional<LeafResult> arrange_across_axes(const LeafProblem& problem, EvaluateStats& stats);
    std::optional<LeafResult> arrange_prisms(const LeafProblem& problem, EvaluateStats& stats);
    std::optional<LeafResult> arrange_plain(const LeafProblem& problem, EvaluateStats& stats);
    void collect_crossings(std::span<const Crossings::Operand> operands) {
        collect_ = true;
        crossings_.operands.assign(operands.begin(), operands.end());
    }
    void make_pictures() { pictures_ = true; }
    [[nodiscard]] std::size_t largest_leaf() const { return largest_leaf_; }
    void forget() {
        pictures_ = collect_ = false;
        crossings_ = {};
        seen_ = {};
    }
    void note_doubtful(std::int32_t slot, std::uint32_t facet) {
        crossings_.doubtful.push_back(crossings_.number_of(static_cast<std::size_t>(slot), facet));
    }
    [[nodiscard]] const Crossings& crossings() const { return crossings_; }
    [[nodiscard]] const std::vector<std::uint32_t>& seen() const { return seen_; }

private:
    template <class Work>
    auto or_end_fragments(const LeafProblem& problem, const Work& work);
    void note_doubtful(const LeafProblem& problem);
    // What a leaf keeps is as large as it need be; what it was collected in is used again.
    [[nodiscard]] std::vector<PolygonRef> listed() {
        std::vector<PolygonRef> list(out_.begin(), out_.end());
        out_.clear();
        return list;
    }
    void arrange_embedded();
    void arrange_any(SlotValues& values);
    void emit_remains(LeafIndex i, const LeafRemains& remains);
    void emit_all();
    void emit_pieces(LeafIndex i, std::size_t first, std::size_t last);
    void emit(const PolygonRef& ref, bool inside_above);

    AxisLeaf axis_;
    PlainLeaf plain_;
    PrismLeaf prisms_;
    LeafWork work_;
    LeafPairs pairs_;
    LeafLinks links_;
    LeafClassification classes_;
    LeafWindings windings_;
    LeafAnchors anchors_;
    LeafCutting cutting_;
    LeafFormula formula_;
    std::size_t largest_leaf_ = 0;
    bool pictures_ = false;
    bool collect_ = false;
    Crossings crossings_;
    std::vector<std::uint32_t> seen_;
    std::vector<PolygonRef> out_;
    std::vector<std::pair<const WorkPolygon*, LeafSides>> kept_;
};

LeafArranger::LeafArranger() : impl_(std::make_unique<Impl>()) {}
LeafArranger::~LeafArranger() = default;

LeafResult LeafArranger::arrange(const LeafProblem& problem, SlotValues& values,
                                 EvaluateStats& stats) {
    return impl_->arrange(problem, values, stats);
}

void LeafArranger::collect_crossings(std::span<const Crossings::Operand> operands) {
    impl_->collect_crossings(operands);
}

void LeafArranger::make_pictures() { impl_->make_pictures(); }

void LeafArranger::note_doubtful(std::int32_t slot, std::uint32_t facet) {
    impl_->note_doubtful(slot, facet);
}

std::size_t LeafArranger::largest_leaf() const { return impl_->largest_leaf(); }

void LeafArranger::forget() { impl_->forget(); }

const Crossings& LeafArranger::crossings() const { return impl_->crossings(); }

const std::vector<std::uint32_t>& LeafArranger::seen() const { return impl_->seen(); }

std::optional<LeafResult> LeafArranger::arrange_across_axes(const LeafProblem& problem,
                                                            EvaluateStats& stats) {
    return impl_->arrange_across_axes(problem, stats);
}

std::optional<LeafResult> LeafArranger::arrange_prisms(const LeafProblem& problem,
                                                       EvaluateStats& stats) {
    return impl_->arrange_prisms(problem, stats);
}

std::optional<LeafResult> LeafArranger::arrange_plain(const LeafProblem& problem,
                                                      EvaluateStats& stats) {
    return impl_->arrange_plain(problem, stats);
}

// Calls `work`, which fills out_; when memory ends on the way, the fragments made so far are freed.
template <class Work>
auto LeafArranger::Impl::or_end_fragments(const LeafProblem& problem, const Work& work) {
    std::size_t size = 0;
    for (const LeafOperand& o : problem.operands) size += o.polygons.size();
    largest_leaf_ = std::max(largest_leaf_, size);
    out_.clear();
    try {
        return work();
    } catch (...) {
        end_fragments(out_);
        throw;
    }
}

std::optional<LeafResult> LeafArranger::Impl::arrange_prisms(const LeafProblem& problem,
                                                             EvaluateStats& stats) {
    return or_end_fragments(problem, [&]() -> std::optional<LeafResult> {
        if (!prisms_.arrange(problem, stats, out_)) return std::nullopt;
        note_doubtful(problem);
        return LeafResult{listed(), {}};
    });
}

std::optional<LeafResult> LeafArranger::Impl::arrange_across_axes(const LeafProblem& problem,
                                                                  EvaluateStats& stats) {
    return or_end_fragments(problem, [&]() -> std::optional<LeafResult> {
        std::vector<FacetName> incomplete;
        std::unique_ptr<AxisPicture> picture;
        if (!(pictures_ ? axis_.picture(problem, stats, out_, incomplete, picture)
                        : axis_.arrange(problem, stats, out_, incomplete)))
            return std::nullopt;
        note_doubtful(problem);
        if (picture == nullptr) return LeafResult{listed(), std::move(incomplete)};
        picture->facets = PolygonList(listed());
        return LeafResult{{}, std::move(incomplete), 0, std::move(picture)};
    });
}

// General position, in doubles.
std::optional<LeafResult> LeafArranger::Impl::arrange_plain(const LeafProblem& problem,
                                                            EvaluateStats& stats) {
    return or_end_fragments(problem, [&]() -> std::optional<LeafResult> {
        if (!collect_ || problem.operands.size() < 2) {
            if (!plain_.arrange(problem, stats, out_)) return std::nullopt;
            return LeafResult{listed(), {}};
        }
        const auto crossed = plain_.arrange_uncrossed(problem, stats, out_, crossings_, seen_);
        if (!crossed) return std::nullopt;
        return LeafResult{listed(), {}, *crossed};
    });
}

void LeafArranger::Impl::note_doubtful(const LeafProblem& problem) {
    if (!collect_) return;
    for (const LeafOperand& o : problem.operands)
        for (const PolygonRef& r : o.polygons) note_doubtful(o.slot, r.facet);
}

LeafResult LeafArranger::Impl::arrange(const LeafProblem& problem, SlotValues& values,
                                       EvaluateStats& stats) {
    if (auto result = arrange_across_axes(problem, stats)) return *std::move(result);
    if (auto result = arrange_plain(problem, stats)) return *std::move(result);
    if (auto result = arrange_prisms(problem, stats)) return *std::move(result);
    return or_end_fragments(problem, [&] {
        note_doubtful(problem);
        work_.start(problem, stats);
        pairs_.relate_all(work_);
        if (std::all_of(problem.operands.begin(), problem.operands.end(),
                        [](const LeafOperand& o) { return o.embedded; })) {
            arrange_embedded();
        } else {
            arrange_any(values);
        }
        ++stats.mixed_leaves;
        return LeafResult{listed(), std::move(work_.incomplete)};
    });
}

// Operands without self-intersections: cut only what the result needs (leaf_cutting.h).
void LeafArranger::Impl::arrange_embedded() {
    windings_.start(work_);
    anchors_.build(work_, windings_);
    formula_.start(*work_.problem);
    cutting_.start(work_, windings_, anchors_, formula_);
    for (LeafIndex i = 0; i < work_.item_count(); ++i) {
        const bool whole = work_.item(i).is_whole();
        if (whole && !work_.item(i).ref.touched) ++work_.stats->untouched_polygons;
        emit_remains(i, whole ? cutting_.whole(i) : cutting_.cut(i));
    }
}

void LeafArranger::Impl::emit_remains(LeafIndex i, const LeafRemains& remains) {
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
void LeafArranger::Impl::arrange_any(SlotValues& values) {
    for (LeafIndex i = 0; i < work_.item_count(); ++i)
        if (!work_.item(i).is_whole()) make_pieces(work_, i);
    links_.build(work_);
    classes_.classify(work_, links_, values);
    emit_all();
}

void LeafArranger::Impl::emit_all() {
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

void LeafArranger::Impl::emit_pieces(LeafIndex i, std::size_t first, std::size_t last) {
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
    if (kept_.size() == last - first && uniform) {
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
void LeafArranger::Impl::emit(const PolygonRef& ref, bool inside_above) {
    PolygonRef out = ref;
    out.flipped = inside_above;
    out_.push_back(out);
}

}  // namespace trisect::detail
