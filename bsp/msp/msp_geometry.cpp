// SPDX-License-Identifier: Apache-2.0
//
// Polygons are cut as in kernel/convex_polygon.cpp (Bernstein and Fussell 2009): the cutting plane
// is inserted into the cyclic list of edges, and no coordinate is constructed. Two things differ.
// Edges and corners carry what they are on the boundary, so that a piece still identifies which of
// its edges are real; and corners may be straight, as the corners of faces are where a neighbour
// ends. A plane that runs through the interior still meets the border in exactly two places.
//
// A point is numbered once and named by three planes. The symbolic stage compares numbers; so the
// commonest degenerate question, a cut by a plane that made the point, costs three comparisons.

#include <trisect/bsp/msp/msp_geometry.h>

#include <cmath>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail::msp {

PlaneIndex MspGeometry::add_plane(const Plane& plane) {
    planes_.push_back(plane);
    return static_cast<PlaneIndex>(planes_.size() - 1);
}

PointIndex MspGeometry::add_point(const std::array<PlaneIndex, 3>& planes, const Point& exact) {
    Record r;
    r.planes = planes;
    r.is_lattice = exact.is_lattice();
    if (r.is_lattice) r.lattice = exact.lattice();
    r.approximation = exact.approximation();
    points_.push_back(r);
    return static_cast<PointIndex>(points_.size() - 1);
}

PointIndex MspGeometry::meet(PlaneIndex p, PlaneIndex q, PlaneIndex r) {
    Record record;
    record.planes = {p, q, r};
    record.approximation = approximate(planes_[p], planes_[q], planes_[r]);
    points_.push_back(record);
    return static_cast<PointIndex>(points_.size() - 1);
}

Side MspGeometry::side(PointIndex point, PlaneIndex plane) const {
    const Record& p = points_[point];
    const Plane& s = planes_[plane];
    if (const auto side = filtered_side(p.approximation, s)) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return *side;
    }
    if (p.planes[0] == plane || p.planes[1] == plane || p.planes[2] == plane) {
        ++detail::counters_of_thread<PredicateCounters>.symbolic;
        return Side::On;
    }
    if (p.is_lattice) return side_of(p.lattice, s);
    return side_of(p.approximation, planes_[p.planes[0]], planes_[p.planes[1]],
                   planes_[p.planes[2]], s);
}

HomogeneousPoint MspGeometry::homogeneous(const Record& p) const {
    if (p.is_lattice) return trisect::homogeneous(p.lattice);
    const auto exact = intersect(planes_[p.planes[0]], planes_[p.planes[1]], planes_[p.planes[2]]);
    TRISECT_EXPECTS(exact.has_value(), "MSP tree: three planes do not meet in a point");
    return *exact;
}

std::strong_ordering MspGeometry::compare(PointIndex a, PointIndex b, int axis) const {
    if (a == b) return std::strong_ordering::equal;
    const Record& p = points_[a];
    const Record& q = points_[b];
    const auto i = static_cast<std::size_t>(axis);
    const double gap = p.approximation.c[i] - q.approximation.c[i];
    // The difference has one rounding; the sum of the errors another.
    if (std::fabs(gap) > error_slack * (p.approximation.error + q.approximation.error))
        return gap < 0 ? std::strong_ordering::less : std::strong_ordering::greater;
    if (p.is_lattice && q.is_lattice) return p.lattice[axis] <=> q.lattice[axis];
    return compare_coordinate(homogeneous(p), homogeneous(q), axis);
}

std::strong_ordering MspGeometry::compare(PointIndex a, PointIndex b) const {
    for (int axis = 0; axis < 3; ++axis)
        if (const auto c = compare(a, b, axis); c != 0) return c;
    return std::strong_ordering::equal;
}

std::uint32_t MspGeometry::add_corners(std::span<const Corner> corners) {
    const auto first = static_cast<std::uint32_t>(corners_.size());
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    return first;
}

MspGeometry::Cut MspGeometry::cut(const Fragment& f, PlaneIndex plane,
                                  std::span<const Side> sides) {
    below_.clear();
    above_.clear();
    Cut result;
    std::size_t ends = 0;
    const auto add_end = [&](const BorderPoint& p) {
        TRISECT_EXPECTS(ends < 2, "MSP tree: a plane meets a convex polygon in three places");
        result.ends[ends++] = p;
    };
    // The new edge, on which both parts lie: within the face, and on the border of both cells.
    const auto closing = [&](Corner c) {
        c.edge_plane = plane;
        c.edge = f.face;
        c.edge_is_dead = true;
        c.vertex_is_dead = true;
        return c;
    };
    for (std::uint32_t i = 0; i < f.corner_count; ++i) {
        const Corner c = corners_[f.first_corner + i];
        const Side here = sides[i];
        const Side next = sides[i + 1 < f.corner_count ? i + 1 : 0];
        if (here == Side::On) {
            add_end({c.point, c.vertex, c.vertex_is_dead});
            Corner open = c;
            open.vertex_is_dead = true;
            below_.push_back(next == Side::Below ? open : closing(c));
            above_.push_back(next == Side::Above ? open : closing(c));
            continue;
        }
        (here == Side::Below ? below_ : above_).push_back(c);
        if (next == Side::On || next == here) continue;
        Corner crossing = c;
        crossing.point = meet(f.support, c.edge_plane, plane);
        crossing.vertex = c.edge;
        crossing.vertex_is_dead = true;
        add_end({crossing.point, c.edge, c.edge_is_dead});
        (here == Side::Below ? below_ : above_).push_back(closing(crossing));
        (here == Side::Below ? above_ : below_).push_back(crossing);
    }
    TRISECT_EXPECTS(ends == 2, "MSP tree: a plane that cuts a polygon does not cross its border");
    const auto part = [&](const std::vector<Corner>& corners) {
        return Fragment{f.support, f.face, add_corners(corners),
                        static_cast<std::uint32_t>(corners.size())};
    };
    result.below = part(below_);
    result.above = part(above_);
    return result;
}

}  // namespace trisect::detail::msp
