// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/hull_facets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <trisect/kernel/error.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

using Vector = std::array<double, 3>;

Vector rounded_difference(const LatticePoint& a, const LatticePoint& b) {
    const Vector p = a.doubles();
    const Vector q = b.doubles();
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

// Above the plane, in units of its normal, with rounding: it chooses among points, decides nothing.
double distance_above(const LatticePoint& p, const Plane& plane) {
    const Vector x = p.doubles();
    return plane.approx_normal(0) * x[0] + plane.approx_normal(1) * x[1] +
           plane.approx_normal(2) * x[2] + plane.approx_offset();
}

// The first point of which a measure is largest.
template <class Measure>
std::uint32_t farthest(std::span<const LatticePoint> points, const Measure& measure) {
    std::uint32_t best = 0;
    double most = -1;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const double m = measure(points[p]);
        if (m > most) {
            most = m;
            best = p;
        }
    }
    return best;
}

// The first point that meets a condition, `chosen` if that one does.
template <class Condition>
std::uint32_t one_that(std::span<const LatticePoint> points, std::uint32_t chosen,
                       const Condition& condition) {
    if (condition(points[chosen])) return chosen;
    const auto found = std::find_if(points.begin(), points.end(), condition);
    if (found == points.end())
        throw UsageError("a convex hull needs points that are not in one plane");
    return static_cast<std::uint32_t>(found - points.begin());
}

}  // namespace

HullFacets::HullFacets(std::span<const LatticePoint> points)
    : points_(points), next_(points.size(), none), starting_(points.size(), none) {
    start();
    while (!pending_.empty()) {
        const std::uint32_t facet = pending_.back();
        pending_.pop_back();
        const State& state = states_[facet];
        if (state.is_alive && state.farthest != none) add_point(state.farthest, facet);
    }
    drop_dead();
}

// Far from each other, so that most of the points inside are dropped at once.
std::array<std::uint32_t, 4> HullFacets::first_four() const {
    if (points_.empty()) throw UsageError("a convex hull needs points that are not in one plane");
    const auto a = static_cast<std::uint32_t>(std::min_element(points_.begin(), points_.end()) -
                                              points_.begin());
    const LatticePoint& pa = points_[a];
    const auto square = [](const Vector& v) { return dot(v, v); };
    const std::uint32_t b = one_that(
        points_,
        farthest(points_, [&](const LatticePoint& p) { return square(rounded_difference(p, pa)); }),
        [&](const LatticePoint& p) { return p != pa; });
    const LatticePoint& pb = points_[b];
    const Vector way = rounded_difference(pb, pa);
    const std::uint32_t c = one_that(
        points_,
        farthest(
            points_,
            [&](const LatticePoint& p) { return square(cross(way, rounded_difference(p, pa))); }),
        [&](const LatticePoint& p) { return !are_collinear(pa, pb, p); });
    const Plane base = Plane::through(pa, pb, points_[c]);
    const std::uint32_t d = one_that(
        points_,
        farthest(points_,
                 [&](const LatticePoint& p) { return std::fabs(distance_above(p, base)); }),
        [&](const LatticePoint& p) { return side_of(p, base) != Side::On; });
    return {a, b, c, d};
}

void HullFacets::start() {
    const auto [a, b, c, d] = first_four();
    const Plane base = Plane::through(points_[a], points_[b], points_[c]);
    const bool below = side_of(points_[d], base) == Side::Below;
    const std::uint32_t u = below ? b : c;
    const std::uint32_t v = below ? c : b;
    for (const Triangle& t : {Triangle{a, u, v}, {u, a, d}, {v, u, d}, {a, v, d}})
        cone_.push_back(add_facet(t));
    facets_[0].neighbours = {1, 2, 3};
    facets_[1].neighbours = {0, 3, 2};
    facets_[2].neighbours = {0, 1, 3};
    facets_[3].neighbours = {0, 2, 1};
    for (std::uint32_t p = 0; p < points_.size(); ++p) give(p, cone_);
    check_stop(points_.size());
}

std::uint32_t HullFacets::add_facet(const Triangle& corners) {
    auto facet = static_cast<std::uint32_t>(facets_.size());
    if (free_.empty()) {
        facets_.emplace_back();
        states_.emplace_back();
    } else {
        facet = free_.back();
        free_.pop_back();
        states_[facet] = {};
    }
    facets_[facet].corners = corners;
    facets_[facet].plane =
        Plane::through(points_[corners[0]], points_[corners[1]], points_[corners[2]]);
    pending_.push_back(facet);
    return facet;
}

// Across its edge that begins at `from`.
void HullFacets::set_neighbour(std::uint32_t facet, std::uint32_t from, std::uint32_t neighbour) {
    Facet& f = facets_[facet];
    for (std::size_t i = 0; i < 3; ++i)
        if (f.corners[i] == from) f.neighbours[i] = neighbour;
}

// To the list of the first of the facets that the point is above, if there is one.
void HullFacets::give(std::uint32_t point, std::span<const std::uint32_t> facets) {
    for (const std::uint32_t f : facets) {
        const Plane& plane = facets_[f].plane;
        if (side_of(points_[point], plane) != Side::Above) continue;
        State& state = states_[f];
        next_[point] = state.first_above;
        state.first_above = point;
        const double distance = distance_above(points_[point], plane);
        if (state.farthest == none || distance > state.distance) {
            state.farthest = point;
            state.distance = distance;
        }
        return;
    }
}

bool HullFacets::sees(std::uint32_t point, std::uint32_t facet) {
    State& state = states_[facet];
    if (state.round != round_) {
        state.round = round_;
        state.is_seen = side_of(points_[point], facets_[facet].plane) == Side::Above;
        if (state.is_seen) seen_.push_back(facet);
    }
    return state.is_seen;
}

void HullFacets::add_point(std::uint32_t point, std::uint32_t facet) {
    ++round_;
    find_seen(point, facet);
    add_cone(point);
    distribute(point);
}

// From a facet that the point is above to its neighbours, and so on. `seen_` grows meanwhile.
void HullFacets::find_seen(std::uint32_t point, std::uint32_t facet) {
    seen_.clear();
    outline_.clear();
    (void)sees(point, facet);
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        const Facet& f = facets_[seen_[i]];
        for (std::size_t k = 0; k < 3; ++k)
            if (!sees(point, f.neighbours[k]))
                outline_.push_back({f.corners[k], f.corners[(k + 1) % 3], f.neighbours[k]});
    }
    check_stop(seen_.size());
}

void HullFacets::add_cone(std::uint32_t point) {
    cone_.clear();
    for (const OutlineEdge& e : outline_) {
        const std::uint32_t f = add_facet({e.from, e.to, point});
        facets_[f].neighbours[0] = e.outside;
        set_neighbour(e.outside, e.to, f);
        starting_[e.from] = f;
        cone_.push_back(f);
    }
    for (const std::uint32_t f : cone_) {
        const std::uint32_t after = starting_[facets_[f].corners[1]];
        facets_[f].neighbours[1] = after;
        facets_[after].neighbours[2] = f;
    }
}

// Points above facets that are replaced go to the cone's; these facets end.
void HullFacets::distribute(std::uint32_t point) {
    std::size_t count = 0;
    for (const std::uint32_t f : seen_) {
        for (std::uint32_t p = states_[f].first_above; p != none; ++count) {
            const std::uint32_t next = next_[p];
            if (p != point) give(p, cone_);
            p = next;
        }
        states_[f] = {.is_alive = false};
        free_.push_back(f);
    }
    check_stop(count);
}

void HullFacets::drop_dead() {
    std::vector<std::uint32_t> names(facets_.size(), none);
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
        if (!states_[f].is_alive) continue;
        if (count != f) facets_[count] = facets_[f];
        names[f] = count++;
    }
    facets_.resize(count);
    for (Facet& f : facets_)
        for (std::uint32_t& n : f.neighbours) n = names[n];
}

}  // namespace trisect::detail
