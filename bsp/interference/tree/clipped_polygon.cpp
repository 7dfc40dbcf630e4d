// SPDX-License-Identifier: Apache-2.0
//
// Sutherland and Hodgman's clipping (1974) by the walls of a cell, as far as doubles decide on
// which side of a wall each corner is; corners of input meshes never lie on one. What they leave
// open is clipped exactly.
//
// A side from u, inside, to v, outside, meets a wall at u + t (v - u), t = d_u / (d_u - d_v), d the
// distances to the wall. With d_u and d_v known within e and f, and D = d_u - d_v > 64 (e + f), t
// is off by at most 1.1 (e + f) / D + 4 u; the point by |v - u| times that, by what its ends are
// off, and by three roundings.

#include <trisect/bsp/interference/tree/clipped_polygon.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

void PolygonClipper::begin(IndexPolygons::Id id) {
    is_all_ = true;
    corners_.clear();
    edges_ = polygons_.edge_names(id);
    if (polygons_.is_triangle(id)) {
        for (int i = 0; i < 3; ++i) corners_.push_back({polygons_.corner(id, i).doubles(), 0});
        return;
    }
    for (const Approximation& a : polygons_.approximate_corners(id))
        corners_.push_back({a.c, a.error});
}

// What is on the side of a wall where sign times the distance is negative.
bool PolygonClipper::clip_by(std::size_t axis, double wall, double sign) {
    const auto distance = [&](const Corner& p) { return sign * (p.c[axis] - wall); };
    const auto error_of = [&](const Corner& p) {
        return p.error + last_place * (std::fabs(p.c[axis]) + 2 * std::fabs(wall));
    };
    bool any_outside = false;
    for (const Corner& p : corners_) {
        const double d = distance(p);
        if (!(std::fabs(d) > error_of(p))) return false;
        any_outside = any_outside || d > 0;
    }
    if (!any_outside) return true;
    next_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Corner& p = corners_[i];
        const Corner& q = corners_[i + 1 == corners_.size() ? 0 : i + 1];
        const double dp = distance(p);
        const double dq = distance(q);
        if (dp < 0) next_.push_back(p);
        if ((dp < 0) == (dq < 0)) continue;
        // The same point whichever way the side runs.
        const bool forward = dp < 0;
        const Corner& u = forward ? p : q;
        const Corner& v = forward ? q : p;
        const double du = forward ? dp : dq;
        const double way = std::fabs(dp - dq);
        const double e = error_of(p) + error_of(q);
        if (!(way > 64 * e)) return false;
        const double t = std::fabs(du) / way;
        const double t_error = 1.1 * e / way + 4 * unit_roundoff;
        Corner x;
        double size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double side = v.c[k] - u.c[k];
            x.c[k] = u.c[k] + t * side;
            size = std::max(size, std::fabs(u.c[k]) + std::fabs(v.c[k]));
            x.error = std::max(x.error, std::fabs(side) * t_error);
        }
        x.c[axis] = wall;
        x.error = bound_slack * (x.error + std::max(u.error, v.error) + 4 * unit_roundoff * size +
                                 last_place * std::fabs(wall));
        next_.push_back(x);
    }
    corners_.swap(next_);
    is_all_ = false;
    return true;
}

// Whether one of its edges is on a wall, which then has all of it on one side. Corners are on the
// wall there, which doubles do not see.
bool PolygonClipper::ends_at(std::size_t axis, std::int64_t wall) const {
    return std::ranges::any_of(edges_, [&](const EdgeName& e) {
        return e.plane == PlaneName::splitter(static_cast<int>(axis), wall);
    });
}

// The part on the side of a wall where `sign` times the distance is negative.
bool PolygonClipper::clip_by_wall(std::size_t axis, std::int64_t wall, double sign) {
    const double position = rounded_position(wall);
    if (!ends_at(axis, wall)) return clip_by(axis, position, sign);
    for (const Corner& p : corners_) {
        const double d = sign * (p.c[axis] - position);
        const double e = p.error + last_place * (std::fabs(p.c[axis]) + 2 * std::fabs(position));
        if (d < -e) return true;
        if (d > e) {
            corners_.clear();
            is_all_ = false;
            return true;
        }
    }
    return corners_.empty();
}

bool PolygonClipper::clip_by_walls() {
    const Cell& cell = polygons_.cell();
    for (std::size_t k = 0; k < 3; ++k) {
        if (!clip_by_wall(k, cell.hi[k], 1) || !clip_by_wall(k, cell.lo[k], -1)) return false;
    }
    return true;
}

void PolygonClipper::take_exact(IndexPolygons::Id id) {
    is_all_ = false;
    corners_.clear();
    const ConvexPolygon part = polygons_.part(id);
    for (const Point& p : part.vertices()) {
        Corner c{p.approximation().c, p.approximation().error};
        if (!(c.error <= most_error_)) {
            c.c = p.nearest();
            c.error = 0;
            for (const double x : c.c) c.error = std::max(c.error, unit_roundoff * std::fabs(x));
        }
        corners_.push_back(c);
    }
}

const ClippedPolygon& PolygonClipper::clip(IndexPolygons::Id id) {
    begin(id);
    const auto is_good = [this] {
        return std::ranges::all_of(corners_,
                                   [this](const Corner& c) { return c.error <= most_error_; });
    };
    if (polygons_.is_unbounded(id) || (polygons_.reaches_out(id) && !clip_by_walls()) || !is_good())
        take_exact(id);
    result_.corners.clear();
    result_.error = 0;
    result_.is_all = is_all_;
    for (const Corner& c : corners_) {
        result_.corners.push_back(c.c);
        result_.error = std::max(result_.error, c.error);
    }
    return result_;
}

}  // namespace trisect::detail
