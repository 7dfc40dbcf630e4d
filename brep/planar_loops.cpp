// SPDX-License-Identifier: Apache-2.0
//
// Why loops are linked anew. "A hole that touches the outline in a vertex" and "an outline that
// touches itself" are two descriptions of one region, and programs hand over either. Read as
// stated, the corner of the outline has an interior wedge that contains edges of the hole, and
// whatever walks around the vertex takes the wrong turn: ears overlap the hole, and a boundary
// split at the vertex gets a topology that no solid has (a plate whose hole touches the rim becomes
// a surface of genus 2). The region itself is not ambiguous: at each place its interior is a set of
// wedges between an outgoing edge and the next incoming one counter-clockwise. Linking exactly
// those makes the description canonical.

#include <trisect/brep/planar_loops.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

PlaneProjection::PlaneProjection(const Plane& plane, std::span<const Point> points)
    : points_(points), axes_(axes_of(plane)) {}

PlaneProjection::Axes PlaneProjection::axes_of(const Plane& plane, bool from_below) {
    const int k = plane.dominant_axis();
    Axes axes{(k + 1) % 3, (k + 2) % 3};
    if ((plane.normal(k) < 0) != from_below) std::swap(axes.u, axes.v);
    return axes;
}

std::strong_ordering PlaneProjection::compare(std::uint32_t a, std::uint32_t b) const {
    if (const auto c = compare_coordinate(points_[a], points_[b], axes_.u); c != 0) return c;
    return compare_coordinate(points_[a], points_[b], axes_.v);
}

int PlaneProjection::orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Point& p = points_[a];
    const Point& q = points_[b];
    const Point& r = points_[c];
    if (const int s =
            filtered_orientation(p.approximation(), q.approximation(), r.approximation(), axes_);
        s != 0)
        return s;
    if (p.is_lattice() && q.is_lattice() && r.is_lattice()) return lattice_orientation(a, b, c);
    return exact_orientation(p.homogeneous(), q.homogeneous(), r.homogeneous(), axes_);
}

// (a - c) × (b - c) in doubles, or 0 for unknown. A difference is off by the errors of its
// terms and one rounding; each product by the errors of its factors and one rounding, the
// difference of the products by one more. 2^-50 covers the roundings and those of the bound.
int PlaneProjection::filtered_orientation(const Approximation& a, const Approximation& b,
                                          const Approximation& c, Axes axes) {
    const auto u = static_cast<std::size_t>(axes.u);
    const auto v = static_cast<std::size_t>(axes.v);
    const double ea = a.error + c.error;
    const double eb = b.error + c.error;
    const double au = a.c[u] - c.c[u];
    const double av = a.c[v] - c.c[v];
    const double bu = b.c[u] - c.c[u];
    const double bv = b.c[v] - c.c[v];
    const double s = au * bv;
    const double t = av * bu;
    const double bound = 0x1p-50 * (std::fabs(s) + std::fabs(t)) +
                         1.0000001 * (ea * (std::fabs(bu) + std::fabs(bv)) +
                                      eb * (std::fabs(au) + std::fabs(av)) + 2 * ea * eb);
    if (s - t > bound) return 1;
    if (t - s > bound) return -1;
    return 0;
}

// Differences have 54 bits, products 108.
int PlaneProjection::lattice_orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const LatticePoint p = points_[a].lattice() - points_[c].lattice();
    const LatticePoint q = points_[b].lattice() - points_[c].lattice();
    const Int128 s = Int128{p[axes_.u]} * q[axes_.v];
    const Int128 t = Int128{p[axes_.v]} * q[axes_.u];
    return s > t ? 1 : (s < t ? -1 : 0);
}

// The sign of the 3×3 determinant of homogeneous rows (u, v, w) with w > 0:
// 2^384 · 2^384 · 2^330 · 6 < 2^1101, hence 18 limbs.
int PlaneProjection::exact_orientation(const HomogeneousPoint& a, const HomogeneousPoint& b,
                                       const HomogeneousPoint& c, Axes axes) {
    const auto i = static_cast<std::size_t>(axes.u);
    const auto j = static_cast<std::size_t>(axes.v);
    const auto minor = [&](const HomogeneousPoint& s, const HomogeneousPoint& t) {
        return multiply<13>(s.xyz[i], t.xyz[j]) - multiply<13>(s.xyz[j], t.xyz[i]);
    };
    return (multiply<18>(minor(a, b), c.w) + multiply<18>(minor(b, c), a.w) +
            multiply<18>(minor(c, a), b.w))
        .sign();
}

PlanarLoops::PlanarLoops(const Plane& plane, std::span<const Point> points,
                         std::span<const IndexLoop> loops)
    : projection_(plane, points) {
    for (const IndexLoop& loop : loops) {
        const auto first = static_cast<std::uint32_t>(corners_.size());
        const auto n = static_cast<std::uint32_t>(loop.size());
        for (std::uint32_t i = 0; i < n; ++i)
            corners_.push_back({loop[i], 0, first + (i + n - 1) % n, first + (i + 1) % n});
    }
    number_places();
    for (std::uint32_t p = 0; p < corners_at_.size(); ++p)
        if (corners_at_[p].size() > 1) join_edges_at(p);
    find_loops();
}

void PlanarLoops::number_places() {
    std::vector<std::uint32_t> order(corners_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
        const auto c = projection_.compare(corners_[a].point, corners_[b].point);
        return c != 0 ? c < 0 : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t point = corners_[order[i]].point;
        if (i == 0 || projection_.compare(point_at_.back(), point) != 0) {
            point_at_.push_back(point);
            corners_at_.emplace_back();
        }
        corners_[order[i]].place = static_cast<std::uint32_t>(point_at_.size() - 1);
        corners_at_.back().push_back(order[i]);
    }
}

// Each outgoing edge keeps its corner; the incoming edge that ends its wedge is led there. Where
// both run along one line (a slit), the wedge before it ends before the wedge after it begins.
void PlanarLoops::join_edges_at(std::uint32_t p) {
    // Half planes of the lexicographic order are half-open: within one the orientation sorts.
    struct Direction {
        std::uint32_t place;
        std::uint32_t corner;
        bool leaves;  // an outgoing edge, opens the interior
    };
    std::vector<Direction> around;
    for (const std::uint32_t c : corners_at_[p]) {
        around.push_back({place_of(next(c)), c, true});
        around.push_back({place_of(prev(c)), prev(c), false});
    }
    std::sort(around.begin(), around.end(), [&](const Direction& a, const Direction& b) {
        if ((a.place < p) != (b.place < p)) return b.place < p;
        if (const int s = orientation(p, a.place, b.place); s != 0) return s > 0;
        if (a.leaves != b.leaves) return b.leaves;
        return a.corner < b.corner;
    });
    // Around a region's corner leaving and arriving edges alternate.
    const auto start = static_cast<std::size_t>(
        std::find_if(around.begin(), around.end(), [](const auto& d) { return d.leaves; }) -
        around.begin());
    for (std::size_t i = 0; i < around.size(); i += 2) {
        const Direction& leaving = around[(start + i) % around.size()];
        const Direction& arriving = around[(start + i + 1) % around.size()];
        TRISECT_EXPECTS(leaving.leaves && !arriving.leaves, "edges around a point bound wedges");
        connect(arriving.corner, leaving.corner);
    }
}

void PlanarLoops::find_loops() {
    std::vector<bool> seen(corners_.size(), false);
    for (const auto& at_place : corners_at_) {  // by rank: the first corner met is the least
        for (const std::uint32_t first : at_place) {
            if (seen[first]) continue;
            bool is_hole = false;
            std::uint32_t c = first;
            do {
                seen[c] = true;
                // The corners at the loop's first place are all convex in an outline.
                if (place_of(c) == place_of(first) && turn(c) <= 0) is_hole = true;
                c = next(c);
            } while (c != first);
            (is_hole ? holes_ : outlines_).push_back(first);
        }
    }
}

bool PlanarLoops::is_inside(std::uint32_t place, std::uint32_t outline) const {
    // Edges below the place along v; the ranks stand for a line that passes beside every corner.
    bool inside = false;
    std::uint32_t c = outline;
    do {
        const std::uint32_t a = std::min(place_of(c), place_of(next(c)));
        const std::uint32_t b = std::max(place_of(c), place_of(next(c)));
        if (a < place && place < b && orientation(a, b, place) > 0) inside = !inside;
        c = next(c);
    } while (c != outline);
    return inside;
}

void PlanarLoops::splice(std::uint32_t a, std::uint32_t b) {
    const auto a2 = static_cast<std::uint32_t>(corners_.size());
    const std::uint32_t b2 = a2 + 1;
    const std::uint32_t after_a = next(a);
    const std::uint32_t before_b = prev(b);
    const Corner copy_of_a = corners_[a];
    const Corner copy_of_b = corners_[b];
    corners_.push_back(copy_of_a);
    corners_.push_back(copy_of_b);
    corners_at_[place_of(a)].push_back(a2);
    corners_at_[place_of(b)].push_back(b2);
    connect(before_b, b2);
    connect(b2, a2);
    connect(a2, after_a);
    connect(a, b);
}

std::vector<std::vector<IndexLoop>> connected_regions(const Plane& plane,
                                                      std::span<const Point> points,
                                                      std::span<const IndexLoop> loops) {
    const PlanarLoops figure(plane, points, loops);
    const auto loop_from = [&](std::uint32_t first) {
        IndexLoop loop;
        std::uint32_t c = first;
        do {
            loop.push_back(figure.corner(c).point);
            c = figure.next(c);
        } while (c != first);
        return loop;
    };
    std::vector<std::vector<IndexLoop>> regions;
    for (const std::uint32_t outline : figure.outlines()) regions.push_back({loop_from(outline)});
    for (const std::uint32_t hole : figure.holes()) {
        // Outlines of a region lie side by side: at most one contains the hole.
        std::size_t r = 0;
        while (r < regions.size() && !figure.is_inside(figure.place_of(hole), figure.outlines()[r]))
            ++r;
        TRISECT_EXPECTS(r < regions.size(), "a hole inside an outline");
        regions[r].push_back(loop_from(hole));
    }
    return regions;
}

}  // namespace trisect
