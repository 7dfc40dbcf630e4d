// SPDX-License-Identifier: Apache-2.0
//
// Ear clipping made safe for faces that touch themselves.
//
// The textbook algorithm assumes a simple outline. Faces of booleans are not: holes touch the
// outline or each other in vertices, outlines touch themselves, and straight runs carry vertices of
// the neighbours. Rounded arithmetic turns each of these into a wrong ear sooner or later. Here
// all tests are exact, and the topology is brought into a form in which the textbook is right:
//
//  1. The plane is projected along its dominant axis; corners are sorted lexicographically in
//     the projection. Equal points get one *place*, whose number is also its rank.
//  2. Where several corners share a place, edges are linked anew so that the interior wedges of
//     its corners are disjoint (planar_loops.cpp). Now no wedge contains an edge.
//  3. The remaining holes touch nothing. In the order of their first corners each is tied to a
//     corner before it that sees it. One exists: the left end of the trapezoid that ends at the
//     hole's first corner; and it is already tied, because its own loop starts even earlier.
//  4. Ears: a strictly convex corner whose triangle contains no other place, not even on the cut.
//     A blocking corner that matters is never strictly convex, so only the others are kept in
//     a grid. With the disjoint wedges of step 2 a corner at the same place as one of the
//     triangle's cannot interfere, which is what goes wrong in ear cutters that compare
//     coordinates. Every polygon with positive area has such an ear, also one with straight
//     corners (Meisters 1975 on the triangulations that use all corners).
//
// The number of triangles, n + 2·holes - 2·outlines, is checked at the end.

#include <trisect/brep/triangulate.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <trisect/kernel/contract.h>

namespace trisect {

namespace {

using Index = std::uint32_t;

// The reflex and straight corners by cells of a uniform grid. Rounding is monotone, so a place
// inside the exact box of a triangle is inside the box of the rounded corners too.
class CornerGrid {
public:
    CornerGrid(std::span<const std::array<double, 2>> where) : lo_(where[0]) {
        std::array<double, 2> hi = where[0];
        for (const auto& p : where) {
            for (std::size_t i = 0; i < 2; ++i) {
                lo_[i] = std::min(lo_[i], p[i]);
                hi[i] = std::max(hi[i], p[i]);
            }
        }
        side_ = std::clamp<std::size_t>(
            static_cast<std::size_t>(std::sqrt(static_cast<double>(where.size()))), 1, 512);
        for (std::size_t i = 0; i < 2; ++i)
            if (hi[i] > lo_[i]) scale_[i] = static_cast<double>(side_) / (hi[i] - lo_[i]);
        begin_.assign(side_ * side_ + 1, 0);
        for (const auto& p : where) ++begin_[cell(0, p[0]) * side_ + cell(1, p[1]) + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        members_.resize(where.size());
        std::vector<Index> fill(begin_.begin(), begin_.end() - 1);
        for (Index k = 0; k < where.size(); ++k)
            members_[fill[cell(0, where[k][0]) * side_ + cell(1, where[k][1])]++] = k;
    }

    // Whether `found` accepts a member whose cell meets the box.
    template <class Predicate>
    bool any_in(const std::array<double, 2>& lo, const std::array<double, 2>& hi,
                const Predicate& found) const {
        const std::size_t last_v = cell(1, hi[1]);
        for (std::size_t i = cell(0, lo[0]); i <= cell(0, hi[0]); ++i)
            for (Index k = begin_[i * side_ + cell(1, lo[1])]; k < begin_[i * side_ + last_v + 1];
                 ++k)
                if (found(members_[k])) return true;
        return false;
    }

private:
    std::size_t cell(std::size_t axis, double at) const {
        const double c = std::max(0.0, (at - lo_[axis]) * scale_[axis]);
        return std::min(static_cast<std::size_t>(std::min(c, 1e6)), side_ - 1);
    }

    std::array<double, 2> lo_;
    std::array<double, 2> scale_{};
    std::size_t side_ = 1;
    std::vector<Index> begin_;
    std::vector<Index> members_;
};

class Triangulator {
public:
    Triangulator(const Plane& plane, std::span<const Point> points,
                 std::span<const IndexLoop> loops)
        : figure_(plane, points, loops) {}

    std::vector<IndexTriangle> run() {
        const std::size_t corner_count = figure_.corner_count();
        for (const Index hole : figure_.holes()) tie(hole);
        for (const Index outline : figure_.outlines()) cut_ears(outline);
        TRISECT_EXPECTS(triangles_.size() + 2 * figure_.outlines().size() ==
                            corner_count + 2 * figure_.holes().size(),
                        "a triangulation with one triangle for each corner but two");
        return std::move(triangles_);
    }

private:
    Index place_of(Index c) const { return figure_.place_of(c); }
    Index prev(Index c) const { return figure_.prev(c); }
    Index next(Index c) const { return figure_.next(c); }
    int turn(Index c) const { return figure_.turn(c); }
    int orientation(Index a, Index b, Index c) const { return figure_.orientation(a, b, c); }

    // Whether the direction to a place lies strictly inside the corner's interior wedge.
    bool wedge_contains(Index c, Index target) const {
        const Index p = place_of(c);
        const Index out = place_of(next(c));
        const Index in = place_of(prev(c));
        const int wedge = orientation(p, out, in);
        const int from_out = orientation(p, out, target);
        const int to_in = orientation(p, target, in);
        if (wedge > 0) return from_out > 0 && to_in > 0;
        if (wedge < 0) return from_out > 0 || to_in > 0;
        const bool straight = (out < p) != (in < p);
        if (straight) return from_out > 0;
        return from_out != 0 || (target < p) != (out < p);  // all around the tip of a slit
    }

    // Whether the open segment between two places, a before b, meets no edge and no place.
    bool sees(Index a, Index b) const {
        for (const PlanarLoops::Corner& corner : figure_.corners()) {
            const Index c = corner.place;
            const Index d = place_of(corner.next);
            if (std::max(c, d) <= a || std::min(c, d) >= b) continue;
            const int side_c = orientation(a, b, c);
            if (side_c == 0 && a < c && c < b) return false;
            if (c == a || c == b || d == a || d == b) continue;
            const int side_d = orientation(a, b, d);
            if (side_c * side_d >= 0) continue;
            if (orientation(c, d, a) * orientation(c, d, b) < 0) return false;
        }
        return true;
    }

    // Ties a hole to an earlier corner by a pair of opposite edges.
    void tie(Index hole) {
        const Index b = place_of(hole);
        using Candidate = std::pair<double, Index>;
        std::vector<Candidate> candidates;
        for (Index a = 0; a < b; ++a) {
            const double u = figure_.u(a) - figure_.u(b);
            const double v = figure_.v(a) - figure_.v(b);
            candidates.emplace_back(u * u + v * v, a);
        }
        const auto farther = std::greater<>();
        std::make_heap(candidates.begin(), candidates.end(), farther);
        while (!candidates.empty()) {
            std::pop_heap(candidates.begin(), candidates.end(), farther);
            const Index a = candidates.back().second;
            candidates.pop_back();
            const Index from = corner_facing(a, b);
            const Index to = corner_facing(b, a);
            if (from == PlanarLoops::none || to == PlanarLoops::none || !sees(a, b)) continue;
            figure_.splice(from, to);
            return;
        }
        TRISECT_EXPECTS(false, "a hole inside an outline");
    }

    Index corner_facing(Index place, Index target) const {
        for (const Index c : figure_.corners_at(place))
            if (wedge_contains(c, target)) return c;
        return PlanarLoops::none;
    }

    std::array<double, 2> where(Index c) const {
        return {figure_.u(place_of(c)), figure_.v(place_of(c))};
    }

    void emit(Index a, Index b, Index c) {
        triangles_.push_back(
            {figure_.corner(a).point, figure_.corner(b).point, figure_.corner(c).point});
    }

    void cut_ears(Index first) {
        std::vector<Index> blocking;
        std::vector<std::array<double, 2>> places;
        std::size_t left = 0;
        is_blocking_.resize(figure_.corner_count(), false);
        Index c = first;
        do {
            ++left;
            if (turn(c) <= 0) {
                is_blocking_[c] = true;
                blocking.push_back(c);
                places.push_back(where(c));
            }
            c = next(c);
        } while (c != first);
        const CornerGrid grid(places.empty() ? std::vector{where(first)} : places);
        for (std::size_t failures = 0; left > 3;) {
            if (!is_ear(c, grid, blocking)) {
                TRISECT_EXPECTS(++failures <= left, "an outline that has an ear");
                c = next(c);
                continue;
            }
            emit(prev(c), c, next(c));
            const Index before = prev(c);
            const Index after = next(c);
            figure_.connect(before, after);
            // Cutting only narrows wedges: a convex corner stays convex.
            for (const Index neighbour : {before, after})
                if (is_blocking_[neighbour]) is_blocking_[neighbour] = turn(neighbour) <= 0;
            --left;
            failures = 0;
            c = next(after);  // skipping one spreads the triangles
        }
        TRISECT_EXPECTS(turn(c) > 0, "a last triangle with area");
        emit(prev(c), c, next(c));
    }

    bool is_ear(Index c, const CornerGrid& grid, std::span<const Index> blocking) const {
        if (is_blocking_[c]) return false;
        if (blocking.empty()) return true;
        const Index a = place_of(prev(c));
        const Index b = place_of(c);
        const Index d = place_of(next(c));
        const auto wa = where(prev(c));
        const auto wb = where(c);
        const auto wd = where(next(c));
        const std::array<double, 2> lo{std::min({wa[0], wb[0], wd[0]}),
                                       std::min({wa[1], wb[1], wd[1]})};
        const std::array<double, 2> hi{std::max({wa[0], wb[0], wd[0]}),
                                       std::max({wa[1], wb[1], wd[1]})};
        return !grid.any_in(lo, hi, [&](Index k) {
            if (!is_blocking_[blocking[k]]) return false;
            const Index p = place_of(blocking[k]);
            if (p == a || p == b || p == d) return false;
            return orientation(a, b, p) >= 0 && orientation(b, d, p) >= 0 &&
                   orientation(d, a, p) >= 0;
        });
    }

    PlanarLoops figure_;
    std::vector<bool> is_blocking_;
    std::vector<IndexTriangle> triangles_;
};

// A simple loop that turns left at every corner is convex. (A loop that touches itself has a
// corner that does not.)
bool is_strictly_convex(const Plane& plane, std::span<const Point> points,
                        std::span<const Index> loop) {
    const PlaneProjection projection(plane, points);
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i)
        if (projection.orientation(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]) <= 0)
            return false;
    return true;
}

std::vector<IndexTriangle> fan(std::span<const Index> loop) {
    std::vector<IndexTriangle> triangles;
    triangles.reserve(loop.size() - 2);
    for (std::size_t i = 2; i < loop.size(); ++i)
        triangles.push_back({loop[0], loop[i - 1], loop[i]});
    return triangles;
}

}  // namespace

std::vector<IndexTriangle> triangulate(const Plane& plane, std::span<const Point> points,
                                       std::span<const IndexLoop> loops) {
    TRISECT_EXPECTS(!loops.empty(), "a face has an outer loop");
    for (const auto& loop : loops)
        TRISECT_EXPECTS(loop.size() >= 3, "a loop has at least three corners");
    if (loops.size() == 1 && (loops[0].size() == 3 || is_strictly_convex(plane, points, loops[0])))
        return fan(loops[0]);
    return Triangulator(plane, points, loops).run();
}

std::vector<IndexTriangle> triangulate(const Brep& brep, FaceId face) {
    std::vector<IndexLoop> loops;
    for (const LoopId l : brep.loops(face)) {
        loops.emplace_back();
        for (const HalfedgeId h : brep.halfedges(l)) loops.back().push_back(brep.origin(h).index);
    }
    return triangulate(brep.plane(face), brep.points(), loops);
}

}  // namespace trisect
