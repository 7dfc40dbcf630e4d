// SPDX-License-Identifier: Apache-2.0
//
// The winding number of all sides together at a point is the number of triangles there, so what is
// inside by the positive rule is their union.
#include <trisect/bsp/modelling/pieces/plane_triangles.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/pieces/plane_turn.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

std::uint32_t PlaneTriangles::number(const Point2d& p) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
        throw LimitError("a corner of a region of the plane leaves the range of doubles");
    const Point2d at{p[0] + 0.0, p[1] + 0.0};  // minus zero is zero
    const auto [it, is_new] = numbers_.emplace(at, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(at);
    return it->second;
}

void PlaneTriangles::add(const Point2d& a, const Point2d& b, const Point2d& c) {
    triangles_.push_back({number(a), number(b), number(c)});
}

void PlaneTriangles::add_fan(const Outline& outline) {
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        add(outline[0], outline[i], outline[i + 1]);
}

std::vector<PlaneTriangles::Corners> PlaneTriangles::turned_alike() const {
    const PlaneTurns turns(points_);
    std::vector<Corners> out;
    for (const auto& [a, b, c] : triangles_) {
        const int turn = turns.turn(a, b, c);
        if (turn > 0) out.push_back({a, b, c});
        if (turn < 0) out.push_back({a, c, b});
    }
    return out;
}

/// Sides that are passed more often in one direction than in the other, as often as that.
std::vector<PlaneTriangles::Side> PlaneTriangles::outline(
    const std::vector<Corners>& triangles) const {
    std::vector<Side> passed = sides_;
    for (const Corners& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) passed.push_back({t[k], t[(k + 1) % 3]});
    const auto ends = [](const Side& s) {
        return Side{std::min(s[0], s[1]), std::max(s[0], s[1])};
    };
    std::sort(passed.begin(), passed.end(),
              [&](const Side& a, const Side& b) { return ends(a) < ends(b); });
    std::vector<Side> out;
    for (std::size_t i = 0; i < passed.size();) {
        const auto [low, high] = ends(passed[i]);
        int times = 0;
        for (; i < passed.size() && ends(passed[i]) == Side{low, high}; ++i)
            times += passed[i][0] < passed[i][1] ? 1 : -1;
        for (int k = 0; k < std::abs(times); ++k)
            out.push_back(times > 0 ? Side{low, high} : Side{high, low});
    }
    return out;
}

void PlaneTriangles::add_loop(const Outline& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        sides_.push_back({number(outline[i]), number(outline[(i + 1) % outline.size()])});
}

Solid PlaneTriangles::prism() const {
    check_stop(triangles_.size());
    const auto sides = outline(turned_alike());
    return sides.empty() ? Solid() : flat_prism(points_, sides, 0, 1);
}

}  // namespace trisect::detail
