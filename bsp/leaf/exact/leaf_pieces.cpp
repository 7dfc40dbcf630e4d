// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/exact/leaf_pieces.h>

#include <utility>

#include <trisect/bsp/leaf/exact/leaf_coincidence.h>
#include <trisect/bsp/leaf/split_piece.h>

namespace trisect::detail {

namespace {

// Splits the pieces from `first` on.
void split_all(LeafWork& work, std::size_t first, PlaneId plane, const WorkPolygon& cutter) {
    const std::size_t end = work.pieces.size();
    for (std::size_t i = first; i < end; ++i) {
        WorkPolygon above;
        if (!split_along(work.bench, work.pieces[i].shape, plane, cutter, false, above)) continue;
        LeafPiece other;
        other.item = work.pieces[i].item;
        other.shape = std::move(above);
        work.pieces.push_back(std::move(other));
    }
}

}  // namespace

void make_pieces(LeafWork& work, LeafIndex i) {
    const LeafItem& item = work.item(i);
    LeafPiece start;
    start.item = i;
    start.shape = work.with_edges(i);
    if (!item.contained)
        start.shape = work.bench.clipped(start.shape, item.ref.box(), work.problem->cell);
    if (start.shape.is_empty()) return;
    const std::size_t first = work.pieces.size();
    work.pieces.push_back(std::move(start));
    for (const LeafContact& c : work.contacts(i)) {
        if (!c.cuts) continue;
        const WorkPolygon& cutter = work.with_edges(c.other);
        split_all(work, first, cutter.support, cutter);
    }
    if (item.overlapped) {
        for (const LeafContact& c : work.contacts(i)) {
            if (!c.overlaps) continue;
            // The edges of the overlapping facet are lines in the plane of the item, given by its
            // edge planes.
            const WorkPolygon& other = work.with_edges(c.other);
            for (const WorkEdge& e : other.edges) split_all(work, first, e.plane, other);
        }
        resolve_coincidence(work, first);
    }
    work.stats->pieces += work.pieces.size() - first;
}

}  // namespace trisect::detail
