// SPDX-License-Identifier: Apache-2.0
//
// Quickhull with exact signs. A facet is a triangle with the points strictly above it; the farthest
// of these is added, the facets that it sees strictly are replaced by a cone over their horizon.
//
// Coplanar points need no special case as long as "sees" is strict and exact:
//  - A horizon edge has a facet that the point is strictly above, so the point is not on the edge's
//    line and the new triangle has area. It may be coplanar with the facet behind the edge.
//  - A point in the plane of a facet and beyond one of its edges is strictly above the facet there,
//    or above one behind further coplanar ones; so it is found outside.
//  - Coplanar facets are seen together or not at all, so the seen ones are a disk.
// A point that was above a replaced facet and is outside the new hull is above a new facet: the
// segment from a generic point of the old facet to it leaves the old hull at once, never comes back
// and leaves the new hull through a new facet. So points are handed on to new facets only.
//
// At the end neighbouring coplanar triangles are joined; corners where a face's outline runs
// straight on have the same two faces on both sides and are dropped, what is in the middle of a
// face is no corner of an outline.

#include <trisect/bsp/hierarchies/convex/convex_hull.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>

namespace trisect::hierarchies {

namespace {

using Index = std::uint32_t;
constexpr Index no_facet = ConvexPolytope::none;

struct Facet {
    std::array<Index, 3> vertex{};
    std::array<Index, 3> beyond{no_facet, no_facet,
                                no_facet};  // behind the side from vertex i to i + 1
    Plane plane;
    std::vector<Index> above;
    bool gone = false;
    std::uint32_t visit = 0;
};

double height(const LatticePoint& p, const Plane& plane) {
    double h = plane.approx_offset();
    for (int k = 0; k < 3; ++k) h += plane.approx_normal(k) * p[k].to_double();
    return h;
}

class Quickhull {
public:
    Quickhull(std::span<const LatticePoint> points, const std::array<Index, 4>& simplex)
        : points_(points) {
        start(simplex);
        // Facets are appended while we go.
        for (Index f = 0; f < facets_.size(); ++f)
            while (!facets_[f].gone && !facets_[f].above.empty()) add_farthest_of(f);
    }

    [[nodiscard]] ConvexPolytope polytope(Lattice lattice) {
        find_faces();
        return assemble(lattice);
    }

private:
    [[nodiscard]] bool is_above(Index p, Index f) const {
        return side_of(points_[p], facets_[f].plane) == Side::Above;
    }

    Index make(Index a, Index b, Index c) {
        Facet f;
        f.vertex = {a, b, c};
        f.plane = Plane::through(points_[a], points_[b], points_[c]);
        facets_.push_back(std::move(f));
        return static_cast<Index>(facets_.size() - 1);
    }

    void start(std::array<Index, 4> s) {
        if (side_of(points_[s[3]], Plane::through(points_[s[0]], points_[s[1]], points_[s[2]])) ==
            Side::Above)
            std::swap(s[1], s[2]);
        // Now the fourth is below the first three.
        make(s[0], s[1], s[2]);
        make(s[1], s[0], s[3]);
        make(s[2], s[1], s[3]);
        make(s[0], s[2], s[3]);
        for (Index f = 0; f < 4; ++f)
            for (std::size_t i = 0; i < 3; ++i) link(f, i);
        for (Index p = 0; p < points_.size(); ++p) give(p, 0);
    }

    // Finds the facet behind a side among the first four.
    void link(Index f, std::size_t i) {
        const Index a = facets_[f].vertex[i];
        const Index b = facets_[f].vertex[(i + 1) % 3];
        for (Index g = 0; g < 4; ++g)
            for (std::size_t j = 0; j < 3; ++j)
                if (facets_[g].vertex[j] == b && facets_[g].vertex[(j + 1) % 3] == a)
                    facets_[f].beyond[i] = g;
    }

    // To the first facet, from number `from` on, that the point is above.
    void give(Index p, Index from) {
        for (Index f = from; f < facets_.size(); ++f)
            if (!facets_[f].gone && is_above(p, f)) {
                facets_[f].above.push_back(p);
                return;
            }
    }

    struct Side3 {
        Index facet;
        std::size_t side;
    };

    void add_farthest_of(Index first) {
        const auto& above = facets_[first].above;
        const Index apex = *std::max_element(above.begin(), above.end(), [&](Index a, Index b) {
            return height(points_[a], facets_[first].plane) <
                   height(points_[b], facets_[first].plane);
        });
        const std::vector<Side3> horizon = remove_seen(first, apex);
        const auto from = static_cast<Index>(facets_.size());
        for (const Side3& s : horizon) {
            // The kept facet's side seen from the other side is the new facet's first side.
            const Index a = facets_[s.facet].vertex[(s.side + 1) % 3];
            const Index b = facets_[s.facet].vertex[s.side];
            const Index f = make(a, b, apex);
            facets_[f].beyond[0] = s.facet;
            facets_[s.facet].beyond[s.side] = f;
            cone_at_[a] = f;
        }
        for (Index f = from; f < facets_.size(); ++f) {
            const Index next = cone_at_[facets_[f].vertex[1]];
            facets_[f].beyond[1] = next;
            facets_[next].beyond[2] = f;
        }
        for (const Index p : orphans_)
            if (p != apex) give(p, from);
    }

    // Removes the facets that the point is strictly above; returns the sides of kept facets around
    // them. Their points become orphans.
    std::vector<Side3> remove_seen(Index first, Index apex) {
        cone_at_.resize(points_.size(), no_facet);
        orphans_.clear();
        ++visit_;
        std::vector<Side3> horizon;
        std::vector<Index> stack{first};
        facets_[first].gone = true;
        while (!stack.empty()) {
            const Index f = stack.back();
            stack.pop_back();
            orphans_.insert(orphans_.end(), facets_[f].above.begin(), facets_[f].above.end());
            facets_[f].above = {};
            for (std::size_t i = 0; i < 3; ++i) {
                const Index g = facets_[f].beyond[i];
                if (facets_[g].gone) continue;
                if (facets_[g].visit != visit_ && is_above(apex, g)) {
                    facets_[g].gone = true;
                    stack.push_back(g);
                    continue;
                }
                facets_[g].visit = visit_;  // not seen
                for (std::size_t j = 0; j < 3; ++j)
                    if (facets_[g].beyond[j] == f &&
                        facets_[g].vertex[j] == facets_[f].vertex[(i + 1) % 3])
                        horizon.push_back({g, j});
            }
        }
        return horizon;
    }

    // Numbers the classes of coplanar neighbours.
    void find_faces() {
        face_of_.assign(facets_.size(), no_facet);
        for (Index f = 0; f < facets_.size(); ++f) {
            if (facets_[f].gone || face_of_[f] != no_facet) continue;
            std::vector<Index> stack{f};
            face_of_[f] = face_count_;
            while (!stack.empty()) {
                const Index g = stack.back();
                stack.pop_back();
                for (const Index h : facets_[g].beyond)
                    if (face_of_[h] == no_facet && is_coplanar(f, h)) {
                        face_of_[h] = face_count_;
                        stack.push_back(h);
                    }
            }
            ++face_count_;
        }
    }
    [[nodiscard]] bool is_coplanar(Index f, Index g) const {
        return std::all_of(facets_[g].vertex.begin(), facets_[g].vertex.end(), [&](Index v) {
            return side_of(points_[v], facets_[f].plane) == Side::On;
        });
    }

    [[nodiscard]] ConvexPolytope assemble(Lattice lattice) const {
        // The outline of each face: where it goes from each of its corners, and which face is
        // there.
        struct Step {
            Index from;
            Index to;
            Index face;
        };
        std::vector<std::vector<Step>> outline(face_count_);
        for (Index f = 0; f < facets_.size(); ++f) {
            if (facets_[f].gone) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const Index other = face_of_[facets_[f].beyond[i]];
                if (other != face_of_[f])
                    outline[face_of_[f]].push_back(
                        {facets_[f].vertex[i], facets_[f].vertex[(i + 1) % 3], other});
            }
        }
        std::vector<LatticePoint> vertices;
        std::vector<Index> name(points_.size(), no_facet);
        std::vector<std::vector<Index>> loops;
        for (auto& steps : outline) {
            std::sort(steps.begin(), steps.end(),
                      [](const Step& a, const Step& b) { return a.from < b.from; });
            std::vector<Index> loop;
            std::size_t at = 0;
            for (std::size_t n = 0; n < steps.size(); ++n) {
                const auto next =
                    std::lower_bound(steps.begin(), steps.end(), steps[at].to,
                                     [](const Step& a, Index v) { return a.from < v; });
                TRISECT_EXPECTS(next != steps.end() && next->from == steps[at].to,
                                "the outline of a hull's face is open");
                if (next->face != steps[at].face) {
                    Index& v = name[next->from];
                    if (v == no_facet) {
                        v = static_cast<Index>(vertices.size());
                        vertices.push_back(points_[next->from]);
                    }
                    loop.push_back(v);
                }
                at = static_cast<std::size_t>(next - steps.begin());
            }
            loops.push_back(std::move(loop));
        }
        return ConvexPolytope(lattice, 3, vertices, loops);
    }

    std::span<const LatticePoint> points_;
    std::vector<Facet> facets_;
    std::vector<Index> orphans_;
    std::vector<Index> cone_at_;  // the new facet whose first side starts at a vertex
    std::vector<Index> face_of_;
    Index face_count_ = 0;
    std::uint32_t visit_ = 0;
};

// Points of one plane, in lexicographic order, not all collinear: Andrew's two chains.
ConvexPolytope flat_hull(std::span<const LatticePoint> points, const Plane& plane,
                         Lattice lattice) {
    const int axis = plane.dominant_axis();
    const bool up = plane.normal(axis) > 0;
    // The chains want an order within the projection. Sorting by the two other coordinates is one,
    // because the projection is one to one.
    std::vector<LatticePoint> sorted(points.begin(), points.end());
    const int j = (axis + 1) % 3;
    const int k = (axis + 2) % 3;
    std::sort(sorted.begin(), sorted.end(), [&](const LatticePoint& a, const LatticePoint& b) {
        return std::pair(a[j], a[k]) < std::pair(b[j], b[k]);
    });
    std::vector<LatticePoint> ring;
    const auto flat = [&](const LatticePoint& p) { return detail::flat_corner(p, j, k); };
    const auto extend = [&](const LatticePoint& p, std::size_t keep) {
        while (ring.size() > keep &&
               detail::turn(flat(ring[ring.size() - 2]), flat(ring.back()), flat(p)) <= 0)
            ring.pop_back();
        ring.push_back(p);
    };
    for (const LatticePoint& p : sorted) extend(p, 1);
    const std::size_t lower = ring.size();
    for (std::size_t i = sorted.size() - 1; i-- > 0;) extend(sorted[i], lower);
    ring.pop_back();
    std::vector<Index> there(ring.size());
    for (Index i = 0; i < there.size(); ++i) there[i] = i;
    std::vector<Index> back(there.rbegin(), there.rend());
    if (!up) std::swap(there, back);
    const std::array<std::vector<Index>, 2> loops{there, back};
    return ConvexPolytope(lattice, 2, ring, loops);
}

}  // namespace

ConvexPolytope convex_hull(std::span<const LatticePoint> given, Lattice lattice) {
    std::vector<LatticePoint> points(given.begin(), given.end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.empty()) return {};
    if (points.size() == 1) return ConvexPolytope(lattice, points);

    // The first, the last, the farthest from their line, the farthest from their plane.
    const auto count = static_cast<Index>(points.size());
    const LatticePoint& a = points.front();
    const LatticePoint& b = points.back();
    std::optional<Index> third;
    double best = -1;
    for (Index i = 1; i + 1 < count; ++i) {
        if (are_collinear(a, b, points[i])) continue;
        const auto n = detail::cross(detail::minus(b.doubles(), a.doubles()),
                                     detail::minus(points[i].doubles(), a.doubles()));
        const double square = detail::dot(n, n);
        if (square > best) {
            best = square;
            third = i;
        }
    }
    if (!third) return ConvexPolytope(lattice, std::array{a, b});
    const Plane plane = Plane::through(a, b, points[*third]);
    std::optional<Index> fourth;
    best = -1;
    for (Index i = 0; i < count; ++i) {
        if (side_of(points[i], plane) == Side::On) continue;
        const double h = std::abs(height(points[i], plane));
        if (h > best) {
            best = h;
            fourth = i;
        }
    }
    if (!fourth) return flat_hull(points, plane, lattice);
    return Quickhull(points, {0, count - 1, *third, *fourth}).polytope(lattice);
}

ConvexPolytope enclosing_hull(std::span<const Point> points, Lattice lattice) {
    // Among corners with fractions, boxes of a unit may be larger than all of the hull.
    const bool whole = std::ranges::all_of(
        points, [](const Point& p) { return !p.is_lattice() || p.lattice().is_whole(); });
    const int bits = whole ? 0 : fraction_limit;
    std::vector<LatticePoint> corners;
    for (const Point& p : points) {
        if (p.is_lattice()) {
            corners.push_back(p.lattice());
            continue;
        }
        const Approximation& x = p.approximation();
        std::array<std::array<Coordinate, 2>, 3> range{};
        for (std::size_t k = 0; k < 3; ++k) {
            // Multiples of 2^-bits around it. Coordinates are below 2^53, so both ends are such
            // that doubles hold. Their rounding is paid for by the next double outwards.
            const double below = std::nextafter(x.c[k] - x.error, -HUGE_VAL);
            const double above = std::nextafter(x.c[k] + x.error, HUGE_VAL);
            const double lo = std::ldexp(std::floor(std::ldexp(below, bits)), -bits);
            const double hi = std::ldexp(std::ceil(std::ldexp(above, bits)), -bits);
            if (!(lo > -0x1p53 && hi < 0x1p53))
                throw LimitError("the corners of an enclosing hull leave the lattice's range");
            range[k] = {Coordinate(lo), Coordinate(hi)};
        }
        for (unsigned i = 0; i < 8; ++i)
            corners.push_back({range[0][i & 1U], range[1][i >> 1U & 1U], range[2][i >> 2U & 1U]});
    }
    return convex_hull(corners, lattice);
}

}  // namespace trisect::hierarchies
