// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/flat/flat_figure.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

using Line = FlatRegion::Line;
using Vertex = FlatRegion::Vertex;

constexpr FlatFigure::Index no_vertex = FlatRegion::none;

LatticePoint at_zero(const FlatCorner& c) { return {c.u, c.v, Coordinate()}; }

const Plane& plane_of_figure() {
    static const Plane plane = Plane::axis_aligned(2, 1, 0);
    return plane;
}

double du_of(const Line& l) { return l.b.u.to_double() - l.a.u.to_double(); }
double dv_of(const Line& l) { return l.b.v.to_double() - l.a.v.to_double(); }

std::uint64_t hash_of(const FlatCorner& c) {
    std::uint64_t h = c.u.bits() * 0x9E3779B97F4A7C15U;
    h = (std::rotl(h, 29) ^ c.v.bits()) * 0xBF58476D1CE4E5B9U;
    return h ^ (h >> 31U);
}

int sign(double v) { return (v > 0 ? 1 : 0) - (v < 0 ? 1 : 0); }

// The crossing in doubles: a + t d with t a quotient of two minors. Those are within minor_rounding
// of the sums of the magnitudes of their products. Nothing where the lines are nearly parallel.
bool quick_crossing(const Line& p, const Line& q, Approximation& out) {
    const double du = du_of(p);
    const double dv = dv_of(p);
    const double eu = du_of(q);
    const double ev = dv_of(q);
    const double ru = q.a.u.to_double() - p.a.u.to_double();
    const double rv = q.a.v.to_double() - p.a.v.to_double();
    const double below = du * ev - dv * eu;
    const double below_error = minor_rounding * (std::fabs(du * ev) + std::fabs(dv * eu));
    if (!(std::fabs(below) > 16 * below_error)) return false;
    const double above = ru * ev - rv * eu;
    const double above_error = minor_rounding * (std::fabs(ru * ev) + std::fabs(rv * eu));
    const double t = above / below;
    // |below| is within a sixteenth of itself.
    const double t_error = 1.1 * (above_error + std::fabs(t) * below_error) / std::fabs(below) +
                           0x1p-52 * std::fabs(t);
    const auto error_of = [&](double d, double at) {
        return t_error * std::fabs(d) + 0x1p-51 * std::fabs(t * d) + 0x1p-52 * std::fabs(at);
    };
    const double u = p.a.u.to_double() + t * du;
    const double v = p.a.v.to_double() + t * dv;
    out.c = {u, v, 0};
    out.error = bound_slack * std::max(error_of(du, u), error_of(dv, v));
    return std::isfinite(out.error);
}

}  // namespace

Plane flat_plane(const Line& line) {
    return Plane::along_axis(at_zero(line.a), at_zero(line.b), 2);
}

Approximation flat_approximation(const Line& p, const Line& q) {
    Approximation out;
    // What is farther than a billionth of its size from sure is worth integers.
    if (quick_crossing(p, q, out) &&
        out.error <= 0x1p-30 * (std::fabs(out.c[0]) + std::fabs(out.c[1])))
        return out;
    return approximate(flat_plane(p), flat_plane(q), plane_of_figure());
}

Point flat_point(const FlatRegion& region, const Vertex& v) {
    if (v.is_corner()) return Point(at_zero(v.corner()));
    return {flat_plane(region.lines[v.lines[0]]), flat_plane(region.lines[v.lines[1]]),
            plane_of_figure()};
}

FlatFigure::Index FlatFigure::corner(const FlatCorner& at) {
    if (2 * (corners_ + 1) > table_.size()) grow_table();
    const std::size_t mask = table_.size() - 1;
    for (std::size_t i = hash_of(at) & mask;; i = (i + 1) & mask) {
        if (table_[i] == no_vertex) {
            table_[i] = static_cast<Index>(vertices.size());
            vertices.push_back({at.u.to_double(), at.v.to_double(), 0});
            ++corners_;
            return table_[i];
        }
        if (vertices[table_[i]].corner() == at) return table_[i];
    }
}

void FlatFigure::grow_table() {
    std::vector<Index> old(std::max<std::size_t>(64, 4 * table_.size()), no_vertex);
    old.swap(table_);
    const std::size_t mask = table_.size() - 1;
    for (const Index known : old) {
        if (known == no_vertex) continue;
        std::size_t i = hash_of(vertices[known].corner()) & mask;
        while (table_[i] != no_vertex) i = (i + 1) & mask;
        table_[i] = known;
    }
}

FlatFigure::Index FlatFigure::crossing(Index p, Index q) {
    const Line& l = lines[p];
    const Line& m = lines[q];
    if (l.a.u == l.b.u && m.a.v == m.b.v) return corner({l.a.u, m.a.v});
    if (m.a.u == m.b.u && l.a.v == l.b.v) return corner({m.a.u, l.a.v});
    const Approximation at = flat_approximation(l, m);
    const auto number = static_cast<Index>(vertices.size());
    // An error of 0 would say that it is a corner's.
    vertices.push_back({at.c[0], at.c[1], std::max(at.error, 0x1p-300), {p, q}});
    return number;
}

const Plane& FlatFigure::plane(Index line) const {
    const auto known = planes_.find(line);
    if (known != planes_.end()) return known->second;
    return planes_.emplace(line, flat_plane(lines[line])).first->second;
}

int FlatFigure::side(Index line, Index vertex) const {
    const Line& l = lines[line];
    const Vertex& v = vertices[vertex];
    if (v.is_corner()) return turn(l.a, l.b, v.corner());
    if (v.lines[0] == line || v.lines[1] == line) return 0;
    const double du = du_of(l);
    const double dv = dv_of(l);
    const double left = du * (v.v - l.a.v.to_double());
    const double right = dv * (v.u - l.a.u.to_double());
    const double error = minor_rounding * (std::fabs(left) + std::fabs(right)) +
                         v.error * (std::fabs(du) + std::fabs(dv));
    const int known = certain_sign(left - right, bound_slack * error);
    return known != 0 ? known : exact_side(line, v);
}

int FlatFigure::exact_side(Index line, const Vertex& v) const {
    return -sign_of(side_of(Approximation{{v.u, v.v, 0}, v.error}, plane(v.lines[0]),
                            plane(v.lines[1]), plane_of_figure(), plane(line)));
}

int FlatFigure::cross(Index p, Index q) const {
    if (p == q) return 0;
    const Line& l = lines[p];
    const Line& m = lines[q];
    const double left = du_of(l) * dv_of(m);
    const double right = dv_of(l) * du_of(m);
    const double error = minor_rounding * (std::fabs(left) + std::fabs(right));
    const int known = certain_sign(left - right, error);
    if (known != 0 || error == 0) return known;
    return sign_of_cross(plane(p), plane(q), 2);
}

int FlatFigure::compare_along(Index line, Index p, Index q) const {
    if (p == q) return 0;
    const Line& l = lines[line];
    const Vertex& x = vertices[p];
    const Vertex& y = vertices[q];
    const double du = du_of(l);
    const double dv = dv_of(l);
    const bool by_u = std::fabs(du) >= std::fabs(dv);
    const double difference = by_u ? x.u - y.u : x.v - y.v;
    const int forward = sign(by_u ? du : dv);
    if (x.is_corner() && y.is_corner()) return forward * sign(difference);
    const int known = certain_sign(
        difference, bound_slack * (x.error + y.error + 0x1p-52 * std::fabs(difference)));
    if (known != 0) return forward * known;
    // Of a line across this one that one of them lies on, the other one is on a side.
    const bool by_first = !x.is_corner();
    const Vertex& named = by_first ? x : y;
    for (const Index across : named.lines) {
        const int turn = cross(across, line);
        if (turn != 0) return (by_first ? -1 : 1) * turn * side(across, by_first ? q : p);
    }
    return 0;
}

Point FlatFigure::point(Index v) const {
    const Vertex& x = vertices[v];
    if (x.is_corner()) return Point(at_zero(x.corner()));
    return {plane(x.lines[0]), plane(x.lines[1]), plane_of_figure()};
}

int FlatFigure::exact_compare(Index p, Index q, int axis) const {
    const auto order = compare_coordinate(point(p), point(q), axis);
    return (order > 0 ? 1 : 0) - (order < 0 ? 1 : 0);
}

int FlatFigure::compare_u(Index p, Index q) const {
    const Vertex& x = vertices[p];
    const Vertex& y = vertices[q];
    if (x.u - y.u > bound_slack * (x.error + y.error)) return 1;
    if (y.u - x.u > bound_slack * (x.error + y.error)) return -1;
    return (x.is_corner() && y.is_corner()) || p == q ? 0 : exact_compare(p, q, 0);
}

int FlatFigure::compare(Index p, Index q) const {
    if (p == q) return 0;
    if (const int by_u = compare_u(p, q); by_u != 0) return by_u;
    const Vertex& x = vertices[p];
    const Vertex& y = vertices[q];
    if (x.v - y.v > bound_slack * (x.error + y.error)) return 1;
    if (y.v - x.v > bound_slack * (x.error + y.error)) return -1;
    return x.is_corner() && y.is_corner() ? 0 : exact_compare(p, q, 1);
}

}  // namespace trisect::detail
