// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/line_chains.h>

#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace trisect::detail {

std::uint32_t LineChains::point_at(const Point2d& p) {
    const auto x = static_cast<std::int64_t>(std::llround(p[0] / cell));
    const auto y = static_cast<std::int64_t>(std::llround(p[1] / cell));
    if (const auto it = point_in_.find({x, y}); it != point_in_.end()) return it->second;
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t i = x - 1; i <= x + 1; ++i)
        for (std::int64_t j = y - 1; j <= y + 1; ++j) {
            const auto it = point_in_.find({i, j});
            if (it == point_in_.end()) continue;
            const Point2d& q = points_[it->second];
            const double distance = std::hypot(q[0] - p[0], q[1] - p[1]);
            if (distance < least) {
                least = distance;
                nearest = it->second;
            }
        }
    if (least < std::numeric_limits<double>::infinity()) return nearest;
    const auto fresh = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    lines_at_.emplace_back();
    first_at_.push_back(0);
    degree_.push_back(0);
    point_in_.emplace(std::pair(x, y), fresh);
    return fresh;
}

void LineChains::add(const Point2d& from, const Point2d& to) {
    const std::uint32_t a = point_at(from);
    const std::uint32_t b = point_at(to);
    if (a == b) return;
    const auto line = static_cast<std::uint32_t>(lines_.size());
    lines_.push_back({{a, b}});
    for (const std::uint32_t p : {a, b}) {
        lines_at_[p].push_back(line);
        ++degree_[p];
    }
}

/// Along lines that are not used yet, as far as they go.
Outline LineChains::walk(std::uint32_t line, int from) {
    std::uint32_t at = lines_[line].ends[from];
    Outline out{points_[at]};
    while (true) {
        Line& l = lines_[line];
        l.is_used = true;
        for (const std::uint32_t p : l.ends)
            if (--degree_[p] == 1) freed_.push_back(p);
        at = l.ends[0] == at ? l.ends[1] : l.ends[0];
        out.push_back(points_[at]);
        if (degree_[at] == 0) break;
        std::uint32_t& k = first_at_[at];
        while (lines_[lines_at_[at][k]].is_used) ++k;
        line = lines_at_[at][k];
    }
    return out;
}

std::vector<Outline> LineChains::outlines() {
    std::vector<Outline> out;
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> open;
    for (std::uint32_t i = 0; i < lines_.size(); ++i) open.push(i);
    while (!open.empty()) {
        const std::uint32_t i = open.top();
        open.pop();
        if (lines_[i].is_used) continue;
        const bool first = is_free_end(lines_[i].ends[0]);
        if (!first && !is_free_end(lines_[i].ends[1])) continue;
        out.push_back(walk(i, first ? 0 : 1));
        for (const std::uint32_t p : freed_)
            for (const std::uint32_t line : lines_at_[p])
                if (!lines_[line].is_used) open.push(line);
        freed_.clear();
    }
    for (std::uint32_t i = 0; i < lines_.size(); ++i)
        if (!lines_[i].is_used) out.push_back(walk(i, 0));
    return out;
}

}  // namespace trisect::detail
