// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/split_piece.h>

#include <utility>

namespace trisect::detail {

namespace {

// The interval of the line within the piece is clipped by the edges of the cutter; at every step
// its ends are exact points. `sides`: of the piece's corners with respect to `line`.
bool meets_interior(Workbench& bench, const WorkPolygon& piece, const Workbench::Sides& sides,
                    PlaneId line, const WorkPolygon& cutter, std::array<PointId, 2>& ends) {
    const std::size_t n = piece.points.size();
    ends = {-1, -1};
    bool above = false;
    bool below = false;
    for (std::size_t i = 0; i < n; ++i) {
        above = above || sides[i] > 0;
        below = below || sides[i] < 0;
    }
    if (!above || !below) return false;
    // Ends of the interval are corners on the line or crossings of edges.
    std::size_t found = 0;
    for (std::size_t i = 0; i < n && found < 2; ++i) {
        const int here = sides[i];
        const int next = sides[i + 1 < n ? i + 1 : 0];
        if (here == 0) {
            ends[found++] = piece.points[i];
        } else if (here * next < 0) {
            ends[found++] = bench.meet(piece.support, piece.edges[i].plane, line);
        }
    }
    if (found < 2) return false;
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

}  // namespace

bool split_along(Workbench& bench, WorkPolygon& piece, PlaneId line, const WorkPolygon& cutter,
                 bool sure, WorkPolygon& above, PlaneId* along) {
    const Workbench::Sides& sides = bench.sides_of(piece, line);
    if (along != nullptr) {
        const std::size_t n = piece.points.size();
        for (std::size_t i = 0; i < n; ++i)
            if (sides[i] == 0 && sides[i + 1 < n ? i + 1 : 0] == 0) {
                *along = piece.edges[i].plane;
                return false;
            }
    }
    std::array<PointId, 2> ends{};
    if (!sure && !meets_interior(bench, piece, sides, line, cutter, ends)) return false;
    WorkPolygon below;
    bench.split(piece, line, sides, below, above);
    piece = std::move(below);
    return true;
}

bool segment_meets_interior(Workbench& bench, const WorkPolygon& piece, PlaneId line,
                            const WorkPolygon& cutter, std::array<PointId, 2>& ends) {
    return meets_interior(bench, piece, bench.sides_of(piece, line), line, cutter, ends);
}

bool is_common_line(const Workbench& bench, const Few<WorkEdge>& own, PlaneId edge,
                    PlaneId cutter) {
    for (const PlaneId p : {edge, cutter})
        if (bench.name(p).is_splitter() || bench.name(p).is_edge()) return false;
    for (const WorkEdge& e : own)
        if (e.plane == edge) return false;
    return !is_same_plane(bench.plane_at(edge), bench.plane_at(cutter));
}

}  // namespace trisect::detail
