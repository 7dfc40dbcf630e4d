// SPDX-License-Identifier: Apache-2.0
//
// A loop in a plane bounds exactly one 2-chain of that plane: its winding number. So any set of
// triangles whose oriented boundaries add up to the loop represents the same figure, and if all of
// them are positively oriented while the winding number is nowhere above one, they cannot overlap.
// Clipping corners keeps the boundary; it remains to clip only corners that turn left. That is
// enough for correctness, also for loops that touch themselves.
//
// It is not enough for good meshes: an ear whose diagonal passes through another corner leaves a
// T-vertex, and a corner in the middle of a side must not be cut off as a triangle without area,
// since the neighbouring face has that corner too. An ear is therefore clipped only if the closed
// triangle holds no other corner; for a simple loop such an ear always exists (every simple polygon
// with corners of 180 degrees has a triangulation without flat triangles, and the dual tree of that
// has two leaves). Only when none is left do weaker rules apply, in this order: corners on the
// ear's boundary are allowed, corners without area are clipped, anything is clipped (the loop is
// not simple, and the caller gets an error).
//
// Everything happens in the projection along an axis in which the loop's (Newell) normal is
// largest, with exact turns (flat_corner.h).

#include <trisect/brep/face/loop_triangulator.h>

#include <algorithm>
#include <string>

#include <trisect/brep/face/convex_cut.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

constexpr std::uint64_t work_limit = std::uint64_t{1} << 32;

// Twice the vector area in units of 2^(-2 fraction_limit). 2^17 terms of at most 2^255.
std::array<WideInt<5>, 3> newell_of_fractions(std::span<const LatticePoint> points,
                                              std::span<const std::uint32_t> loop) {
    const auto way = [&](std::uint32_t to, std::size_t k) {
        const auto fine = [k](const LatticePoint& p) {
            return WideInt<2>(scaled_integer(coordinate(p, k), fraction_limit));
        };
        return fine(points[to]) - fine(points[loop[0]]);
    };
    std::array<WideInt<5>, 3> n;
    for (std::size_t i = 2; i < loop.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3;
            const std::size_t v = (k + 2) % 3;
            n[k] += multiply<5>(way(loop[i - 1], u), way(loop[i], v)) -
                    multiply<5>(way(loop[i - 1], v), way(loop[i], u));
        }
    return n;
}

// Twice the vector area of whole coordinates. 2^17 terms of at most 2^109: below 2^127.
std::array<Int128, 3> newell_of_whole(std::span<const LatticePoint> points,
                                      std::span<const std::uint32_t> loop) {
    std::array<Int128, 3> n{};
    const LatticePoint& origin = points[loop[0]];
    auto a = difference(points[loop[1]], origin);
    for (std::size_t i = 2; i < loop.size(); ++i) {
        const auto b = difference(points[loop[i]], origin);
        n[0] += Int128{a[1]} * b[2] - Int128{a[2]} * b[1];
        n[1] += Int128{a[2]} * b[0] - Int128{a[0]} * b[2];
        n[2] += Int128{a[0]} * b[1] - Int128{a[1]} * b[0];
        a = b;
    }
    return n;
}

// Twice the vector area, in some unit.
std::array<WideInt<5>, 3> newell(std::span<const LatticePoint> points,
                                 std::span<const std::uint32_t> loop) {
    if (!std::ranges::all_of(loop, [&](std::uint32_t c) { return points[c].is_whole(); }))
        return newell_of_fractions(points, loop);
    const auto n = newell_of_whole(points, loop);
    return {n[0], n[1], n[2]};
}

// Index of the first corner that is not on the line of corners 0 and 1 (which differ), or size().
std::size_t first_off_line(std::span<const LatticePoint> points,
                           std::span<const std::uint32_t> loop) {
    std::size_t i = 2;
    while (i < loop.size() && are_collinear(points[loop[0]], points[loop[1]], points[loop[i]])) ++i;
    return i;
}

}  // namespace

LoopShape LoopTriangulator::shape(std::span<const std::uint32_t> loop) const {
    LoopShape s;
    const std::size_t i = loop.size() < 3 ? loop.size() : first_off_line(points_, loop);
    if (i == loop.size()) {
        s.degenerate = true;
        return s;
    }
    if (loop.size() == 3) return s;
    const Plane plane = Plane::through(points_[loop[0]], points_[loop[1]], points_[loop[i]]);
    for (std::size_t k = i + 1; k < loop.size() && s.planar; ++k)
        s.planar = side_of(points_[loop[k]], plane) == Side::On;
    return s;
}

void LoopTriangulator::project(std::span<const std::uint32_t> loop) {
    auto n = newell(points_, loop);
    if (n[0].is_zero() && n[1].is_zero() &&
        n[2].is_zero()) {  // a figure of eight: any plane of its corners
        const std::size_t i = first_off_line(points_, loop);
        const std::array<std::uint32_t, 3> t{loop[0], loop[1], loop[i]};
        n = newell(points_, t);
    }
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (n[static_cast<std::size_t>(i)].abs() > n[static_cast<std::size_t>(axis)].abs())
            axis = i;
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    if (n[static_cast<std::size_t>(axis)] < 0) std::swap(u, v);
    flat_.resize(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) flat_[i] = flat_corner(points_[loop[i]], u, v);
}

// Left turns only, and once around: upward and downward sides form one run each.
bool LoopTriangulator::is_strictly_convex() const {
    const std::size_t n = flat_.size();
    const auto goes_up = [&](std::size_t i) {
        const FlatCorner& a = flat_[i % n];
        const FlatCorner& b = flat_[(i + 1) % n];
        return b.v > a.v || (b.v == a.v && b.u > a.u);
    };
    std::size_t runs = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(flat_[i], flat_[(i + 1) % n], flat_[(i + 2) % n]) <= 0) return false;
        if (goes_up(i) != goes_up(i + 1)) ++runs;
    }
    return runs == 2;
}

bool LoopTriangulator::fan(std::span<const std::uint32_t> loop, std::size_t apex,
                           std::vector<std::array<std::uint32_t, 3>>& out) const {
    const std::size_t n = loop.size();
    for (std::size_t k = 1; k + 1 < n; ++k)
        if (turn(flat_[apex], flat_[(apex + k) % n], flat_[(apex + k + 1) % n]) <= 0) return false;
    for (std::size_t k = 1; k + 1 < n; ++k)
        out.push_back({loop[apex], loop[(apex + k) % n], loop[(apex + k + 1) % n]});
    return true;
}

LoopShape LoopTriangulator::triangulate(std::span<const std::uint32_t> loop,
                                        std::vector<std::array<std::uint32_t, 3>>& out) {
    if (loop.size() > loop_corner_limit)
        throw LimitError("a face has " + std::to_string(loop.size()) + " corners; at most " +
                         std::to_string(loop_corner_limit) + " are supported");
    LoopShape s = shape(loop);
    if (s.degenerate) return s;
    if (loop.size() == 3) {
        out.push_back({loop[0], loop[1], loop[2]});
        return s;
    }
    project(loop);
    if (loop.size() > small_convex_limit && is_strictly_convex()) {
        cut_convex(static_cast<std::uint32_t>(loop.size()),
                   [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                       out.push_back({loop[a], loop[b], loop[c]});
                   });
        return s;
    }
    if (fan(loop, 0, out) || fan(loop, 1, out)) return s;
    if (loop.size() >= ShortEars::least_corners && cut_short_ears(loop, out)) return s;
    s.simple = clip_ears(loop, out);
    return s;
}

bool LoopTriangulator::cut_short_ears(std::span<const std::uint32_t> loop,
                                      std::vector<std::array<std::uint32_t, 3>>& out) {
    const std::size_t first = out.size();
    if (!short_ears_.triangulate(flat_, out)) return false;
    for (std::size_t t = first; t < out.size(); ++t)
        for (std::uint32_t& corner : out[t]) corner = loop[corner];
    return true;
}

// Whether no other corner lies in the ear's triangle: `boundary_too` selects the closed one.
// Corners at the same place as one of the ear's do not count.
bool LoopTriangulator::is_clear(std::uint32_t ear, bool boundary_too) {
    const FlatCorner& a = flat_[prev_[ear]];
    const FlatCorner& b = flat_[ear];
    const FlatCorner& c = flat_[next_[ear]];
    const int limit = boundary_too ? 0 : 1;
    work_ += reflex_.size() + 1;
    if (work_ > work_limit) throw LimitError("triangulating a face takes too much work");
    for (const std::uint32_t i : reflex_) {
        if (clipped_[i]) continue;
        const FlatCorner& p = flat_[i];
        if (turn(c, a, p) < limit || turn(a, b, p) < limit || turn(b, c, p) < limit) continue;
        if (p == a || p == b || p == c) continue;
        return false;
    }
    return true;
}

void LoopTriangulator::clip(std::uint32_t ear, std::span<const std::uint32_t> loop,
                            std::vector<std::array<std::uint32_t, 3>>& out) {
    const std::uint32_t a = prev_[ear];
    const std::uint32_t c = next_[ear];
    const bool flat = turn(flat_[a], flat_[ear], flat_[c]) == 0;
    if (!flat || !are_collinear(points_[loop[a]], points_[loop[ear]], points_[loop[c]]))
        out.push_back({loop[a], loop[ear], loop[c]});
    next_[a] = c;
    prev_[c] = a;
    clipped_[ear] = true;
}

bool LoopTriangulator::clip_ears(std::span<const std::uint32_t> loop,
                                 std::vector<std::array<std::uint32_t, 3>>& out) {
    const auto n = static_cast<std::uint32_t>(loop.size());
    prev_.resize(n);
    next_.resize(n);
    clipped_.assign(n, false);
    reflex_.clear();
    work_ = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        prev_[i] = i == 0 ? n - 1 : i - 1;
        next_[i] = i + 1 == n ? 0 : i + 1;
    }
    for (std::uint32_t i = 0; i < n; ++i)
        if (turn(flat_[prev_[i]], flat_[i], flat_[next_[i]]) <= 0) reflex_.push_back(i);

    bool simple = true;
    std::uint32_t left = n;
    std::uint32_t at = 0;
    std::uint32_t misses = 0;
    int rule = 0;  // the essay's order
    while (left > 3) {
        const int t = turn(flat_[prev_[at]], flat_[at], flat_[next_[at]]);
        const bool take =
            rule == 3 || (rule == 2 && t == 0) || (rule < 2 && t > 0 && is_clear(at, rule == 0));
        const std::uint32_t following = next_[at];
        if (take) {
            if (rule == 3) simple = false;
            // The neighbours of a clipped corner can become reflex only where something folds.
            clip(at, loop, out);
            --left;
            misses = 0;
            rule = 0;
        } else if (++misses >= left) {
            misses = 0;
            ++rule;
        }
        at = following;
    }
    const int last = turn(flat_[prev_[at]], flat_[at], flat_[next_[at]]);
    if (last < 0) simple = false;
    clip(at, loop, out);
    return simple;
}

}  // namespace trisect::detail
