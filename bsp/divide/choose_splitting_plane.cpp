// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/divide/choose_splitting_plane.h>

#include <algorithm>
#include <cstddef>

namespace trisect::detail {

namespace {

// Above so many operands the boxes are not compared pair by pair.
constexpr std::size_t many_operands = 64;

struct Extents {
    PackedBox all;
    PackedBox contested;
};

Extents extents(const CellTask& task) {
    Extents e;
    std::size_t bounded = 0;
    for (const CellOperand& o : task.operands) {
        if (o.unbounded || o.box.is_empty()) continue;
        e.all.add(o.box);
        ++bounded;
    }
    const bool alone = bounded == 1 || bounded > many_operands;
    if (alone) {
        e.contested = e.all;
        return e;
    }
    for (std::size_t i = 0; i < task.operands.size(); ++i) {
        const CellOperand& a = task.operands[i];
        if (a.unbounded || a.box.is_empty()) continue;
        // What is in the box of the contested part by now adds nothing to it.
        if (e.contested.contains(a.box)) continue;
        if (!a.embedded) e.contested.add(a.box);
        for (std::size_t j = i + 1; j < task.operands.size(); ++j) {
            const CellOperand& b = task.operands[j];
            if (b.unbounded || b.box.is_empty()) continue;
            const PackedBox both = a.box.intersected(b.box);
            if (!both.is_empty()) e.contested.add(both);
        }
    }
    if (e.contested.is_empty()) e.contested = e.all;  // all disjoint: cut in the middle
    return e;
}

bool has_half_space(const CellTask& task) {
    return std::ranges::any_of(task.operands, [](const CellOperand& o) { return o.unbounded; });
}

// A wall beside all that is bounded, where the cell goes on for more than the extent of that.
std::optional<SplittingPlane> wall_of_bounded(const CellTask& task, const PackedBox& all,
                                              std::int64_t offset) {
    std::int64_t extent = 1;
    for (std::size_t k = 0; k < 3; ++k)
        extent = std::max(extent, task.frame.last_below(k, all.high(k) + 1) -
                                      task.frame.last_below(k, all.low(k)));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t low = task.frame.last_below(k, all.low(k));
        const std::int64_t high = task.frame.last_below(k, all.high(k) + 1);
        const int axis = static_cast<int>(k);
        if (low - lattice_below(task.cell.lo[k]) > extent)
            return SplittingPlane{axis, low * splitting_scale + offset};
        if (lattice_below(task.cell.hi[k]) - high > extent)
            return SplittingPlane{axis, high * splitting_scale + offset};
    }
    return std::nullopt;
}

}  // namespace

int contested_extent(const CellTask& task) {
    const PackedBox b = extents(task).contested;
    int longest = 0;
    if (b.is_empty()) return longest;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, b.high(k) - b.low(k));
    return longest;
}

std::optional<SplittingPlane> choose_splitting_plane(const CellTask& task, std::int64_t offset) {
    const Extents e = extents(task);
    if (e.all.is_empty()) return std::nullopt;
    if (has_half_space(task))
        if (const auto wall = wall_of_bounded(task, e.all, offset)) return wall;
    const auto below = [&](std::size_t axis, int q) {
        return SplittingPlane{static_cast<int>(axis),
                              task.frame.last_below(axis, q) * splitting_scale + offset};
    };
    std::optional<SplittingPlane> splitter;
    double best_trim = 0.3;
    for (std::size_t k = 0; k < 3; ++k) {
        const double extent = e.all.high(k) - e.all.low(k);
        if (extent <= 0) continue;
        const double low = (e.contested.low(k) - e.all.low(k)) / extent;
        const double high = (e.all.high(k) - e.contested.high(k)) / extent;
        if (low > best_trim) {
            best_trim = low;
            splitter = below(k, e.contested.low(k));
        }
        if (high > best_trim) {
            best_trim = high;
            splitter = below(k, e.contested.high(k) + 1);
        }
    }
    if (splitter) return splitter;
    int longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const int extent = e.contested.high(k) - e.contested.low(k);
        if (extent <= longest) continue;
        longest = extent;
        splitter = below(k, e.contested.low(k) + (extent + 1) / 2);
    }
    return splitter;
}

}  // namespace trisect::detail
