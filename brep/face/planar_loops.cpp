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
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include <trisect/brep/face/loops_below.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/radix_sort.h>

namespace trisect {

PlaneProjection::PlaneProjection(const Plane& plane, std::span<const Point> points)
    : points_(points), axes_(axes_of(plane)) {}

PlaneProjection::PlaneProjection(const Plane& plane, const RoundedPoints& points)
    : rounded_(&points), nearest_(points.nearest()), axes_(axes_of(plane)) {}

LatticePoint PlaneProjection::lattice(std::uint32_t i) const {
    if (rounded_ == nullptr) return points_[i].lattice();
    const auto& c = nearest_[i].c;
    return {Coordinate(c[0]), Coordinate(c[1]), Coordinate(c[2])};
}

PlaneProjection::Axes PlaneProjection::axes_of(const Plane& plane, bool from_below) {
    const int k = plane.dominant_axis();
    Axes axes{(k + 1) % 3, (k + 2) % 3};
    if ((plane.normal(k) < 0) != from_below) std::swap(axes.u, axes.v);
    return axes;
}

std::strong_ordering PlaneProjection::compare(std::uint32_t a, std::uint32_t b) const {
    if (rounded_ != nullptr) {
        const int along_u = rounded_->compare_along(a, b, axes_.u);
        return (along_u != 0 ? along_u : rounded_->compare_along(a, b, axes_.v)) <=> 0;
    }
    if (const auto c = compare_coordinate(points_[a], points_[b], axes_.u); c != 0) return c;
    return compare_coordinate(points_[a], points_[b], axes_.v);
}

int PlaneProjection::orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    if (const int s =
            filtered_orientation(approximation(a), approximation(b), approximation(c), axes_);
        s != 0)
        return s;
    if (is_lattice(a) && is_lattice(b) && is_lattice(c)) return lattice_orientation(a, b, c);
    return exact_orientation(homogeneous(a), homogeneous(b), homogeneous(c), axes_);
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
    const double bound = detail::minor_rounding * (std::fabs(s) + std::fabs(t)) +
                         detail::error_slack * (ea * (std::fabs(bu) + std::fabs(bv)) +
                                                eb * (std::fabs(au) + std::fabs(av)) + 2 * ea * eb);
    if (s - t > bound) return 1;
    if (t - s > bound) return -1;
    return 0;
}

int PlaneProjection::lattice_orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const auto flat = [&](std::uint32_t p) {
        return detail::flat_corner(lattice(p), axes_.u, axes_.v);
    };
    return detail::exact_turn(flat(c), flat(a), flat(b));
}

namespace {

// In limbs: of xyz, of w, of minors and of the determinant.
template <int Xyz, int W, int Minor, int Determinant>
int sign_of_rows(const std::array<const HomogeneousPoint*, 3>& rows, std::size_t i, std::size_t j) {
    const auto minor = [&](const HomogeneousPoint& s, const HomogeneousPoint& t) {
        return multiply<Minor>(WideInt<Xyz>(s.xyz[i]), WideInt<Xyz>(t.xyz[j])) -
               multiply<Minor>(WideInt<Xyz>(s.xyz[j]), WideInt<Xyz>(t.xyz[i]));
    };
    const auto term = [&](std::size_t k) {
        return multiply<Determinant>(minor(*rows[k], *rows[(k + 1) % 3]),
                                     WideInt<W>(rows[(k + 2) % 3]->w));
    };
    return (term(0) + term(1) + term(2)).sign();
}

}  // namespace

// The sign of the 3×3 determinant of homogeneous rows (u, v, w) with w > 0:
// 2^384 · 2^384 · 2^330 · 6 < 2^1101, hence 18 limbs; of the first tier, whose numbers have 230 and
// 174 bits, 2^230 · 2^230 · 2^174 · 6 < 2^637, hence 11.
int PlaneProjection::exact_orientation(const HomogeneousPoint& a, const HomogeneousPoint& b,
                                       const HomogeneousPoint& c, Axes axes) {
    const auto i = static_cast<std::size_t>(axes.u);
    const auto j = static_cast<std::size_t>(axes.v);
    if (!(a.is_short() && b.is_short() && c.is_short())) {
        using detail::BoundedInt;  // 3157 bits
        const auto minor = [&](const HomogeneousPoint& s, const HomogeneousPoint& t) {
            return BoundedInt(s.xyz[i]) * t.xyz[j] - BoundedInt(s.xyz[j]) * t.xyz[i];
        };
        return (minor(a, b) * c.w + minor(b, c) * a.w + minor(c, a) * b.w).sign();
    }
    if (a.tier == 0 && b.tier == 0 && c.tier == 0)
        return sign_of_rows<4, 3, 8, 11>({&a, &b, &c}, i, j);
    return sign_of_rows<7, 6, 13, 18>({&a, &b, &c}, i, j);
}

PlanarLoops::PlanarLoops(const PlaneProjection& projection, std::span<const IndexLoop> loops)
    : projection_(projection) {
    for (const IndexLoop& loop : loops) {
        const auto first = static_cast<std::uint32_t>(corners_.size());
        const auto n = static_cast<std::uint32_t>(loop.size());
        for (std::uint32_t i = 0; i < n; ++i)
            corners_.push_back({loop[i], 0, first + (i + n - 1) % n, first + (i + 1) % n});
    }
    number_places();
    for (std::size_t i = 0; i < order_.size();) {
        std::size_t j = i + 1;
        while (j < order_.size() && place_of(order_[j]) == place_of(order_[i])) ++j;
        if (j - i > 1) join_edges_at(std::span(order_).subspan(i, j - i));
        i = j;
    }
    find_loops();
}

namespace {

// Integers in the order of doubles; one for both zeros.
std::uint64_t ordered_bits(double value) {
    constexpr std::uint64_t sign = std::uint64_t{1} << 63U;
    const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);
    return (bits & sign) != 0 ? ~bits : bits | sign;
}

}  // namespace

// Rounding is monotone, so different rounded coordinates give the order of the exact ones, and
// those of lattice points show when they are equal.
void PlanarLoops::number_places() {
    struct Place {
        double u;
        double v;
        std::uint32_t corner;
        bool is_lattice;
    };
    const auto compare = [&](const Place& a, const Place& b) {
        if (a.u != b.u)
            return a.u < b.u ? std::strong_ordering::less : std::strong_ordering::greater;
        if (!a.is_lattice || !b.is_lattice)
            return projection_.compare(corners_[a.corner].point, corners_[b.corner].point);
        if (a.v != b.v)
            return a.v < b.v ? std::strong_ordering::less : std::strong_ordering::greater;
        return std::strong_ordering::equal;
    };
    std::vector<Place> places;
    places.reserve(corners_.size());
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
        const std::uint32_t p = corners_[c].point;
        places.push_back({projection_.u(p), projection_.v(p), c, projection_.is_lattice(p)});
    }
    const auto comes_first = [&](const Place& a, const Place& b) {
        const auto order = compare(a, b);
        return order != 0 ? order < 0 : a.corner < b.corner;
    };
    detail::radix_sort(places, [](const Place& a) { return ordered_bits(a.u); });
    for (auto run = places.begin(); run != places.end();) {
        const auto end =
            std::find_if(run, places.end(), [&](const Place& a) { return a.u != run->u; });
        std::sort(run, end, comes_first);
        run = end;
    }
    order_.reserve(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::uint32_t c = places[i].corner;
        if (i == 0 || compare(places[i - 1], places[i]) != 0)
            point_at_.push_back(corners_[c].point);
        corners_[c].place = static_cast<std::uint32_t>(point_at_.size() - 1);
        order_.push_back(c);
    }
}

// Each outgoing edge keeps its corner; the incoming edge that ends its wedge is led there. Where
// both run along one line (a slit), the wedge before it ends before the wedge after it begins.
void PlanarLoops::join_edges_at(std::span<const std::uint32_t> corners) {
    const std::uint32_t p = place_of(corners[0]);
    // Half planes of the lexicographic order are half-open: within one the orientation sorts.
    struct Direction {
        std::uint32_t place;
        std::uint32_t corner;
        bool leaves;  // an outgoing edge, opens the interior
    };
    std::vector<Direction> around;
    for (const std::uint32_t c : corners) {
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
    for (const std::uint32_t first : order_) {  // by place: the first corner met is the least
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
    TRISECT_EXPECTS(!regions.empty(), "a region has an outline");
    if (figure.holes().empty()) return regions;
    if (regions.size() == 1) {
        for (const std::uint32_t hole : figure.holes()) regions[0].push_back(loop_from(hole));
        return regions;
    }
    std::vector<std::uint32_t> first(figure.outlines().begin(), figure.outlines().end());
    first.insert(first.end(), figure.holes().begin(), figure.holes().end());
    const std::vector<std::uint32_t> below = detail::loops_below(figure, first);
    std::vector<std::uint32_t> region_of(first.size());
    std::iota(region_of.begin(), region_of.end(), 0U);
    for (std::size_t i = regions.size(); i < first.size(); ++i) {
        // Holes are ordered by their first places, so that of the loop below is known.
        TRISECT_EXPECTS(below[i] < i, "a hole inside an outline");
        region_of[i] = region_of[below[i]];
        regions[region_of[i]].push_back(loop_from(first[i]));
    }
    return regions;
}

}  // namespace trisect
