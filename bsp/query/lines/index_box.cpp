// SPDX-License-Identifier: Apache-2.0
//
// Which polygons meet a box? A polygon with a corner in the box does, one whose box misses it does
// not. Of the others the outline is clipped in rationals by the six half-spaces of the box: what is
// left is not empty exactly when they meet (Sutherland and Hodgman 1974; the polygon is convex).

#include <trisect/bsp/query/lines/index_box.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/lines/index_handles.h>

namespace trisect::detail {

namespace {

using Exact = IndexPoint::Rational;

// The part of a polygon where sign · (coordinate k - bound) <= 0.
std::vector<Exact> clipped(const std::vector<Exact>& corners, std::size_t k,
                           const ExactRational& bound, int sign) {
    std::vector<Exact> out;
    const auto side = [&](const Exact& p) { return (p[k] - bound).sign() * sign; };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Exact& a = corners[i];
        const Exact& b = corners[(i + 1) % corners.size()];
        const int sa = side(a);
        const int sb = side(b);
        if (sa <= 0) out.push_back(a);
        if (sa * sb >= 0) continue;
        const ExactRational t = (bound - a[k]) / (b[k] - a[k]);
        Exact p;
        for (std::size_t j = 0; j < 3; ++j) p[j] = a[j] + t * (b[j] - a[j]);
        out.push_back(std::move(p));
    }
    return out;
}

bool meets(std::vector<Exact> corners, const IndexPoint& lo, const IndexPoint& hi) {
    for (std::size_t k = 0; k < 3 && !corners.empty(); ++k) {
        corners = clipped(corners, k, lo.rational()[k], -1);
        corners = clipped(corners, k, hi.rational()[k], 1);
    }
    return !corners.empty();
}

// The corners of the box as a plane sees them: both signs, or one of them 0?
bool plane_meets(const Plane& plane, const IndexPoint& lo, const IndexPoint& hi) {
    bool below = false;
    bool above = false;
    for (unsigned i = 0; i < 8; ++i) {
        Exact p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = ((i >> k) & 1U) != 0 ? hi.rational()[k] : lo.rational()[k];
        const int s = value_at(p, plane).sign();
        below = below || s <= 0;
        above = above || s >= 0;
    }
    return below && above;
}

// The part of a polygon that is in its cell.
bool meets(const PolygonId& id, const IndexPoint& lo, const IndexPoint& hi) {
    if (id.is_unbounded() && !id.reaches_out()) return plane_meets(id.support(), lo, hi);
    if (!id.is_unbounded()) {
        const DoubleBox box = id.bounds();
        for (std::size_t k = 0; k < 3; ++k)
            if (lo.compare(k, box.hi[k]) > 0 || hi.compare(k, box.lo[k]) < 0) return false;
    }
    std::vector<Exact> corners;
    const ConvexPolygon part = id.part();
    if (part.is_empty()) return false;
    for (const Point& c : part.vertices()) {
        if (is_in_box(c, lo, hi)) return true;
        corners.push_back(IndexPoint(c).rational());
    }
    return meets(std::move(corners), lo, hi);
}

}  // namespace

bool is_in_box(const Point& p, const IndexPoint& lo, const IndexPoint& hi) {
    const IndexPoint q(p);
    for (std::size_t k = 0; k < 3; ++k)
        if (compare_coordinate(q, lo, k) < 0 || compare_coordinate(q, hi, k) > 0) return false;
    return true;
}

bool meets_box(const Point& a, const Point& b, const IndexPoint& lo, const IndexPoint& hi) {
    if (is_in_box(a, lo, hi) || is_in_box(b, lo, hi)) return true;
    const IndexPoint p(a);
    const IndexPoint q(b);
    for (std::size_t k = 0; k < 3; ++k) {
        if (compare_coordinate(p, lo, k) < 0 && compare_coordinate(q, lo, k) < 0) return false;
        if (compare_coordinate(p, hi, k) > 0 && compare_coordinate(q, hi, k) > 0) return false;
    }
    return meets({p.rational(), q.rational()}, lo, hi);
}

std::vector<PolygonId> polygons_in_box(const IndexBase& index, const IndexPoint& lo,
                                       const IndexPoint& hi) {
    DoubleBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::nextafter(lo[k] - lo.error(), -HUGE_VAL);
        box.hi[k] = std::nextafter(hi[k] + hi.error(), HUGE_VAL);
    }
    std::vector<PolygonId> ids =
        polygons_in(index, [&](const DoubleBox& cell) { return cell.overlaps(box); });
    std::erase_if(ids, [&](const PolygonId& id) { return !meets(id, lo, hi); });
    return ids;
}

}  // namespace trisect::detail
