// SPDX-License-Identifier: Apache-2.0
//
// Nearest loop straight below another, which identifies the face of a hole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <trisect/brep/face/sweep_line.h>

namespace trisect::detail {

inline constexpr std::uint32_t no_loop = std::numeric_limits<std::uint32_t>::max();

/// For every loop of a figure, given by a corner of it at its smallest vertex, the loop that has
/// the highest edge straight below that vertex, or no_loop. The region lies between the two: so a
/// hole is in the face of the loop below it, which starts earlier, be it an outline or a hole.
///
/// Beside the members that SweepLine needs, `Figure` has `corner_count()`, `next(corner)` (edge c
/// leaves corner c) and `corners_in_order()`, sorted by vertex. One sweep, O(n log n).
template <class Figure>
std::vector<std::uint32_t> loops_below(const Figure& figure,
                                       std::span<const std::uint32_t> first_corners) {
    using Index = std::uint32_t;
    const std::size_t n = figure.corner_count();
    std::vector<Index> loop_of(n, no_loop);
    std::vector<Index> before(n);
    std::vector<Index> region(n);  // by corner: above the edge that leaves it
    for (Index l = 0; l < first_corners.size(); ++l) {
        Index c = first_corners[l];
        do {
            loop_of[c] = l;
            before[figure.next(c)] = c;
            c = figure.next(c);
        } while (c != first_corners[l]);
    }
    const auto runs_with_sweep = [&](Index c) { return figure.from(c) < figure.to(c); };
    SweepLine<Figure> line(figure);
    std::vector<Index> below(first_corners.size(), no_loop);
    const auto order = figure.corners_in_order();
    for (std::size_t i = 0; i < order.size();) {
        const Index vertex = figure.from(order[i]);
        std::size_t j = i;
        for (; j < order.size() && figure.from(order[j]) == vertex; ++j) {
            const Index c = order[j];
            if (first_corners[loop_of[c]] == c)
                if (const Index r = line.below(vertex); r != SweepLine<Figure>::none)
                    below[loop_of[c]] = loop_of[line.edge(r)];
            if (!runs_with_sweep(before[c])) continue;
            region[c] = region[before[c]];
            if (runs_with_sweep(c)) {
                line.advance(region[c], c);
            } else {
                line.close(region[c]);
            }
        }
        for (; i < j; ++i)
            if (runs_with_sweep(order[i]) && !runs_with_sweep(before[order[i]]))
                region[order[i]] = line.open(order[i]);
    }
    return below;
}

}  // namespace trisect::detail
