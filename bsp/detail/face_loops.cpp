// SPDX-License-Identifier: Apache-2.0
//
// Chaining is trivial where one edge leaves every vertex. Where the region touches itself in a
// vertex several edges leave, and the right continuation of an arriving edge is the other side of
// the same wedge of the region: the first leaving edge clockwise from the way back. Then loops
// touch but never cross. All turns are decided by which side of an edge's line a point lies on,
// never by angles.
//
// Holes: the region lies immediately to the low-u side of a hole's smallest vertex (u, v: the two
// axes across the dominant one). That point, moved by an infinitesimal amount, lies on no edge, and
// its parity with respect to an outer loop is exact without special cases.

#include <trisect/bsp/detail/face_loops.h>

#include <algorithm>
#include <numeric>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

class LoopMaker {
public:
    LoopMaker(const Workbench& bench, PlaneId support, bool flipped,
              std::span<const BoundaryEdge> edges)
        : bench_(bench), edges_(edges) {
        const Plane& p = bench.plane_at(support);
        const int k = p.dominant_axis();
        u_ = (k + 1) % 3;
        v_ = (k + 2) % 3;
        right_handed_ = (p.normal(k) > 0) != flipped;
    }

    std::vector<FaceLoops> run();

private:
    struct Loop {
        std::vector<std::size_t> edges;
        bool outer = false;
        std::size_t smallest = 0;  // position of the smallest vertex: start of edges[smallest]
    };

    // 1 when p lies on the region's side of the line of the edge, which is the left, -1 right, 0
    // on.
    [[nodiscard]] int left_of(std::size_t edge, PointId p) const {
        const WorkEdge& line = edges_[edge].line;
        const int s = bench_.side(p, line.plane);
        return line.above ? s : -s;
    }
    [[nodiscard]] int compare(PointId a, PointId b) const {
        if (a == b) return 0;
        const int c = compare_along(bench_, a, b, u_);
        return c != 0 ? c : compare_along(bench_, a, b, v_);
    }
    void chain();
    [[nodiscard]] std::size_t continuation(std::size_t arriving,
                                           std::span<const std::size_t> leaving) const;
    void orient(Loop& loop) const;
    [[nodiscard]] bool contains(const Loop& outer, PointId p) const;
    [[nodiscard]] std::size_t owner_of(const Loop& hole) const;

    const Workbench& bench_;
    std::span<const BoundaryEdge> edges_;
    int u_ = 0;
    int v_ = 1;
    bool right_handed_ = true;
    std::vector<Loop> loops_;
};

// Clockwise from the way back: first what lies to the left of the arriving edge, then straight on,
// then what lies to the right; of two on the same side the one that has the other on its right.
std::size_t LoopMaker::continuation(std::size_t arriving,
                                    std::span<const std::size_t> leaving) const {
    const auto comes_first = [&](std::size_t a, std::size_t b) {
        const int sa = left_of(arriving, edges_[a].to);
        const int sb = left_of(arriving, edges_[b].to);
        if (sa != sb) return sa > sb;
        return left_of(b, edges_[a].to) > 0;
    };
    std::size_t best = leaving[0];
    for (const std::size_t e : leaving.subspan(1))
        if (comes_first(e, best)) best = e;
    return best;
}

void LoopMaker::chain() {
    std::vector<std::size_t> by_start(edges_.size());
    std::iota(by_start.begin(), by_start.end(), std::size_t{0});
    std::stable_sort(by_start.begin(), by_start.end(),
                     [&](std::size_t a, std::size_t b) { return edges_[a].from < edges_[b].from; });
    const auto leaving = [&](PointId p) {
        const auto lo =
            std::lower_bound(by_start.begin(), by_start.end(), p,
                             [&](std::size_t e, PointId q) { return edges_[e].from < q; });
        auto hi = lo;
        while (hi != by_start.end() && edges_[*hi].from == p) ++hi;
        return std::span<const std::size_t>(lo, hi);
    };
    std::vector<bool> used(edges_.size(), false);
    for (std::size_t start = 0; start < edges_.size(); ++start) {
        if (used[start]) continue;
        Loop loop;
        std::size_t e = start;
        do {
            TRISECT_EXPECTS(!used[e], "boundary edges of a face cross");
            used[e] = true;
            loop.edges.push_back(e);
            const auto next = leaving(edges_[e].to);
            TRISECT_EXPECTS(!next.empty(), "boundary of a face is not closed");
            e = next.size() == 1 ? next[0] : continuation(e, next);
        } while (e != start);
        orient(loop);
        loops_.push_back(std::move(loop));
    }
}

// At the smallest vertex an outer loop only turns left; a hole turns right there at least once.
void LoopMaker::orient(Loop& loop) const {
    const std::size_t n = loop.edges.size();
    for (std::size_t i = 1; i < n; ++i)
        if (compare(edges_[loop.edges[i]].from, edges_[loop.edges[loop.smallest]].from) < 0)
            loop.smallest = i;
    const PointId p = edges_[loop.edges[loop.smallest]].from;
    loop.outer = true;
    for (std::size_t i = 0; i < n; ++i) {
        if (edges_[loop.edges[i]].from != p) continue;
        const std::size_t before = loop.edges[(i + n - 1) % n];
        if (left_of(before, edges_[loop.edges[i]].to) < 0) loop.outer = false;
    }
}

// Parity of p, moved by an infinitesimal amount towards low u and less than that towards low v.
bool LoopMaker::contains(const Loop& outer, PointId p) const {
    bool inside = false;
    for (const std::size_t e : outer.edges) {
        const bool from_below = compare_along(bench_, edges_[e].from, p, v_) < 0;
        const bool to_below = compare_along(bench_, edges_[e].to, p, v_) < 0;
        if (from_below == to_below) continue;
        // Left of an upward edge is low u in a right-handed view.
        const bool left_is_low = from_below == right_handed_;
        const int left = left_of(e, p);
        const bool edge_at_lower_u = left_is_low ? left < 0 : left > 0;
        if (edge_at_lower_u) inside = !inside;
    }
    return inside;
}

// The innermost outer loop around a hole: of several, which are nested, the one that starts last.
std::size_t LoopMaker::owner_of(const Loop& hole) const {
    const PointId p = edges_[hole.edges[hole.smallest]].from;
    std::size_t best = loops_.size();
    for (std::size_t i = 0; i < loops_.size(); ++i) {
        if (!loops_[i].outer || !contains(loops_[i], p)) continue;
        const auto start = [&](std::size_t l) {
            return edges_[loops_[l].edges[loops_[l].smallest]].from;
        };
        if (best == loops_.size() || compare(start(i), start(best)) > 0) best = i;
    }
    TRISECT_EXPECTS(best < loops_.size(), "a hole lies in no face");
    return best;
}

std::vector<FaceLoops> LoopMaker::run() {
    chain();
    std::vector<FaceLoops> out;
    std::vector<std::size_t> face_of(loops_.size());
    const auto points_of = [&](const Loop& loop) {
        std::vector<PointId> points;
        const std::size_t n = loop.edges.size();
        for (std::size_t i = 0; i < n; ++i)
            points.push_back(edges_[loop.edges[(loop.smallest + i) % n]].from);
        return points;
    };
    for (std::size_t i = 0; i < loops_.size(); ++i) {
        if (!loops_[i].outer) continue;
        face_of[i] = out.size();
        out.push_back({{points_of(loops_[i])}});
    }
    for (const Loop& loop : loops_)
        if (!loop.outer) out[face_of[owner_of(loop)]].loops.push_back(points_of(loop));
    return out;
}

}  // namespace

std::vector<FaceLoops> make_face_loops(const Workbench& bench, PlaneId support, bool flipped,
                                       std::span<const BoundaryEdge> edges) {
    return LoopMaker(bench, support, flipped, edges).run();
}

}  // namespace trisect::detail
