// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/leaf_pieces.h>

#include <array>
#include <utility>

#include <trisect/bsp/detail/leaf_coincidence.h>

namespace trisect::detail {

// The interval of the line within the piece is clipped by the edges of the cutter; at every step
// its ends are exact points.
bool segment_meets_interior(Workbench& bench, const WorkPolygon& piece, PlaneId line,
                            const WorkPolygon& cutter) {
    const std::size_t n = piece.points.size();
    std::array<PointId, 2> ends{-1, -1};
    bool above = false;
    bool below = false;
    std::size_t found = 0;
    // Sides once around; ends of the interval are vertices on the line or crossings of edges.
    int here = bench.side(piece.points[0], line);
    const int first = here;
    for (std::size_t i = 0; i < n; ++i) {
        const int next = i + 1 < n ? bench.side(piece.points[i + 1], line) : first;
        above = above || here > 0;
        below = below || here < 0;
        if (here == 0 && found < 2) {
            ends[found++] = piece.points[i];
        } else if (here * next < 0 && found < 2) {
            ends[found++] = bench.meet(piece.support, piece.edges[i].plane, line);
        }
        here = next;
    }
    if (!above || !below || found < 2) return false;
    for (const WorkEdge& e : cutter.edges) {
        const int outside = e.above ? -1 : 1;
        const int s0 = bench.side(ends[0], e.plane) * outside;
        const int s1 = bench.side(ends[1], e.plane) * outside;
        // An edge of the cutter along the line itself: the surface may go on behind that edge on
        // the other side of the piece's plane, so touching along an edge counts as cutting.
        if (s0 == 0 && s1 == 0) continue;
        if (s0 >= 0 && s1 >= 0) return false;
        if (s0 > 0) ends[0] = bench.meet(piece.support, line, e.plane);
        if (s1 > 0) ends[1] = bench.meet(piece.support, line, e.plane);
    }
    return true;
}

namespace {

// Splits the pieces from `first` on.
void split_all(LeafWork& work, std::size_t first, PlaneId plane, const WorkPolygon& cutter) {
    const std::size_t end = work.pieces.size();
    for (std::size_t i = first; i < end; ++i) {
        if (!segment_meets_interior(work.bench, work.pieces[i].shape, plane, cutter)) continue;
        WorkPolygon below;
        WorkPolygon above;
        if (!work.bench.split(work.pieces[i].shape, plane, below, above)) continue;
        LeafPiece other = work.pieces[i];
        other.shape = std::move(above);
        work.pieces[i].shape = std::move(below);
        work.pieces.push_back(std::move(other));
    }
}

}  // namespace

void make_pieces(LeafWork& work, LeafIndex s) {
    const LeafItem& item = work.item(s);
    LeafPiece start;
    start.item = s;
    start.shape = work.bench.clipped(work.with_edges(s), item.ref.box(), work.problem->cell);
    if (start.shape.is_empty()) return;
    const std::size_t first = work.pieces.size();
    work.pieces.push_back(std::move(start));
    for (const LeafIndex t : work.item(s).cutters)
        split_all(work, first, work.item(t).shape.support, work.item(t).shape);
    for (const LeafIndex t : work.item(s).covers) {
        // The edges of the covering facet are lines in the plane of s, given by its edge planes.
        const WorkPolygon cover = work.with_edges(t);
        for (const WorkEdge& e : cover.edges) split_all(work, first, e.plane, cover);
    }
    resolve_coincidence(work, first);
    work.stats->pieces += work.pieces.size() - first;
}

}  // namespace trisect::detail
