// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/fragment_group.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

std::uint8_t FragmentGroup::line(const PlaneName& name) {
    for (std::size_t i = 0; i < line_count_; ++i)
        if (lines_[i] == name) return static_cast<std::uint8_t>(i);
    if (line_count_ == max_lines) return none;
    lines_[line_count_] = name;
    return static_cast<std::uint8_t>(line_count_++);
}

std::uint8_t FragmentGroup::vertex(std::uint8_t p, std::uint8_t q, const Approximation& at) {
    const std::array<std::uint8_t, 2> lines{std::min(p, q), std::max(p, q)};
    for (std::size_t i = 0; i < vertex_count_; ++i)
        if (vertices_[i].lines == lines) return static_cast<std::uint8_t>(i);
    if (vertex_count_ == max_vertices) return none;
    vertices_[vertex_count_] = {lines, none, &at};
    return static_cast<std::uint8_t>(vertex_count_++);
}

// False when doubles cannot decide their order.
bool FragmentGroup::sort_vertices_on(std::uint8_t line) {
    on_line_.clear();
    for (std::size_t i = 0; i < vertex_count_; ++i)
        if (vertices_[i].lines[0] == line || vertices_[i].lines[1] == line)
            on_line_.push_back(static_cast<std::uint8_t>(i));
    const Approximation& a = approximation(on_line_[0]);
    const Approximation& b = approximation(on_line_[1]);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(b.c[k] - a.c[k]) > std::fabs(b.c[axis] - a.c[axis])) axis = k;
    std::ranges::sort(on_line_, {}, [&](std::uint8_t v) { return approximation(v).c[axis]; });
    for (std::size_t i = 1; i < on_line_.size(); ++i) {
        const Approximation& p = approximation(on_line_[i - 1]);
        const Approximation& q = approximation(on_line_[i]);
        if (!(q.c[axis] - p.c[axis] > error_slack * (p.error + q.error))) return false;
    }
    return true;
}

void FragmentGroup::cancel_on(std::uint8_t line) {
    if (!sort_vertices_on(line)) {
        std::ranges::copy_if(all_, std::back_inserter(edges_),
                             [&](const Edge& e) { return e.line == line; });
        return;
    }
    const auto place = [&](std::uint8_t v) {
        return static_cast<std::size_t>(std::ranges::find(on_line_, v) - on_line_.begin());
    };
    cover_.assign(on_line_.size(), 0);
    bool above_upwards = false;  // whether edges that run upwards have their part above
    for (const Edge& e : all_) {
        if (e.line != line) continue;
        const std::size_t from = place(e.from);
        const std::size_t to = place(e.to);
        above_upwards = e.above == (from < to);
        for (std::size_t i = std::min(from, to); i < std::max(from, to); ++i)
            cover_[i] += from < to ? 1 : -1;
    }
    for (std::size_t i = 0; i + 1 < on_line_.size(); ++i) {
        const std::uint8_t low = on_line_[i];
        const std::uint8_t high = on_line_[i + 1];
        for (int k = 0; k < cover_[i]; ++k) edges_.push_back({low, high, line, above_upwards});
        for (int k = 0; k > cover_[i]; --k) edges_.push_back({high, low, line, !above_upwards});
    }
}

bool FragmentGroup::join(std::span<const PolygonRef> group) {
    line_count_ = 0;
    vertex_count_ = 0;
    all_.clear();
    std::array<std::uint8_t, max_lines> around{};
    std::array<std::uint8_t, max_lines> corners{};
    for (const PolygonRef& ref : group) {
        const auto names = ref.fragment->edges();
        const std::size_t n = names.size();
        if (n > max_lines) return false;
        for (std::size_t i = 0; i < n; ++i)
            if ((around[i] = line(names[i].plane)) == none) return false;
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint8_t before = around[i == 0 ? n - 1 : i - 1];
            corners[i] = vertex(before, around[i], ref.fragment->vertices()[i]);
            if (corners[i] == none) return false;
        }
        for (std::size_t i = 0; i < n; ++i)
            all_.push_back(
                {corners[i], corners[i + 1 == n ? 0 : i + 1], around[i], names[i].above});
    }
    edges_.clear();
    for (std::size_t l = 0; l < line_count_; ++l) {
        const auto number = static_cast<std::uint8_t>(l);
        const auto runs = [&](bool above) {
            return std::ranges::any_of(
                all_, [&](const Edge& e) { return e.line == number && e.above == above; });
        };
        if (group.size() > 1 && runs(false) && runs(true)) {
            cancel_on(number);
        } else {
            std::ranges::copy_if(all_, std::back_inserter(edges_),
                                 [&](const Edge& e) { return e.line == number; });
        }
    }
    if (edges_.size() >= none) return false;
    for (std::size_t i = 0; i < edges_.size(); ++i)
        vertices_[edges_[i].from].first_edge = static_cast<std::uint8_t>(i);
    return true;
}

}  // namespace trisect::detail
