// SPDX-License-Identifier: Apache-2.0
//
// Chaining is trivial where one edge leaves every vertex. Where the region touches itself in a
// vertex several edges leave, and the right continuation of an arriving edge is the other side of
// the same wedge of the region: the first leaving edge clockwise from the way back. Then loops
// touch but never cross. All turns are decided by which side of an edge's line a point lies on,
// never by angles. Where the region is slit, a segment is an edge in both directions; at the tip of
// a slit the only way on is the way back, a full turn.
//
// Holes: the region lies immediately to the low side of a hole's smallest vertex, so the edge
// straight below that vertex, with the region above it, belongs to the same face: to its outer
// loop, or to a hole that starts earlier and whose face is known. One sweep finds these edges; to
// test every hole against every loop is quadratic, and engraved plates have thousands of both.

#include <trisect/bsp/assembly/parts/face_loops.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include <trisect/brep/face/loops_below.h>
#include <trisect/bsp/cells/point_order.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

// 1 when p lies on the region's side of the line of the edge, which is the left, -1 right, 0 on.
int FaceLoops::left_of(std::size_t edge, PointId p) const {
    const BoundaryEdge& e = edges_[edge];
    // Mostly doubles decide, and then the plane of the line is not made.
    if (const int s = PlaneProjection::filtered_orientation(bench_.approximation(e.from),
                                                            bench_.approximation(e.to),
                                                            bench_.approximation(p), axes());
        s != 0)
        return s;
    const WorkEdge& line = e.line;
    const int s = bench_.side(p, line.plane);
    return line.above ? s : -s;
}

int FaceLoops::compare(PointId a, PointId b) const {
    if (a == b) return 0;
    const int c = compare_along(bench_, a, b, u_);
    return c != 0 ? c : compare_along(bench_, a, b, v_);
}

std::span<const std::pair<PointId, std::uint32_t>> FaceLoops::leaving(PointId p) const {
    auto lo = by_start_.begin();
    if (by_start_.size() > 16) {
        lo = std::lower_bound(lo, by_start_.end(), std::pair{p, std::uint32_t{0}});
    } else {
        while (lo != by_start_.end() && lo->first < p) ++lo;
    }
    auto hi = lo;
    while (hi != by_start_.end() && hi->first == p) ++hi;
    return {std::to_address(lo), std::to_address(hi)};
}

// Clockwise from the way back: first what lies to the left of the arriving edge, then straight on,
// then what lies to the right, then the way back itself; of two on the same side the one that has
// the other on its right.
std::size_t FaceLoops::continuation(std::size_t arriving, PointId at) const {
    const auto choices = leaving(at);
    TRISECT_EXPECTS(!choices.empty(), "boundary of a face is not closed");
    const auto side = [&](std::size_t e) {
        return edges_[e].to == edges_[arriving].from ? -2 : left_of(arriving, edges_[e].to);
    };
    const auto comes_first = [&](std::size_t a, std::size_t b) {
        const int sa = side(a);
        const int sb = side(b);
        if (sa != sb) return sa > sb;
        return left_of(b, edges_[a].to) > 0;
    };
    std::size_t best = choices[0].second;
    for (const auto& [p, e] : choices.subspan(1))
        if (comes_first(e, best)) best = e;
    return best;
}

void FaceLoops::chain_from(std::size_t start) {
    chain_.clear();
    std::size_t e = start;
    do {
        TRISECT_EXPECTS(!used_[e], "boundary edges of a face cross");
        used_[e] = true;
        chain_.push_back(static_cast<std::uint32_t>(e));
        e = continuation(e, edges_[e].to);
    } while (e != start);
}

// At the smallest vertex an outer loop only turns left; a hole turns right or back there at least
// once.
bool FaceLoops::is_outer(std::size_t smallest) const {
    const std::size_t n = chain_.size();
    const PointId p = edges_[chain_[smallest]].from;
    for (std::size_t i = 0; i < n; ++i) {
        if (edges_[chain_[i]].from != p) continue;
        const std::size_t before = chain_[i == 0 ? n - 1 : i - 1];
        if (edges_[before].from == edges_[chain_[i]].to) return false;
        if (left_of(before, edges_[chain_[i]].to) < 0) return false;
    }
    return true;
}

void FaceLoops::add_loop() {
    const std::size_t n = chain_.size();
    std::size_t smallest = 0;
    for (std::size_t i = 1; i < n; ++i) {
        const int c = compare(edges_[chain_[i]].from, edges_[chain_[smallest]].from);
        // A loop may pass its smallest vertex several times: the rightmost edge is the first.
        if (c < 0 || (c == 0 && left_of(chain_[smallest], edges_[chain_[i]].to) < 0)) smallest = i;
    }
    loops_.push_back({points_.size(), n, true});
    if (n < edges_.size()) loops_.back().outer = is_outer(smallest);
    const auto add = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            points_.push_back(edges_[chain_[i]].from);
            edge_at_.push_back(chain_[i]);
        }
    };
    add(smallest, n);
    add(0, smallest);
}

// By their smallest vertices; of two that share it the right one first.
void FaceLoops::order_loops() {
    if (loops_.size() < 2) return;
    std::sort(loops_.begin(), loops_.end(), [&](const Loop& a, const Loop& b) {
        const int c = compare(points_[a.begin], points_[b.begin]);
        if (c != 0) return c < 0;
        return left_of(edge_at_[a.begin], edges_[edge_at_[b.begin]].to) > 0;
    });
}

void FaceLoops::set_region(PlaneId support, bool flipped, std::span<const BoundaryEdge> edges) {
    edges_ = edges;
    const auto [k, is_up] = bench_.facing(support);
    u_ = k == 2 ? 0 : k + 1;
    v_ = k == 0 ? 2 : k - 1;
    right_handed_ = is_up != flipped;
    points_.clear();
    edge_at_.clear();
    loops_.clear();
    are_simple_ = chains_.are_simple(edges);
    if (are_simple_) {
        chain_.clear();
        for_each_turn(edges, [&](std::size_t in, std::size_t out) {
            chain_.push_back(static_cast<std::uint32_t>(in));
            if (out > in) return;
            add_loop();
            chain_.clear();
        });
    } else {
        chain_all();
    }
    order_loops();
}

void FaceLoops::chain_all() {
    by_start_.clear();
    for (std::size_t i = 0; i < edges_.size(); ++i)
        by_start_.emplace_back(edges_[i].from, static_cast<std::uint32_t>(i));
    std::sort(by_start_.begin(), by_start_.end());
    used_.assign(edges_.size(), false);
    for (std::size_t start = 0; start < edges_.size(); ++start) {
        if (used_[start]) continue;
        chain_from(start);
        add_loop();
    }
}

// The corners of all loops for loops_below; edge i runs from corner i to the next one of its loop.
class FaceLoops::Figure {
public:
    explicit Figure(const FaceLoops& loops)
        : loops_(loops), rank_(loops.points_.size()), order_(rank_.size()), next_(rank_.size()) {
        for (const Loop& l : loops.loops_)
            for (std::size_t i = 0; i < l.size; ++i)
                next_[l.begin + i] =
                    static_cast<std::uint32_t>(l.begin + (i + 1 == l.size ? 0 : i + 1));
        std::iota(order_.begin(), order_.end(), 0U);
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            const int c = loops.compare(loops.points_[a], loops.points_[b]);
            return c != 0 ? c < 0 : a < b;
        });
        for (const std::uint32_t c : order_) {
            if (points_.empty() || points_.back() != loops.points_[c])
                points_.push_back(loops.points_[c]);
            rank_[c] = static_cast<std::uint32_t>(points_.size() - 1);
        }
    }
    [[nodiscard]] std::size_t corner_count() const { return rank_.size(); }
    [[nodiscard]] std::span<const std::uint32_t> corners_in_order() const { return order_; }
    [[nodiscard]] std::uint32_t next(std::uint32_t corner) const { return next_[corner]; }
    [[nodiscard]] std::uint32_t from(std::uint32_t edge) const { return rank_[edge]; }
    [[nodiscard]] std::uint32_t to(std::uint32_t edge) const { return rank_[next_[edge]]; }
    [[nodiscard]] int above(std::uint32_t edge, std::uint32_t vertex) const {
        return loops_.left_of(loops_.edge_at_[edge], points_[vertex]);
    }

private:
    const FaceLoops& loops_;
    std::vector<std::uint32_t> rank_;   // by corner
    std::vector<std::uint32_t> order_;  // corners by rank
    std::vector<std::uint32_t> next_;
    std::vector<PointId> points_;  // by rank
};

std::span<const std::vector<std::uint32_t>> FaceLoops::faces() {
    faces_.clear();
    std::vector<std::uint32_t> face_of(loops_.size());
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
        if (!loops_[l].outer) continue;
        face_of[l] = static_cast<std::uint32_t>(faces_.size());
        faces_.push_back({l});
    }
    TRISECT_EXPECTS(!faces_.empty(), "a hole lies in no face");
    if (faces_.size() == loops_.size()) return faces_;
    std::vector<std::uint32_t> below;
    if (faces_.size() > 1) {
        std::vector<std::uint32_t> first;
        for (const Loop& l : loops_) first.push_back(static_cast<std::uint32_t>(l.begin));
        below = detail::loops_below(Figure(*this), first);
    }
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
        if (loops_[l].outer) continue;
        if (!below.empty()) {
            TRISECT_EXPECTS(below[l] < l, "a hole lies in no face");
            face_of[l] = face_of[below[l]];
        }
        faces_[face_of[l]].push_back(l);
    }
    return faces_;
}

}  // namespace trisect::detail
