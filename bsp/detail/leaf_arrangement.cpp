// SPDX-License-Identifier: Apache-2.0
//
// A mixed leaf holds a few dozen polygons of two or more operands. Every polygon that another one
// cuts is clipped to the cell and split along the traces of the others into convex pieces, as in
// the local BSPs of EMBER (Trettner, Nehring-Wirxel, Kobbelt 2022, sec. 5), but with a flat list
// instead of a tree: leaves are small, and a split is made only where the trace runs through the
// piece's interior. A piece is then on one side of everything, so one winding number on each side
// of it says whether it bounds the result: it does iff the formula changes across it.
//
// Winding numbers come from exact segment traces from the cell's reference point. One trace serves
// a whole patch of untouched facets that hang together by edges within the cell.
//
// Coplanar overlaps: the pieces of a facet are split along the edges of every facet that covers it,
// so each piece is covered completely or not at all. Of all facets that cover a piece the first one
// (by slot, source, facet) speaks for all: the others drop theirs, and the step of winding numbers
// across the piece is the sum over all of them.
//
// What goes wrong otherwise: classifying the two halves of one clipped polygon separately by float
// rays (holes), closed coplanar twins emitted twice, and snapping intersection points. Here no
// coordinate is constructed; a piece is a list of planes.

#include <trisect/bsp/detail/leaf_arrangement.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include <trisect/bsp/detail/leaf_pairs.h>
#include <trisect/bsp/detail/leaf_patches.h>
#include <trisect/bsp/detail/leaf_pieces.h>
#include <trisect/bsp/detail/leaf_windings.h>
#include <trisect/bsp/detail/leaf_work.h>

namespace trisect::detail {

class LeafArranger::Impl {
public:
    LeafResult arrange(const LeafProblem& problem, SlotValues& values, EvaluateStats& stats);

private:
    void emit_all(LeafPatches& patches, LeafWindings& windings);
    void emit_whole(LeafIndex i, LeafPatches& patches, LeafWindings& windings);
    void emit_pieces(LeafIndex i, std::size_t first, LeafWindings& windings);
    void emit(const PolygonRef& ref, const LeafSides& sides);
    static std::size_t u(LeafIndex i) { return LeafWork::u(i); }

    LeafWork work_;
    std::vector<std::optional<LeafSides>> patch_sides_;
    std::vector<PolygonRef> out_;
};

LeafArranger::LeafArranger() : impl_(std::make_unique<Impl>()) {}
LeafArranger::~LeafArranger() = default;

LeafResult LeafArranger::arrange(const LeafProblem& problem, SlotValues& values,
                                 EvaluateStats& stats) {
    return impl_->arrange(problem, values, stats);
}

LeafResult LeafArranger::Impl::arrange(const LeafProblem& problem, SlotValues& values,
                                       EvaluateStats& stats) {
    work_.start(problem, stats);
    out_.clear();
    LeafPairs(work_).relate_all();
    for (LeafItem& item : work_.items) item.ref.touched = item.ref.touched || item.touched;
    LeafPatches patches(work_);
    LeafWindings windings(work_, values);
    patch_sides_.assign(work_.items.size(), std::nullopt);
    try {
        emit_all(patches, windings);
    } catch (...) {
        const PolygonList freed(std::move(out_));  // the fragments made so far
        throw;
    }
    ++stats.mixed_leaves;
    return {std::move(out_), std::move(work_.incomplete)};
}

void LeafArranger::Impl::emit_all(LeafPatches& patches, LeafWindings& windings) {
    for (LeafIndex i = 0; i < static_cast<LeafIndex>(work_.items.size()); ++i) {
        if (work_.item(i).is_whole()) {
            emit_whole(i, patches, windings);
        } else {
            const std::size_t first = work_.pieces.size();
            make_pieces(work_, i);
            emit_pieces(i, first, windings);
        }
    }
}

void LeafArranger::Impl::emit_whole(LeafIndex i, LeafPatches& patches, LeafWindings& windings) {
    const LeafIndex patch = patches.patch_of(i);
    std::optional<LeafSides>& sides = patch_sides_[u(patch)];
    if (!sides) {
        // A facet within the cell needs no clipping.
        const LeafIndex within = patches.facet_within_cell(patch);
        const LeafIndex speaker = within >= 0 ? within : i;
        const LeafItem& item = work_.item(speaker);
        const bool needs_clipping = within < 0 || item.shape.is_empty();
        const WorkPolygon part = needs_clipping
                                     ? work_.bench.clipped(work_.with_edges(speaker),
                                                           item.ref.box(), work_.problem->cell)
                                     : item.shape;
        if (part.is_empty()) return;  // listed for its box, but not in the cell
        sides = windings.sides_of(speaker, part, work_.step_of(speaker));
    }
    emit(work_.item(i).ref, *sides);
}

void LeafArranger::Impl::emit_pieces(LeafIndex i, std::size_t first, LeafWindings& windings) {
    const LeafItem& item = work_.item(i);
    std::vector<std::pair<const WorkPolygon*, LeafSides>> kept;
    for (std::size_t k = first; k < work_.pieces.size(); ++k) {
        const LeafPiece& piece = work_.pieces[k];
        if (piece.dropped) continue;
        const LeafSides sides =
            windings.sides_of(i, piece.shape, work_.steps[static_cast<std::size_t>(piece.step)]);
        if (sides.differ()) kept.emplace_back(&piece.shape, sides);
    }
    if (kept.empty()) return;
    const bool uniform = std::all_of(kept.begin(), kept.end(), [&](const auto& k) {
        return k.second.above == kept.front().second.above;
    });
    if (kept.size() == work_.pieces.size() - first && uniform) {
        // Every cut was in vain here: keep what there was. What cuts a facet somewhere must show in
        // every cell, though (see PolygonRef), so only a facet within the cell stays whole.
        if (const auto part = clip_to_cell(work_.bench, item.ref, work_.problem->cell))
            emit(*part, kept.front().second);
        return;
    }
    for (const auto& [shape, sides] : kept)
        emit(make_fragment(work_.bench, item.ref, *shape), sides);
}

// A polygon bounds the result when it is inside on one side only; its outside faces upwards, unless
// flipped.
void LeafArranger::Impl::emit(const PolygonRef& ref, const LeafSides& sides) {
    if (!sides.differ()) return;
    PolygonRef out = ref;
    out.flipped = sides.above;
    out_.push_back(out);
}

}  // namespace trisect::detail
