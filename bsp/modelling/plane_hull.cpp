// SPDX-License-Identifier: Apache-2.0
//
// Andrew's monotone chain (1979).
#include <trisect/bsp/modelling/plane_hull.h>

#include <algorithm>

#include <trisect/bsp/modelling/pieces/plane_turn.h>

namespace trisect {

Outline hull_of_points(std::vector<Point2d> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    const detail::PlaneTurns turns(points);
    std::vector<std::size_t> chain;
    const auto add = [&](std::size_t i, std::size_t least) {
        while (chain.size() > least && turns.turn(chain[chain.size() - 2], chain.back(), i) <= 0)
            chain.pop_back();
        chain.push_back(i);
    };
    for (std::size_t i = 0; i < points.size(); ++i) add(i, 1);
    const std::size_t lower = chain.size();
    for (std::size_t i = points.size() - 1; i-- > 0;) add(i, lower);
    chain.pop_back();
    Outline out;
    for (const std::size_t i : chain) out.push_back(points[i]);
    return out;
}

}  // namespace trisect
