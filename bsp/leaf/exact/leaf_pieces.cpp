// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/exact/leaf_pieces.h>

#include <utility>

#include <trisect/bsp/leaf/exact/leaf_coincidence.h>
#include <trisect/bsp/leaf/split_piece.h>

namespace trisect::detail {

namespace {

// Splits the pieces from `first` on. Returns whether an edge along which one was cut before lies in
// the plane, too, and in another plane.
bool split_all(LeafWork& work, std::size_t first, PlaneId plane, const WorkPolygon& cutter) {
    const std::size_t end = work.pieces.size();
    bool found = false;
    for (std::size_t i = first; i < end; ++i) {
        WorkPolygon above;
        PlaneId edge = -1;
        if (!split_along(work.bench, work.pieces[i].shape, plane, cutter, false, above, &edge)) {
            if (edge >= 0 && !found)
                found = is_common_line(work.bench, work.item(work.pieces[i].item).shape.edges, edge,
                                       plane);
            continue;
        }
        LeafPiece other;
        other.item = work.pieces[i].item;
        other.shape = std::move(above);
        work.pieces.push_back(std::move(other));
    }
    return found;
}

}  // namespace

bool make_pieces(LeafWork& work, LeafIndex i) {
    const LeafItem& item = work.item(i);
    LeafPiece start;
    start.item = i;
    start.shape = work.with_edges(i);
    if (!item.contained)
        start.shape = work.bench.clipped(start.shape, item.ref.box(), work.problem->cell);
    if (start.shape.is_empty()) return false;
    const std::size_t first = work.pieces.size();
    work.pieces.push_back(std::move(start));
    bool has_common_lines = false;
    for (const LeafContact& c : work.contacts(i)) {
        if (!c.cuts) continue;
        const WorkPolygon& cutter = work.with_edges(c.other);
        has_common_lines = split_all(work, first, cutter.support, cutter) || has_common_lines;
    }
    if (item.overlapped) {
        for (const LeafContact& c : work.contacts(i)) {
            if (!c.overlaps) continue;
            // The edges of the overlapping facet are lines in the plane of the item, given by its
            // edge planes.
            const WorkPolygon& other = work.with_edges(c.other);
            for (const WorkEdge& e : other.edges) (void)split_all(work, first, e.plane, other);
        }
        resolve_coincidence(work, first);
    }
    work.stats->pieces += work.pieces.size() - first;
    return has_common_lines;
}

}  // namespace trisect::detail
